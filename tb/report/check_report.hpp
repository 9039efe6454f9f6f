#pragma once
// The findings of the checks, for a terminal.
#include <string>

#include "tb/bench/record.hpp"

namespace dsdpv1::tb {

/// The checks that have a row in the table.
enum class CheckRows { kViolated, kAll };

/// How many checks were kept and which the tightest is; a row for each check that was violated, or for all that were
/// evaluated, with the worst slave's margin; below, the first violation of each check and slave with the history of its
/// pins. Empty when nothing was checked.
std::string check_report(const RunResult& result, CheckRows wanted);

}  // namespace dsdpv1::tb
