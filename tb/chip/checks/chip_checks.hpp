#pragma once
// The rules of one chip's user side, judged from its pins, the user's accesses and the telegrams on the line. So they
// apply equally to every user CPU, every engine and foreign RTL; only rules about what the chip refuses need its
// events.
#include <cstdint>
#include <functional>

#include "bus/monitor/monitor.hpp"
#include "tb/chip/checks/recorder.hpp"
#include "tb/chip/pins/pins.hpp"

namespace dsdpv1::profibus {
struct Event;
}

namespace dsdpv1::checks {

class ChipChecks {
 public:
  virtual ~ChipChecks() = default;

  /// A change of a pin. The first changes are relative to the levels of a newly constructed chip. Ticks never decrease;
  /// pins that change at the same tick may come in any order.
  virtual void pin(Tick at, tb::PinNumber pin, tb::Level level) = 0;
  /// Several changes, in their order.
  virtual void pins(const tb::PinEdge* first, const tb::PinEdge* last) {
    for (; first != last; ++first) pin(first->at, first->pin, first->level);
  }
  /// Announces, before its first edge, a read that samples the data at `sample`. Only for user CPUs that report it,
  /// because the pins do not show it.
  virtual void read(Tick /*sample*/) {}
  /// The user CPU tells its looks at the chip's pins: without `looked` there was none. Before the first change.
  virtual void hears_looks() {}
  /// Announces, before the user acts on it, that it looked at `pin` last at `at`; negative: never.
  virtual void looked(tb::PinNumber /*pin*/, Tick /*at*/) {}
  /// An access that no pin shows, of a chip whose accesses can come so, at the tick at which it acts; a read with its
  /// answer.
  virtual void unseen_access(Tick /*at*/, std::uint16_t /*address*/, std::uint8_t /*value*/, bool /*write*/) {}
  /// A telegram of any station that has ended, at `now`.
  virtual void telegram(Tick now, const bus::WireTelegram& telegram) = 0;
  /// Once, at the end of the run.
  virtual void finish(Tick end) = 0;

  /// Whether a check concerns the port that the chip's user has; a report omits the others.
  virtual bool applies(CheckId /*check*/) const { return true; }
  virtual const Record& record(CheckId check) const = 0;
  virtual const Limit& limit(CheckId check) const = 0;
  virtual void on_violation(std::function<void(const Violation&)> sink) = 0;

  /// An event of the chip, if there is a chip that tells; in order of time with the pins.
  virtual void event(const profibus::Event& /*event*/) {}
};

}  // namespace dsdpv1::checks
