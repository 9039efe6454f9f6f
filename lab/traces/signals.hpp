#pragma once
// The signals of a trace: all pins of each slave, in the order of the scenario and of the chip's pin table, then the
// line.
#include <string>
#include <vector>

#include "tb/scenario/scenario.hpp"

namespace dsdpv1::tb::traces {

struct Signal {
  enum class Kind : std::uint8_t { kInput, kOutput, kLine };  ///< inputs and outputs are the chip's

  std::string slave;  ///< "bus" for the line
  std::string name;   ///< the pin's, "line" for the line
  int width = 1;      ///< number of wires, 1..15
  Kind kind = Kind::kInput;

  bool operator==(const Signal& other) const {
    return slave == other.slave && name == other.name && width == other.width && kind == other.kind;
  }
};
using Signals = std::vector<Signal>;

Signals signals_of(const scenario::Scenario& scenario);

/// "1", "7FF", "Z", "X".
std::string level_words(const Signal& signal, Level level);

}  // namespace dsdpv1::tb::traces
