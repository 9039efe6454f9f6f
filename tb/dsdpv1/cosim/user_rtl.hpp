#pragma once
// RTL of a user's own: built with Verilator into a shared library, loaded, and evaluated as any other RtlTop.
#include <memory>
#include <string>

#include "tb/dsdpv1/cosim/lockstep_execution.hpp"
#include "tb/dsdpv1/cosim/pin_map.hpp"

namespace cosim {

struct UserRtl {
  std::string folder, top;
  std::string build = "build/cosim";  ///< for what is generated
};

/// Builds it; throws tb::InputError with Verilator's or the compiler's words. The result makes chips that run three
/// times, with different values wherever nothing is initialised or reset: where the three differ a pin is X.
MakeRtl build_user_rtl(const UserRtl& rtl, const PinMap& map);

/// The generated file between the Verilated class and this program.
std::string adapter_source(const std::string& top, const PinMap& map);

}  // namespace cosim
