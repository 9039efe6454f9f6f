#pragma once
// The progress bar of a long run, on the terminal's error channel.
#include <chrono>
#include <string>

#include "bus/time.hpp"

namespace tb {

class Progress {
 public:
  /// Draws nothing when not `wanted`.
  Progress(bus::Tick end, bool wanted) : end_(end), wanted_(wanted) {}
  /// Redraws when the last drawing is a tenth of a second old.
  void show(bus::Tick now);
  /// Removes the bar.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;
  bus::Tick end_;
  bool wanted_, drawn_ = false;
  Clock::time_point begin_ = Clock::now(), last_ = Clock::now();
};

/// The bar's text: "[#####     ]  50 %  60ms of 120ms  0.85 x real time  2 s left".
std::string progress_text(bus::Tick now, bus::Tick end, double wall_s);

}  // namespace tb
