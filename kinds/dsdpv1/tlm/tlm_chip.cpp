#include "kinds/dsdpv1/tlm/tlm_chip.hpp"

namespace dsdpv1::systemc_bench {

TlmChip::TlmChip(const sc_core::sc_module_name& name, bus::Segment& segment, TimelineModule& timeline)
    : sc_module(name), segment_(segment), timeline_(timeline) {}

TlmChip::TlmChip(const sc_core::sc_module_name& name, const dsdpv1::systemc::TlmOptions& options, bus::Segment& segment,
                 TimelineModule& timeline)
    : TlmChip(name, segment, timeline) {
  take(new dsdpv1::systemc::TlmModule("chip", options));
}

TlmChip::TlmChip(const sc_core::sc_module_name& name, const dsdpv1::systemc::RsuTlmOptions& options,
                 bus::Segment& segment, TimelineModule& timeline)
    : TlmChip(name, segment, timeline) {
  take(rsu_ = new dsdpv1::systemc::RsuTlmModule("chip", options));
}

void TlmChip::take(dsdpv1::systemc::TlmModule* module) {
  module_.reset(module);
  timeline_.add(*module);
  module->RESET(reset_);
  module->R_REQ(r_req_);
  module->R_STA(r_sta_);
  module->on_pin = [this](bus::Tick at, Pin pin, Level level) { pin_changed(at, pin, level); };
  port_ = std::make_unique<ChipPort>(name(), *module, *module, segment_, timeline_);
}

void TlmChip::set_reset(bool level) {
  timeline_.catch_up();
  move(reset_, level);
}

void TlmChip::move(PromptPin& pin, bool level) {
  pin.set(level);
  module_->sync(timeline_.ahead());
}

void TlmChip::pin_changed(bus::Tick at, Pin pin, Level level) {
  if (on_pin) on_pin(at, pin, level);
  if (pin == Pin::kPbrts) port_->enable(at, level != 0);
  if (pin == Pin::kPbtxd) port_->drive(at, level != 0);
}

}  // namespace dsdpv1::systemc_bench
