#include "cosim/wave_pins.hpp"

#include <fmt/format.h>

#include "io/input/units.hpp"

namespace dsdpv1::cosim {
namespace {

constexpr tb::compare::Femtoseconds kThreeCycles = 62'500'000;

/// Table 1's pins; both directions of D are the bus.
std::vector<Pin> pins_of_waves() {
  std::vector<Pin> pins;
  for (int i = 0; i < dsdpv1::kPinCount; ++i)
    if (static_cast<Pin>(i) != Pin::kDOut) pins.push_back(static_cast<Pin>(i));
  return pins;
}

std::string name_in_both(Pin pin) { return pin == Pin::kDIn ? "D" : dsdpv1::name(pin); }

/// What the chip drives, Z when it does not: D_OUT of a golden trace.
tb::compare::NamedPair driven_pair(const PinMap& map) {
  const Port &out = map.pins.at("D_OUT"), &drives = map.pins.at("D_OE");
  tb::compare::NamedPair pair;
  pair.a = dsdpv1::name(Pin::kDOut);
  pair.b = out.name;
  pair.inverted = out.inverted;
  pair.driven = drives.name;
  pair.driven_low = drives.inverted;
  return pair;
}

/// The bus: D of a run's wave.
tb::compare::NamedPair data_pair(const PinMap& map) {
  tb::compare::NamedPair pair = driven_pair(map);
  pair.a = "D";
  pair.released = map.pins.at("D_IN").name;
  return pair;
}

tb::compare::NamedPair pair_of(const PinMap& map, Pin pin) {
  if (pin == Pin::kDIn) return data_pair(map);
  if (pin == Pin::kDOut) return driven_pair(map);
  const Port& port = map.pins.at(dsdpv1::name(pin));
  tb::compare::NamedPair pair;
  pair.a = dsdpv1::name(pin);
  pair.b = port.name;
  pair.inverted = port.inverted;
  return pair;
}

Level level_of(std::string_view value) {
  Level level = 0;
  for (const char bit : value) {
    if (bit == 'x') return dsdpv1::kLevelX;
    if (bit == 'z') return dsdpv1::kLevelZ;
    level = static_cast<Level>(level * 2 + (bit == '1' ? 1 : 0));
  }
  return level;
}

std::string telegram_text(const LineHistory& line, Tick now) {
  const LineTelegram telegram = line.last_telegram(-1, now);
  return telegram.text.empty() ? "none" : fmt::format("{}, began at {}", telegram.text, tb::cycle_text(telegram.start));
}

}  // namespace

std::vector<tb::compare::NamedPair> pairs_of(const PinMap& map) {
  std::vector<tb::compare::NamedPair> pairs;
  for (int i = 0; i < dsdpv1::kPinCount; ++i) {
    const auto pin = static_cast<Pin>(i);
    tb::compare::NamedPair pair = pair_of(map, pin);
    pair.required = false;
    if (const int cycles = map.tolerances.at(static_cast<std::size_t>(pin)); cycles != 0)
      pair.tolerance = cycles * kThreeCycles / 3;
    pairs.push_back(std::move(pair));
  }
  return pairs;
}

const std::vector<std::string>& PinSurroundings::pins() const {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const Pin pin : pins_of_waves()) all.push_back(name_in_both(pin));
    return all;
  }();
  return names;
}

void PinSurroundings::change(Tick at, std::size_t number, std::string_view value) {
  static const std::vector<Pin> all = pins_of_waves();
  const Pin pin = all.at(number);
  if (value.size() != static_cast<std::size_t>(dsdpv1::width(pin))) return;  // another thing of that name
  const Level level = level_of(value);
  watch_.change(at, pin, level);
  if (pin == Pin::kPbrxd) received_.add(at, level != 0);
  if (pin == Pin::kPbtxd) sent_.add(at, level != 0);
}

std::vector<tb::compare::Line> PinSurroundings::lines(Tick now) const {
  return {{"last telegram", telegram_text(received_, now)},
          {"last answer", telegram_text(sent_, now)},
          {"last access", watch_.user_text()},
          {"DPRAM", watch_.chip_text()}};
}

}  // namespace dsdpv1::cosim
