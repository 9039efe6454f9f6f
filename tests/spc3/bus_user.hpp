#pragma once
// A CPU at the pins of the bus, edge by edge.
#include "tests/spc3/bench.hpp"

namespace dsdpv1::spc3_test {

/// `bench` must outlive it. Times are ticks.
class BusUser {
 public:
  static constexpr Tick kStrobe = 2500;  ///< long enough for ready

  explicit BusUser(Bench& bench) : bench_(bench) {}

  void set(Pin pin, spc3::Level level) { bench_.twins.set(bench_.now(), pin, level); }
  void wait(Tick time) { bench_.run_until(bench_.now() + time); }

  void begin_read(Address address) { begin(Pin::kXRd, address); }
  void begin_write(Address address, spc3::Level value) {
    set(Pin::kDbIn, value);
    begin(Pin::kXWr, address);
  }
  void end() {
    set(Pin::kXRd, 1);
    set(Pin::kXWr, 1);
    set(Pin::kXCs, 1);
    set(Pin::kDbIn, spc3::kLevelZ);
  }
  spc3::Level end_read() {
    const spc3::Level value = bench_.twins.sample(bench_.now());
    end();
    return value;
  }
  /// An access and a pause.
  spc3::Level read(Address address, Tick strobe = kStrobe) {
    begin_read(address);
    wait(strobe);
    const spc3::Level value = end_read();
    wait(1000);
    return value;
  }
  void write(Address address, std::uint8_t value, Tick strobe = kStrobe) {
    begin_write(address, value);
    wait(strobe);
    end();
    wait(1000);
  }

 private:
  void begin(Pin strobe, Address address) {
    set(Pin::kAb, static_cast<spc3::Level>(address));
    set(Pin::kXCs, 0);
    set(strobe, 0);
  }
  Bench& bench_;
};

}  // namespace dsdpv1::spc3_test
