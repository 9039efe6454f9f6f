#pragma once
// A command's inputs and outputs, checked before it begins: no output may replace an input or another output.
#include <optional>
#include <string>
#include <vector>

#include "io/output/output_file.hpp"

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

/// A file that an option may ask for: opened at once, so that what is wrong with its name shows before the work.
class WantedFile {
 public:
  /// Empty: not wanted. Throws tb::InputError.
  explicit WantedFile(const std::string& path) {
    if (!path.empty()) file_.emplace(path);
  }
  /// All that `text` returns, which is asked only where the file is wanted. Throws tb::InputError when it cannot be
  /// written.
  template <typename Text>
  void write(const Text& text) {
    if (!file_) return;
    file_->write(text());
    file_->commit();
  }

 private:
  std::optional<tb::OutputFile> file_;
};

/// The text of a command that has nothing else: to standard output, or into the file where `output` names one. Returns
/// the exit code; throws tb::InputError.
int print_or_write(const std::string& command, const std::string& text, const std::string& output);

/// The whole file; nothing where the path is empty. Throws InputError when it cannot be written.
void write_wanted(const std::string& path, const std::string& text);

}  // namespace dsdpv1::app
