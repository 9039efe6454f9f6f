#pragma once
// The terminal of standard output.
#include <cstddef>
#include <string>

namespace dsdpv1::app {

/// The columns of the terminal that standard output goes to; tb::TableWidth::kUnlimited when it goes elsewhere.
std::size_t terminal_columns();

/// The value of --color; auto: standard output is a terminal that can, and NO_COLOR (no-color.org) does not forbid
/// it.
bool wants_colour(const std::string& word);

/// A line (without its end) with what stands out in colour: verdicts, violations, expectations that are not met. They
/// are found by this program's words for them; names from users cannot add colours.
std::string painted(const std::string& line);

}  // namespace dsdpv1::app
