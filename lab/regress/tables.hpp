#pragma once
// A regression as text: for programs, for CI, in one line.
#include <string>
#include <vector>

#include "lab/regress/folder.hpp"
#include "lab/regress/outcome.hpp"

namespace dsdpv1::tb::regress {

/// The runs of a plan with their results.
struct Report {
  Description description;
  std::vector<Outcome> outcomes;  ///< of the runs, in their order
  std::string folder;             ///< as the user has named it
  std::string more = {};          ///< HTML below the table of the runs

  /// All that were run; false when all were only listed.
  bool passed() const;
  const std::vector<Run>& runs() const { return description.plan.runs; }
  /// The command line that carries a run out again, in the folder in which this was called.
  std::string again(const Run& run, const Outcome& outcome) const;
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
