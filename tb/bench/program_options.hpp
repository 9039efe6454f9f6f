#pragma once
#include "tb/chip/user_cpu/program.hpp"
#include "tb/scenario/scenario.hpp"

namespace dsdpv1::tb {

/// The settings of the standard user program from the scenario.
user_cpu::ProgramOptions program_options(const scenario::UserCpu& user, const user_cpu::StationConfig& station);

}  // namespace dsdpv1::tb
