#pragma once
// The stable codes by which scenarios, logs and result files name what can happen.
#include <string>
#include <vector>

#include "bus/monitor/monitor.hpp"
#include "tb/chip/chip_kind.hpp"

namespace dsdpv1::tb::scenario {

/// "BUS_T_SYN", "BUS_COLLISION", ...: what the bus monitor flags.
std::string flag_code(bus::FlagKind kind);
/// The program of a user CPU stopped with a fault.
constexpr const char* kFirmwareFault = "ARM_FAULT";
/// All codes of the kind of chip and of the monitor, and the ids of the checks.
const std::vector<std::string>& all_codes(const ChipKind& kind);

}  // namespace dsdpv1::tb::scenario
