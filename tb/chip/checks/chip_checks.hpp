#pragma once
// The rules of one chip's user side, judged from outside: its pins and the telegrams on the line, nothing of what is
// behind the pins. So they hold the same way for every user CPU, every engine and foreign RTL.
#include <functional>

#include "bus/monitor/monitor.hpp"
#include "tb/chip/checks/recorder.hpp"
#include "tb/chip/pins/pins.hpp"

namespace dsdpv1::checks {

class ChipChecks {
 public:
  virtual ~ChipChecks() = default;

  /// A change of a pin. The first changes are those from the levels of a chip fresh from construction. Ticks never go
  /// back; pins that change at the same tick may come in any order.
  virtual void pin(Tick at, tb::PinNumber pin, tb::Level level) = 0;
  /// The user begins a read, told before its first edge, and samples the data at `sample`. Only for a user CPU that
  /// tells: at the pins nobody sees it.
  virtual void read(Tick /*sample*/) {}
  /// A telegram that has ended, of any station, heard at `now`.
  virtual void telegram(Tick now, const bus::WireTelegram& telegram) = 0;
  /// Once, at the end of the run.
  virtual void finish(Tick end) = 0;

  /// Whether a check is about the port that the chip's user has; a report leaves out the others.
  virtual bool applies(CheckId /*check*/) const { return true; }
  virtual const Record& record(CheckId check) const = 0;
  virtual const Limit& limit(CheckId check) const = 0;
  virtual void on_violation(std::function<void(const Violation&)> sink) = 0;
};

}  // namespace dsdpv1::checks
