#include "tb/systemc/chip_port.hpp"

#include <utility>

namespace dsdpv1::systemc_bench {

ChipPort::ChipPort(const std::string& name, dsdpv1::systemc::LineStation& chip,
                   const dsdpv1::systemc::TimedModule& module, bus::Segment& segment, TimelineModule& timeline)
    : chip_(chip), module_(module), segment_(segment), timeline_(timeline), station_(segment.attach(name, this)) {
  chip_.on_answer = [this](const profibus::CharacterRun& run) { return answer_begins(run); };
  chip_.on_left_run = [this](bus::Tick at) {
    segment_.cut_run(at + module_.zero());
    timeline_.wake();
  };
}

void ChipPort::enable(bus::Tick at, bool enabled) {
  enabled_ = enabled;
  own_run_ = hides_txd_ = false;
  pass_on(at);
}

void ChipPort::drive(bus::Tick at, bool level) {
  drives_ = level;
  pass_on(at);
}

void ChipPort::pass_on(bus::Tick at) {
  segment_.drive(station_, at + module_.zero(), enabled_, drives_);
  timeline_.wake();
}

void ChipPort::line_changed(bus::Tick /*at*/, bool level) {
  timeline_.catch_up();
  chip_.set_line(level);
}

bool ChipPort::run_begins(const bus::CharacterRun& run) {
  if (own_run_) return true;  // the chip does not receive while it sends
  if (run.bit % bus::kTicksPerCycle != 0) return false;
  timeline_.catch_up();
  return chip_.hear_run(
      {run.start - module_.zero(), run.bit / bus::kTicksPerCycle, run.bytes, static_cast<int>(run.size)});
}

void ChipPort::run_cut(bus::Tick /*at*/, bool level) {
  timeline_.catch_up();
  if (std::exchange(hides_txd_, false)) {
    chip_.show_txd();
    drives_ = level;
  }
  if (!std::exchange(own_run_, false)) chip_.leave_run();
  chip_.set_line(level);
}

bool ChipPort::answer_begins(const profibus::CharacterRun& run) {
  own_run_ = true;
  hides_txd_ = segment_.send_run(station_, {run.start + module_.zero(), run.bit * bus::kTicksPerCycle, run.bytes,
                                            static_cast<std::size_t>(run.size)});
  timeline_.wake();
  return hides_txd_;
}

}  // namespace dsdpv1::systemc_bench
