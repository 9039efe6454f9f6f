#pragma once
// Generates docs/checks.md up to the sections of other families.
#include <string>

namespace dsdpv1::checks {

/// How to use the checks of any chip; those of the DSDPV1, each with rule, clause, formula and limit.
std::string markdown();

}  // namespace dsdpv1::checks
