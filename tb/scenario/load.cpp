// From a file to a checked scenario.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "tb/scenario/check.hpp"
#include "tb/scenario/input_error.hpp"
#include "tb/scenario/scenario.hpp"

namespace tb::scenario {
namespace {

constexpr std::uintmax_t kLargestFile = 4U
                                        << 20;  // far beyond every scenario; keeps a wrong file from filling the memory

std::string read_file(const std::string& path) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) throw InputError(path, 0, "no such file, allowed is a scenario in YAML");
  if (std::filesystem::is_directory(status)) throw InputError(path, 0, "is a folder, allowed is a scenario in YAML");
  if (std::filesystem::is_regular_file(status) && std::filesystem::file_size(path, error) > kLargestFile) {
    throw InputError(path, 0, "is larger than 4 MB, allowed is a scenario in YAML");
  }
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  if (!in) throw InputError(path, 0, "cannot be read");
  return text.str();
}

YAML::Node parse_yaml(const std::string& text, const std::string& file) {
  try {
    const std::vector<YAML::Node> documents = YAML::LoadAll(text);
    if (documents.empty() || documents[0].IsNull()) throw InputError(file, 1, "is empty, allowed is a scenario");
    if (documents.size() > 1)
      throw InputError(file, keys::line_of(documents[1]), "a second document, allowed is one scenario a file");
    return documents[0];
  } catch (const YAML::Exception& error) {
    throw InputError(file, error.mark.line + 1, "is not YAML: " + error.msg);
  }
}

}  // namespace

Scenario parse(const std::string& text, const std::string& file) {
  const YAML::Node root = parse_yaml(text, file);
  Scenario scenario;
  keys::read_object(description(), &scenario, root, {file});
  scenario.file = file;
  check(scenario);
  return scenario;
}

Scenario load(const std::string& path) { return parse(read_file(path), path); }

bool allows(const Scenario& scenario, const std::string& code, const std::string& station) {
  return std::any_of(scenario.allow.begin(), scenario.allow.end(), [&](const Allow& allow) {
    return allow.event.text == code && (allow.slave.empty() || allow.slave.text == station);
  });
}

std::string resolve(const Scenario& scenario, const Name& path) {
  return (std::filesystem::path(scenario.file).parent_path() / path.text).lexically_normal().string();
}

}  // namespace tb::scenario
