#include "cosim/random/play_options.hpp"

#include "cosim/random/campaign.hpp"
#include "io/input/input_error.hpp"
#include "kinds/dsdpv1/keys/settings.hpp"
#include "kinds/dsdpv1/kind.hpp"
#include "tb/scenario/settings.hpp"

namespace dsdpv1::cosim {
namespace {

tb::Dsdpv1Settings settings_of(const dsdpv1::Config& config) {
  tb::Dsdpv1Settings settings;
  static_cast<dsdpv1::Config&>(settings) = config;
  return settings;
}

tb::Engine engine_of(const dsdpv1::Config& config) {
  return config.engine == dsdpv1::Engine::kStep ? tb::Engine::kStep : tb::Engine::kSkip;
}

}  // namespace

const tb::ChipKind& chip_kind(Part part) { return tb::kind_of(part); }

PlayOptions own_rtl_options(Part part, const Tolerances& tolerances) {
  PlayOptions options = quick_options();
  options.config = {};
  options.config.part = part;
  options.lockstep.tolerances = tolerances;
  return options;
}

void set_parameters(PlayOptions& options, const std::vector<std::string>& settings) {
  const tb::ChipKind& kind = chip_kind(options.config.part);
  YAML::Node scenario(YAML::NodeType::Map);
  for (const tb::scenario::Setting& each : tb::scenario::parse_settings(settings)) {
    if (each.path.rfind("chip.", 0) != 0)
      throw tb::InputError(each.origin, 0, "is no parameter of the chip, allowed is like chip.search_window_ms=1");
    tb::scenario::apply(each, kind, scenario);
  }
  tb::Dsdpv1Settings chip = settings_of(options.config);
  if (const YAML::Node keys = scenario["chip"]; keys.IsDefined())
    tb::keys::read_object(kind.chip_keys(), &chip, keys, {"--set"});
  options.config = static_cast<const dsdpv1::Config&>(chip);
}

std::unique_ptr<Lockstep> make_lockstep(const PlayOptions& options, std::unique_ptr<Rtl> rtl) {
  const tb::ChipKind& kind = chip_kind(options.config.part);
  const tb::Dsdpv1Settings chip = settings_of(options.config);
  return std::make_unique<Lockstep>(kind.make_device({"chip", chip, engine_of(options.config)}), std::move(rtl), kind,
                                    chip, options.lockstep);
}

MakeTop reference_top(const PlayOptions& options, unsigned fault, std::uint32_t seed) {
  return [&rtl = *chip_kind(options.config.part).rtl(), chip = settings_of(options.config), fault, seed] {
    return rtl.make_reference(chip, fault, seed);
  };
}

}  // namespace dsdpv1::cosim
