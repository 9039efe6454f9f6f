#pragma once
// A CPU at the pins of one of the four buses, edge by edge.
#include "model/spc3/bus_lines.hpp"
#include "tests/spc3/bench.hpp"

namespace dsdpv1::spc3_test {

using spc3::Bus;

/// `bench` must outlive it. Times are ticks, addresses those of the CPU.
class BusUser {
 public:
  static constexpr Tick kStrobe = 2500;  ///< long enough for ready

  explicit BusUser(Bench& bench, Bus bus = Bus::kIntelAsync) : bench_(bench), bus_(bus) {
    set(Pin::kXIntMot, is_motorola(bus) ? 1 : 0);
    set(Pin::kMode, is_synchronous(bus) ? 1 : 0);
    set(Pin::kAle, bus == Bus::kMotorolaAsync ? 1 : 0);
    set(Pin::kXWr, bus == Bus::kMotorolaSync ? 0 : 1);
  }

  void set(Pin pin, spc3::Level level) { bench_.twins.set(bench_.now(), pin, level); }
  void wait(Tick time) { bench_.run_until(bench_.now() + time); }

  /// The strobe begins now.
  void begin_read(Address address) {
    aim(address);
    strobe(Pin::kXRd, true);
  }
  void begin_write(Address address, spc3::Level value) {
    aim(address);
    set(Pin::kDbIn, value);
    if (is_motorola(bus_)) set(Pin::kXRd, 0);
    strobe(Pin::kXWr, true);
  }
  void end() {
    strobe(Pin::kXRd, false);
    strobe(Pin::kXWr, false);
    set(Pin::kXCs, 1);
    set(Pin::kXRd, 1);
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
  void aim(Address address) {
    if (bus_ != Bus::kIntelSync) {
      set(Pin::kAb, static_cast<spc3::Level>(address));
      return set(Pin::kXCs, 0);
    }
    set(Pin::kAb, static_cast<spc3::Level>(address >> 8));
    set(Pin::kDbIn, static_cast<spc3::Level>(address & 0xFF));
    set(Pin::kAle, 1);
    set(Pin::kAle, 0);
    set(Pin::kDbIn, spc3::kLevelZ);
  }
  void strobe(Pin of_intel, bool active) {
    if (bus_ == Bus::kMotorolaSync) return set(Pin::kXWr, active ? 1 : 0);
    set(bus_ == Bus::kMotorolaAsync ? Pin::kAle : of_intel, active ? 0 : 1);
  }

  Bench& bench_;
  const Bus bus_;
};

}  // namespace dsdpv1::spc3_test
