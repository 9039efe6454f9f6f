#pragma once
// Generates docs/checks.md.
#include <string>

namespace dsdpv1::checks {

/// The whole document: how to use the checks, and each with rule, clause, formula and limit.
std::string markdown();

}  // namespace dsdpv1::checks
