#pragma once
// The description of the target for gdb, in XML ("Debugging with GDB", appendices G and E.16).
#include <string>
#include <vector>

#include "board/cpu/debug_target.hpp"

namespace dsdpv1::arm {

/// Features org.gnu.gdb.arm.m-profile and org.gnu.gdb.arm.m-system; the registers have the numbers of Register, each
/// has 32 bits.
std::string target_description();

/// The regions as `ram` and `rom`: gdb sets hardware breakpoints in the latter without being asked.
std::string memory_map_description(const std::vector<MemoryRegion>& regions);

}  // namespace dsdpv1::arm
