#pragma once
// Scenarios whose user CPUs are in another program: that one takes the place of this one.
#include <optional>
#include <string>
#include <vector>

#include "io/input/read_file.hpp"
#include "tb/scenario/scenario.hpp"

namespace dsdpv1::app {

/// Thrown where another program has to go on; program() lets it, once all that the command has begun is undone.
struct HandOver {
  std::string program;                  ///< path
  std::optional<std::string> scenario;  ///< the text of its file, which can perhaps not be read twice
};

/// Ends this program in favour of the other, with the same words, environment, channels and process number. Returns an
/// exit code when that fails.
int become(const HandOver& other, char** argv);

/// Whether this program has not all that the scenario needs.
bool needs_other_program(const tb::scenario::Scenario& scenario);

/// The path of the program that then has to be called in place of this one: beside this one, in ../libexec/dsdpv1, in
/// PATH. Empty when this one has all that it needs, and when there is no such program: its chips then say what is
/// missing.
std::string other_program(const tb::scenario::Scenario& scenario);

/// Throws HandOver when the scenario needs another program. For commands that read scenarios by name, again and again.
void hand_over(const tb::scenario::Scenario& scenario);

/// The text of the file that says what is to be run, which may come from a pipe. Throws tb::InputError.
std::string load_text(const std::string& path, const tb::FileKind& kind);
/// The scenario of this text; throws HandOver as above. `left`: what the other program gets as load_text.
tb::scenario::Scenario parse_scenario(const std::string& text, const std::string& path,
                                      const std::vector<tb::scenario::Setting>& settings, const std::string& left);
/// Both, as scenario::load for the one scenario of a command, which may come from a pipe. Throws HandOver as above.
tb::scenario::Scenario load_scenario(const std::string& path, const std::vector<tb::scenario::Setting>& settings = {});

}  // namespace dsdpv1::app
