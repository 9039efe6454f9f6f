#pragma once
// The parameters of the rulings marked (p), for adapters to a platform's own ones: CCI, vcml::property, sc_attribute.
//
//   dsdpv1::systemc::TlmOptions options;
//   dsdpv1::systemc::each_parameter(options.chip, [&](const dsdpv1::systemc::ParameterRow& row, std::uint32_t& value) {
//     value = my_platform.value(row.name, value);
//   });
//   dsdpv1::systemc::TlmModule chip("chip", options);
#include <cstddef>
#include <cstdint>
#include <string>

#include "model/dsdpv1/config.hpp"
#include "model/spc3/config.hpp"

namespace dsdpv1::systemc {

/// A row of a chip's parameters.inc.
struct ParameterRow {
  std::string name;  ///< as the key in scenarios; of an element of a list with its index: uart_gaps_0
  std::uint32_t least, most;
  const char *unit, *ruling, *text;
};

/// Calls `tell(const ParameterRow&, std::uint32_t& value)` for each parameter of the part.
template <class Tell>
void each_parameter(dsdpv1::Config& config, const Tell& tell) {
  const bool serial = has_serial_ports(config.part);
#define DSDPV1_PARAMETER(name, initial, least, most, unit, ruling, text) \
  tell(ParameterRow{#name, least, most, unit, ruling, text}, config.name);
#define DSDPV1_RSU_PARAMETER(name, initial, least, most, unit, ruling, text) \
  if (serial) tell(ParameterRow{#name, least, most, unit, ruling, text}, config.name);
#define DSDPV1_RSU_LIST(name, initial, least, most, unit, ruling, text) \
  for (std::size_t i = 0; serial && i < config.name.size(); ++i)        \
    tell(ParameterRow{#name "_" + std::to_string(i), least, most, unit, ruling, text}, config.name[i]);
#include "model/dsdpv1/parameters.inc"
}

/// The same for the SPC3 family.
template <class Tell>
void each_parameter(spc3::Config& config, const Tell& tell) {
#define SPC3_PARAMETER(name, initial, least, most, unit, ruling, text) \
  tell(ParameterRow{#name, least, most, unit, ruling, text}, config.name);
#include "model/spc3/parameters.inc"
}

}  // namespace dsdpv1::systemc
