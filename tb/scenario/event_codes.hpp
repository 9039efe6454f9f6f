#pragma once
// The stable codes by which scenarios, logs and result files name what can happen.
#include <string>
#include <vector>

#include "bus/monitor/monitor.hpp"
#include "driver/dsdpv1.h"

namespace tb::scenario {

/// "BUS_T_SYN", "BUS_COLLISION", ...: what the bus monitor flags.
std::string flag_code(bus::FlagKind kind);
/// "DSDPV1_ERR_INIT_CRC", ...: what a call of the driver returned.
std::string driver_error_code(dsdpv1_error error);
/// The firmware of an ARM board stopped with a fault.
constexpr const char* kFirmwareFault = "ARM_FAULT";
/// All codes of the chip, the driver, the monitor and the ARM board, and the ids of the checks.
const std::vector<std::string>& all_codes();

}  // namespace tb::scenario
