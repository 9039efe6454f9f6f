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

/// Those from here on are about SPI, then about the UART, which only the DSDPV1-RSU has.
constexpr Check kFirstSpiCheck = Check::kSckHigh, kFirstUartCheck = Check::kRxdCharacterGap;

/// The rules of a part: of all but the DSDPV1-RSU those without the serial ports.
const RuleTable& rules(Part part = {});
/// Of any part: the place of a check is the same in all of their tables.
const Rule& rule(CheckId check);

}  // namespace dsdpv1::checks
