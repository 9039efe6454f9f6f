#pragma once
// The option --checks, which several commands have, and the exit code of a run.
#include <CLI/App.hpp>

#include <optional>
#include <string>

#include "tb/bench/verdict.hpp"

namespace dsdpv1::app {

CLI::Option* add_checks_option(CLI::App& command, std::string& word);

/// Absent for an empty word: as the scenario says. Throws tb::InputError; `command` as "run".
std::optional<tb::ChecksMode> checks_mode(const std::string& command, const std::string& word);

}  // namespace dsdpv1::app
