#pragma once
// Scenarios as the command line names them.
#include <string>
#include <vector>

namespace dsdpv1::app {

/// The folder of the scenarios that come with the program.
std::string scenario_folder();

/// All that are in it, in order. Throws tb::InputError where the folder is not there.
std::vector<std::string> shipped_scenarios();

/// A path as it is; a name without folder and ending, where no file is called so, is that of a scenario that comes with
/// the program. Throws tb::InputError, with the nearest name, for one that is not there; `command` as "dsdpv1-sim run".
std::string scenario_file(const std::string& command, const std::string& word);

}  // namespace dsdpv1::app
