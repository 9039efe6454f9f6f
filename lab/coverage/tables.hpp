#pragma once
// Coverage for people and programs: sums by file, and what is missing.
#include <cstddef>
#include <string>

#include "lab/coverage/reached.hpp"

namespace dsdpv1::tb::coverage {

/// "880 of 901 lines, 310 of 322 branches, 8698 of 10067 toggles".
std::string summary(const Files& files);
/// A line per file and one for all: file, then reached and all of lines, branches and toggles, separated by tabs.
std::string tsv(const Files& files);
/// A line for each place that was not reached: file:line, what, separated by tabs. The bits of a signal together.
std::string missing_tsv(const Files& files);
/// A heading, the table, and what was not reached below each file, as a part of a page.
std::string html(const Files& files);

}  // namespace dsdpv1::tb::coverage
