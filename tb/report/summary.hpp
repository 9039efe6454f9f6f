#pragma once
#include <string>

#include "tb/bench/record.hpp"
#include "tb/report/check_report.hpp"

namespace dsdpv1::tb {

/// The text for the terminal at the end of a run: state changes with times, measurements of each slave, expectations,
/// checks, verdict. Waits and holds only if the run did not pass, or with CheckRows::kAll.
std::string summary(const RunResult& result, CheckRows checks = CheckRows::kViolated);

/// The same with all checks and without wrapping, for files.
std::string whole_summary(const RunResult& result);

}  // namespace dsdpv1::tb
