#include "tb/dsdpv1/systemc/tlm_chip.hpp"

namespace systemc_bench {

using dsdpv1::Level;
using dsdpv1::Pin;

TlmChip::TlmChip(const sc_core::sc_module_name& name, const dsdpv1::systemc::TlmOptions& options, bus::Segment& segment,
                 TimelineModule& timeline)
    : sc_module(name),
      segment_(segment),
      timeline_(timeline),
      module_("chip", options),
      station_(segment.attach(sc_module::name(), this)) {
  module_.RESET(reset_);
  module_.R_REQ(r_req_);
  module_.R_STA(r_sta_);
  module_.PBRXD(rxd_);
  module_.on_pin = [this](bus::Tick at, Pin pin, Level level) { pin_changed(at, pin, level); };
}

void TlmChip::line_changed(bus::Tick /*at*/, bool level) { rxd_.write(level); }

void TlmChip::pin_changed(bus::Tick at, Pin pin, Level level) {
  if (on_pin) on_pin(at, pin, level);
  if (pin != Pin::kPbtxd && pin != Pin::kPbrts) return;
  (pin == Pin::kPbtxd ? drives_ : enabled_) = level != 0;
  segment_.drive(station_, at, enabled_, drives_);
  timeline_.wake();
}

}  // namespace systemc_bench
