#pragma once
// The progress bar of a long run, on the terminal's error channel.
#include <chrono>
#include <cstddef>
#include <string>
#include <utility>

#include "bus/time.hpp"

namespace dsdpv1::tb {

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
  /// `what`: "points".
  CountProgress(std::size_t all, std::string what, bool wanted) : all_(all), what_(std::move(what)), wanted_(wanted) {}
  /// So many were done before; they say nothing about how long the others take.
  void begin(std::size_t done) { before_ = done; }
  /// Redraws when something was done, or the last drawing is a second old.
  void show(std::size_t done);
  void clear() const;

 private:
  using Clock = std::chrono::steady_clock;
  std::size_t all_, before_ = 0, shown_ = 0;
  std::string what_;
  bool wanted_;
  Clock::time_point begin_ = Clock::now(), last_ = begin_;
};

/// The same for work of which the part that is done is known.
class ShareProgress {
 public:
  explicit ShareProgress(bool wanted) : wanted_(wanted) {}
  /// `done` from 0 to 1; redraws when the last drawing is a tenth of a second old.
  void show(double done);
  void clear() const;

 private:
  using Clock = std::chrono::steady_clock;
  bool wanted_;
  Clock::time_point begin_ = Clock::now(), last_ = begin_;
};

/// "[#####     ]  16 %  5 s left".
std::string share_text(double done, double wall_s);
/// The bar's text: "[#####     ]  50 %  60ms of 120ms  0.85 x real time  2 s left".
std::string progress_text(bus::Tick now, bus::Tick end, double wall_s);

/// Of `all`, `done` are done, `before` of them when the clock started.
struct Count {
  std::size_t done = 0, all = 0, before = 0;
};
/// "[#####     ]  32 of 64 points  5 s, 5 s left".
std::string count_text(const Count& count, const std::string& what, double wall_s);

}  // namespace dsdpv1::tb
