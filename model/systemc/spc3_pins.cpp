#include "model/systemc/spc3_pins.hpp"

#include "model/systemc/data_wires.hpp"
#include "model/systemc/has_process.hpp"

namespace dsdpv1::systemc {

using spc3::Pin;

static_assert(kLevelZ == spc3::kLevelZ && kLevelX == spc3::kLevelX);  // data_wires.hpp

Spc3PinModule::Spc3PinModule(const sc_core::sc_module_name& name, const Spc3PinOptions& options)
    : PinsOf(name, options),
      inputs_{{{Pin::kReset, &RESET},
               {Pin::kXIntMot, &XINT_MOT},
               {Pin::kMode, &MODE},
               {Pin::kDivider, &DIVIDER},
               {Pin::kXTest0, &XTEST0},
               {Pin::kXTest1, &XTEST1},
               {Pin::kXCs, &XCS},
               {Pin::kXRd, &XRD_R_W},
               {Pin::kXWr, &XWR_E_CLOCK},
               {Pin::kAle, &ALE_AS},
               {Pin::kRxd, &RXD},
               {Pin::kXCts, &XCTS}}},
      optional_inputs_{
          {{Pin::kAb11, &AB11}, {Pin::kSerial, &SERIAL}, {Pin::kSck, &SCK}, {Pin::kMosi, &MOSI}, {Pin::kXss, &XSS}}} {
  watch(spc3::kOutputPins, 0);
  DSDPV1_HAS_PROCESS(Spc3PinModule);
  SC_METHOD(evaluate);
  sensitive << due_ << soon_ << CLK << AB << DB;
  for (const auto& [pin, port] : inputs_) sensitive << *port;
  for (const auto& [pin, port] : optional_inputs_) sensitive << *port;
}

void Spc3PinModule::end_of_elaboration() {
  PinsOf::end_of_elaboration();
  connect(mask(Pin::kXReady), XREADY_XDTACK);
  connect(mask(Pin::kXInt), X_INT);
  connect(mask(Pin::kXDataExch), XDATAEXCH);
  connect(mask(Pin::kTxd), TXD);
  connect(mask(Pin::kRts), RTS);
}

void Spc3PinModule::begin_inputs() { user_db_ = level_of(DB.read()); }

void Spc3PinModule::apply_inputs(Tick at, bool first) {
  const bool user_drives = chip().level(Pin::kDbOut) == spc3::kLevelZ;
  const bool other_driver = std::exchange(user_drives_db_, user_drives) != user_drives;
  for (const auto& [pin, port] : inputs_)
    if (first || port->event()) set(at, pin, port->read());
  if (first || AB.event()) set(at, Pin::kAb, static_cast<spc3::Level>(AB.read().to_uint()));
  for (const auto& [pin, port] : optional_inputs_)
    if (port->size() > 0 && (first || (*port)->event())) set(at, pin, (*port)->read());
  if (!first && !other_driver && !DB.event()) return;
  if (DB.event()) user_db_ = level_of(DB.read());  // costly: four-valued
  set(at, Pin::kDbIn, user_drives ? user_db_ : spc3::kLevelZ);
}

void Spc3PinModule::drive_pins(std::uint32_t pins) {
  drive(pins);
  if ((pins & mask(Pin::kDbOut)) != 0) DB.write(wires(chip().level(Pin::kDbOut)));
  if ((pins & mask(Pin::kMiso)) != 0 && MISO.size() > 0) MISO->write(wire(chip().level(Pin::kMiso)));
}

}  // namespace dsdpv1::systemc
