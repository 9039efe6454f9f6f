#pragma once
// The part of docs/checks.md about the host of an XGate-DPS10.
#include <string>

#include "tb/chip/checks/rules_markdown.hpp"

namespace dsdpv1::xgate_checks {

std::string markdown(checks::RulingPlace place);

}  // namespace dsdpv1::xgate_checks
