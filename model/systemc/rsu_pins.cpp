#include "model/systemc/rsu_pins.hpp"

#include "model/systemc/data_wires.hpp"

namespace dsdpv1::systemc {
namespace {

PinOptions of_rsu(PinOptions options) {
  options.chip.part = Part::kRsu;
  return options;
}

}  // namespace

RsuPinModule::RsuPinModule(const sc_core::sc_module_name& name, const PinOptions& options)
    : PinModule(name, of_rsu(options)) {
  // Applies to PinModule's process, the last one created.
  sensitive << between_edges_ << XSS << SCK << MOSI << RXD << MODE << ADR << UBR << UIV;
}

void RsuPinModule::end_of_elaboration() {
  PinModule::end_of_elaboration();
  connect(mask(Pin::kTxd), TXD);
}

void RsuPinModule::apply_inputs(Tick at, bool first) {
  const auto apply = [&](Pin pin, auto& port) {
    if (first || port.event()) set(at, pin, static_cast<Level>(static_cast<int>(port.read())));
  };
  apply(Pin::kSck, SCK);
  apply(Pin::kMosi, MOSI);
  apply(Pin::kXss, XSS);
  apply(Pin::kRxd, RXD);
  apply(Pin::kMode, MODE);
  apply(Pin::kAdr, ADR);
  apply(Pin::kUbr, UBR);
  apply(Pin::kUiv, UIV);
  PinModule::apply_inputs(at, first);
}

void RsuPinModule::drive_pins(std::uint32_t pins) {
  PinModule::drive_pins(pins);
  const Level miso = chip().level(Pin::kMiso);
  if ((pins & mask(Pin::kMiso)) != 0) MISO.write(wire(miso));
}

/// MISO follows SCK, not CLK.
void RsuPinModule::plan_between_edges(Tick now) {
  const Tick next = chip().next_event();
  if (next / profibus::kTicksPerCycle == now / profibus::kTicksPerCycle) between_edges_.notify(to_time(next - now));
}

}  // namespace dsdpv1::systemc
