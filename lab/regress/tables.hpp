#pragma once
// A regression as text: for programs, for CI, in one line.
#include <string>
#include <vector>

#include "lab/regress/outcome.hpp"
#include "lab/regress/plan.hpp"

namespace dsdpv1::tb::regress {

/// The runs of a plan with their results.
struct Report {
  Plan plan;
  std::vector<Outcome> outcomes;  ///< of the runs, in their order

  bool passed() const;
};

/// One line per run, with a heading, its fields separated by tabs. Control characters in them are shown as escapes.
std::string tsv(const Report& report);
/// The same for people, fitted to a terminal (tb/report/text_table.hpp).
std::string table(const Report& report);
/// One JSON object with counts and runs.
std::string json(const Report& report);
/// JUnit's XML: one suite per scenario.
std::string junit(const Report& report);
/// "57 of 60 runs passed, 2 failed, 1 crashed; 20 combinations that cannot be are left out".
std::string summary(const Report& report);

}  // namespace dsdpv1::tb::regress
