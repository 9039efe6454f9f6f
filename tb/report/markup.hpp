#pragma once
// Text in HTML and SVG.
#include <string>
#include <string_view>

namespace dsdpv1::tb {

/// Also fit for the value of an attribute in double quotes.
std::string markup_escaped(std::string_view text);

}  // namespace dsdpv1::tb
