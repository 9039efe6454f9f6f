#pragma once
// Calls the built dsdpv1-sim, or the one that DSDPV1_SIM of the environment names, as ./run faults does.
// Under DSDPV1_TEST_PROGRAMS alone: elsewhere what calls it is not linked.
#include <filesystem>
#include <string>
#include <vector>

#include "tests/app/folder.hpp"

namespace dsdpv1::app_test {

struct Called {
  int status = 0;  ///< exit code, 128 + signal when it was killed
  std::string out, err;
};

/// The program that call() runs.
std::string simulator();

/// Runs the program with `arguments` (shell words) in `folder`; `program`: another one than the built dsdpv1-sim.
Called call(const std::string& arguments, const std::filesystem::path& folder, const std::string& program = "");

/// The names of scenarios/*.yaml, in order.
std::vector<std::string> shipped_scenarios();

}  // namespace dsdpv1::app_test
