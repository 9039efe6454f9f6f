#pragma once
// Telegrams on one wire of a capture with as few as two samples a bit.
#include <vector>

#include "bus/telegram/telegram.hpp"
#include "lab/calibrate/time_base.hpp"
#include "lab/calibrate/wires.hpp"

namespace dsdpv1::calibrate {

struct LineTelegram {
  Tick start = 0;       ///< the first start bit falls
  Tick last_start = 0;  ///< the last one
  int baud = 0;         ///< index of bus/baud.hpp
  bool right = false;   ///< else not a telegram at any rate
  bool gap =
      false;  ///< within the error of an edge there may be a gap of more than 1 bit time, which makes it void (S10)
  bus::Telegram telegram = {};
  bus::Bytes bytes = {};  ///< if it is not a telegram: its right characters at the beginning
  Tick last_edge = 0;     ///< if it is not a telegram

  /// Cycles of one bit at its rate.
  double bit() const { return TimeBase::nominal(bus::baud(baud).bit); }
  /// True when a bit has fewer than four samples: then a fault may exist only in the capture.
  bool coarse(const TimeBase& time) const { return time.period * 4 > bit() + 0.01; }
  /// Cycles from the start bit of the last character to the decision: 12 bit times, the synchroniser, the edge (3 to
  /// 4).
  Span decision() const { return {12 * bit() + 3, 12 * bit() + 4}; }
  Tick end() const { return last_start + characters(1); }
  /// From its end to the latest begin of an answer (S3).
  Tick max_tsdr() const { return bus::baud(baud).max_tsdr_bits * bus::baud(baud).bit; }
  /// When a receiver takes the line to be idle. If it is not a telegram: from its last edge on, or up to a character
  /// later.
  Tick idle_from() const { return right ? end() : last_edge; }
  Tick idle_until() const { return right ? end() : last_edge + characters(1); }
  /// It ends within the character after its right ones, of which there is at least one.
  bool breaks_off() const { return !right && !bytes.empty() && last_edge < start + characters(bytes.size() + 1); }

 private:
  Tick characters(std::size_t count) const {
    return static_cast<Tick>(count) * bus::kCharacterBits * bus::baud(baud).bit;
  }
};

/// Everything on PBRXD, in order of time: a low level of less than half a bit is not a start bit (S10).
std::vector<LineTelegram> telegrams_received(const Trace& trace, const TimeBase& time);
/// Everything on PBTXD. `received`: their rates are tried first.
std::vector<LineTelegram> telegrams_sent(const Trace& trace, const TimeBase& time,
                                         const std::vector<LineTelegram>& received);

}  // namespace dsdpv1::calibrate
