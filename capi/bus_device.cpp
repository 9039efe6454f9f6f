#include "capi/bus_device.hpp"

namespace dsdpv1::capi {

BusDevice::BusDevice(const Kind& kind, const ChipPlan& plan, dpsim_bus& bus)
    : bus_(bus),
      chip_(plan.name, kind.chip.make_device(plan.request()), kind.chip.pins(), kind.chip.board_pins(), 0, bus.segment),
      inputs_(tb::inputs_of(kind.chip.pins()) & ~tb::mask_of(kind.chip.board_pins().rxd)) {
  chip_.listen(*this, 0);
  bus.timeline.add(chip_);
  bus.add_station({chip_.station(), Station::Kind::kChip});
}

void BusDevice::set(Tick at, tb::PinNumber pin, tb::Level level) {
  bus_.run(at);
  chip_.set_pin(at, pin, level);
}

tb::Level BusDevice::sample(Tick at) {
  bus_.run(at);
  return chip_.sample(at);
}

void BusDevice::watch(const tb::PinSink& sink, tb::PinMask pins) {
  changes_ = sink;
  told_ = pins & ~inputs_;
  chip_.watch(now(), told_);
}

tb::ChipStatus BusDevice::status() const {
  catch_up();
  return chip_.status();
}

std::uint8_t BusDevice::peek(std::uint16_t address) const {
  catch_up();
  return chip_.peek(address);
}

/// It must not be advanced inside a callback.
void BusDevice::catch_up() const {
  if (!bus_.clock.calling) chip_.sync(now());
}

}  // namespace dsdpv1::capi
