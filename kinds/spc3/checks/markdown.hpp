#pragma once
// Generates the last sections of docs/checks.md.
#include <string>

#include "tb/chip/checks/rules_markdown.hpp"

namespace dsdpv1::spc3_checks {

/// The sight of the checks of the SPC3 family, and each with rule, clause, formula and limit.
std::string markdown(checks::RulingPlace place);

}  // namespace dsdpv1::spc3_checks
