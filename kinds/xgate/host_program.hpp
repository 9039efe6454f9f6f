#pragma once
// The program of an XGate-DPS10's user CPU: driver/xgate on a HostLine.
#include "tb/kit/slave_kit.hpp"

namespace dsdpv1::xgate {

/// Codes of its errors.
const tb::CodeTable& program_codes();

/// kit::Parts::program.
void run_host(kit::Cpu& cpu);

}  // namespace dsdpv1::xgate
