#include "apps/options/checks.hpp"

#include <CLI/Option.hpp>

#include "apps/command_line.hpp"

namespace dsdpv1::app {

CLI::Option* add_checks_option(CLI::App& command, std::string& word) {
  return command.add_option(
      "--checks", word,
      "The checks of docs/checks.md on handshake, bus timing and DPRAM: fail (exit 1 on a violation that the scenario "
      "does not allow), report (listed, and counted beside the verdict), off; left out: as the scenario says, else "
      "fail");
}

std::optional<tb::ChecksMode> checks_mode(const std::string& command, const std::string& word) {
  if (word.empty()) return std::nullopt;
  check_word(command + ": --checks", word, {"fail", "report", "off"});
  if (word == "off") return tb::ChecksMode::kOff;
  return word == "report" ? tb::ChecksMode::kReport : tb::ChecksMode::kFail;
}

}  // namespace dsdpv1::app
