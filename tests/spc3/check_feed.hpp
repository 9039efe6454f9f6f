#pragma once
// The checks of the user's side beside a chip of bench.hpp: they get its pins, its events, the telegrams on the line,
// and the accesses that the test passes on.
#include <set>
#include <string>

#include "bus/monitor/monitor.hpp"
#include "tests/spc3/bench.hpp"
#include "tests/spc3/script.hpp"

namespace dsdpv1::spc3_test {

class CheckFeed {
 public:
  /// `bench` must outlive it.
  CheckFeed(Bench& bench, Variant variant)
      : bench_(bench), monitor_(bench.segment), checks_(limits(), variant, script_pins()) {
    bench.timeline.add(monitor_);
    monitor_.on_telegram = [this](const bus::WireTelegram& telegram) {
      catch_up();
      checks_.telegram(bench_.now(), telegram);
    };
    checks_.on_violation([this](const checks::Violation& violation) {
      broken.insert(spc3_checks::rules().at(violation.check.index).id);
      texts += violation.text + "\n";
    });
  }
  CheckFeed(const CheckFeed&) = delete;
  CheckFeed& operator=(const CheckFeed&) = delete;

  void released() { checks_.pin(bench_.now(), static_cast<tb::PinNumber>(Pin::kReset), 0); }
  void accessed(Address address, std::uint8_t value, bool write) {
    catch_up();
    checks_.accessed({bench_.now(), address, value, write});
  }
  void finish() {
    catch_up();
    checks_.finish(bench_.now());
  }

  std::set<std::string> broken;  ///< ids of rules
  std::string texts;

 private:
  /// The tests are short.
  static checks::Limits limits() {
    checks::Limits all(spc3_checks::rules());
    for (const Check each : {Check::kAckTime, Check::kIrqEoi}) all[each].value = 2 * bus::kTicksPerMs;
    return all;
  }
  void catch_up() {
    const auto& trace = bench_.twins.trace;
    const auto& events = bench_.twins.events;
    while (pin_ < trace.size() || event_ < events.size()) {
      if (event_ == events.size() || (pin_ < trace.size() && trace[pin_].at <= events[event_].at)) {
        const PinChange& each = trace[pin_++];
        checks_.pin(each.at, static_cast<tb::PinNumber>(each.pin), each.level);
      } else {
        checks_.event(events[event_++]);
      }
    }
  }

  Bench& bench_;
  bus::Monitor monitor_;
  spc3_checks::Checks checks_;
  std::size_t pin_ = 0, event_ = 0;
};

}  // namespace dsdpv1::spc3_test
