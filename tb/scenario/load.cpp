// From a file to a checked scenario.
#include <fmt/format.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>

#include "io/input/input_error.hpp"
#include "io/input/read_file.hpp"
#include "tb/scenario/check.hpp"
#include "tb/scenario/describe.hpp"
#include "tb/scenario/scenario.hpp"

namespace dsdpv1::tb::scenario {
namespace {

/// Records the position of a document's first node.
class FirstNode : public YAML::EventHandler {
 public:
  std::optional<YAML::Mark> mark;

  void OnDocumentStart(const YAML::Mark& /*mark*/) override {}
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& at, YAML::anchor_t /*anchor*/) override { see(at); }
  void OnAlias(const YAML::Mark& at, YAML::anchor_t /*anchor*/) override { see(at); }
  void OnScalar(const YAML::Mark& at, const std::string& /*tag*/, YAML::anchor_t /*anchor*/,
                const std::string& /*value*/) override {
    see(at);
  }
  void OnSequenceStart(const YAML::Mark& at, const std::string& /*tag*/, YAML::anchor_t /*anchor*/,
                       YAML::EmitterStyle::value /*style*/) override {
    see(at);
  }
  void OnSequenceEnd() override {}
  void OnMapStart(const YAML::Mark& at, const std::string& /*tag*/, YAML::anchor_t /*anchor*/,
                  YAML::EmitterStyle::value /*style*/) override {
    see(at);
  }
  void OnMapEnd() override {}

 private:
  void see(const YAML::Mark& at) {
    if (!mark) mark = at;
  }
};

/// Where a second document begins. YAML::LoadAll is not used: it finds documents endlessly in text that begins with a
/// comma.
std::optional<YAML::Mark> second_document(const std::string& text) {
  std::istringstream in(text);
  YAML::Parser parser(in);
  FirstNode first, second;
  return parser.HandleNextDocument(first) && parser.HandleNextDocument(second) ? second.mark : std::nullopt;
}

YAML::Node parse_yaml(const std::string& text, const std::string& file) {
  try {
    YAML::Node root = YAML::Load(text);
    if (root.IsNull()) throw InputError(file, 1, "is empty, expected a scenario");
    if (const std::optional<YAML::Mark> second = second_document(text))
      throw InputError(file, second->line + 1, "a second document, expected one scenario a file");
    return root;
  } catch (const YAML::Exception& error) {
    throw InputError(file, error.mark.line + 1, "is not YAML: " + error.msg);
  }
}

/// `path` relative to the folder of `scenario`.
std::string beside(const std::string& scenario, const std::string& relative) {
  return (std::filesystem::path(scenario).parent_path() / relative).lexically_normal().string();
}

/// The values of all keys of the kind file in `node` and below.
void collect_files(const keys::Object& object, const YAML::Node& node, const keys::Source& source,
                   std::vector<std::string>& found) {
  for (const keys::Field& field : object.fields) {
    const YAML::Node value = node.IsMap() ? node[field.name] : YAML::Node(YAML::NodeType::Undefined);
    if (!value.IsDefined()) continue;
    if (field.type.kind == keys::Kind::kFile && value.IsScalar()) found.push_back(value.Scalar());
    if (field.type.object == nullptr) continue;
    if (value.IsMap()) collect_files(*field.type.object, value, source, found);
    if (!value.IsSequence()) continue;
    for (const YAML::Node& item : value) collect_files(field.type.object_of(item, source), item, source, found);
  }
}

const ChipKind& kind_of(const YAML::Node& root, const std::string& file) {
  return kind_in(root, *chip_kinds().front(), {file});
}

std::vector<std::string> files_of(const YAML::Node& root, const std::string& scenario) {
  std::vector<std::string> found;
  collect_files(description(kind_of(root, scenario)), root, {scenario}, found);
  for (std::string& file : found) file = beside(scenario, file);
  return found;
}

YAML::Node root_of(const std::string& text, const std::string& file, const std::vector<Setting>& settings) {
  YAML::Node root = parse_yaml(text, file);
  for (const Setting& setting : settings) apply(setting, kind_of(root, file), root);
  return root;
}

}  // namespace

std::string read_file(const std::string& path) { return tb::read_file(path, kScenarioFile); }

Scenario parse(const std::string& text, const std::string& file, const std::vector<Setting>& settings, Least slaves) {
  const YAML::Node root = root_of(text, file, settings);
  const ChipKind& kind = kind_of(root, file);
  Scenario scenario;
  scenario.kind = &kind;
  scenario.chip = kind.make_chip_settings();
  static_cast<checks::Limits&>(scenario.checks) = checks::Limits(kind.rules());
  keys::read_object(description(kind), &scenario, root, {file});
  for (Slave& slave : scenario.slaves) {
    if (slave.kind == nullptr) slave.kind = &kind, slave.chip = scenario.chip;
    if (!slave.user_cpu.own) slave.user_cpu.own = slave.kind->make_user_settings();
  }
  scenario.file = file;
  scenario.files = files_of(root, file);
  if (scenario.slaves.empty() && slaves == Least::kOne)
    throw InputError(file, root["slaves"].Mark().line + 1, "slaves has 0 items, expected 1 to 125");
  check(scenario);
  return scenario;
}

Scenario load(const std::string& path, const std::vector<Setting>& settings, Least slaves) {
  return parse(read_file(path), path, settings, slaves);
}

Action parse_action(const std::string& json, const std::string& file, const Scenario& scenario) {
  if (!nlohmann::json::accept(json)) throw InputError(file, 0, "is not JSON, expected an action: {\"do\": ...}");
  YAML::Node node = parse_yaml(json, file);
  if (node.IsMap() && (node["at"] || node["when"]))
    throw InputError(file, 0, "at or when, expected neither: it is done at once");
  if (node.IsMap()) node["at"] = "0us";
  Action action;
  keys::read_object(action_keys(*scenario.kind), &action, node, {file});
  action.at.reset();
  Scenario named = scenario;
  named.file = file;
  check(named, action);
  return action;
}

std::size_t slave_number(const Scenario& scenario, const std::string& name) {
  const auto found = std::find_if(scenario.slaves.begin(), scenario.slaves.end(),
                                  [&name](const Slave& each) { return each.name.text == name; });
  return static_cast<std::size_t>(found - scenario.slaves.begin());
}

ChipKinds kinds(const Scenario& scenario) {
  ChipKinds found;
  for (const Slave& slave : scenario.slaves)
    if (std::find(found.begin(), found.end(), slave.kind) == found.end()) found.push_back(slave.kind);
  return found;
}

bool has_rtl(const Scenario& scenario) {
  return std::all_of(
      scenario.slaves.begin(), scenario.slaves.end(),
      [](const Slave& slave) { return slave.kind->has_reference_rtl(); });
}

bool needs_pins(const Scenario& scenario) {
  return std::any_of(
      scenario.slaves.begin(), scenario.slaves.end(),
      [&scenario](const Slave& slave) { return slave.kind->needs_pins(scenario, slave); });
}

checks::Limits limits_of(const Scenario& scenario, const ChipKind& kind) {
  return &kind == scenario.kind ? static_cast<const checks::Limits&>(scenario.checks) : checks::Limits(kind.rules());
}

void check_one_chip(const Scenario& scenario, const std::string& what) {
  for (const Slave& slave : scenario.slaves)
    if (slave.chip != scenario.chip)
      throw InputError(
          scenario.file, slave.line,
          fmt::format("slave {} has a chip of its own, expected one chip for all slaves: {} takes no other",
                      slave.name.text, what));
}

bool allows(const Scenario& scenario, const std::string& code, const std::string& station) {
  return std::any_of(
      scenario.allow.begin(), scenario.allow.end(),
      [&](const Allow& allow) {
        return allow.event.text == code && (allow.slave.empty() || allow.slave.text == station);
      });
}

std::vector<std::string> files(const std::string& path, const std::vector<Setting>& settings) {
  return files_of(root_of(read_file(path), path, settings), path);
}

std::string resolve(const Scenario& scenario, const Name& path) { return beside(scenario.file, path.text); }

}  // namespace dsdpv1::tb::scenario
