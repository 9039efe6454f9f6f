#pragma once
// The inputs that the standard user program gives to its chip, for any chip.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "tb/chip/user_cpu/program.hpp"

namespace dsdpv1::user_cpu {

class ProgramInputs {
 public:
  /// `options` must outlive it.
  explicit ProgramInputs(const ProgramOptions& options) : options_(options) {}

  /// command::SetInputs: these from now on.
  void set(const std::vector<std::uint8_t>& bytes) { set_ = bytes; }
  bool are_set() const { return set_.has_value(); }
  /// command::WrongLength: the next ones are one byte longer, or shorter if that is impossible.
  void spoil_length() { wrong_length_ = true; }

  /// The next ones, with `length` bytes unless they are set. `outputs`: the last ones. `most`: bytes that the chip
  /// takes.
  std::vector<std::uint8_t> next(std::size_t length, const std::vector<std::uint8_t>& outputs, std::size_t most);

 private:
  const ProgramOptions& options_;
  std::optional<std::vector<std::uint8_t>> set_;
  std::uint8_t count_ = 0;
  bool wrong_length_ = false;
};

inline std::vector<std::uint8_t> ProgramInputs::next(std::size_t length, const std::vector<std::uint8_t>& outputs,
                                                     std::size_t most) {
  std::vector<std::uint8_t> inputs;
  if (set_) {
    inputs = *set_;
  } else if (options_.inputs == InputSource::kCount) {
    inputs.assign(length, count_++);
  } else {
    inputs = options_.inputs == InputSource::kLoopBack ? outputs : options_.constant;
    inputs.resize(length);
  }
  if (std::exchange(wrong_length_, false)) inputs.resize(inputs.size() < most ? inputs.size() + 1 : inputs.size() - 1);
  return inputs;
}

}  // namespace dsdpv1::user_cpu
