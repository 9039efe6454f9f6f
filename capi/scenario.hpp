#pragma once
// The scenario named in the header's options.
#include <cstdint>
#include <string>
#include <vector>

#include "capi/error.hpp"
#include "tb/scenario/scenario.hpp"

namespace dsdpv1::capi {

/// NULL only if there are none.
std::vector<tb::scenario::Setting> settings_of(const char* const* settings, std::uint32_t count);

/// For options with path, text and settings. Throws InputError for a wrong scenario.
template <class Options>
tb::scenario::Scenario load_scenario(const Options& options) {
  need(options.path, "path");
  const auto settings = settings_of(options.settings, options.setting_count);
  return options.text == nullptr ? tb::scenario::load(options.path, settings)
                                 : tb::scenario::parse(options.text, options.path, settings);
}

}  // namespace dsdpv1::capi
