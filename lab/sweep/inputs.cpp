#include "lab/sweep/inputs.hpp"

#include "lab/sweep/folder.hpp"
#include "tb/scenario/scenario.hpp"

namespace dsdpv1::tb::sweep {
namespace {

bool names_files(const Parameter& parameter) {
  return scenario::field_of_any(parameter.path, "--param").type.kind == keys::Kind::kFile;
}

}  // namespace

Inputs::Inputs(const Plan& plan) : plan_(plan), common_{plan.scenario}, contents_(kind()) {
  contents_.add_scenario(plan.scenario);
  const std::vector<std::string> named = scenario::files(plan.scenario, scenario::parse_settings(plan.settings));
  common_.insert(common_.end(), named.begin(), named.end());
  for (const std::string& file : named) contents_.add(file);
  for (const Parameter& parameter : plan.parameters) {
    if (!names_files(parameter)) continue;
    for (const std::string& value : parameter.values) contents_.add(scenario::given_path(value));
  }
}

std::vector<std::string> Inputs::files_of(std::size_t point) const {
  std::vector<std::string> files = common_;
  const std::vector<std::string> values = plan_.values(point);
  for (std::size_t i = 0; i < values.size(); ++i)
    if (names_files(plan_.parameters[i])) files.push_back(scenario::given_path(values[i]));
  return files;
}

}  // namespace dsdpv1::tb::sweep
