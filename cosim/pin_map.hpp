#pragma once
// Names and meanings of the ports of a user's RTL: a YAML file.
//
//   clock: clk_i                      # default: the names of rtl_ref/
//   pins:
//     RESET: {port: rst_i, inverted: true}
//     D_OE: {port: d_oe_o}            # 1: the chip drives D
//   tolerance: {READY: 1}             # cycles that a pin may be earlier or later
//   tie: {scan_en_i: 0}               # inputs that are no pins
//   fault: fault_i                    # an input that selects one of the RTL's single faults, 0: none
//   chip: {search_window_ms: SW_MS, rts_lead: {port: lead_i}}   # the model's parameters: a parameter of the top, an
//   input parameters: {FIFO_DEPTH: 5} defines: {SIMULATION: 1} files: [chip.sv, uart.sv]         # default: every .sv
//   and .v of the folder file_list: chip.f                 # ... or files and options in the syntax of -f include:
//   [../lib]                 # folders for `include and for modules that no file holds reference: true # ... and those
//   of the reference RTL after them
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "cosim/pin_comparator.hpp"
#include "cosim/rtl.hpp"

namespace dsdpv1::cosim {

struct Port {
  std::string name;
  bool inverted = false;  ///< relative to the level in the datasheet
  int line = 0;           ///< in the map; 0: not there
};

/// A word of the map.
struct MapWord {
  std::string text;
  int line = 0;
};

/// The constant level of an input.
struct Tie {
  std::uint64_t value = 0;
  int line = 0;
};

/// The place of a chip's parameter in the RTL: a parameter of the top, or an input.
struct Place {
  std::string name;
  bool port = false;
  int line = 0;
};

struct PinMap {
  std::string path;  ///< of its file; empty: there is none
  Port clock;
  std::map<std::string, Port>
      pins;  ///< by the datasheet's name; NAME_OE of an output that may be released, D_OE of D_OUT
  Tolerances tolerances{};
  std::map<std::string, Tie> ties;    ///< by port
  MapWord fault;                      ///< an input: the number of the single fault; empty: there is none
  std::map<std::string, Place> chip;  ///< by the parameter's key in scenarios
  std::map<std::string, MapWord> parameters, defines;
  std::vector<MapWord> files, include;  ///< relative to the folder of the RTL
  MapWord file_list;                    ///< the same; empty: none
  bool reference = false;               ///< modules missing in all of these come from the reference RTL
};

/// The pin in the map that enables this output; empty: it is always driven.
std::string enable_of(const tb::PinInfo& pin);
/// The names of rtl_ref/: the datasheet's in lower case, _i and _o.
PinMap default_pin_map(const tb::PinTable& pins);
/// Reads the differences from the default; `parameters`: keys of RtlOf::parameters, empty: any. Throws tb::InputError.
PinMap load_pin_map(const std::string& path, const tb::PinTable& pins, const std::vector<std::string>& parameters = {});
/// The same from text; `path` is for messages only.
PinMap parse_pin_map(const std::string& text, const std::string& path, const tb::PinTable& pins,
                     const std::vector<std::string>& parameters = {});

}  // namespace dsdpv1::cosim
