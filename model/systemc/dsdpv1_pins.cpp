#include "model/systemc/dsdpv1_pins.hpp"

#include <utility>

#include "model/systemc/data_wires.hpp"
#include "model/systemc/has_process.hpp"

namespace dsdpv1::systemc {

PinModule::PinModule(const sc_core::sc_module_name& name, const PinOptions& options) : PinsOf(name, options) {
  watch(outputs_of(part()), 0);
  DSDPV1_HAS_PROCESS(PinModule);
  SC_METHOD(evaluate);
  sensitive << due_ << soon_ << CLK << RESET << R_REQ << R_STA << CSR << RD << WR << A << D << PBRXD;
}

void PinModule::end_of_elaboration() {
  PinsOf::end_of_elaboration();
  const struct {
    Pin pin;
    Out& port;
  } wires[] = {{Pin::kLReq, L_REQ},  {Pin::kLSta, L_STA}, {Pin::kPbtxd, PBTXD}, {Pin::kIntr0, INTR0},
               {Pin::kPbrts, PBRTS}, {Pin::kPbf, PBF},    {Pin::kBr, BR},       {Pin::kReady, READY}};
  for (const auto& wire : wires) connect(mask(wire.pin), wire.port);
}

void PinModule::begin_inputs() { user_d_ = level_of(D.read()); }

/// Applies each changed pin, those of the host together, because their order matters.
void PinModule::apply_inputs(Tick at, bool first) {
  const bool user_drives_d = chip().level(Pin::kDOut) == kLevelZ;
  const bool access = CSR.event() || RD.event() || WR.event() || A.event() || D.event();
  const bool releases_d = std::exchange(user_drives_d_, user_drives_d) != user_drives_d;
  if (first || access || releases_d || R_REQ.event() || R_STA.event()) apply_host(at);
  if (first || PBRXD.event()) set(at, Pin::kPbrxd, PBRXD.read());
  if (first || RESET.event()) set(at, Pin::kReset, RESET.read());
}

void PinModule::apply_host(Tick at) {
  if (R_REQ.read()) set(at, Pin::kRReq, 1);
  if (R_STA.read()) set(at, Pin::kRSta, 1);
  set(at, Pin::kA, static_cast<Level>(A.read().to_uint()));
  if (D.event()) user_d_ = level_of(D.read());  // costly: four-valued
  set(at, Pin::kDIn, user_drives_d_ ? user_d_ : kLevelZ);
  if (!CSR.read()) set(at, Pin::kCsr, 0);
  set(at, Pin::kRd, RD.read());
  set(at, Pin::kWr, WR.read());
  set(at, Pin::kCsr, CSR.read());
  set(at, Pin::kRSta, R_STA.read());
  set(at, Pin::kRReq, R_REQ.read());
}

void PinModule::drive_pins(std::uint32_t pins) {
  drive(pins);
  if ((pins & mask(Pin::kDOut)) != 0) D.write(wires(chip().level(Pin::kDOut)));
}

}  // namespace dsdpv1::systemc
