#pragma once
// Times of samples taken at a fixed rate.
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>

#include "bus/time.hpp"

namespace dsdpv1::bus::capture {

/// Samples a second, 1 to 10^12.
class SampleClock {
 public:
  explicit SampleClock(std::uint64_t per_second) : per_second_(per_second) {}
  /// Computed from the absolute number, so nothing drifts.
  Tick at(std::uint64_t sample) const {
    const auto part = static_cast<double>(sample % per_second_) / static_cast<double>(per_second_);
    return static_cast<Tick>(sample / per_second_) * kTicksPerSecond +
           std::llround(part * static_cast<double>(kTicksPerSecond));
  }

 private:
  std::uint64_t per_second_;
};

/// "24000000", "24 MHz", "500 kHz"; nullopt for another text.
std::optional<std::uint64_t> sample_rate(const std::string& text);

}  // namespace dsdpv1::bus::capture
