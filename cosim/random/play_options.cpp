#include "cosim/random/play_options.hpp"

#include "cosim/random/campaign.hpp"
#include "cosim/reference_rtl.hpp"
#include "io/input/input_error.hpp"
#include "kinds/dsdpv1/keys/settings.hpp"
#include "kinds/dsdpv1/kind.hpp"
#include "tb/scenario/settings.hpp"

namespace dsdpv1::cosim {

const tb::ChipKind& chip_kind(Part part) { return tb::kind_of(part); }

PlayOptions own_rtl_options(const Tolerances& tolerances) {
  PlayOptions options = quick_options();
  options.config = {};
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
  tb::Dsdpv1Settings chip;
  static_cast<dsdpv1::Config&>(chip) = options.config;
  if (const YAML::Node keys = scenario["chip"]; keys.IsDefined())
    tb::keys::read_object(kind.chip_keys(), &chip, keys, {"--set"});
  options.config = static_cast<const dsdpv1::Config&>(chip);
}

MakeTop reference_top(const PlayOptions& options, unsigned fault, std::uint32_t seed) {
  const dsdpv1::Config config = options.config;
  if (fault != 0) return [=] { return make_faulty_rtl(config, fault, seed); };
  return [=] { return make_reference_rtl(config, seed); };
}

}  // namespace dsdpv1::cosim
