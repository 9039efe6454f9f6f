#pragma once
// A user's RTL: built with Verilator into a shared library, loaded, and evaluated like any other Rtl.
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cosim/pin_map.hpp"
#include "cosim/rtl_trace.hpp"

namespace dsdpv1::cosim {

struct UserRtl {
  std::string command;  ///< for messages: "dsdpv1-sim cosim"
  std::string folder, top;
  std::string build = "build/cosim";  ///< for generated files
  std::string sources;                ///< of this program, where PinMap::reference finds the reference RTL
  bool traced = false;                ///< records internal signals; needs a separate build
  unsigned fault = 0;                 ///< the level of PinMap::fault; 0: none
  bool counted = false;               ///< counts which lines, branches and toggles are reached; as well
};

/// In the folder of a build: a fingerprint of all that it was made from.
constexpr const char* kBuiltFrom = "built_from";

/// Makes the design for one run, also on several threads. With a trace, in a build with UserRtl::traced, records its
/// internal signals.
using MakeUserRtl = std::function<std::unique_ptr<Rtl>(const std::optional<RtlTrace>& trace)>;

/// "Verilator 5.006 2023-01-22 rev (Debian 5.006-3)", of the one in PATH; empty: there is none.
std::string verilator_version();

/// Keys of the chip's parameters, `chip:` of scenarios, that are not the default and that the map does not take to the
/// RTL: it would differ for that reason alone.
std::vector<std::string> untold(const PinMap& map, const tb::ChipKind& kind, const tb::OwnSettings& chip);
/// Throws tb::InputError when there is one.
void check_parameters(const UserRtl& rtl, const PinMap& map, const tb::ChipKind& kind, const tb::OwnSettings& chip);

struct BuiltUserRtl {
  MakeUserRtl make;
  /// Verilator's records of what the designs that no longer exist have counted since the last call. Empty: UserRtl was
  /// not counted.
  std::function<std::string()> counts;
};

/// Builds it with the parameters of `chip`; throws tb::InputError for a map that does not fit the top, and with
/// Verilator's or the compiler's message. The result makes chips that run three
/// times, with different values wherever nothing is initialised or reset: a pin is X if the three differ. Only the one
/// that begins with zeros is traced and counted.
BuiltUserRtl build_user_rtl(const UserRtl& rtl, const PinMap& map, const tb::ChipKind& kind,
                            const tb::OwnSettings& chip);

/// The generated file between the Verilated class and this program; `traced` and `counted` as in UserRtl, `constants`:
/// statements that set inputs of a new design.
std::string adapter_source(const std::string& top, const PinMap& map, const tb::PinTable& pins, bool traced,
                           const std::string& constants = {}, bool counted = false);

}  // namespace dsdpv1::cosim
