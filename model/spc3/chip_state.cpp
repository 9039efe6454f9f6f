#include "model/spc3/chip_state.hpp"

namespace dsdpv1::spc3 {
namespace {

using profibus::StateReader;

constexpr profibus::StateFrame kFrame = {0x5453'2020'3343'5053, kStateVersion};  // "SPC3  ST"

/// Calls `tell(name, value)` for each parameter, with its name in scenarios.
template <class Tell>
void each_parameter(Config& config, const Tell& tell) {
#define SPC3_PARAMETER(name, ...) tell(#name, config.name);
#include "model/spc3/parameters.inc"
}

}  // namespace

void begin_state(profibus::StateWriter& writer, const Config& config) {
  profibus::begin_frame(writer, kFrame);
  Config parameters = config;
  writer.within(Variant::kApc3, Variant::kVpc3, parameters.variant);
  each_parameter(parameters, [&](const char* /*name*/, std::uint32_t& value) { writer(value); });
}

StateReader open_state(const std::uint8_t* bytes, std::size_t size, const Config& config) {
  StateReader reader = profibus::open_frame(bytes, size, kFrame);
  Variant saved = config.variant;
  reader.within(Variant::kApc3, Variant::kVpc3, saved);
  profibus::check_title(row(saved).title, row(config.variant).title);
  Config own = config;
  each_parameter(own, [&](const char* name, std::uint32_t value) { profibus::check_parameter(reader, name, value); });
  return reader;
}

}  // namespace dsdpv1::spc3
