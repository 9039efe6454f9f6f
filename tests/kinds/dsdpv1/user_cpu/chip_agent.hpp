#pragma once
// The core as an agent of a timeline, for tests that have no bench.
#include "bus/timeline.hpp"
#include "kinds/dsdpv1/chip/core_device.hpp"

namespace dsdpv1 {

class ChipAgent : public bus::Agent, public tb::CoreDevice {
 public:
  explicit ChipAgent(const dsdpv1::Config& config = {}) : CoreDevice(config) {}

  bus::Tick next() const override { return next_event(); }
  void run(bus::Tick now) override { CoreDevice::advance(now); }

  void set(bus::Tick at, tb::PinNumber pin, Level level) override {
    announce();
    CoreDevice::set(at, pin, level);
  }
  void advance(bus::Tick to) override {
    announce();
    CoreDevice::advance(to);
  }
  Level sample(bus::Tick at) override {
    announce();
    return CoreDevice::sample(at);
  }
};

}  // namespace dsdpv1
