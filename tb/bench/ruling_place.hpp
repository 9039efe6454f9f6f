#pragma once
// Where docs/ has a ruling or a clause.
#include <string>
#include <vector>

namespace dsdpv1::tb {

/// "S6": its page and anchor, "chip.md#s6".
std::string ruling_place(const std::string& name);
/// The names of "S6, T19-4".
std::vector<std::string> names_of(const std::string& list);

}  // namespace dsdpv1::tb
