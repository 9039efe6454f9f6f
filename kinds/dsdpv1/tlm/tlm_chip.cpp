#include "kinds/dsdpv1/tlm/tlm_chip.hpp"

#include <utility>

namespace dsdpv1::systemc_bench {

TlmChip::TlmChip(const sc_core::sc_module_name& name, bus::Segment& segment, TimelineModule& timeline)
    : sc_module(name), segment_(segment), timeline_(timeline), station_(segment.attach(sc_module::name(), this)) {}

TlmChip::TlmChip(const sc_core::sc_module_name& name, const dsdpv1::systemc::TlmOptions& options, bus::Segment& segment,
                 TimelineModule& timeline)
    : TlmChip(name, segment, timeline) {
  take(new dsdpv1::systemc::TlmModule("chip", options), options);
}

TlmChip::TlmChip(const sc_core::sc_module_name& name, const dsdpv1::systemc::RsuTlmOptions& options,
                 bus::Segment& segment, TimelineModule& timeline)
    : TlmChip(name, segment, timeline) {
  take(rsu_ = new dsdpv1::systemc::RsuTlmModule("chip", options), options);
}

void TlmChip::take(dsdpv1::systemc::TlmModule* module, const dsdpv1::systemc::TlmOptions& options) {
  module_.reset(module);
  timeline_.add(*module);
  module->RESET(reset_);
  module->R_REQ(r_req_);
  module->R_STA(r_sta_);
  module->PBRXD(rxd_);
  module->on_pin = [this](bus::Tick at, Pin pin, Level level) { pin_changed(at, pin, level); };
  if ((options.observed & dsdpv1::mask(Pin::kPbtxd)) == 0)
    module->on_answer = [this](const profibus::CharacterRun& run) { return answer_begins(run); };
  module->on_left_run = [this](bus::Tick at) {
    segment_.cut_run(at);
    timeline_.wake();
  };
}

void TlmChip::set_reset(bool level) {
  timeline_.catch_up();
  move(reset_, level);
}

void TlmChip::move(PromptPin& pin, bool level) {
  pin.set(level);
  module_->sync(timeline_.ahead());
}

void TlmChip::line_changed(bus::Tick /*at*/, bool level) {
  timeline_.catch_up();
  rxd_.write(level);
}

bool TlmChip::run_begins(const bus::CharacterRun& run) {
  if (own_run_) return true;  // the chip does not receive while it sends
  if (run.bit % bus::kTicksPerCycle != 0) return false;
  timeline_.catch_up();
  return module_->hear_run({run.start, run.bit / bus::kTicksPerCycle, run.bytes, static_cast<int>(run.size)});
}

void TlmChip::run_cut(bus::Tick /*at*/, bool level) {
  timeline_.catch_up();
  if (std::exchange(hides_txd_, false)) {
    module_->show_txd();
    drives_ = level;
  }
  if (!std::exchange(own_run_, false)) module_->leave_run();
  rxd_.write(level);
}

bool TlmChip::answer_begins(const profibus::CharacterRun& run) {
  own_run_ = true;
  hides_txd_ = segment_.send_run(
      station_, {run.start, run.bit * bus::kTicksPerCycle, run.bytes, static_cast<std::size_t>(run.size)});
  timeline_.wake();
  return hides_txd_;
}

void TlmChip::pin_changed(bus::Tick at, Pin pin, Level level) {
  if (on_pin) on_pin(at, pin, level);
  if (pin != Pin::kPbtxd && pin != Pin::kPbrts) return;
  (pin == Pin::kPbtxd ? drives_ : enabled_) = level != 0;
  if (pin == Pin::kPbrts) own_run_ = hides_txd_ = false;
  segment_.drive(station_, at, enabled_, drives_);
  timeline_.wake();
}

}  // namespace dsdpv1::systemc_bench
