#pragma once
// The checks of the user's side of a chip of the SPC3 family as a table.
#include <cstdint>

#include "tb/chip/checks/check.hpp"

namespace dsdpv1::spc3_checks {

enum class Check : std::uint8_t {
#define X(enumerator, ...) enumerator,
#include "kinds/spc3/checks/check_table.inc"
#undef X
};

const checks::RuleTable& rules();

}  // namespace dsdpv1::spc3_checks
