#include "lab/traces/manifest.hpp"

#include <fmt/format.h>
#include <sha256.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <set>

#include "bus/baud.hpp"
#include "io/input/read_file.hpp"
#include "io/input/units.hpp"

namespace dsdpv1::tb::traces {
namespace {

namespace fs = std::filesystem;

constexpr FileKind kNamedFile{"a file that the scenario names", 64};
constexpr FileKind kRulings{"a document of rulings", 16};

bool is_firmware(const fs::path& file) { return file.extension() == ".elf"; }

Json files_of(const scenario::Scenario& scenario) {
  const fs::path folder = fs::path(scenario.file).parent_path();
  Json files = Json::object();
  for (const std::string& file : std::set<std::string>(scenario.files.begin(), scenario.files.end()))
    files[fs::path(file).lexically_relative(folder).generic_string()] =
        is_firmware(file) ? Json("built") : Json(sha256(read_file(file, kNamedFile)));
  return files;
}

/// Adds the parameters of a chip: those that the mapping `chip` gives, else the defaults.
void add_parameters(Json& parameters, const ChipKind& kind, const YAML::Node& chip) {
  for (const keys::Field& field : kind.chip_keys().fields) {
    const bool given = chip && chip.IsMap() && chip[field.name];
    parameters[field.name] = given ? chip[field.name].Scalar() : field.default_text;
  }
}

Json parameters_of(const scenario::Scenario& scenario, const std::string& text) {
  const YAML::Node root = YAML::Load(text);
  Json parameters = {{"kind", scenario.kind->name()},
                     {"baud", std::string(bus::baud(scenario.baud).name)},
                     {"end", time_text(scenario.end)}};
  add_parameters(parameters, *scenario.kind, root["chip"]);
  for (std::size_t i = 0; i < scenario.slaves.size(); ++i) {
    const scenario::Slave& slave = scenario.slaves[i];
    if (slave.chip == scenario.chip) continue;
    Json& own = parameters["slaves"][slave.name.text] = {{"kind", slave.kind->name()}};
    add_parameters(own, *slave.kind, root["slaves"][i]["chip"]);
  }
  return parameters;
}

Json slave_of(const Trace& trace, const std::string& name) {
  Json pins = Json::object();
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i < trace.signals().size(); ++i) {
    if (trace.signals()[i].slave != name) continue;
    pins[trace.signals()[i].name] = trace.changes(i);
    sum += trace.changes(i);
  }
  return {{"changes", sum}, {"pins", pins}};
}

}  // namespace

std::string sha256(std::string_view content) {
  std::array<char, SHA256_DIGEST_STRING_LENGTH> text{};
  SHA256Data(reinterpret_cast<const std::uint8_t*>(content.data()), content.size(), text.data());
  return text.data();
}

Json origin_of(const scenario::Scenario& scenario) {
  const std::string text = scenario::read_file(scenario.file);
  return {{"scenario", {{fs::path(scenario.file).filename().string(), sha256(text)}}},
          {"files", files_of(scenario)},
          {"parameters", parameters_of(scenario, text)}};
}

bool names_firmware(const scenario::Scenario& scenario) {
  return std::any_of(scenario.files.begin(), scenario.files.end(), is_firmware);
}

Json rulings_of(const std::string& root, const std::vector<std::string>& paths) {
  Json rulings = Json::object();
  for (const std::string& path : paths) rulings[path] = sha256(read_file((fs::path(root) / path).string(), kRulings));
  return rulings;
}

Json contents_of(const Trace& trace) {
  constexpr Tick kTicksPerCycle = 250;
  Json slaves = Json::object();
  for (const Signal& signal : trace.signals())
    if (signal.kind != Signal::Kind::kLine && !slaves.contains(signal.slave))
      slaves[signal.slave] = slave_of(trace, signal.slave);
  return {{"trace", {{"sha256", sha256(trace.content())}, {"bytes", trace.content().size()}}},
          {"cycles", trace.end() / kTicksPerCycle},
          {"changes", trace.changes()},
          {"line", trace.changes(trace.signals().size() - 1)},
          {"slaves", slaves}};
}

std::string first_other(const Json& manifest, const Json& present) {
  if (!manifest.is_object()) return "it is no JSON object";
  for (const auto& entry : present.items()) {
    if (!manifest.contains(entry.key())) return fmt::format("{} is missing", entry.key());
    const Json& kept = manifest[entry.key()];
    if (kept == entry.value()) continue;
    if (!kept.is_object() || !entry.value().is_object())
      return fmt::format("{} is {} there and {} now", entry.key(), kept.dump(), entry.value().dump());
    const std::string inner = first_other(kept, entry.value());
    return fmt::format("{}: {}", entry.key(), inner.empty() ? "it has more entries" : inner);
  }
  return "";
}

std::string text_of(const Json& manifest) { return manifest.dump(2) + "\n"; }

}  // namespace dsdpv1::tb::traces
