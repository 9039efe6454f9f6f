#include "tb/sweep/inputs.hpp"

#include "tb/input/input_error.hpp"
#include "tb/scenario/scenario.hpp"
#include "tb/sweep/fingerprint.hpp"

namespace tb::sweep {
namespace {

using Json = nlohmann::ordered_json;

bool names_files(const Parameter& parameter) {
  return scenario::field_of_any(parameter.path, "--param").type.kind == keys::Kind::kFile;
}

Json fingerprint_json(const std::string& file) {
  const std::optional<std::string> found = fingerprint_of_file(file);
  return found ? Json(*found) : Json();
}

/// Empty when there is no such file.
std::vector<std::int64_t> times_of(const std::string& file) {
  struct stat seen {};
  if (stat(file.c_str(), &seen) != 0) return {};
  return {static_cast<std::int64_t>(seen.st_dev),
          static_cast<std::int64_t>(seen.st_ino),
          seen.st_size,
          seen.st_mtim.tv_sec,
          seen.st_mtim.tv_nsec,
          seen.st_ctim.tv_sec,  // cannot be set back
          seen.st_ctim.tv_nsec};
}

[[noreturn]] void fail_changed(const std::string& file) {
  throw InputError(file, 0, "was changed while the sweep ran, allowed is the same content for all of its points");
}

}  // namespace

Inputs::Inputs(const Plan& plan) : plan_(plan), common_{plan.scenario} {
  content_[plan.scenario] = fingerprint(scenario::read_file(plan.scenario));
  const std::vector<std::string> named = scenario::files(plan.scenario, scenario::parse_settings(plan.settings));
  common_.insert(common_.end(), named.begin(), named.end());
  for (const std::string& file : named) content_[file] = fingerprint_json(file);
  for (const Parameter& parameter : plan.parameters) {
    if (!names_files(parameter)) continue;
    for (const std::string& value : parameter.values) {
      const std::string file = scenario::given_path(value);
      content_[file] = fingerprint_json(file);
    }
  }
  if (content_[plan.scenario] != fingerprint_json(plan.scenario)) fail_changed(plan.scenario);
}

std::vector<std::string> Inputs::files_of(std::size_t point) const {
  std::vector<std::string> files = common_;
  const std::vector<std::string> values = plan_.values(point);
  for (std::size_t i = 0; i < values.size(); ++i)
    if (names_files(plan_.parameters[i])) files.push_back(scenario::given_path(values[i]));
  return files;
}

/// The times are taken first: what is written after that shows in the next look.
Inputs::Times Inputs::look(std::size_t point) const {
  Times times;
  for (const std::string& file : files_of(point)) {
    times.push_back(times_of(file));
    if (fingerprint_json(file) != content_.at(file)) fail_changed(file);
  }
  return times;
}

}  // namespace tb::sweep
