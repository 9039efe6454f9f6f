#pragma once
// What a command reads and writes, looked at before it begins: no output may replace an input or another output.
#include <string>
#include <vector>

namespace dsdpv1::app {

struct NamedFile {
  std::string what;  ///< as in "--log", "the scenario"
  std::string path;  ///< empty: not wanted
};

/// The scenario and the files that it names.
std::vector<NamedFile> scenario_inputs(const std::string& scenario, const std::vector<std::string>& named);

/// Throws InputError unless the outputs are apart from the inputs, from each other, and from the files that standard
/// output and the error channel go to. `command`: as "dsdpv1-sim run".
void check_outputs(const std::string& command, const std::vector<NamedFile>& inputs,
                   const std::vector<NamedFile>& outputs);

/// The whole file; nothing where the path is empty. Throws InputError when it cannot be written.
void write_wanted(const std::string& path, const std::string& text);

}  // namespace dsdpv1::app
