#pragma once
// The progress bar of a long run, on the terminal's error channel.
#include <chrono>
#include <cstddef>
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

/// The same for work that is counted.
class CountProgress {
 public:
  CountProgress(std::size_t all, bool wanted) : all_(all), wanted_(wanted) {}
  /// Redraws when something was done, or the last drawing is a second old.
  void show(std::size_t done);
  void clear() const;

 private:
  using Clock = std::chrono::steady_clock;
  std::size_t all_, shown_ = 0;
  bool wanted_;
  Clock::time_point begin_ = Clock::now(), last_ = begin_;
};

/// The bar's text: "[#####     ]  50 %  60ms of 120ms  0.85 x real time  2 s left".
std::string progress_text(bus::Tick now, bus::Tick end, double wall_s);
/// "[#####     ]  32 of 64 points  5 s".
std::string count_text(std::size_t done, std::size_t all, double wall_s);

}  // namespace tb
