#pragma once
// The checks of the DSDPV1's user side as a table.
#include <cstddef>
#include <cstdint>
#include <iterator>

#include "tb/checks/check.hpp"

namespace dsdpv1::checks {

enum class Check : std::uint8_t {
#define X(enumerator, ...) enumerator,
#include "tb/dsdpv1/checks/check_table.inc"
#undef X
};
/// All of them, in the order of the table.
constexpr Check kAllChecks[] = {
#define X(enumerator, ...) Check::enumerator,
#include "tb/dsdpv1/checks/check_table.inc"
#undef X
};
constexpr std::size_t kCheckCount = std::size(kAllChecks);

const RuleTable& rules();
const Rule& rule(CheckId check);

}  // namespace dsdpv1::checks
