#pragma once
#include <string>

#include "tb/bench/record.hpp"

namespace dsdpv1::tb {

/// What the terminal shows at the end of a run: state changes with times, measurements of each slave, expectations,
/// verdict.
std::string summary(const RunResult& result);

}  // namespace dsdpv1::tb
