#include "tb/systemc/segment_module.hpp"

#include <string>

#include "model/systemc/sim_time.hpp"

namespace dsdpv1::systemc_bench {

using dsdpv1::systemc::TimedModule;
using dsdpv1::systemc::to_time;

SegmentModule::SegmentModule(const sc_core::sc_module_name& name) : sc_module(name) {}

bus::StationId SegmentModule::attach(dsdpv1::systemc::TlmModule& chip) {
  agents_.add(chip);
  return attach(static_cast<const TimedModule&>(chip), chip);
}

bus::StationId SegmentModule::attach(dsdpv1::systemc::Spc3TlmModule& chip) {
  return attach(static_cast<const TimedModule&>(chip), chip);
}

bus::StationId SegmentModule::attach(const TimedModule& module, dsdpv1::systemc::LineStation& chip) {
  if (chip.on_rts) {
    const std::string text = std::string(module.name()) + " is already a station of a segment";
    SC_REPORT_ERROR("/dsdpv1/segment", text.c_str());
  }
  chips_.push_back(std::make_unique<ChipPort>(module.name(), chip, module, segment_, agents_));
  ChipPort& port = *chips_.back();
  chip.on_rts = [&port](bus::Tick at, bool level) { port.enable(at, level); };
  chip.on_txd = [&port](bus::Tick at, bool level) { port.drive(at, level); };
  return port.station();
}

bus::Monitor& SegmentModule::monitor() {
  if (!monitor_) timeline_.add(monitor_.emplace(segment_));
  return *monitor_;
}

void SegmentModule::end_of_elaboration() {
  if (!heard.bound()) return;
  monitor().on_character = [this](const bus::ReceivedCharacter& character) { tell(character); };
  segment_.on_drive = [this](bus::StationId station, bus::Tick at, bool enabled, bool) {
    driven(station, at, enabled);
  };
}

void SegmentModule::driven(bus::StationId station, bus::Tick at, bool enabled) {
  if (station >= enabled_.size()) enabled_.resize(segment_.stations());
  if (enabled_[station] == enabled) return;
  enabled_[station] = enabled;
  if (!enabled && drivers_ == 2) conflict_end_ = at;
  enabled ? ++drivers_ : --drivers_;
}

bool SegmentModule::collided(bus::Tick start) const { return drivers_ > 1 || conflict_end_ > start; }

void SegmentModule::tell(const bus::ReceivedCharacter& character) {
  HeardCharacter told;
  told.start = to_time(character.start);
  told.bit = to_time(bus::baud(monitor().baud()).bit);
  told.data = character.byte;
  told.parity_ok = character.parity_ok;
  told.stop_ok = character.stop_ok;
  told.collided = collided(character.start);
  heard.write(told);
}

}  // namespace dsdpv1::systemc_bench
