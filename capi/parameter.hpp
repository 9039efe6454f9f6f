#pragma once
// The parameters of a kind of chip as numbers, derived from its keys in scenarios.
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "capi/names.hpp"
#include "dsdpv1/chip.h"
#include "tb/chip/chip_kind.hpp"

namespace dsdpv1::capi {

struct Kind;

struct Parameter {
  std::string name;              ///< the key; each number of a list separately: "uart_gaps[3]"
  const tb::keys::Field* field;  ///< the key
  std::optional<std::size_t> element;
  tb::keys::Range range;
  std::int64_t default_value;
};

/// All integers, integers in lists, words and times, except straps: their levels are set at the pins.
std::vector<Parameter> parameters_of(const tb::ChipKind& chip);

/// Throws for an unknown name or a value out of range.
void set_parameters(const dpsim_parameter* values, std::size_t count, const Kind& kind, tb::OwnSettings& settings);

}  // namespace dsdpv1::capi
