#pragma once
// Connects a chip's two sending pins to the line through a board's RS-485 driver.
#include <vector>

#include "bus/wire/segment.hpp"

namespace dsdpv1::tb {

/// One pin enables the driver, the other is its input. Changes made inside a call of the chip are passed to the line
/// after the call, because the line reacts, which may change the chip again.
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
  /// Whether changes are pending, and since when.
  bool waits() const { return next_ < due_.size(); }
  bus::Tick since() const { return due_[next_].at; }
  /// The chip's changes of the line are reported in another way from now on, up to a `resume` with the level of that
  /// time, or the end: the one pending change, of the level, is dropped.
  bool only_level_waits() const { return waits() && next_ + 1 == due_.size() && enabled_; }
  void forget_level() {
    due_.clear();
    next_ = 0;
    level_ = true;
  }
  void resume(bool level) { level_ = level; }
  /// Passes the changes to the line; the list may grow meanwhile.
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
