#pragma once
// XCTS (A35): while it is high an answer waits, and is dropped after a time.
#include "model/profibus/station.hpp"
#include "model/profibus/synchroniser.hpp"
#include "model/spc3/reasons.hpp"

namespace dsdpv1::spc3 {

class ClearToSend {
 public:
  /// `wait`: bit times.
  ClearToSend(profibus::EventLog& log, profibus::Cycle wait) : log_(log), wait_(wait) {}

  void set(profibus::Tick at, bool level) {
    pin_ = level;
    xcts_.set(at, level);
  }
  bool pin() const { return pin_; }
  /// The edge of `now`, before the station's.
  void eval(profibus::Cycle now, profibus::Station& station) {
    xcts_.eval(now);
    if (!xcts_.level() || !station.begins_answer(now)) return;
    if (now != waited_ + 1) since_ = now;
    waited_ = now;
    if (now - since_ < wait_ * station.bit()) return station.postpone_answer(1);
    log_.at_cycle(now, Reason::kNotClear, static_cast<unsigned>(wait_));
    station.drop_answer();
  }
  profibus::Cycle next() const { return xcts_.next(); }

  template <class Archive>
  void store(Archive& archive) {
    auto& [log, wait, xcts, pin, since, waited] = *this;
    archive.given(log, wait);
    archive(xcts, pin);
    archive.cycles(since, waited);
  }

 private:
  profibus::EventLog& log_;
  const profibus::Cycle wait_;
  profibus::Synchroniser xcts_{false};
  bool pin_ = false;
  profibus::Cycle since_ = 0, waited_ = -1;  // the first and the last cycle of the present wait
};

}  // namespace dsdpv1::spc3
