#pragma once
// Who hears what happens at chips and on the line: log, waves, checks, trace, script. The bench tells all of them the
// same, in the order in which they were added. It builds and finishes them, and what is only for the log it says there.
#include <optional>
#include <string>
#include <vector>

#include "bus/monitor/monitor.hpp"
#include "model/profibus/event.hpp"
#include "tb/bench/record.hpp"
#include "tb/chip/checks/recorder.hpp"
#include "tb/chip/host_reader.hpp"
#include "tb/chip/pins/pins.hpp"

namespace dsdpv1::tb {

/// A telegram that has ended, heard at `now`; its words are made for the first who asks.
class HeardTelegram {
 public:
  HeardTelegram(Tick at, const bus::WireTelegram& wire) : now(at), telegram(wire) {}
  const std::string& words() const;

  const Tick now;
  const bus::WireTelegram& telegram;

 private:
  mutable std::optional<std::string> words_;
};

/// Overrides what concerns it. Slaves are numbered as in the scenario.
class Observer {
 public:
  virtual ~Observer() = default;

  /// The run begins, `chip` has the levels of power-on.
  virtual void begins(std::size_t /*slave*/, const ChipView& /*chip*/) {}
  virtual void pin(std::size_t /*slave*/, Tick /*at*/, PinNumber /*pin*/, Level /*level*/) {}
  /// The slave's user CPU begins a read and samples the data then, see ChipView::on_read.
  virtual void read(std::size_t /*slave*/, Tick /*sample*/) {}
  virtual void event(std::size_t /*slave*/, const profibus::Event& /*event*/) {}
  virtual void telegram(const HeardTelegram& /*telegram*/) {}
  /// What the checks of tb/chip/checks find, as soon as it can be seen.
  virtual void violated(const std::string& /*slave*/, const checks::Violation& /*violation*/) {}
  /// What the monitor flags; what is flagged of a telegram comes before it.
  virtual void flag(const bus::Flag& /*flag*/) {}
  /// A character after a wrong telegram, see bus::Monitor::on_skipped.
  virtual void skipped(const bus::ReceivedCharacter& /*character*/) {}
  /// Between the slave and its user, on a serial host port; told when it has ended, which a silence may have to show.
  virtual void host_telegram(std::size_t /*slave*/, const HostTelegram& /*telegram*/) {}
  /// Right or not.
  virtual void character(Tick /*now*/, const bus::ReceivedCharacter& /*heard*/) {}
  /// See ChipView::on_inside and on_action.
  virtual void inside(std::size_t /*slave*/, Tick /*at*/, std::size_t /*signal*/, Level /*level*/,
                      const std::string& /*word*/) {}
  virtual void action(std::size_t /*slave*/, Tick /*at*/, const std::string& /*words*/) {}
  /// What a master makes of a slave (class 1), or the state of a connection (class 2): `member` is its name.
  virtual void master_state(Tick /*now*/, const std::string& /*master*/, const std::string& /*member*/,
                            const std::string& /*state*/) {}
  /// Something that a condition of the scenario may be about has changed.
  virtual void changed(Tick /*at*/) {}
};

class Observers {
 public:
  /// It must outlive the calls of `tell`.
  void add(Observer& observer) { all_.push_back(&observer); }

  /// tell(&Observer::pin, slave, at, pin, level)
  template <class... Parameters, class... Arguments>
  void tell(void (Observer::*what)(Parameters...), const Arguments&... arguments) const {
    for (Observer* each : all_) (each->*what)(arguments...);
  }

 private:
  std::vector<Observer*> all_;
};

}  // namespace dsdpv1::tb
