#pragma once
// How a chip's two sending pins reach the line on a board with an RS-485 driver.
#include <vector>

#include "bus/wire/segment.hpp"

namespace dsdpv1::tb {

/// One pin enables the driver, the other is what it drives. What the chip does inside of a call is told to the line
/// after the call, because the line answers, which may change the chip again.
class LineDriver {
 public:
  LineDriver(bus::Segment& segment, bus::StationId station) : segment_(segment), station_(station) {}

  void enable(bus::Tick at, bool enabled) {
    enabled_ = enabled;
    due_.push_back({at, enabled_, level_});
  }
  void drive(bus::Tick at, bool level) {
    level_ = level;
    due_.push_back({at, enabled_, level_});
  }
  /// Whether something has not been told yet, and since when.
  bool waits() const { return next_ < due_.size(); }
  bus::Tick since() const { return due_[next_].at; }
  /// What the chip does to the line from now on is told otherwise, up to a `resume` with the level of then, or the end:
  /// the one change that waits, of the level, is not told.
  bool only_level_waits() const { return waits() && next_ + 1 == due_.size() && enabled_; }
  void forget_level() {
    due_.clear();
    next_ = 0;
    level_ = true;
  }
  void resume(bool level) { level_ = level; }
  /// Tells the line; the list may grow meanwhile.
  void pass_on() {
    for (; next_ < due_.size(); ++next_) {
      const Change change = due_[next_];
      segment_.drive(station_, change.at, change.enabled, change.level);
    }
    due_.clear();
    next_ = 0;
  }

 private:
  struct Change {
    bus::Tick at;
    bool enabled, level;
  };
  bus::Segment& segment_;
  bus::StationId station_;
  bool enabled_ = false, level_ = true;
  std::vector<Change> due_;
  std::size_t next_ = 0;
};

}  // namespace dsdpv1::tb
