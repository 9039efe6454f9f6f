#pragma once
// Converts times of packets to ticks.
#include <cmath>
#include <cstdint>
#include <optional>

#include "bus/capture/captured_telegram.hpp"
#include "bus/time.hpp"

namespace dsdpv1::bus::capture {

/// The clock of a capture: whole seconds since 1970 and a part of a second.
class PacketClock {
 public:
  /// `units` since 1970 and `offset_s`, of `per_second` each. Throws CaptureError for a time that is years from that of
  /// the first packet.
  Tick at(std::uint64_t units, std::uint64_t per_second, std::int64_t offset_s = 0) {
    constexpr std::int64_t kDay = 24 * 3600, kMostApart = 20LL * 365 * kDay, kFarthest = 1LL << 40U;
    const std::uint64_t whole = units / per_second;
    if (whole > kFarthest || offset_s > kFarthest || offset_s < -kFarthest) fail();
    const std::int64_t seconds = static_cast<std::int64_t>(whole) + offset_s;
    if (!first_s_) first_s_ = seconds >= 0 && seconds < kDay ? 0 : seconds;
    const std::int64_t since = seconds - *first_s_;
    if (since > kMostApart || since < -kMostApart) fail();
    const double part = static_cast<double>(units % per_second) / static_cast<double>(per_second);
    return since * kTicksPerSecond + std::llround(part * static_cast<double>(kTicksPerSecond));
  }

 private:
  [[noreturn]] static void fail() {
    throw CaptureError("packets more than 20 years apart, expected times of one capture");
  }

  std::optional<std::int64_t> first_s_;
};

}  // namespace dsdpv1::bus::capture
