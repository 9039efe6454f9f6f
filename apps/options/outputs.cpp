#include "apps/options/outputs.hpp"

#include <unistd.h>

#include <iostream>
#include <map>

#include "apps/exit_codes.hpp"
#include "apps/interrupt.hpp"
#include "io/input/input_error.hpp"
#include "io/output/output_place.hpp"
#include "io/output/write_file.hpp"

namespace dsdpv1::app {
namespace {

using Owners = std::map<std::string, std::string>;  ///< what a file is, by its identity

void add(Owners& owners, const std::optional<std::string>& identity, const std::string& what) {
  if (identity) owners.emplace(*identity, what);
}

}  // namespace

std::vector<NamedFile> scenario_inputs(const std::string& scenario, const std::vector<std::string>& named) {
  std::vector<NamedFile> inputs = {{"the scenario", scenario}};
  for (const std::string& file : named) inputs.push_back({"a file of the scenario", file});
  return inputs;
}

void check_outputs(const std::string& command, const std::vector<NamedFile>& inputs,
                   const std::vector<NamedFile>& outputs) {
  Owners owners;
  for (const NamedFile& input : inputs)
    if (!input.path.empty()) add(owners, tb::input_identity(input.path), input.what);
  add(owners, tb::file_identity(STDOUT_FILENO), "the file of standard output");
  add(owners, tb::file_identity(STDERR_FILENO), "the file of the error channel");
  for (const NamedFile& output : outputs) {
    if (output.path.empty()) continue;
    const std::optional<std::string> identity = tb::output_identity(output.path);
    if (!identity) continue;
    const auto [owner, free] = owners.emplace(*identity, output.what);
    if (free) continue;
    throw tb::InputError(command + ": " + output.what + " would replace " + owner->second + ", " + output.path +
                         ", expected a separate file");
  }
}

void write_wanted(const std::string& path, const std::string& text) {
  if (!path.empty()) tb::write_file(path, text);
}

int print_or_write(const std::string& command, const std::string& text, const std::string& output) {
  if (output.empty()) {
    std::cout << text << std::flush;
    return kPassed;
  }
  leave_nothing_on_signals();
  check_outputs(command, {}, {{"--output", output}});
  tb::write_file(output, text);
  return kPassed;
}

}  // namespace dsdpv1::app
