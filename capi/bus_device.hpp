#pragma once
// A chip of a bus as a device: whoever moves it moves the bus.
#include <vector>

#include "capi/bus.hpp"
#include "capi/kind.hpp"
#include "tb/chip/pin_chip.hpp"

namespace dsdpv1::capi {

class BusDevice : public tb::PinDevice {
 public:
  BusDevice(const Kind& kind, const ChipPlan& plan, dpsim_bus& bus);

  void set(Tick at, tb::PinNumber pin, tb::Level level) override;
  void advance(Tick to) override { bus_.run(to); }
  Tick now() const override { return bus_.timeline.now(); }
  Tick next_event() const override { return bus_.timeline.next(); }
  tb::Level level(tb::PinNumber pin) const override { return chip_.level(pin); }
  tb::Level sample(Tick at) override;
  void watch(const tb::PinSink& sink, tb::PinMask pins) override;
  void on_event(const profibus::EventSink& sink) override;
  tb::ChipStatus status() const override;
  std::uint8_t address() const override { return chip_.address(); }
  std::uint8_t peek(std::uint16_t address) const override;
  void poke(std::uint16_t address, std::uint8_t value) override { chip_.poke(now(), address, value); }

 private:
  void catch_up() const;

  dpsim_bus& bus_;
  mutable tb::PinChip chip_;  ///< it leaves undone what nobody sees
  const tb::PinMask inputs_;  ///< those that the caller sets
};

}  // namespace dsdpv1::capi
