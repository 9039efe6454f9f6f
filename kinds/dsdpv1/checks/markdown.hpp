#pragma once
// docs/checks.md.
#include <string>

namespace dsdpv1::checks {

/// The whole document: how the checks are used, and each of them with rule, clause, formula and limit.
std::string markdown();

}  // namespace dsdpv1::checks
