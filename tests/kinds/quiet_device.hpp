#pragma once
// A device with pins that neither acts nor reports, for tests of its inputs.
#include "bus/time.hpp"
#include "tb/chip/pin_device.hpp"

namespace dsdpv1 {

class QuietDevice : public tb::PinDevice {
 public:
  void advance(tb::Tick /*to*/) override {}
  tb::Tick now() const override { return 0; }
  tb::Tick next_event() const override { return bus::kNever; }
  void watch(const tb::PinSink& /*sink*/, tb::PinMask /*pins*/) override {}
  void on_event(const profibus::EventSink& /*sink*/) override {}
  tb::ChipStatus status() const override { return {}; }
  std::uint8_t address() const override { return 0; }
  std::uint8_t peek(std::uint16_t /*address*/) const override { return 0; }
  void poke(std::uint16_t /*address*/, std::uint8_t /*value*/) override {}
};

}  // namespace dsdpv1
