#pragma once
// The reference RTL (rtl_ref/) under Verilator. It is no part of the program: it stands in shared libraries, two for
// each top, the RTL as it is and the RTL with single faults, which are loaded when somebody asks for them. `./run
// build` builds them, `./run sim` need not wait for it.
#include <string>

#include "cosim/rtl.hpp"
#include "cosim/rtl_library.hpp"

namespace dsdpv1::cosim {

/// Its functions; they stay loaded to the end of the program, as designs may live as long. The text says why there are
/// none.
RtlLibrary load_library(const std::string& path, std::string& why_not);

/// That of `top` ("dsdpv1"), as it is or with single faults. Throws tb::InputError when it was not built, or by another
/// build than this program.
RtlLibrary reference_library(const std::string& top, bool with_faults);

/// A design of the library.
std::unique_ptr<Rtl> make_design(const RtlLibrary& library, const RtlStart& start);

}  // namespace dsdpv1::cosim
