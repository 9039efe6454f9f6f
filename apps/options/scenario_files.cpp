#include "apps/options/scenario_files.hpp"

#include <algorithm>
#include <filesystem>

#include "apps/data_folder.hpp"
#include "io/input/input_error.hpp"
#include "io/input/read_file.hpp"
#include "io/input/suggest.hpp"

namespace dsdpv1::app {

namespace fs = std::filesystem;

std::string scenario_folder() { return fs::path(data_folder()) / "scenarios"; }

std::vector<std::string> shipped_scenarios() {
  std::error_code error;
  std::vector<std::string> files;
  for (const auto& entry : fs::directory_iterator(scenario_folder(), error))
    if (entry.path().extension() == ".yaml") files.push_back(entry.path());
  if (error) throw tb::InputError(scenario_folder(), 0, "is no folder of scenarios, expected scenarios by their paths");
  std::sort(files.begin(), files.end());
  return files;
}

namespace {

std::vector<std::string> shipped_names() {
  std::vector<std::string> names;
  if (!fs::is_directory(scenario_folder())) return names;  // a user's program has none
  for (const std::string& file : shipped_scenarios()) names.push_back(fs::path(file).stem());
  return names;
}

}  // namespace

std::string scenario_file(const std::string& command, const std::string& word) {
  std::error_code error;
  if (word.empty() || fs::exists(word, error) || error) return word;
  if (word.find('/') == std::string::npos && !fs::path(word).has_extension()) {
    std::string file = fs::path(scenario_folder()) / (word + ".yaml");
    if (fs::exists(file, error)) return file;
    const std::vector<std::string> names = shipped_names();
    throw tb::InputError(
        command + ": there is no scenario " + word + tb::did_you_mean(word, names) +
        (names.empty() ? ", expected a path" : ", expected a path and the names that traces list shows"));
  }
  const std::string name = tb::nearest_file(word).empty() ? tb::nearest(fs::path(word).stem(), shipped_names()) : "";
  if (name.empty()) return word;
  throw tb::InputError(word, 0, "no such file (did you mean " + name + "?), expected a scenario in YAML");
}

}  // namespace dsdpv1::app
