#pragma once
#include "tb/chip/user_cpu/program.hpp"
#include "tb/scenario/scenario.hpp"

namespace dsdpv1::tb {

/// The settings of the standard user program from the scenario.
user_cpu::ProgramOptions program_options(const scenario::UserCpu& user, const user_cpu::StationConfig& station);

/// A diagnosis as the chips' users write it, and as the log shows it: bit 7 for one that begins, the low bits for its
/// kind.
std::uint8_t diagnosis_code(user_cpu::DiagnosisKind kind);

}  // namespace dsdpv1::tb
