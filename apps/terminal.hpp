#pragma once
// What standard output is shown on.
#include <cstddef>
#include <string>

namespace dsdpv1::app {

/// The columns of the terminal that standard output goes to; tb::TableWidth::kUnlimited when it goes elsewhere.
std::size_t terminal_columns();

/// What --color says; auto: standard output is a terminal that can, and NO_COLOR (no-color.org) does not forbid it.
bool wants_colour(const std::string& word);

/// A line (without its end) with what stands out in colour: verdicts, violations, expectations that are not met. They
/// are found by the words that this program uses for them; nothing that others have named can bring colours of its own.
std::string painted(const std::string& line);

}  // namespace dsdpv1::app
