#pragma once
// What the checks found, on a terminal.
#include <string>

#include "tb/bench/record.hpp"

namespace dsdpv1::tb {

/// A row a check that was evaluated, the worst slave's margin in it; below, the first violation of each check and slave
/// with the history of its pins. Empty when nothing was checked.
std::string check_report(const RunResult& result);

}  // namespace dsdpv1::tb
