#pragma once
// FNV-1a, 64 bits: tells contents apart; not a protection against intent.
#include <cstdint>
#include <string_view>

namespace dsdpv1::tb {

class Hash {
 public:
  void add(std::string_view bytes) {
    for (const char c : bytes) add_byte(static_cast<unsigned char>(c));
  }
  /// Its eight bytes, the lowest first.
  void add(std::uint64_t number) {
    for (int i = 0; i < 8; ++i) add_byte(number >> (8 * i) & 0xFFU);
  }
  std::uint64_t value() const { return hash_; }

 private:
  void add_byte(std::uint64_t byte) { hash_ = (hash_ ^ byte) * 0x100000001B3U; }

  std::uint64_t hash_ = 0xCBF29CE484222325U;
};

}  // namespace dsdpv1::tb
