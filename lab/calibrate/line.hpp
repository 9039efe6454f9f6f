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
  bool right = false;   ///< else something that is no telegram at any rate
  bool gap = false;  ///< within what an edge may be off there is one of more than 1 bit time, which makes it void (S10)
  bus::Telegram telegram = {};
  bus::Bytes bytes = {};  ///< of what is no telegram the right characters that it begins with
  Tick last_edge = 0;     ///< of what is no telegram

  /// Cycles of one bit at its rate.
  double bit() const { return TimeBase::nominal(bus::baud(baud).bit); }
  /// Whether fewer than four samples make a bit: what is not right may be so only in the capture.
  bool coarse(const TimeBase& time) const { return time.period * 4 > bit() + 0.01; }
  /// Cycles from the start bit of the last character to the decision: 12 bit times, the synchroniser, the edge (3 to
  /// 4).
  Span decision() const { return {12 * bit() + 3, 12 * bit() + 4}; }
  Tick end() const { return last_start + characters(1); }
  /// From its end to the latest begin of an answer (S3).
  Tick max_tsdr() const { return bus::baud(baud).max_tsdr_bits * bus::baud(baud).bit; }
  /// When a receiver takes the line to be idle: of what is no telegram from its last edge on, or up to a character
  /// later.
  Tick idle_from() const { return right ? end() : last_edge; }
  Tick idle_until() const { return right ? end() : last_edge + characters(1); }
  /// It ends within the character that follows its right ones, of which there is at least one.
  bool breaks_off() const { return !right && !bytes.empty() && last_edge < start + characters(bytes.size() + 1); }

 private:
  Tick characters(std::size_t count) const {
    return static_cast<Tick>(count) * bus::kCharacterBits * bus::baud(baud).bit;
  }
};

/// All that a chip hears on PBRXD, in order of time: a low level of less than half a bit is no start bit (S10).
std::vector<LineTelegram> telegrams_received(const Trace& trace, const TimeBase& time);
/// All that it sends. `received`: their rates are tried first.
std::vector<LineTelegram> telegrams_sent(const Trace& trace, const TimeBase& time,
                                         const std::vector<LineTelegram>& received);

}  // namespace dsdpv1::calibrate
