#pragma once
// RTL of the user's own, of cosim and rtl-random: --rtl and what goes with it.
#include <string>

#include "cosim/pin_map.hpp"
#include "cosim/user_rtl.hpp"

namespace CLI {  // NOLINT(readability-identifier-naming): its library's
class App;
}

namespace dsdpv1::app {

struct OwnRtlArguments {
  std::string rtl, top, pins, build = "build/cosim";
};

struct OwnRtl {
  cosim::PinMap map;
  cosim::MakeUserRtl make;
};

/// `required`: the command is about nothing else.
void add_own_rtl_options(CLI::App& command, OwnRtlArguments& arguments, bool required);

/// Reads the map of its pins, the names of the reference RTL when there is none, and builds it, `traced` so that its
/// inside can be recorded. `command` as "dsdpv1-sim cosim". Throws tb::InputError.
OwnRtl build_own_rtl(const OwnRtlArguments& arguments, const std::string& command, bool traced);

}  // namespace dsdpv1::app
