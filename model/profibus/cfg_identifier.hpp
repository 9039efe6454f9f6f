#pragma once
// Configuration identifiers of Check_Cfg (EN 50170, APC3 tables A.3 to A.5), taken byte by byte as they arrive.
#include <cstdint>

namespace dsdpv1::profibus {

/// Adds up the input and output bytes that a sequence of identifiers describes.
class CfgLengths {
 public:
  void add(std::uint8_t byte);
  int input() const { return input_; }
  int output() const { return output_; }
  bool complete() const { return state_ == State::kIdentifier; }  ///< the last identifier has all its bytes

 private:
  enum class State : std::uint8_t { kIdentifier, kOutputLength, kInputLength, kManufacturer };
  void compact(std::uint8_t byte);
  void special(std::uint8_t byte);
  void after_lengths();

  State state_ = State::kIdentifier;
  bool input_follows_ = false;
  int manufacturer_ = 0;  // manufacturer specific bytes still to come
  int input_ = 0, output_ = 0;
};

CfgLengths cfg_lengths(const std::uint8_t* bytes, int size);

}  // namespace dsdpv1::profibus
