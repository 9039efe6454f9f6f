#include "model/systemc/bound_clock.hpp"

#include <algorithm>
#include <cmath>

#include "model/systemc/sim_time.hpp"

namespace dsdpv1::systemc {
namespace {

constexpr double kNominalMhz = 48.0;
constexpr Tick kHalf = profibus::kTicksPerCycle / 2;

}  // namespace

void BoundClock::rising(const sc_core::sc_time& now) {
  ++cycle_;
  high_ = true;
  edge_ = now;
  if (cycle_ % kWindow == 0) close_window(now);
}

void BoundClock::falling(const sc_core::sc_time& now) {
  if (cycle_ < 0) return;
  high_ = false;
  edge_ = now;
}

Tick BoundClock::chip_tick(const sc_core::sc_time& now) const {
  if (cycle_ < 0) return 0;
  const Tick half = cycle_ * profibus::kTicksPerCycle + (high_ ? 0 : kHalf);
  return half + std::min(to_tick(now - edge_), kHalf - 1);
}

std::optional<double> BoundClock::take_wrong_frequency() {
  const std::optional<double> mhz = wrong_mhz_;
  wrong_mhz_.reset();
  return mhz;
}

void BoundClock::close_window(const sc_core::sc_time& now) {
  if (cycle_ > 0 && !reported_ && measures_) {
    const double mhz = static_cast<double>(kWindow) / ((now - window_start_).to_seconds() * 1e6);
    reported_ = std::fabs(mhz / kNominalMhz - 1.0) * 1e6 > tolerance_ppm_;
    if (reported_) wrong_mhz_ = mhz;
  }
  window_start_ = now;
  measures_ = true;
}

}  // namespace dsdpv1::systemc
