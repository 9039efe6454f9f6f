#pragma once
// A scenario as the header's options name it.
#include <cstdint>
#include <string>
#include <vector>

#include "capi/error.hpp"
#include "tb/scenario/scenario.hpp"

namespace dsdpv1::capi {

/// NULL only when there are none.
std::vector<tb::scenario::Setting> settings_of(const char* const* settings, std::uint32_t count);

/// Of options with path, text and settings. Throws InputError for a scenario that is wrong.
template <class Options>
tb::scenario::Scenario load_scenario(const Options& options) {
  need(options.path, "path");
  const auto settings = settings_of(options.settings, options.setting_count);
  return options.text == nullptr ? tb::scenario::load(options.path, settings)
                                 : tb::scenario::parse(options.text, options.path, settings);
}

}  // namespace dsdpv1::capi
