// The reference RTL as a shared library, compiled together with what Verilator makes of rtl_ref/ (reference_rtl.cmake).
#include "Vdsdpv1.h"
#include "Vdsdpv1___024root.h"
#include "tb/cosim/verilated_top.hpp"

extern "C" std::uint32_t dsdpv1_rtl_layout() { return DSDPV1_RTL_LAYOUT; }

/// The caller owns the result.
extern "C" cosim::RtlTop* dsdpv1_rtl_make(const cosim::RtlLimits* limits, [[maybe_unused]] std::uint32_t fault,
                                          std::uint32_t seed) {
  auto top = std::make_unique<cosim::VerilatedTop<Vdsdpv1>>(seed);
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
#ifdef DSDPV1_FAULTS
  model.fault_i = static_cast<CData>(fault);
#endif
  return top.release();
}
