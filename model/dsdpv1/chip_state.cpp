// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
#include "model/dsdpv1/chip_state.hpp"

namespace dsdpv1 {
namespace {

using profibus::StateReader;
using profibus::StateWriter;

constexpr profibus::StateFrame kFrame = {0x5453'3156'5044'5344, kStateVersion};  // "DSDPV1ST"

/// Calls `tell(name, value)` for each parameter, with its name in scenarios.
template <class Tell>
void each_parameter(Config& config, const Tell& tell) {
#define DSDPV1_PARAMETER(name, ...) tell(#name, config.name);
#define DSDPV1_RSU_LIST(name, ...) \
  for (std::uint32_t & each : config.name) tell(#name, each);
#include "model/dsdpv1/parameters.inc"
}

void check_part(StateReader& reader, Part part) {
  Part saved = part;
  reader.within(Part::kDsdpv1, Part::kRsu, saved);
  profibus::check_title(row(saved).title, row(part).title);
}

}  // namespace

void begin_state(StateWriter& writer, const Config& config) {
  profibus::begin_frame(writer, kFrame);
  Config parameters = config;
  writer.within(Part::kDsdpv1, Part::kRsu, parameters.part);
  each_parameter(parameters, [&](const char* /*name*/, std::uint32_t& value) { writer(value); });
}

StateReader open_state(const std::uint8_t* bytes, std::size_t size, const Config& config) {
  StateReader reader = profibus::open_frame(bytes, size, kFrame);
  check_part(reader, config.part);
  Config own = config;
  each_parameter(own, [&](const char* name, std::uint32_t value) { profibus::check_parameter(reader, name, value); });
  return reader;
}

}  // namespace dsdpv1
