#pragma once
// How the ports of a user's RTL are called and what they mean: a YAML file.
//
//   clock: clk_i                      # left out: the names of rtl_ref/
//   pins:
//     CSR: {port: cs_i, inverted: true}
//     D_OE: {port: d_oe_o}            # 1: the chip drives D
//   tolerance: {INTR0: 1}             # cycles that a pin may be earlier or later
//   parameters: {SEARCH_WINDOW_MS: 5}
//   files: [chip.sv, uart.sv]         # left out: every .sv and .v of the folder
//   include: [../lib]                 # folders for `include and for modules that no file holds
//   reference: true                   # ... and those of the reference RTL after them
#include <map>
#include <string>
#include <vector>

#include "cosim/pin_comparator.hpp"

namespace dsdpv1::cosim {

struct Port {
  std::string name;
  bool inverted = false;  ///< against the level of table 1
};

struct PinMap {
  Port clock;
  std::map<std::string, Port> pins;  ///< by table 1's name; D_IN, D_OUT, D_OE for the three sides of D
  Tolerances tolerances{};
  std::map<std::string, std::string> parameters;
  std::vector<std::string> files, include;  ///< relative to the folder of the RTL
  bool reference = false;                   ///< modules that neither has are those of the reference RTL
};

/// The names of rtl_ref/: table 1's in lower case, _i and _o.
PinMap default_pin_map();
/// Reads what differs from the default; throws tb::InputError.
PinMap load_pin_map(const std::string& path);
/// The same from text; `path` is for messages only.
PinMap parse_pin_map(const std::string& text, const std::string& path);

}  // namespace dsdpv1::cosim
