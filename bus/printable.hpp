#pragma once
// Text of others - names, file names, firmware - as it may go to a terminal, a table or a log.
#include <string>
#include <string_view>

namespace dsdpv1::bus {

/// `text` as one line that steers nothing: control characters (C0, DEL, C1), marks that turn the direction of writing,
/// separators of lines and bytes that are no UTF-8 become \n, \r, \t, \x1B, \u202E. Letters of every script stay. Done
/// twice it is done once.
std::string printable(std::string_view text);

/// The same for text that the program has laid out itself: line ends and tabs stay.
std::string printable_lines(std::string_view text);

}  // namespace dsdpv1::bus
