#pragma once
// What a run of accept has shown: for each stimulus what was met how often, and a verdict.
#include <string>
#include <vector>

#include "lab/accept/facts.hpp"
#include "lab/accept/plan.hpp"
#include "tb/bench/record.hpp"

namespace dsdpv1::tb::accept {

/// Adds to the result, as expectations, what the slave owes under each stimulus.
void judge(RunResult& result, const Plan& plan, const Facts& facts);

/// The table of stimuli, for the terminal.
std::string table(const Plan& plan, const Facts& facts);

}  // namespace dsdpv1::tb::accept
