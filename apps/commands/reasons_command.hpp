#pragma once
// reasons: every code that logs, scenarios and result files may hold, with what to do about it.
#include <string>

namespace dsdpv1::app {

struct ReasonsArguments {
  std::string code;  ///< only this one; empty: all
  bool markdown = false;
  bool checks = false;  ///< docs/checks.md
  std::string output;   ///< empty: standard output
};

int reasons(const ReasonsArguments& arguments);

}  // namespace dsdpv1::app
