// The reference RTL as a shared library, compiled together with what Verilator makes of rtl_ref/ (reference_rtl.cmake):
// of the top dsdpv1, or with DSDPV1_RTL_RSU of dsdpv1_rsu.
#include <unistd.h>

#include <atomic>
#include <cstdlib>
#include <string>

#ifdef DSDPV1_RTL_RSU
#include "Vdsdpv1_rsu.h"
#include "Vdsdpv1_rsu___024root.h"
#define RTL_INSIDE(place) dsdpv1_rsu__DOT__##place
#else
#include "Vdsdpv1.h"
#include "Vdsdpv1___024root.h"
#define RTL_INSIDE(place) dsdpv1__DOT__##place
#endif
#include "kinds/dsdpv1/rtl/verilated_top.hpp"
#include "model/dsdpv1/config.hpp"
#if VM_COVERAGE
#include "verilated_cov.h"
#endif

namespace {

#ifdef DSDPV1_RTL_RSU
using Model = Vdsdpv1_rsu;

/// With the pins of R2 beside those of table 1.
class Chip : public dsdpv1::cosim::VerilatedTop<Model> {
 public:
  using VerilatedTop::VerilatedTop;
  void eval() override {
    drive();
    model().xss_i = in.xss;
    model().sck_i = in.sck;
    model().mosi_i = in.mosi;
    model().rxd_i = in.rxd;
    model().mode_i = in.mode;
    model().adr_i = in.adr;
    model().ubr_i = in.ubr;
    model().uiv_i = in.uiv;
    model().eval();
    out.word = outputs() | wire(model().miso_o, dsdpv1::cosim::kWireMiso) |
               wire(model().miso_oe_o, dsdpv1::cosim::kWireMisoDriven) | wire(model().txd_o, dsdpv1::cosim::kWireTxd);
  }
  /// In SPI mode B014 is a register (5.4 of docs/microarchitecture_rsu.md).
  bool dpram(dsdpv1::cosim::DpramImage& image) const override {
    constexpr std::size_t kOwnership = 0x014;
    VerilatedTop::dpram(image);
    const auto& root = *model().rootp;
    if (root.RTL_INSIDE(spi) != 0)
      image[kOwnership] = static_cast<std::uint8_t>(root.RTL_INSIDE(u_serial_port__DOT__u_ownership__DOT__host_q) << 1 |
                                                    root.RTL_INSIDE(u_sequencer__DOT__own_q));
    return true;
  }
};
#else
using Model = Vdsdpv1;
using Chip = dsdpv1::cosim::VerilatedTop<Model>;
#endif

void set_parameters(Model& model, const dsdpv1::Config& config) {
#define DSDPV1_PARAMETER(name, ...) model.name##_i = config.name;
#define DSDPV1_RSU_TICKS(...)
#ifdef DSDPV1_RTL_RSU
  constexpr unsigned kGapBits = 16;
#define DSDPV1_RSU_LIST(name, ...)                     \
  for (unsigned i = 0; i < config.name.size(); i += 2) \
    model.name##_i[i / 2] = config.name[i] | config.name[i + 1] << kGapBits;
#else
#define DSDPV1_RSU_PARAMETER(...)
#define DSDPV1_RSU_LIST(...)
#endif
#include "model/dsdpv1/parameters.inc"
}

#if VM_COVERAGE
/// Writes at its end what it has counted, as a file of its own in the folder that the environment names
/// DSDPV1_RTL_COVERAGE.
class Top : public Chip {
 public:
  using Chip::Chip;
  ~Top() override {
    static std::atomic<unsigned> number{0};
    const char* folder = std::getenv("DSDPV1_RTL_COVERAGE");
    if (folder == nullptr) return;
    const std::string name = std::to_string(getpid()) + "-" + std::to_string(number++) + ".dat";
    context().coveragep()->write((std::string(folder) + "/" + name).c_str());
  }
};
#else
using Top = Chip;
#endif

}  // namespace

extern "C" std::uint32_t dsdpv1_rtl_layout() { return DSDPV1_RTL_LAYOUT; }

/// The caller owns the result.
extern "C" dsdpv1::cosim::RtlTop* dsdpv1_rtl_make(const dsdpv1::Config* config, [[maybe_unused]] std::uint32_t fault,
                                                  std::uint32_t seed) {
  auto top = std::make_unique<Top>(seed);
  set_parameters(top->model(), *config);
#ifdef SINGLE_FAULTS
  top->model().fault_i = static_cast<CData>(fault);
#endif
  return top.release();
}
