#pragma once
#include <string>

#include "tb/bench/record.hpp"
#include "tb/report/check_report.hpp"

namespace dsdpv1::tb {

/// What the terminal shows at the end of a run: state changes with times, measurements of each slave, expectations,
/// checks, verdict.
std::string summary(const RunResult& result, CheckRows checks = CheckRows::kViolated);

/// The same with all checks, as wide as it is: what files keep.
std::string whole_summary(const RunResult& result);

}  // namespace dsdpv1::tb
