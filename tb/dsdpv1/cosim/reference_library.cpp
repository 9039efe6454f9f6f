// The reference RTL as a shared library, compiled together with what Verilator makes of rtl_ref/ (reference_rtl.cmake).
#include <unistd.h>

#include <atomic>
#include <cstdlib>
#include <string>

#include "Vdsdpv1.h"
#include "Vdsdpv1___024root.h"
#include "tb/dsdpv1/cosim/verilated_top.hpp"

#if VM_COVERAGE
#include "verilated_cov.h"

namespace {

/// Writes at its end what it has counted, as a file of its own in the folder that the environment names
/// DSDPV1_RTL_COVERAGE.
class Top : public dsdpv1::cosim::VerilatedTop<Vdsdpv1> {
 public:
  using VerilatedTop::VerilatedTop;
  ~Top() override {
    static std::atomic<unsigned> number{0};
    const char* folder = std::getenv("DSDPV1_RTL_COVERAGE");
    if (folder == nullptr) return;
    const std::string name = std::to_string(getpid()) + "-" + std::to_string(number++) + ".dat";
    context().coveragep()->write((std::string(folder) + "/" + name).c_str());
  }
};

}  // namespace
#else
using Top = dsdpv1::cosim::VerilatedTop<Vdsdpv1>;
#endif

extern "C" std::uint32_t dsdpv1_rtl_layout() { return DSDPV1_RTL_LAYOUT; }

/// The caller owns the result.
extern "C" dsdpv1::cosim::RtlTop* dsdpv1_rtl_make(const dsdpv1::cosim::RtlLimits* limits,
                                                  [[maybe_unused]] std::uint32_t fault, std::uint32_t seed) {
  auto top = std::make_unique<Top>(seed);
  Vdsdpv1& model = top->model();
  model.access_interval_i = limits->access_interval;
  model.ready_cycles_i = limits->ready_cycles;
  model.rts_lead_i = limits->rts_lead;
  model.rts_trail_i = limits->rts_trail;
  model.intr_low_i = limits->intr_low;
  model.intr_gap_i = limits->intr_gap;
  model.search_window_ms_i = limits->search_window_ms;
  model.search_window_bits_i = limits->search_window_bits;
  model.baud_control_ms_i = limits->baud_control_ms;
#ifdef SINGLE_FAULTS
  model.fault_i = static_cast<CData>(fault);
#endif
  return top.release();
}
