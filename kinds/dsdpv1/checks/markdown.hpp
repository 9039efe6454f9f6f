#pragma once
// Generates docs/checks.md up to the sections of other families.
#include <string>

#include "tb/chip/checks/rules_markdown.hpp"

namespace dsdpv1::checks {

/// How to use the checks of any chip; those of the DSDPV1, each with rule, clause, formula and limit.
std::string markdown(RulingPlace place);

}  // namespace dsdpv1::checks
