#pragma once
// The reference RTL (rtl_ref/) under Verilator. It is no part of the program: it stands in shared libraries, for the
// DSDPV1 and the DSDPV1-RSU two each, the RTL as it is and the RTL with single faults, which are loaded when somebody
// asks for them. `./run build` builds them,
// `./run sim` need not wait for it.
#include <cstdint>
#include <memory>

#include "cosim/rtl_top.hpp"
#include "model/dsdpv1/chip.hpp"

namespace dsdpv1::cosim {

/// The RTL of the part, with the parameters of `config`. What is not reset in it begins with values that depend on
/// `seed`. Throws tb::InputError when it was not built.
std::unique_ptr<RtlTop> make_reference_rtl(const dsdpv1::Config& config, std::uint32_t seed = 1);

/// The RTL with the single fault `fault` of rtl_ref/faults.txt or, of the DSDPV1-RSU, faults_rsu.txt; 0: none. Throws
/// likewise.
std::unique_ptr<RtlTop> make_faulty_rtl(const dsdpv1::Config& config, unsigned fault, std::uint32_t seed = 1);

}  // namespace dsdpv1::cosim
