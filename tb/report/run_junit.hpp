#pragma once
// A single run in JUnit's XML.
#include <vector>

#include "tb/bench/record.hpp"
#include "tb/report/junit.hpp"

namespace dsdpv1::tb {

/// A suite with the scenario's file as its name: a case for the run itself, with its wall time and its table, one for
/// violations, one for each expectation, and one for model and RTL in lockstep.
std::vector<JunitCase> run_cases(const RunResult& result);

}  // namespace dsdpv1::tb
