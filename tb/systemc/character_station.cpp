#include "tb/systemc/character_station.hpp"

#include <algorithm>

#include "tb/systemc/segment_module.hpp"

namespace dsdpv1::systemc_bench {

CharacterStation::CharacterStation(const sc_core::sc_module_name& name, SegmentModule& line)
    : TimedModule(name, 0), line_(line), station_(line.segment().attach(TimedModule::name(), nullptr)) {
  in.bind(*this);
  line_.add(*this);
}

void CharacterStation::write(const dsdpv1::systemc::BusCharacter& character) {
  if (!input_.is_sendable(character)) return;
  input_.collides(character);
  input_.put(character);
  announce();
  line_.agents().wake();
}

bus::Tick CharacterStation::next() const {
  return std::min(input_.edges.next(), enabled_ ? input_.busy_until : bus::kNever);
}

void CharacterStation::run(bus::Tick now) {
  while (input_.edges.next() <= now) {
    const dsdpv1::systemc::Edge edge = input_.edges.take();
    enabled_ = true;
    line_.segment().drive(station_, edge.at, true, edge.level);
  }
  if (!enabled_ || input_.busy_until > now) return;
  enabled_ = false;
  line_.segment().drive(station_, now, false, true);
}

}  // namespace dsdpv1::systemc_bench
