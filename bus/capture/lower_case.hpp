// For names and headings in capture files, whose case varies.
#pragma once

#include <cctype>
#include <string>

namespace dsdpv1::bus::capture {

/// Converts ASCII letters; all other bytes stay.
inline std::string lower_case(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

}  // namespace dsdpv1::bus::capture
