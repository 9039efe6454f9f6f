#pragma once
// Characters on the bus of a TLM module: what its ports carry, and their way to the edges of the line.
#include <tlm.h>

#include <cstdint>
#include <ostream>
#include <systemc>

#include "model/profibus/baud.hpp"
#include "model/systemc/character_line.hpp"
#include "model/systemc/module_reports.hpp"

namespace dsdpv1::systemc {

class TimedModule;

/// One character on the bus.
struct BusCharacter {
  sc_core::sc_time start;  ///< falling edge of the start bit, absolute
  sc_core::sc_time bit;    ///< length of a bit, given by the baud rate
  std::uint8_t data = 0;
  bool parity_ok = true;  ///< even parity
  bool stop_ok = true;    ///< the stop bit is high (else a framing error)
};
std::ostream& operator<<(std::ostream& out, const BusCharacter& character);
/// The line is low for the whole character.
inline bool is_break(const BusCharacter& character) {
  return character.data == 0 && character.parity_ok && !character.stop_ok;
}

extern template class ListenedPort<BusCharacter>;

/// A character of a chip whose tick 0 is at simulation tick `zero`, as its port `bus_out` carries it; not before time
/// 0.
BusCharacter on_bus(const LineCharacter& character, Tick zero);

/// The bit time at which a chip sends. Without a baud rate it does not send; an edge then comes from RESET cutting a
/// character.
constexpr Tick bit_time_of(profibus::BaudIndex baud) {
  return (baud.known() ? baud.bit_cycles() : 1) * profibus::kTicksPerCycle;
}

/// The characters of a module's `bus_in`, as edges of its line. Ticks are the chip's.
class CharacterInput {
 public:
  explicit CharacterInput(const TimedModule& module) : module_(module) {}

  EdgeQueue edges;
  Tick busy_until = 0;  ///< end of the last character

  /// False, and the warning /dsdpv1/bus: it begins in the past or has no bit time.
  bool is_sendable(const BusCharacter& character) const;
  /// True, and the warning /dsdpv1/bus: it begins before the end of the previous one.
  bool collides(const BusCharacter& character) const;
  void put(const BusCharacter& character);
  /// The tick nearest to the start of a bit, or of the position after the last bit.
  Tick tick_of_bit(const BusCharacter& character, unsigned int bit) const;

  template <class Archive>
  void store(Archive& archive) {
    archive(edges);
    archive.ticks(busy_until);
  }

 private:
  const TimedModule& module_;
};

}  // namespace dsdpv1::systemc
