// In place of the reference RTL in a build without Verilator.
#include "tb/cosim/reference_rtl.hpp"
#include "tb/scenario/input_error.hpp"

namespace cosim {
namespace {

[[noreturn]] void fail() {
  throw tb::InputError(
      "this program was built without Verilator and has no RTL; install Verilator 5.006 or later and configure with "
      "-DDSDPV1_RTL=ON, allowed without it are the engines step and skip");
}

}  // namespace

bool reference_rtl_built() { return false; }
std::unique_ptr<RtlTop> make_reference_rtl(const dsdpv1::Config&, std::uint32_t) { fail(); }
dsdpv1::Config quick_config() { return {}; }
std::unique_ptr<RtlTop> make_faulty_rtl(unsigned, std::uint32_t) { fail(); }

}  // namespace cosim
