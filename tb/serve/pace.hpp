#pragma once
// Simulated time held to real time. The computer is never ahead on purpose; when it is behind it catches up, and what
// it cannot catch up is given up: simulated time then lags for good, by an amount that is reported.
#include <functional>
#include <optional>

#include "bus/time.hpp"
#include "tb/bench/record.hpp"
#include "tb/serve/framing.hpp"

namespace dsdpv1::tb::serve {

using bus::Tick;

class Pace {
 public:
  /// Lag that is still caught up.
  static constexpr Tick kMostLag = 100 * bus::kTicksPerMs;

  /// Time that was given up, and how fast the computer was meanwhile (1 = real time).
  struct Loss {
    Tick lag = 0;
    double speed = 0;
  };

  /// `now` is the clock; simulated time is `simulated` at this moment.
  Pace(std::function<WallTime()> now, Tick simulated);

  WallTime now() const { return now_(); }
  /// Where simulated time should be now.
  Tick target() const;
  /// When simulated time `at` should be.
  WallTime wall(Tick at) const;
  /// Simulated time stood still on purpose for `held`: so much more lag may be caught up.
  void hold(Tick held) { allowed_ = kMostLag + held; }
  /// Simulated time is `simulated` now. A loss when it lags too much; the lag is then forgotten.
  std::optional<Loss> check(Tick simulated);

  const PaceStatistics& statistics() const { return statistics_; }

 private:
  void note(Tick lag);

  std::function<WallTime()> now_;
  WallTime origin_, kept_up_;  ///< real time of tick 0; last time without lag
  Tick kept_up_at_;            ///< simulated time then
  Tick allowed_ = kMostLag;
  PaceStatistics statistics_;
};

std::chrono::nanoseconds to_wall(Tick ticks);
Tick to_ticks(std::chrono::nanoseconds time);

}  // namespace dsdpv1::tb::serve
