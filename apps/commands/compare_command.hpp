#pragma once
// compare: two waves of any simulators held against each other.
#include <optional>
#include <string>
#include <vector>

namespace dsdpv1::app {

struct CompareArguments {
  std::string a, b;
  std::string scope, scope_a, scope_b;
  std::string pins;  ///< a map of pins, or kOwnRtl
  std::vector<std::string> signals, masks;
  std::string from, to, shift, tolerance, clock, x = "expected", z = "equal";
  std::string wave, json, junit;
  std::optional<bool> progress;
  bool quiet = false;
};

/// In the place of a map: the names of the reference RTL.
constexpr const char* kOwnRtl = "rtl_ref";

int compare(const CompareArguments& arguments);

}  // namespace dsdpv1::app
