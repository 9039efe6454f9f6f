#pragma once
// The accesses of a user CPU to a chip of the SPC3 family, derived from the pins of its bus alone.
#include "bus/time.hpp"
#include "model/spc3/bus_lines.hpp"
#include "tb/chip/pins/pins.hpp"

namespace dsdpv1::spc3_bus {

using bus::Tick;
using tb::Level;

/// One byte.
struct BusAccess {
  bool write = false;
  Level address = tb::kLevelX;  ///< in Intel order, at the begin and then at the answer or the end; kLevelX: unknown
  Level data = tb::kLevelX;     ///< of a write at its end, of a read its answer; kLevelX: unknown or none
  Tick began = 0;
};

class AccessSink {
 public:
  virtual ~AccessSink() = default;
  virtual void access_began(const BusAccess& /*access*/) {}
  /// DB has the answer of a read.
  virtual void read_answered(Tick /*at*/, const BusAccess& /*access*/) {}
  virtual void access_ended(Tick /*at*/, const BusAccess& /*access*/) {}
};

/// The straps of a board and its strobes at rest, from power-on; `set(pin, level)`.
template <class Set>
void strap(spc3::Bus bus, const Set& set) {
  set(spc3::Pin::kXIntMot, Level{spc3::is_motorola(bus)});
  set(spc3::Pin::kMode, Level{spc3::is_synchronous(bus)});
  set(spc3::Pin::kXWr, Level{bus != spc3::Bus::kMotorolaSync});
  set(spc3::Pin::kAle, Level{bus == spc3::Bus::kMotorolaAsync});
}

class BusReader {
 public:
  /// `bus`: the straps, until pin() moves them.
  explicit BusReader(AccessSink& sink, spc3::Bus bus = spc3::Bus::kIntelAsync) : sink_(sink) {
    strap(
        bus, [this](spc3::Pin pin, Level level) { lines_.set(pin, level); });
  }

  /// A change of a pin of spc3::Pin, in order of time; inputs at one tick in the order of their numbers.
  void pin(Tick at, tb::PinNumber pin, Level level);
  const spc3::BusLines& lines() const { return lines_; }
  bool accessing() const { return running_; }

 private:
  void reset(bool high);
  void follow(Tick at);

  AccessSink& sink_;
  spc3::BusLines lines_;
  BusAccess access_;
  bool in_reset_ = true, running_ = false;
};

}  // namespace dsdpv1::spc3_bus
