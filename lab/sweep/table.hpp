#pragma once
// The points of a sweep as tables.
#include <string>
#include <vector>

#include "lab/sweep/plan.hpp"
#include "lab/sweep/point.hpp"

namespace dsdpv1::tb::sweep {

/// The ids of the checks of all points, in order of first appearance.
std::vector<std::string> check_ids(const std::vector<Point>& points);

/// results.csv: a row per point with its parameters, verdict, violations, the worst margin of all and of each check,
/// and the first violation. Times in ns. Fields with commas, quotes or line ends are quoted (RFC 4180).
std::string csv(const Plan& plan, const std::vector<Point>& points);

/// For the terminal: a row for each combination of all parameters but the first, with the values of the first at which
/// the timing holds and does not, and where the first violation begins.
std::string summary(const Plan& plan, const std::vector<Point>& points);

}  // namespace dsdpv1::tb::sweep
