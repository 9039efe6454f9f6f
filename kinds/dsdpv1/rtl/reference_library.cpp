// The reference RTL as a shared library (cosim/rtl_library.hpp), compiled together with what Verilator makes of
// rtl_ref/ (reference_rtl.cmake): of the top dsdpv1, or with DSDPV1_RTL_RSU of dsdpv1_rsu.
#include <unistd.h>

#include <atomic>
#include <cstdlib>
#include <memory>
#include <string>

#ifdef DSDPV1_RTL_RSU
#include "Vdsdpv1_rsu.h"
#include "Vdsdpv1_rsu___024root.h"
#define RTL_INSIDE(place) dsdpv1_rsu__DOT__##place
using Model = Vdsdpv1_rsu;
#else
#include "Vdsdpv1.h"
#include "Vdsdpv1___024root.h"
#define RTL_INSIDE(place) dsdpv1__DOT__##place
using Model = Vdsdpv1;
#endif
#include "cosim/rtl_library.hpp"
#include "model/dsdpv1/config.hpp"
#include "verilated.h"
#if VM_COVERAGE
#include "verilated_cov.h"
#endif

namespace {

using dsdpv1::number;
using dsdpv1::Pin;
using dsdpv1::cosim::RtlStart;

constexpr unsigned kDpramSize = 2048;

struct Design {
  explicit Design(const RtlStart& start) {
    context.randReset(start.fill);
    context.randSeed(static_cast<int>(start.seed % 0x7FFF'FFFF + 1));
    model = std::make_unique<Model>(&context);
  }
  ~Design() { model->final(); }

  VerilatedContext context;
  std::unique_ptr<Model> model;
};

Model& model_of(void* design) { return *static_cast<Design*>(design)->model; }

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

void put(std::uint8_t* image, std::uint32_t write) {
  image[write >> 8 & (kDpramSize - 1)] = static_cast<std::uint8_t>(write & 0xFF);
}

std::int16_t driven(bool enabled, std::uint32_t level) {
  return enabled ? static_cast<std::int16_t>(level) : dsdpv1::kLevelZ;
}

/// The levels of the pins, by their numbers.
class Levels {
 public:
  explicit Levels(std::int16_t* levels) : levels_(levels) {}
  std::int16_t& operator[](Pin pin) const { return levels_[number(pin)]; }

 private:
  std::int16_t* levels_;
};

}  // namespace

extern "C" {

std::uint32_t dsdpv1_rtl_layout() { return DSDPV1_RTL_LAYOUT; }

void* dsdpv1_rtl_create(const RtlStart* start) {
  auto design = std::make_unique<Design>(*start);
  set_parameters(*design->model, *static_cast<const dsdpv1::Config*>(start->parameters));
#ifdef SINGLE_FAULTS
  design->model->fault_i = static_cast<CData>(start->fault);
#endif
  return design.release();
}

/// A build that counts coverage leaves it as a file of its own in the folder that the environment names
/// DSDPV1_RTL_COVERAGE.
void dsdpv1_rtl_destroy(void* self) {
  const std::unique_ptr<Design> design(static_cast<Design*>(self));
#if VM_COVERAGE
  static std::atomic<unsigned> count{0};
  if (const char* folder = std::getenv("DSDPV1_RTL_COVERAGE"))
    design->context.coveragep()->write(
        (std::string(folder) + "/" + std::to_string(getpid()) + "-" + std::to_string(count++) + ".dat").c_str());
#endif
}

/// The chip captures FF from a bus that nobody drives, as the model, which reads no bits from Z.
void dsdpv1_rtl_eval(void* self, bool clk, std::int16_t* by_pin) {
  Model& model = model_of(self);
  const Levels levels(by_pin);
  model.clk_i = clk;
  model.reset_i = static_cast<CData>(levels[Pin::kReset]);
  model.r_req_i = static_cast<CData>(levels[Pin::kRReq]);
  model.r_sta_i = static_cast<CData>(levels[Pin::kRSta]);
  model.csr_i = static_cast<CData>(levels[Pin::kCsr]);
  model.rd_i = static_cast<CData>(levels[Pin::kRd]);
  model.wr_i = static_cast<CData>(levels[Pin::kWr]);
  model.a_i = static_cast<SData>(levels[Pin::kA]);
  model.d_i = levels[Pin::kDIn] < 0 ? CData{0xFF} : static_cast<CData>(levels[Pin::kDIn]);
  model.pbrxd_i = static_cast<CData>(levels[Pin::kPbrxd]);
#ifdef DSDPV1_RTL_RSU
  model.xss_i = static_cast<CData>(levels[Pin::kXss]);
  model.sck_i = static_cast<CData>(levels[Pin::kSck]);
  model.mosi_i = static_cast<CData>(levels[Pin::kMosi]);
  model.rxd_i = static_cast<CData>(levels[Pin::kRxd]);
  model.mode_i = static_cast<CData>(levels[Pin::kMode]);
  model.adr_i = static_cast<CData>(levels[Pin::kAdr]);
  model.ubr_i = static_cast<CData>(levels[Pin::kUbr]);
  model.uiv_i = static_cast<CData>(levels[Pin::kUiv]);
#endif
  model.eval();
  levels[Pin::kLReq] = model.l_req_o;
  levels[Pin::kLSta] = model.l_sta_o;
  levels[Pin::kDOut] = driven(model.d_oe_o != 0, model.d_o);
  levels[Pin::kIntr0] = model.intr0_o;
  levels[Pin::kPbtxd] = model.pbtxd_o;
  levels[Pin::kPbrts] = model.pbrts_o;
  levels[Pin::kPbf] = model.pbf_o;
  levels[Pin::kBr] = model.br_o;
  levels[Pin::kReady] = model.ready_o;
#ifdef DSDPV1_RTL_RSU
  levels[Pin::kMiso] = driven(model.miso_oe_o != 0, model.miso_o);
  levels[Pin::kTxd] = model.txd_o;
#endif
}

/// Four memories interleaved by the low address bits, and up to two writes on their way to them, the older one first.
void dsdpv1_rtl_memory(void* self, std::uint8_t* image) {
  const auto& root = *model_of(self).rootp;
  for (unsigned i = 0; i < kDpramSize; i += 4) {
    image[i] = root.RTL_INSIDE(u_dpram__DOT__g_lane__BRA__0__KET____DOT__u_ram__DOT__memory_q)[i / 4];
    image[i + 1] = root.RTL_INSIDE(u_dpram__DOT__g_lane__BRA__1__KET____DOT__u_ram__DOT__memory_q)[i / 4];
    image[i + 2] = root.RTL_INSIDE(u_dpram__DOT__g_lane__BRA__2__KET____DOT__u_ram__DOT__memory_q)[i / 4];
    image[i + 3] = root.RTL_INSIDE(u_dpram__DOT__g_lane__BRA__3__KET____DOT__u_ram__DOT__memory_q)[i / 4];
  }
  if (root.RTL_INSIDE(u_dpram__DOT__first_valid_q)) put(image, root.RTL_INSIDE(u_dpram__DOT__first_q));
  if (root.RTL_INSIDE(u_dpram__DOT__second_valid_q)) put(image, root.RTL_INSIDE(u_dpram__DOT__second_q));
#ifdef DSDPV1_RTL_RSU
  constexpr unsigned kOwnership = 0x014;  // in SPI mode a register (5.4 of docs/microarchitecture_rsu.md)
  if (root.RTL_INSIDE(spi) != 0)
    image[kOwnership] = static_cast<std::uint8_t>(root.RTL_INSIDE(u_serial_port__DOT__u_ownership__DOT__host_q) << 1 |
                                                  root.RTL_INSIDE(u_sequencer__DOT__own_q));
#endif
}

}  // extern "C"
