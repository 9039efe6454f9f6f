#pragma once
// Keeps simulated time at real time. The computer is never ahead intentionally; when it is behind it catches up, and
// lag beyond a limit is given up: simulated time then stays behind by a reported amount.
#include <functional>
#include <optional>

#include "bus/time.hpp"
#include "tb/serve/framing.hpp"
#include "tb/serve/statistics.hpp"

namespace dsdpv1::tb::serve {

using bus::Tick;

class Pace {
 public:
  /// The largest lag that is made up; more is given up.
  static constexpr Tick kMostLag = 100 * bus::kTicksPerMs;

  /// Time given up, and the speed of the computer meanwhile (1 = real time).
  struct Loss {
    Tick lag = 0;
    double speed = 0;
  };

  /// `now` is the clock; simulated time is `simulated` at present.
  Pace(std::function<WallTime()> now, Tick simulated);

  WallTime now() const { return now_(); }
  /// The present target of simulated time.
  Tick target() const;
  /// The real time for simulated time `at`.
  WallTime wall(Tick at) const;
  /// Simulated time was stopped intentionally for `held`: so much more lag may be made up.
  void hold(Tick held) { allowed_ = kMostLag + held; }
  /// Simulated time is now `simulated`. Returns a loss if it lags too much; the lag is then dropped.
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
