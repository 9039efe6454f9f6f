#pragma once
// The checks of the host of an XGate-DPS10 as a table.
#include <cstdint>

#include "tb/chip/checks/check.hpp"

namespace dsdpv1::xgate_checks {

enum class Check : std::uint8_t {
#define X(enumerator, ...) enumerator,
#include "kinds/xgate/check_table.inc"
#undef X
};

const checks::RuleTable& rules();

}  // namespace dsdpv1::xgate_checks
