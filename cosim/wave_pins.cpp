#include "cosim/wave_pins.hpp"

#include <fmt/format.h>

#include "cosim/rtl_device.hpp"
#include "io/input/units.hpp"

namespace dsdpv1::cosim {
namespace {

constexpr tb::compare::Femtoseconds kThreeCycles = 62'500'000;

/// The chip's drive, Z if it does not drive: D_OUT of a golden trace.
tb::compare::NamedPair driven_pair(const PinMap& map, const tb::PinInfo& output) {
  const Port &out = map.pins.at(output.name), &drives = map.pins.at(enable_of(output));
  tb::compare::NamedPair pair;
  pair.a = output.name;
  pair.output = output.bus != nullptr ? output.bus : output.name;
  pair.b = out.name;
  pair.inverted = out.inverted;
  pair.driven = drives.name;
  pair.driven_low = drives.inverted;
  return pair;
}

/// The bus: D in a run's wave.
tb::compare::NamedPair data_pair(const PinMap& map, const tb::PinInfo& input, const tb::PinInfo& output) {
  tb::compare::NamedPair pair = driven_pair(map, output);
  pair.a = input.bus;
  pair.released = map.pins.at(input.name).name;
  return pair;
}

tb::compare::NamedPair pair_of(const PinMap& map, const tb::PinTable& pins, const tb::PinInfo& pin) {
  if (pin.bus != nullptr && pin.input) return data_pair(map, pin, pins.at(data_output(pins)));
  if (pin.released) return driven_pair(map, pin);
  const Port& port = map.pins.at(pin.name);
  tb::compare::NamedPair pair;
  pair.a = pin.name;
  if (!pin.input) pair.output = pin.name;
  pair.b = port.name;
  pair.inverted = port.inverted;
  return pair;
}

Level level_of(std::string_view value) {
  Level level = 0;
  for (const char bit : value) {
    if (bit == 'x') return tb::kLevelX;
    if (bit == 'z') return tb::kLevelZ;
    level = static_cast<Level>(level * 2 + (bit == '1' ? 1 : 0));
  }
  return level;
}

std::string telegram_text(const LineHistory& line, Tick now) {
  const LineTelegram telegram = line.last_telegram(-1, now);
  return telegram.text.empty() ? "none" : fmt::format("{}, began at {}", telegram.text, tb::cycle_text(telegram.start));
}

}  // namespace

std::vector<tb::compare::NamedPair> pairs_of(const PinMap& map, const tb::PinTable& pins) {
  std::vector<tb::compare::NamedPair> pairs;
  for (std::size_t i = 0; i < pins.size(); ++i) {
    tb::compare::NamedPair pair = pair_of(map, pins, pins[i]);
    pair.required = false;
    if (const int cycles = map.tolerances.at(i); cycles != 0) pair.tolerance = cycles * kThreeCycles / 3;
    pairs.push_back(std::move(pair));
  }
  return pairs;
}

PinSurroundings::PinSurroundings(const tb::ChipKind& kind) : kind_(kind) {
  if (kind.rtl() != nullptr) watch_ = kind.rtl()->watch_memory();
  for (PinNumber pin = 0; pin < end_of(kind.pins()); ++pin) {
    const tb::PinInfo& info = kind.pins()[pin];
    if (info.bus != nullptr && !info.input) continue;
    pins_.push_back(pin);
    names_.emplace_back(info.bus != nullptr ? info.bus : info.name);
  }
}

void PinSurroundings::change(Tick at, std::size_t number, std::string_view value) {
  const PinNumber pin = pins_.at(number);
  if (value.size() != static_cast<std::size_t>(kind_.pins()[pin].width)) return;  // another signal with that name
  const Level level = level_of(value);
  if (watch_) watch_->change(at, pin, level);
  if (pin == kind_.board_pins().rxd) received_.add(at, level != 0);
  if (pin == kind_.board_pins().txd) sent_.add(at, level != 0);
}

std::vector<tb::compare::Line> PinSurroundings::lines(Tick now) const {
  std::vector<tb::compare::Line> lines = {{"last telegram", telegram_text(received_, now)},
                                          {"last answer", telegram_text(sent_, now)}};
  if (!watch_) return lines;
  lines.push_back({"last access", watch_->last_of_user()});
  lines.push_back({"DPRAM", watch_->last_of_chip()});
  return lines;
}

}  // namespace dsdpv1::cosim
