#pragma once
// The reference RTL (rtl_ref/) under Verilator. It is not part of the program but in shared libraries, two for each top
// (the RTL unchanged, and the RTL with single faults), which are loaded on demand. `./run build` builds them, `./run
// sim` need not wait for that.
#include <string>

#include "cosim/rtl.hpp"
#include "cosim/rtl_library.hpp"

namespace dsdpv1::cosim {

/// Its functions; they stay loaded to the end of the program, because designs may live that long. `why_not` receives
/// the reason if they cannot be loaded.
RtlLibrary load_library(const std::string& path, std::string& why_not);

/// The library of `top` ("dsdpv1"), unchanged or with single faults. Throws tb::InputError if it was not built, or by
/// another build than this program.
RtlLibrary reference_library(const std::string& top, bool with_faults);

/// A design of the library.
std::unique_ptr<Rtl> make_design(const RtlLibrary& library, const RtlStart& start);

}  // namespace dsdpv1::cosim
