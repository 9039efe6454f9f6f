#pragma once
// The core as an agent of a timeline, for tests that have no bench.
#include "bus/timeline.hpp"
#include "model/dsdpv1/chip.hpp"
#include "tb/chip/host_pins.hpp"

namespace dsdpv1 {

class ChipAgent : public bus::Agent, public user_cpu::HostPins {
 public:
  explicit ChipAgent(const dsdpv1::Config& config = {}) : chip_(config) {}

  bus::Tick next() const override { return chip_.next_event(); }
  void run(bus::Tick now) override { chip_.advance(now); }

  void set(bus::Tick at, dsdpv1::Pin pin, dsdpv1::Level level) override { chip().set(at, pin, level); }
  void advance(bus::Tick to) override { chip().advance(to); }
  dsdpv1::Level level(dsdpv1::Pin pin) const override { return chip_.level(pin); }
  dsdpv1::Level sample(bus::Tick at) override { return chip().sample(at); }
  dsdpv1::Status status() const { return chip_.status(); }

  dsdpv1::Chip& chip() {
    announce();
    return chip_;
  }

 private:
  dsdpv1::Chip chip_;
};

}  // namespace dsdpv1
