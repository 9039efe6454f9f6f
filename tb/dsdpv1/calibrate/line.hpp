#pragma once
// Telegrams on one wire of a capture with as few as two samples a bit.
#include <vector>

#include "bus/telegram/telegram.hpp"
#include "tb/dsdpv1/calibrate/time_base.hpp"
#include "tb/dsdpv1/calibrate/wires.hpp"

namespace calibrate {

struct LineTelegram {
  Tick start = 0;       ///< the first start bit falls
  Tick last_start = 0;  ///< the last one
  int baud = 0;         ///< index of bus/baud.hpp
  bool right = false;   ///< else something that is no telegram at any rate
  bus::Telegram telegram = {};
  bus::Bytes bytes = {};

  /// Cycles of one bit at its rate.
  double bit() const { return TimeBase::nominal(bus::baud(baud).bit); }
  /// Whether fewer than four samples make a bit: what is not right may be so only in the capture.
  bool coarse(const TimeBase& time) const { return time.period * 4 > bit() + 0.01; }
  /// Cycles from the start bit of the last character to the decision: 12 bit times, the synchroniser, the edge (3 to
  /// 4).
  Span decision() const { return {12 * bit() + 3, 12 * bit() + 4}; }
  Tick end() const { return last_start + bus::kCharacterBits * bus::baud(baud).bit; }
};

/// All of them, in order of time. `rates`: telegrams of another wire, whose rates are tried first.
std::vector<LineTelegram> telegrams_of(const Trace& trace, const TimeBase& time,
                                       const std::vector<LineTelegram>& rates = {});

}  // namespace calibrate
