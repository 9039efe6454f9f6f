#pragma once
// A chip of a bus as a device: advancing it advances the bus.
#include <vector>

#include "capi/bus.hpp"
#include "capi/kind.hpp"
#include "tb/chip/pin_chip.hpp"

namespace dsdpv1::capi {

class BusDevice : public tb::PinDevice, private tb::ChipListener, private tb::RegisterPort {
 public:
  BusDevice(const Kind& kind, const ChipPlan& plan, dpsim_bus& bus);

  void set(Tick at, tb::PinNumber pin, tb::Level level) override;
  void advance(Tick to) override { bus_.run(to); }
  Tick now() const override { return bus_.timeline.now(); }
  Tick next_event() const override { return bus_.timeline.next(); }
  tb::Level level(tb::PinNumber pin) const override { return chip_.level(pin); }
  tb::Level sample(Tick at) override;
  void watch(const tb::PinSink& sink, tb::PinMask pins) override;
  void on_event(const profibus::EventSink& sink) override { events_ = sink; }
  tb::ChipStatus status() const override;
  std::uint8_t address() const override { return chip_.address(); }
  std::uint8_t peek(std::uint16_t address) const override;
  void poke(std::uint16_t address, std::uint8_t value) override { chip_.poke(now(), address, value); }
  tb::RegisterPort* registers() override { return chip_.has_registers() ? this : nullptr; }

 private:
  std::uint8_t load(Tick at, std::uint16_t address) override { return chip_.load(at, address); }
  void store(Tick at, std::uint16_t address, std::uint8_t value) override { chip_.store(at, address, value); }
  void pin(std::size_t /*slave*/, Tick at, tb::PinNumber pin, tb::Level level) override {
    if ((told_ & tb::mask_of(pin)) != 0) changes_.call(changes_.self, at, pin, level);
  }
  void event(std::size_t /*slave*/, const profibus::Event& event) override {
    if (events_.call != nullptr) events_.call(events_.self, event);
  }
  void catch_up() const;

  dpsim_bus& bus_;
  mutable tb::PinChip chip_;  ///< skips unobservable work
  const tb::PinMask inputs_;  ///< those set by the caller
  tb::PinMask told_ = 0;      ///< reported to `changes_`
  tb::PinSink changes_;
  profibus::EventSink events_;
};

}  // namespace dsdpv1::capi
