#pragma once
#include <string>

namespace dsdpv1::tb {

/// A text as one word of a POSIX shell's command, in quotation marks where it needs them.
std::string shell_word(const std::string& text);

}  // namespace dsdpv1::tb
