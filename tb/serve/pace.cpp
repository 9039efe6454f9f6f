#include "tb/serve/pace.hpp"

#include <algorithm>
#include <utility>

namespace dsdpv1::tb::serve {

namespace {
constexpr Tick kNoLag = 2 * bus::kTicksPerMs;  ///< normal delay of sleeping and waking
}

std::chrono::nanoseconds to_wall(Tick ticks) { return std::chrono::nanoseconds(ticks / bus::kTicksPerNs); }
Tick to_ticks(std::chrono::nanoseconds time) { return static_cast<Tick>(time.count()) * bus::kTicksPerNs; }

Pace::Pace(std::function<WallTime()> now, Tick simulated)
    : now_(std::move(now)), origin_(now_() - to_wall(simulated)), kept_up_(now_()), kept_up_at_(simulated) {}

Tick Pace::target() const { return to_ticks(now_() - origin_); }

WallTime Pace::wall(Tick at) const { return origin_ + to_wall(at); }

std::optional<Pace::Loss> Pace::check(Tick simulated) {
  const WallTime now = now_();
  const Tick lag = to_ticks(now - origin_) - simulated;
  if (lag <= kNoLag) {
    kept_up_ = now;
    kept_up_at_ = simulated;
    allowed_ = kMostLag;
  }
  if (allowed_ == kMostLag) note(lag);
  if (lag <= allowed_) return std::nullopt;
  const Tick meanwhile = to_ticks(now - kept_up_);
  const Loss loss{lag,
                  meanwhile > 0 ? static_cast<double>(simulated - kept_up_at_) / static_cast<double>(meanwhile) : 0};
  origin_ += to_wall(lag);
  kept_up_ = now;
  kept_up_at_ = simulated;
  allowed_ = kMostLag;
  ++statistics_.losses;
  statistics_.lost += lag;
  return loss;
}

void Pace::note(Tick lag) {
  const double error_us = static_cast<double>(std::max<Tick>(lag, 0)) / static_cast<double>(bus::kTicksPerUs);
  ++statistics_.samples;
  statistics_.error_sum_us += error_us;
  statistics_.error_max_us = std::max(statistics_.error_max_us, error_us);
}

}  // namespace dsdpv1::tb::serve
