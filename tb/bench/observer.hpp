#pragma once
// Observers receive the events of a run at chips, on the line, of user programs and masters: log, waves, checks, trace,
// script, the bench itself. All receive the same events, in the order in which they were added.
#include <algorithm>
#include <functional>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "bus/monitor/monitor.hpp"
#include "bus/timeline.hpp"
#include "tb/bench/record.hpp"
#include "tb/chip/checks/recorder.hpp"
#include "tb/chip/chip_view.hpp"
#include "tb/chip/host_reader.hpp"
#include "tb/chip/user_cpu/program.hpp"
#include "tb/scenario/scenario.hpp"

namespace dsdpv1::tb {

/// A telegram that has ended, at `now`; its text is made for the first caller.
class HeardTelegram {
 public:
  HeardTelegram(Tick at, const bus::WireTelegram& wire) : now(at), telegram(wire) {}
  const std::string& words() const;

  const Tick now;
  const bus::WireTelegram& telegram;

 private:
  mutable std::optional<std::string> words_;
};

/// Derived classes override the calls that they need, including those of ChipListener. Slaves are numbered as in the
/// scenario.
class Observer : public ChipListener {
 public:
  bool acts_on_events() const override { return false; }
  /// The run begins, `chip` has its power-on levels.
  virtual void begins(std::size_t /*slave*/, const ChipView& /*chip*/) {}
  virtual void telegram(const HeardTelegram& /*telegram*/) {}
  /// A violation found by the checks of tb/chip/checks, as soon as it is visible. `kind`: "check" if it is only
  /// reported, else "violation" or "allowed".
  virtual void violated(const std::string& /*slave*/, const checks::Violation& /*violation*/, const char* /*kind*/) {}
  /// A flag of the monitor; flags of a telegram come before it.
  virtual void flag(const bus::Flag& /*flag*/) {}
  /// A character after an invalid telegram, see bus::Monitor::on_skipped.
  virtual void skipped(const bus::ReceivedCharacter& /*character*/) {}
  /// A telegram between the slave and its user, on a serial host port; called when it has ended, which may be known
  /// only after a silence.
  virtual void host_telegram(std::size_t /*slave*/, const HostTelegram& /*telegram*/) {}
  /// A character, valid or not.
  virtual void character(Tick /*now*/, const bus::ReceivedCharacter& /*heard*/) {}
  // Output and actions of the slave's user program, see user_cpu::StationCpu.
  virtual void error(std::size_t /*slave*/, const user_cpu::ProgramError& /*error*/) {}
  virtual void text(std::size_t /*slave*/, Tick /*at*/, const std::string& /*line*/) {}
  /// It has fetched outputs; `changed`: they differ from the previous ones.
  virtual void outputs(std::size_t /*slave*/, Tick /*at*/, const bus::Bytes& /*outputs*/, bool /*changed*/) {}
  /// Its processor cannot continue; `registers` has its state.
  virtual void user_failed(std::size_t /*slave*/, Tick /*at*/, const std::string& /*why*/,
                           const std::string& /*registers*/) {}
  /// Its debugger ends the run.
  virtual void killed() {}
  /// A code of the log was counted at a chip or "bus", `count` times so far.
  virtual void counted(Tick /*at*/, const std::string& /*station*/, const std::string& /*code*/, bool /*violation*/,
                       std::uint64_t /*count*/) {}
  /// The script is about to execute an action.
  virtual void acts(const scenario::Action& /*action*/, Tick /*now*/) {}
  /// The state of a slave in its master (class 1), or of a connection (class 2): `member` is its name.
  virtual void master_state(Tick /*now*/, const std::string& /*master*/, const std::string& /*member*/,
                            const std::string& /*state*/) {}
  /// A value that conditions of the scenario may refer to has changed.
  virtual void changed(Tick /*at*/) {}
};

/// Passes the chips' events to all observers, frequent ones to those whose class overrides the call.
class Observers : public ChipListener {
 public:
  /// `timeline` must outlive it.
  explicit Observers(const bus::Timeline& timeline) : timeline_(timeline) {}
  /// It must outlive the calls of `tell`. Of a plain Observer nothing is known: it is told everything.
  template <class Own>
  void add(Own& observer) {
    all_.push_back(&observer);
    const auto add_to = [&observer](std::vector<Observer*>& list, auto own, auto inherited) {
      if (std::is_same_v<Own, Observer> || !std::is_same_v<decltype(own), decltype(inherited)>)
        list.push_back(&observer);
    };
    add_to(of_pins_, &Own::pin, &ChipListener::pin);
    add_to(of_events_, &Own::event, &ChipListener::event);
    add_to(of_counts_, &Own::counted, &Observer::counted);
    add_to(of_changes_, &Own::changed, &Observer::changed);
    add_to(actors_, &Own::acts_on_events, &Observer::acts_on_events);
  }

  /// tell(&Observer::pin, slave, at, pin, level)
  template <class Listener, class... Parameters, class... Arguments>
  void tell(void (Listener::*what)(Parameters...), const Arguments&... arguments) const {
    for (Observer* each : all_) (each->*what)(arguments...);
  }

  /// Tells Observer::changed; in the TLM view chips act before the timeline has come to their tick.
  void changed(Tick at = 0) const {
    for (Observer* each : of_changes_) each->changed(std::max(at, timeline_.now()));
  }
  void counted(Tick at, const std::string& station, const std::string& code, bool violation,
               std::uint64_t count) const {
    for (Observer* each : of_counts_) each->counted(at, station, code, violation, count);
  }
  Tick now() const { return timeline_.now(); }

  /// Where the program of a slave's user CPU did something; set by the bench.
  std::function<std::optional<user_cpu::Place>(std::size_t slave, const user_cpu::Act& act)> where =
      [](std::size_t, const user_cpu::Act&) { return std::nullopt; };

  void pin(std::size_t slave, Tick at, PinNumber pin, Level level) override {
    for (Observer* each : of_pins_) each->pin(slave, at, pin, level);
  }
  void edges(std::size_t slave, const PinEdge* first, const PinEdge* last) override {
    for (Observer* each : of_pins_) each->edges(slave, first, last);
  }
  void interrupt(std::size_t slave, Tick at, bool level) override { tell(&Observer::interrupt, slave, at, level); }
  void event(std::size_t slave, const profibus::Event& event) override {
    for (Observer* each : of_events_) each->event(slave, event);
    changed(event.at);
  }
  bool acts_on_events() const override {
    for (const Observer* each : actors_)
      if (each->acts_on_events()) return true;
    return false;
  }
  void follows(std::size_t slave, PinNumber pin) override { tell(&Observer::follows, slave, pin); }
  void read(std::size_t slave, Tick sample) override { tell(&Observer::read, slave, sample); }
  void looked(std::size_t slave, PinNumber pin, Tick at) override { tell(&Observer::looked, slave, pin, at); }
  void inside(std::size_t slave, Tick at, std::size_t signal, Level level, const std::string& word) override {
    tell(&Observer::inside, slave, at, signal, level, word);
  }
  void accessed(std::size_t slave, Tick at, std::uint16_t address, std::uint8_t value, bool write) override {
    tell(&Observer::accessed, slave, at, address, value, write);
  }
  void action(std::size_t slave, Tick at, const std::string& words) override {
    tell(&Observer::action, slave, at, words);
  }

 private:
  const bus::Timeline& timeline_;
  std::vector<Observer*> all_, of_pins_, of_events_, of_counts_, of_changes_, actors_;
};

}  // namespace dsdpv1::tb
