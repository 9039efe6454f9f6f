#pragma once
// A wire or a data bus between a level of the core and the four-valued wires of SystemC.
#include <systemc>

#include "model/dsdpv1/pins.hpp"

namespace dsdpv1::systemc {

inline sc_dt::sc_lv<8> wires(Level level) {
  if (level == kLevelZ) return sc_dt::sc_lv<8>(sc_dt::SC_LOGIC_Z);
  if (level == kLevelX) return sc_dt::sc_lv<8>(sc_dt::SC_LOGIC_X);
  return sc_dt::sc_lv<8>(static_cast<int>(level));
}

inline sc_dt::sc_logic wire(Level level) {
  if (level == kLevelZ) return sc_dt::sc_logic(sc_dt::SC_LOGIC_Z);
  return sc_dt::sc_logic(level == 1);
}

/// A byte with a floating or unknown bit counts as floating.
inline Level level_of(const sc_dt::sc_lv<8>& wires) {
  return wires.is_01() ? static_cast<Level>(wires.to_uint()) : kLevelZ;
}

}  // namespace dsdpv1::systemc
