#pragma once
#include "tb/scenario/scenario.hpp"

namespace dsdpv1::tb::scenario {

/// Checks that the keys cannot express: names that refer to each other, values that must fit together. Throws
/// InputError.
void check(const Scenario& scenario);
void check(const Scenario& scenario, const Action& action);

}  // namespace dsdpv1::tb::scenario
