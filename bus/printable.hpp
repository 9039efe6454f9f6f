#pragma once
// Makes foreign text (names, file names, firmware output) safe for a terminal, a table or a log.
#include <string>
#include <string_view>

namespace dsdpv1::bus {

/// `text` as one line without control effects: control characters (C0, DEL, C1), marks that change the writing
/// direction, line separators and invalid UTF-8 become
/// , \r, \t, \x1B, \u202E. Letters of every script stay. Idempotent.
std::string printable(std::string_view text);

/// As above, for text laid out by the program: line ends and tabs stay.
std::string printable_lines(std::string_view text);

}  // namespace dsdpv1::bus
