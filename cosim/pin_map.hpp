#pragma once
// Names and meanings of the ports of a user's RTL: a YAML file.
//
//   clock: clk_i                      # default: the names of rtl_ref/
//   pins:
//     RESET: {port: rst_i, inverted: true}
//     D_OE: {port: d_oe_o}            # 1: the chip drives D
//   tolerance: {READY: 1}             # cycles that a pin may be earlier or later
//   parameters: {SEARCH_WINDOW_MS: 5}
//   files: [chip.sv, uart.sv]         # default: every .sv and .v of the folder
//   include: [../lib]                 # folders for `include and for modules that no file holds
//   reference: true                   # ... and those of the reference RTL after them
#include <map>
#include <string>
#include <vector>

#include "cosim/pin_comparator.hpp"
#include "cosim/rtl.hpp"

namespace dsdpv1::cosim {

struct Port {
  std::string name;
  bool inverted = false;  ///< relative to the level in the datasheet
};

struct PinMap {
  Port clock;
  std::map<std::string, Port>
      pins;  ///< by the datasheet's name; NAME_OE of an output that may be released, D_OE of D_OUT
  Tolerances tolerances{};
  std::map<std::string, std::string> parameters;
  std::vector<std::string> files, include;  ///< relative to the folder of the RTL
  bool reference = false;                   ///< modules missing in both come from the reference RTL
};

/// The pin in the map that enables this output; empty: it is always driven.
std::string enable_of(const tb::PinInfo& pin);
/// The names of rtl_ref/: the datasheet's in lower case, _i and _o.
PinMap default_pin_map(const tb::PinTable& pins);
/// Reads the differences from the default; throws tb::InputError.
PinMap load_pin_map(const std::string& path, const tb::PinTable& pins);
/// The same from text; `path` is for messages only.
PinMap parse_pin_map(const std::string& text, const std::string& path, const tb::PinTable& pins);

}  // namespace dsdpv1::cosim
