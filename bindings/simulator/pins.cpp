// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0
#include "bindings/simulator/pins.hpp"

#include <fmt/format.h>

#include <map>

#include "bindings/simulator/object.hpp"

namespace dsdpv1::simulator {
namespace {

/// The pins of one direction, by number.
std::vector<dpsim_pin_info> infos_of(const char* kind, bool inputs) {
  std::vector<dpsim_pin_info> infos;
  for (std::size_t number = 0; number < dpsim_pin_count(kind); ++number) {
    dpsim_pin_info info{};
    info.size = sizeof info;
    check(dpsim_pin_get(kind, number, &info));
    if ((info.input != 0) == inputs) infos.push_back(info);
  }
  return infos;
}

uint64_t wires(unsigned count, unsigned shift) { return ((uint64_t{1} << count) - 1) << shift; }

}  // namespace

PackedPins::PackedPins(const char* kind, bool inputs) {
  unsigned bit = 0;
  const std::vector<dpsim_pin_info> infos = infos_of(kind, inputs);
  for (const dpsim_pin_info& info : infos) {
    of_pin_[info.number] = static_cast<uint8_t>(places_.size());
    places_.push_back({info.number, info.name, bit, wires(info.width, bit), 0, 0});
    bit += info.width;
  }
  for (std::size_t i = 0; i < infos.size(); ++i)
    if (infos[i].reset_level == DPSIM_Z) places_[i].released = wires(1, bit++);
  for (PinPlace& place : places_)
    if (!inputs) place.unknown = wires(1, bit++);
  if (bit >= kPins) throw Error(DPSIM_ERR_INTERNAL, fmt::format("the pins of a {} need more than 63 bits", kind));
  for (std::size_t i = 0; i < places_.size(); ++i) {
    at_reset_ = with_level(at_reset_, places_[i], infos[i].reset_level);
    for (uint64_t rest = places_[i].all(); rest != 0; rest &= rest - 1)
      of_bit_[static_cast<unsigned>(__builtin_ctzll(rest))] = static_cast<uint8_t>(i);
  }
}

uint64_t PackedPins::mask(const std::string& name) const {
  for (const PinPlace& place : places_)
    if (place.name == name) return place.level;
  throw Error(DPSIM_ERR_NOT_FOUND, "the chip has no pin " + name);
}

const KindPins& pins_of_kind(const std::string& kind) {
  static std::map<std::string, KindPins> all;
  const auto found = all.find(kind);
  if (found != all.end()) return found->second;
  uint16_t number = 0;
  check(dpsim_pin_find(kind.c_str(), "RESET", &number));  // its error lists the known kinds
  const KindPins pins{kind, {kind.c_str(), true}, {kind.c_str(), false}};
  return all.emplace(kind, pins).first->second;
}

std::string level_text(const PinPlace& place, dpsim_level level) {
  if (level == DPSIM_Z) return "Z";
  if (level == DPSIM_X) return "X";
  const bool hex = (place.level >> place.shift) > 0xF;
  return hex ? fmt::format("{:02X}", level) : fmt::format("{}", level);
}

std::string time_text(uint64_t tick) {
  const uint64_t cycle = tick / DPSIM_TICKS_PER_CYCLE, rest = tick % DPSIM_TICKS_PER_CYCLE;
  const double us = static_cast<double>(tick) / (1000.0 * DPSIM_TICKS_PER_NS);
  return rest == 0 ? fmt::format("cycle {} ({:.3f} us)", cycle, us)
                   : fmt::format("cycle {} + {} ticks ({:.3f} us)", cycle, rest, us);
}

}  // namespace dsdpv1::simulator
