#include "cosim/random/play_options.hpp"

#include <yaml-cpp/yaml.h>

#include <algorithm>

#include "cosim/random/random_cases.hpp"
#include "io/input/input_error.hpp"
#include "tb/scenario/settings.hpp"

namespace dsdpv1::cosim {
namespace {

// No case needs longer; slow rates would make some last for minutes.
constexpr Tick kLongestCase = 2'500'000 * profibus::kTicksPerCycle;

}  // namespace

std::shared_ptr<const tb::OwnSettings> chip_settings(const tb::ChipKind& kind, const std::vector<std::string>& set) {
  YAML::Node scenario(YAML::NodeType::Map);
  for (const tb::scenario::Setting& each : tb::scenario::parse_settings(set)) {
    if (each.path.rfind("chip.", 0) != 0)
      throw tb::InputError(each.origin, 0,
                           "is no parameter of the chip, expected something like chip.search_window_ms=1");
    tb::scenario::apply(each, kind, scenario);
  }
  std::shared_ptr<tb::OwnSettings> chip = kind.make_chip_settings();
  if (const YAML::Node keys = scenario["chip"]; keys.IsDefined())
    tb::keys::read_object(kind.chip_keys(), dynamic_cast<void*>(chip.get()), keys, {"--set"});
  return chip;
}

std::vector<std::string> chip_settings_of(const std::string& scenario, const std::vector<std::string>& set,
                                          const tb::ChipKind& kind, const tb::OwnSettings& chip) {
  const std::string prefix = "chip.";
  std::vector<std::string> all;
  const std::vector<std::string>& quick = kind.random()->words().quick;
  for (const RtlParameter& each : kind.rtl()->parameters(chip)) {
    const std::string key = prefix + each.key + "=";
    if (std::any_of(quick.begin(), quick.end(), [&](const std::string& text) { return text.rfind(key, 0) == 0; }))
      all.push_back(key + std::to_string(each.words.front()));
  }
  YAML::Node root = YAML::LoadFile(scenario);
  for (const tb::scenario::Setting& each : tb::scenario::parse_settings(set)) tb::scenario::apply(each, kind, root);
  if (!root["chip"].IsMap()) return all;  // only its kind
  for (const auto& each : root["chip"]) {
    YAML::Emitter value;
    value << YAML::Flow << each.second;
    const std::string key = each.first.as<std::string>();
    if (key != "kind") all.push_back(prefix + key + "=" + value.c_str());
  }
  return all;
}

PlayOptions usual_options(const tb::ChipKind& kind) {
  PlayOptions options{&kind};
  options.limit = kLongestCase;
  options.chip = chip_settings(kind, {});
  return options;
}

PlayOptions quick_options(const tb::ChipKind& kind) {
  PlayOptions options = usual_options(kind);
  set_parameters(options, kind.random()->words().quick);
  return options;
}

void set_parameters(PlayOptions& options, const std::vector<std::string>& set) {
  options.set.insert(options.set.end(), set.begin(), set.end());
  options.chip = chip_settings(*options.kind, options.set);
}

std::unique_ptr<Lockstep> make_lockstep(const PlayOptions& options, std::unique_ptr<Rtl> rtl) {
  const tb::ChipKind& kind = *options.kind;
  return std::make_unique<Lockstep>(kind.make_device({"chip", *options.chip, options.engine}), std::move(rtl), kind,
                                    *options.chip, options.lockstep);
}

MakeTop reference_top(const PlayOptions& options, unsigned fault, std::uint32_t seed) {
  return
      [rtl = options.kind->rtl(), chip = options.chip, fault, seed] { return rtl->make_reference(*chip, fault, seed); };
}

Stimulus random_case(std::uint64_t seed, const PlayOptions& options) {
  return options.kind->random()->make_case(seed, *options.chip);
}

}  // namespace dsdpv1::cosim
