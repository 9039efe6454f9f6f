#include "tests/state/recorded.hpp"

#include <algorithm>
#include <map>

#include "lab/traces/golden.hpp"

namespace dsdpv1::state_test {
namespace {

using tb::traces::Golden;
using tb::traces::Trace;
using Kind = tb::traces::Signal::Kind;

constexpr const char* kFolder = DSDPV1_SOURCE_DIR "/traces";

Part part_of(const std::string& kind) {
  return kind == "dsdpv1" ? Part::kDsdpv1 : kind == "dsdpv1_r" ? Part::kR : Part::kRsu;
}

Config config_of(const tb::traces::Json& parameters) {
  Config config;
  config.part = part_of(parameters.at("kind"));
  const std::map<std::string, std::uint32_t*> numbers = {
      {"access_interval", &config.access_interval},   {"ready_cycles", &config.ready_cycles},
      {"search_window_ms", &config.search_window_ms}, {"search_window_bits", &config.search_window_bits},
      {"baud_control_ms", &config.baud_control_ms},   {"spi_reply_gap", &config.spi_reply_gap},
      {"spi_write_gap", &config.spi_write_gap},       {"u_timer", &config.u_timer},
  };
  for (const auto& [name, number] : numbers)
    if (parameters.contains(name))
      *number = static_cast<std::uint32_t>(std::stoul(parameters.at(name).get<std::string>()));
  return config;
}

std::vector<Input> inputs_of(const Trace& trace, std::size_t first, std::size_t count) {
  std::vector<Input> inputs;
  for (std::size_t pin = 0; pin < count; ++pin) {
    if (trace.signals()[first + pin].kind != Kind::kInput) continue;
    for (tb::traces::Cursor each = trace.cursor(first + pin); each.at() != bus::kNever; each.step())
      inputs.push_back({each.at(), static_cast<Pin>(pin), each.level()});
  }
  std::stable_sort(inputs.begin(), inputs.end(), [](const Input& a, const Input& b) { return a.at < b.at; });
  return inputs;
}

bool is_of_this_model(const std::string& scenario) {
  const tb::traces::Json parameters = tb::traces::read_manifest(kFolder, scenario).at("parameters");
  return parameters.at("kind").get<std::string>().rfind("dsdpv1", 0) == 0 && !parameters.contains("slaves");
}

}  // namespace

std::vector<std::string> recorded_scenarios() {
  std::vector<std::string> names = tb::traces::golden_names(kFolder);
  names.erase(std::remove_if(names.begin(), names.end(),
                             [](const std::string& scenario) { return !is_of_this_model(scenario); }),
              names.end());
  return names;
}

std::vector<Recorded> recorded(const std::string& scenario) {
  const Golden golden = tb::traces::read_golden(kFolder, scenario);
  const Config config = config_of(golden.manifest.at("parameters"));
  const auto pins = static_cast<std::size_t>(pin_count(config.part));
  std::vector<Recorded> slaves;
  for (std::size_t first = 0; first + pins < golden.trace->signals().size(); first += pins)
    slaves.push_back({scenario + "_" + golden.trace->signals()[first].slave, config,
                      inputs_of(*golden.trace, first, pins), golden.trace->end()});
  return slaves;
}

}  // namespace dsdpv1::state_test
