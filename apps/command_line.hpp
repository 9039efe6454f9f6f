#pragma once
// The command line of dsdpv1-sim: which commands there are (commands/), and what they have in common.
#include "apps/printable_output.hpp"

namespace dsdpv1::app {

/// Parses the command line and carries it out; returns the exit code. `output` is painted when the terminal or --color
/// wants it. Throws tb::InputError.
int command_line(int argc, char** argv, PrintableOutput& output);

}  // namespace dsdpv1::app
