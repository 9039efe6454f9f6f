#pragma once
// The main function of a program with all commands: dsdpv1-sim, and programs with chips that are not in it
// (docs/own_slave.md).
#include <functional>

#include "tb/chip/chip_kind.hpp"

namespace dsdpv1::app {

/// Carries out the command line and returns the exit code: 0 passed, 1 failed, 2 wrong input, 3 nothing judged, 130
/// interrupted. Call it once, first in main(). `name`: of the program in its messages. `kinds`: added to the built-in
/// ones; they must outlive the program.
int program(int argc, char** argv, const char* name, const tb::ChipKinds& kinds = {});
/// Likewise, with kinds made by `make`, whose std::invalid_argument is wrong input.
int program(int argc, char** argv, const char* name, const std::function<tb::ChipKinds()>& make);

}  // namespace dsdpv1::app
