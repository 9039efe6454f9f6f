#include "model/systemc/bus_character.hpp"

#include <algorithm>
#include <string>

#include "model/systemc/core_module.hpp"

namespace dsdpv1::systemc {

std::ostream& operator<<(std::ostream& out, const BusCharacter& character) {
  const std::ios_base::fmtflags flags = out.flags();
  out << character.start << " " << std::hex << std::uppercase << unsigned{character.data};
  out.flags(flags);
  return out << (character.parity_ok ? "" : " parity error") << (character.stop_ok ? "" : " framing error");
}

BusCharacter on_bus(const LineCharacter& character, Tick zero) {
  return {to_time(std::max<Tick>(character.start + zero, 0)), to_time(character.bit), character.data,
          character.parity_ok, character.stop_ok};
}

bool CharacterInput::is_sendable(const BusCharacter& character) const {
  const char* fault = nullptr;
  if (character.start < sc_core::sc_time_stamp()) fault = "begins in the past, it is not sent";
  if (to_tick(character.bit) <= 0) fault = "has no bit time, it is not sent";
  if (fault == nullptr) return true;
  const std::string text = std::string(module_.name()) + ": character at " + character.start.to_string() + " " + fault;
  SC_REPORT_WARNING("/dsdpv1/bus", text.c_str());
  return false;
}

bool CharacterInput::collides(const BusCharacter& character) const {
  if (tick_of_bit(character, 0) >= busy_until) return false;
  const std::string text = std::string(module_.name()) + ": character at " + character.start.to_string() +
                           " begins before the previous one has ended";
  SC_REPORT_WARNING("/dsdpv1/bus", text.c_str());
  return true;
}

Tick CharacterInput::tick_of_bit(const BusCharacter& character, unsigned int bit) const {
  const Tick at = to_tick(sc_core::sc_time::from_value(character.start.value() + bit * character.bit.value()));
  return module_.chip_tick(at);
}

void CharacterInput::put(const BusCharacter& character) {
  const std::uint16_t frame = frame_of(character.data, character.parity_ok, character.stop_ok);
  bool level = true;
  for (unsigned int bit = 0; bit < profibus::kBitsPerCharacter; ++bit) {
    const bool next = ((frame >> bit) & 1U) != 0;
    if (next != level) edges.push({tick_of_bit(character, bit), next});
    level = next;
  }
  busy_until = tick_of_bit(character, profibus::kBitsPerCharacter);
  if (!level) edges.push({busy_until, true});
}

template class ListenedPort<BusCharacter>;

}  // namespace dsdpv1::systemc
