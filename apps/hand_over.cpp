#include "apps/hand_over.hpp"

#include <sys/mman.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <sstream>

#include "apps/exit_codes.hpp"
#include "bus/printable.hpp"
#include "io/input/read_file.hpp"
#include "tb/chip/chip_kind.hpp"

namespace dsdpv1::app {
namespace {

namespace fs = std::filesystem;

/// Names the descriptor of the scenario's text to the program that takes over.
constexpr const char* kTextVariable = "DSDPV1_SCENARIO_TEXT";

std::vector<fs::path> folders() {
  const fs::path own = fs::read_symlink("/proc/self/exe").parent_path();
  std::vector<fs::path> all = {own, own.parent_path() / "libexec" / "dsdpv1"};
  const char* const path = std::getenv("PATH");
  std::istringstream words(path == nullptr ? "" : path);
  for (std::string word; std::getline(words, word, ':');) all.emplace_back(word.empty() ? "." : word);
  return all;
}

std::string find_program(const std::string& name) {
  std::error_code error;
  for (const fs::path& folder : folders()) {
    const fs::path path = folder / name;
    if (fs::is_regular_file(path, error) && access(path.c_str(), X_OK) == 0) return path;
  }
  return "";
}

std::string name_of_other(const tb::scenario::Scenario& scenario) {
  const tb::ChipKind& kind = *scenario.kind;
  for (const tb::scenario::Slave& slave : scenario.slaves) {
    std::string name = kind.other_program(slave);
    if (!name.empty()) return name;
  }
  return "";
}

/// The file has no name and stays open beyond the exec.
bool leave_text(const std::string& text) {
  const int file = memfd_create("scenario", 0);
  if (file < 0 || write(file, text.data(), text.size()) != static_cast<ssize_t>(text.size())) return false;
  return setenv(kTextVariable, std::to_string(file).c_str(), 1) == 0;
}

/// The first library that the program needs and that the dynamic linker does not find; empty when all are there. Asked
/// as ldd asks: once the program has taken this one's place, it would be the linker that complains, with exit code 127.
std::string missing_library(const std::string& program) {
  setenv("DSDPV1_ASKED", program.c_str(), 1);  // needs no quoting then
  std::FILE* const told = popen("LD_TRACE_LOADED_OBJECTS=1 exec \"$DSDPV1_ASKED\" --version 2>/dev/null", "r");
  unsetenv("DSDPV1_ASKED");
  if (told == nullptr) return "";
  std::string missing;
  std::array<char, 1024> line{};
  while (std::fgets(line.data(), line.size(), told) != nullptr) {
    std::istringstream words(line.data());
    if (missing.empty() && std::strstr(line.data(), " => not found") != nullptr) words >> missing;
  }
  pclose(told);
  return missing;
}

/// What leave_text has left to this program.
std::optional<std::string> left_text(const tb::FileKind& kind) {
  const char* const left = std::getenv(kTextVariable);
  if (left == nullptr) return std::nullopt;
  const std::string file = left;
  unsetenv(kTextVariable);  // is not for the runs of a campaign
  std::string text = tb::read_file("/proc/self/fd/" + file, kind);
  close(static_cast<int>(std::strtol(file.c_str(), nullptr, 10)));
  return text;
}

}  // namespace

int become(const HandOver& other, char** argv) {
  const std::string missing = missing_library(other.program);
  if (missing.empty() && (!other.scenario || leave_text(*other.scenario))) execv(other.program.c_str(), argv);
  const std::string why = missing.empty() ? std::strerror(errno) : "its library " + missing + " is not installed";
  std::fprintf(stderr, "dsdpv1-sim: %s cannot be started: %s\n", bus::printable(other.program).c_str(), why.c_str());
  return kWrongInput;
}

bool needs_other_program(const tb::scenario::Scenario& scenario) { return !name_of_other(scenario).empty(); }

std::string other_program(const tb::scenario::Scenario& scenario) {
  const std::string name = name_of_other(scenario);
  return name.empty() ? "" : find_program(name);
}

void hand_over(const tb::scenario::Scenario& scenario) {
  if (std::string program = other_program(scenario); !program.empty()) throw HandOver{std::move(program), std::nullopt};
}

std::string load_text(const std::string& path, const tb::FileKind& kind) {
  std::optional<std::string> text = left_text(kind);
  return text ? std::move(*text) : tb::read_file(path, kind);
}

tb::scenario::Scenario parse_scenario(const std::string& text, const std::string& path,
                                      const std::vector<tb::scenario::Setting>& settings, const std::string& left) {
  tb::scenario::Scenario scenario = tb::scenario::parse(text, path, settings);
  if (std::string program = other_program(scenario); !program.empty()) throw HandOver{std::move(program), left};
  return scenario;
}

tb::scenario::Scenario load_scenario(const std::string& path, const std::vector<tb::scenario::Setting>& settings) {
  const std::string text = load_text(path, tb::kScenarioFile);
  return parse_scenario(text, path, settings, text);
}

}  // namespace dsdpv1::app
