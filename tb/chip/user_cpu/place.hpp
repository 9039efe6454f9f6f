#pragma once
// The line of a user program that did something at its chip, or where the program was while it did nothing.
#include <cstdint>
#include <optional>
#include <string>

#include "bus/time.hpp"

namespace dsdpv1::user_cpu {

struct Place {
  std::string file;      ///< without folders; empty: the program has no line for this address
  int line = 0;          ///< 0 without a file
  std::string function;  ///< empty: not known
  std::uint32_t pc = 0;
  std::optional<bus::Tick> stayed = {};  ///< of an omission: how long the program was in the function meanwhile
};

/// What a user CPU did at the pins of its chip: an access, or a store that moved a pin.
struct Act {
  bus::Tick at = 0;                        ///< the last one up to then
  std::optional<bus::Tick> since = {};     ///< an omission: nothing was done from then until `at`
  std::optional<std::uint16_t> cell = {};  ///< the last write to this cell; if that is not known, the last release
  bool look = false;                       ///< the look at pins of the chip that was made at `at`

  static Act done(bus::Tick at) { return {at}; }
  static Act omitted(bus::Tick since, bus::Tick until) { return {until, since}; }
  static Act looked(bus::Tick at) { return {at, {}, {}, true}; }
  static Act written(std::uint16_t cell, bus::Tick until) { return {until, {}, cell}; }
};

}  // namespace dsdpv1::user_cpu
