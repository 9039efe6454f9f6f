#pragma once
// The checks of the DSDPV1's user side as a table.
#include <cstdint>

#include "model/dsdpv1/pins.hpp"
#include "tb/chip/checks/check.hpp"

namespace dsdpv1::checks {

enum class Check : std::uint8_t {
#define X(enumerator, ...) enumerator,
#include "kinds/dsdpv1/checks/check_table.inc"
#undef X
};
/// All of them, in the order of the table.
constexpr Check kAllChecks[] = {
#define X(enumerator, ...) Check::enumerator,
#include "kinds/dsdpv1/checks/check_table.inc"
#undef X
};

/// The first check of any host port; the checks before it are about the parallel one.
constexpr Check kFirstCommonCheck = Check::kBlockServed;
/// The first checks about SPI and UART, which only the DSDPV1-RSU has; SPI first.
constexpr Check kFirstSpiCheck = Check::kSckHigh, kFirstUartCheck = Check::kRxdCharacterGap;

/// The rules of a part: without the serial ports for all except the DSDPV1-RSU.
const RuleTable& rules(Part part = {});
/// For any part: the position of a check is the same in all tables.
const Rule& rule(CheckId check);

}  // namespace dsdpv1::checks
