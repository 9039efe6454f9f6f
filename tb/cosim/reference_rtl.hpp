#pragma once
// The reference RTL (rtl_ref/) under Verilator. Its parameters are fixed when it is compiled, so there is one variant for each set of
// them that is needed (CMakeLists.txt).
#include <cstdint>
#include <memory>

#include "model/dsdpv1/chip.hpp"
#include "tb/cosim/rtl_top.hpp"

namespace cosim {

/// True when this program was built with Verilator.
bool reference_rtl_built();

/// The variant with the parameters of `config`; throws tb::InputError with those that there are when there is none. What is not
/// reset in the RTL begins with values that depend on `seed`.
std::unique_ptr<RtlTop> make_reference_rtl(const dsdpv1::Config& config, std::uint32_t seed = 1);

/// Parameters so short that every state is reached soon: for random lockstep and the fault campaign.
dsdpv1::Config quick_config();
/// The variant with them and with the single faults of rtl_ref/faults.txt; `fault` 0: none.
std::unique_ptr<RtlTop> make_faulty_rtl(unsigned fault, std::uint32_t seed = 1);

}  // namespace cosim
