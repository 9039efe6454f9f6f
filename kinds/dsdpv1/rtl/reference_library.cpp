// The reference RTL as a shared library (cosim/rtl_library.hpp), compiled with Verilator's output for rtl_ref/
// (reference_rtl.cmake), in which the top, dsdpv1 or dsdpv1_rsu, is called Vchip. A port needs only a row of pins.inc
// or parameters.inc.
#include <unistd.h>

#include <atomic>
#include <cstdlib>
#include <memory>
#include <string>

#include "Vchip.h"
#include "Vchip___024root.h"
#include "cosim/rtl_library.hpp"
#include "model/dsdpv1/config.hpp"
#include "verilated.h"
#if VM_COVERAGE
#include "verilated_cov.h"
#endif

#ifdef DSDPV1_RTL_OF_dsdpv1_rsu
#define INSIDE(place) dsdpv1_rsu__DOT__##place
#define OF_RSU(...) __VA_ARGS__
#else
#define INSIDE(place) dsdpv1__DOT__##place
#define OF_RSU(...)
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
    model = std::make_unique<Vchip>(&context);
  }
  /// Verilator takes the design's names from the thread's last context, which may belong to another design.
  ~Design() {
    Verilated::threadContextp(&context);
    model->final();
    model.reset();
    Verilated::threadContextp(Verilated::defaultContextp());
  }

  VerilatedContext context;
  std::unique_ptr<Vchip> model;
};

Vchip& model_of(void* design) { return *static_cast<Design*>(design)->model; }

void set_parameters(Vchip& model, const dsdpv1::Config& config) {
#define DSDPV1_PARAMETER(name, ...) model.name##_i = config.name;
#define DSDPV1_RSU_PARAMETER(...) OF_RSU(DSDPV1_PARAMETER(__VA_ARGS__))
#define DSDPV1_RSU_TICKS(...)
#define DSDPV1_RSU_LIST(name, ...)                                                    \
  OF_RSU(for (unsigned i = 0; i < config.name.size(); i += 2) model.name##_i[i / 2] = \
             config.name[i] | config.name[i + 1] << 16U;)
#include "model/dsdpv1/parameters.inc"
}

void put(std::uint8_t* image, std::uint32_t write) {
  image[write >> 8 & (kDpramSize - 1)] = static_cast<std::uint8_t>(write & 0xFF);
}

/// Z of an undriven bus becomes ones; the model, too, reads no bits from it.
template <class Port>
void set(Port& port, std::int16_t level) {
  port = static_cast<Port>(level);
}

// Maps a pin to a port of the top: inputs NAME_i, outputs NAME_o; one that is Z while RESET is low also has NAME_oe_o.
#define INPUT(pin, name, width, direction, level, group, place, port) INPUT_##direction(pin, port)
#define INPUT_kInput(pin, port) set(model.port##_i, levels[number(Pin::pin)]);
#define INPUT_kOutput(pin, port)
#define OUTPUT(pin, name, width, direction, level, group, place, port) OUTPUT_##direction(pin, LEVEL_##level(port))
#define OUTPUT_kInput(pin, level)
#define OUTPUT_kOutput(pin, level) levels[number(Pin::pin)] = level;
#define LEVEL_0(port) static_cast<std::int16_t>(model.port##_o)
#define LEVEL_1 LEVEL_0
#define LEVEL_kLevelZ(port) model.port##_oe_o != 0 ? LEVEL_0(port) : dsdpv1::kLevelZ

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

/// A build that counts coverage writes it to a separate file in the folder named by the environment variable
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

void dsdpv1_rtl_eval(void* self, bool clk, std::int16_t* levels) {
  Vchip& model = model_of(self);
  model.clk_i = clk;
#define DSDPV1_PIN INPUT
#define DSDPV1_RSU_PIN(...) OF_RSU(INPUT(__VA_ARGS__))
#include "model/dsdpv1/pins.inc"
  model.eval();
#define DSDPV1_PIN OUTPUT
#define DSDPV1_RSU_PIN(...) OF_RSU(OUTPUT(__VA_ARGS__))
#include "model/dsdpv1/pins.inc"
}

/// Four memories interleaved by the low address bits, and up to two pending writes, the older one first.
void dsdpv1_rtl_memory(void* self, std::uint8_t* image) {
  const auto& root = *model_of(self).rootp;
  for (unsigned i = 0; i < kDpramSize; i += 4) {
    image[i] = root.INSIDE(u_dpram__DOT__g_lane__BRA__0__KET____DOT__u_ram__DOT__memory_q)[i / 4];
    image[i + 1] = root.INSIDE(u_dpram__DOT__g_lane__BRA__1__KET____DOT__u_ram__DOT__memory_q)[i / 4];
    image[i + 2] = root.INSIDE(u_dpram__DOT__g_lane__BRA__2__KET____DOT__u_ram__DOT__memory_q)[i / 4];
    image[i + 3] = root.INSIDE(u_dpram__DOT__g_lane__BRA__3__KET____DOT__u_ram__DOT__memory_q)[i / 4];
  }
  if (root.INSIDE(u_dpram__DOT__first_valid_q)) put(image, root.INSIDE(u_dpram__DOT__first_q));
  if (root.INSIDE(u_dpram__DOT__second_valid_q)) put(image, root.INSIDE(u_dpram__DOT__second_q));
  // In SPI mode B014 is a register (5.4 of docs/microarchitecture_rsu.md).
  OF_RSU(if (root.INSIDE(spi) != 0) image[0x014] = root.INSIDE(b014);)
}

}  // extern "C"
