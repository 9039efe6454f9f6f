#pragma once
// A report in JUnit's XML, as Jenkins and GitLab read it.
#include <optional>
#include <string>
#include <vector>

namespace dsdpv1::tb {

struct JunitCase {
  std::string suite, name;
  double seconds = 0;
  std::optional<std::string> failure;                 ///< why; its first line is the message
  std::string output;                                 ///< what it has printed
  std::optional<std::string> skipped = std::nullopt;  ///< why it was not run
};

/// The report `name`: a suite for each name of one, in the order of their first case. Control characters and
/// invalid UTF-8 are shown as escapes (bus::printable_lines), since XML cannot hold them.
std::string junit(const std::string& name, const std::vector<JunitCase>& cases);

}  // namespace dsdpv1::tb
