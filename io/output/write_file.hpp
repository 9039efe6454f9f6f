#pragma once
// A file of one text, complete or absent.
#include <string>
#include <string_view>

namespace dsdpv1::tb {

/// Replaces an existing file. Throws InputError when it cannot be written.
void write_file(const std::string& path, std::string_view text);

}  // namespace dsdpv1::tb
