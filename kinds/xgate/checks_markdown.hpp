#pragma once
// The part of docs/checks.md about the host of an XGate-DPS10.
#include <string>

namespace dsdpv1::xgate_checks {

std::string markdown();

}  // namespace dsdpv1::xgate_checks
