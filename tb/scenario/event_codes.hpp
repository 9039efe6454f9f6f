#pragma once
// The stable codes for events in scenarios, logs and result files.
#include <string>
#include <vector>

#include "bus/monitor/monitor.hpp"
#include "tb/chip/chip_kind.hpp"

namespace dsdpv1::tb::scenario {

/// "BUS_T_SYN", "BUS_COLLISION", ...: flags of the bus monitor.
std::string flag_code(bus::FlagKind kind);
/// All of these with what they say.
std::vector<CodeText> flag_codes();
/// A host of serve sent before it had its answer; and what the table of codes says of it.
constexpr const char* kHostEarly = "HOST_EARLY";
CodeText host_code();
/// The program of a user CPU stopped with a fault.
constexpr const char* kFirmwareFault = "ARM_FAULT";
/// All codes of the kind of chip and of the monitor, and the ids of the checks.
const std::vector<std::string>& all_codes(const ChipKind& kind);
/// True if `code` is one of them; for a code of the chip the list and its texts are not made.
bool is_code(const ChipKind& kind, const std::string& code);

}  // namespace dsdpv1::tb::scenario
