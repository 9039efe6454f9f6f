// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0
// Two chips of different families on one PROFIBUS segment in SystemC, a DSDPV1 and a VPC3+, each with its own user CPU
// and driver, and a master of class 1. Both go from power-on to data exchange; each device answers an output byte with
// its complement.
//
//   segment_platform characters    the chips at the segment as a whole
//   segment_platform pins          the chips at the segment by their pins: the same results at the same times
#include <cstdio>
#include <memory>
#include <string>
#include <systemc>

#include "bus/master/master1.hpp"
#include "driver/dsdpv1.h"
#include "driver/spc3/spc3.h"
#include "driver/systemc/driver_cpu.hpp"
#include "driver/systemc/spc3_cpu.hpp"
#include "model/systemc/dsdpv1_tlm.hpp"
#include "model/systemc/spc3_tlm.hpp"
#include "registers/spc3_regs.h"
#include "tb/systemc/segment_module.hpp"
#include "tb/systemc/segment_port.hpp"

namespace bus = dsdpv1::bus;
namespace systemc_bench = dsdpv1::systemc_bench;
using dsdpv1::systemc::DriverCpu;
using dsdpv1::systemc::Spc3DriverCpu;
using dsdpv1::systemc::Spc3TlmModule;
using dsdpv1::systemc::TlmModule;
using sc_core::sc_signal;
using sc_core::sc_time;
using sc_core::SC_US;

namespace {

constexpr std::uint8_t kDsdpv1 = 9, kVpc3 = 11, kMaster = 2;
constexpr std::uint16_t kDsdpv1Ident = 0x0C0D, kVpc3Ident = 0x0CC9;
const std::uint8_t kCfg[] = {0x11, 0x21};  // two bytes of inputs, two of outputs

void say(double seconds, const std::string& what, const std::uint8_t* bytes = nullptr, std::size_t count = 0) {
  std::printf("%10.3f us  %s", seconds * 1e6, what.c_str());
  for (std::size_t i = 0; i < count; ++i) std::printf(" %02X", unsigned{bytes[i]});
  std::printf("\n");
}

double seconds(bus::Tick at) { return dsdpv1::systemc::to_time(at).to_seconds(); }

void complement(const std::uint8_t* from, std::uint8_t* to) {
  for (std::size_t i = 0; i < 2; ++i) to[i] = static_cast<std::uint8_t>(~from[i]);
}

// --- the device with the DSDPV1 --------------------------------------------------------------------------------------

void run_dsdpv1(DriverCpu& cpu) {
  dsdpv1_config config{};
  config.address = kDsdpv1;
  config.ident = kDsdpv1Ident;
  config.max_input = config.max_output = 2;
  config.max_cfg = config.cfg_length = sizeof kCfg;
  config.max_prm = DSDPV1_MAX_PRM;
  config.cfg = kCfg;
  cpu.spend(sc_time(1, SC_US));
  cpu.set_reset(true);
  dsdpv1_error error = dsdpv1_wait_ready(&cpu.device());
  if (error == DSDPV1_OK) error = dsdpv1_initialise(&cpu.device(), &config);
  say(cpu.now().to_seconds(), std::string("DSDPV1: initialised: ") + dsdpv1_error_text(error));
  std::uint8_t inputs[2] = {}, outputs[DSDPV1_MAX_IO];
  for (;;) {
    if (cpu.wait_for_intr0(sc_time(100, SC_US))) dsdpv1_service(&cpu.device());
    dsdpv1_exchange_result result{};
    result.outputs = outputs;
    result.capacity = sizeof outputs;
    dsdpv1_exchange(&cpu.device(), DSDPV1_INPUT_NEWEST, inputs, sizeof inputs, &result);
    if (result.outputs_new && result.length == sizeof inputs) complement(outputs, inputs);
  }
}

// --- the device with the VPC3+ ---------------------------------------------------------------------------------------

void start_vpc3(Spc3DriverCpu& cpu, const std::uint8_t* inputs) {
  spc3_config config{};
  config.address = kVpc3;
  config.ident = kVpc3Ident;
  config.max_input = config.max_output = 2;
  config.max_prm = 10;
  config.max_cfg = config.cfg_length = sizeof kCfg;
  config.cfg = kCfg;
  config.vpc3 = true;
  config.interrupts = SPC3_REG_EVENT_MAC_RESET | SPC3_REG_EVENT_NEW_CFG | SPC3_REG_EVENT_NEW_PRM;
  spc3_error error = spc3_initialise(&cpu.device(), &config);
  for (; error == SPC3_ERR_NOT_OFFLINE; error = spc3_initialise(&cpu.device(), &config)) cpu.spend(sc_time(10, SC_US));
  spc3_set_inputs(&cpu.device(), inputs, 2);
  spc3_start(&cpu.device());
  say(cpu.now().to_seconds(), std::string("VPC3+: initialised: ") + spc3_error_text(error));
}

void run_vpc3(Spc3DriverCpu& cpu) {
  std::uint8_t inputs[2] = {}, bytes[2] = {};
  cpu.set_reset(true);
  cpu.spend(sc_time(1, SC_US));
  cpu.set_reset(false);
  start_vpc3(cpu, inputs);
  for (;;) {
    if (cpu.wait_for_interrupt(sc_time(100, SC_US))) spc3_service(&cpu.device());
    spc3_outputs outputs{bytes, sizeof bytes, 0, false, false};
    if (spc3_get_outputs(&cpu.device(), &outputs) != SPC3_OK || !outputs.fresh) continue;
    complement(bytes, inputs);
    spc3_set_inputs(&cpu.device(), inputs, sizeof inputs);
    spc3_serve_watchdog(&cpu.device());
  }
}

// --- the platform ----------------------------------------------------------------------------------------------------

bus::MasterConfig master_config() {
  bus::MasterConfig own;
  own.address = kMaster;
  own.baud = 0;  // 12 Mbit/s
  return own;
}

bus::SlaveParameters slave(std::uint8_t address, std::uint16_t ident) {
  bus::SlaveParameters parameters;
  parameters.address = address;
  parameters.ident = ident;
  parameters.cfg = {kCfg[0], kCfg[1]};
  parameters.input_length = parameters.output_length = 2;
  return parameters;
}

/// Counts everything on the line.
struct Tap : sc_core::sc_module, tlm::tlm_analysis_if<systemc_bench::HeardCharacter> {
  std::uint64_t characters = 0, wrong = 0;
  explicit Tap(const sc_core::sc_module_name& name) : sc_module(name) {}
  void write(const systemc_bench::HeardCharacter& heard) override {
    ++characters;
    if (heard.collided || !heard.parity_ok || !heard.stop_ok) ++wrong;
  }
};

dsdpv1::systemc::Spc3TlmOptions vpc3_options() {
  dsdpv1::systemc::Spc3TlmOptions options;
  options.chip.variant = dsdpv1::spc3::Variant::kVpc3;
  return options;
}

struct Platform {
  systemc_bench::SegmentModule line{"line"};
  bus::Master1 master{line.segment(), master_config()};
  Tap tap{"tap"};
  TlmModule dsdpv1{"dsdpv1"};
  DriverCpu dsdpv1_cpu{"dsdpv1_cpu", run_dsdpv1};
  Spc3TlmModule vpc3{"vpc3", vpc3_options()};
  Spc3DriverCpu vpc3_cpu{"vpc3_cpu", run_vpc3};
  sc_signal<bool> reset{"reset"}, r_req{"r_req"}, r_sta{"r_sta"}, l_req{"l_req"}, l_sta{"l_sta"}, intr0{"intr0"};
  sc_signal<bool> vpc3_reset{"vpc3_reset"}, x_int{"x_int", true};

  Platform() {
    line.heard.bind(tap);
    line.add(master);
    master.add_slave(slave(kDsdpv1, kDsdpv1Ident));
    master.add_slave(slave(kVpc3, kVpc3Ident));
    master.on_state = [](bus::Tick at, std::uint8_t address, bus::SlaveState, bus::SlaveState to) {
      say(seconds(at), "master: slave " + std::to_string(address) + " is " + bus::name(to));
    };
    dsdpv1_cpu.socket.bind(dsdpv1.host_socket);
    wire(dsdpv1), wire(dsdpv1_cpu);
    vpc3_cpu.socket.bind(vpc3.host_socket);
    vpc3.RESET(vpc3_reset), vpc3_cpu.RESET(vpc3_reset), vpc3.X_INT(x_int), vpc3_cpu.X_INT(x_int);
  }

  /// The handshake at the DPRAM.
  template <class Side>
  void wire(Side& side) {
    side.RESET(reset), side.R_REQ(r_req), side.R_STA(r_sta), side.L_REQ(l_req), side.L_STA(l_sta), side.INTR0(intr0);
  }

  void exchange(const bus::Bytes& outputs, int milliseconds) {
    for (const std::uint8_t address : {kDsdpv1, kVpc3}) master.set_outputs(address, outputs);
    sc_core::sc_start(milliseconds, sc_core::SC_MS);
    for (const std::uint8_t address : {kDsdpv1, kVpc3}) {
      const bus::Bytes& inputs = master.slave(address).inputs;
      say(sc_core::sc_time_stamp().to_seconds(), "master: inputs of " + std::to_string(address), inputs.data(),
          inputs.size());
    }
  }

  void run() {
    master.start();
    exchange({0x01, 0x02}, 3);
    exchange({0x0A, 0x0B}, 1);
    std::printf("%llu characters on the line, %llu wrong\n", static_cast<unsigned long long>(tap.characters),
                static_cast<unsigned long long>(tap.wrong));
  }
};

void run_by_characters() {
  Platform platform;
  platform.line.attach(platform.dsdpv1);
  platform.line.attach(platform.vpc3);
  platform.run();
}

/// A chip's pins at the line.
struct Wires {
  sc_signal<bool> rxd, txd, rts;
  systemc_bench::SegmentPort port;

  Wires(const std::string& name, systemc_bench::SegmentModule& line)
      : rxd((name + "_rxd").c_str(), true),
        txd((name + "_txd").c_str(), true),
        rts((name + "_rts").c_str()),
        port((name + "_port").c_str(), line.segment(), line.agents()) {
    port.PBRXD(rxd), port.PBTXD(txd), port.PBRTS(rts);
  }
};

void run_by_pins() {
  Platform platform;
  Wires dsdpv1("dsdpv1", platform.line), vpc3("vpc3", platform.line);
  platform.dsdpv1.PBRXD(dsdpv1.rxd), platform.dsdpv1.PBTXD(dsdpv1.txd), platform.dsdpv1.PBRTS(dsdpv1.rts);
  platform.vpc3.RXD(vpc3.rxd), platform.vpc3.TXD(vpc3.txd), platform.vpc3.RTS(vpc3.rts);
  platform.run();
}

}  // namespace

int sc_main(int argc, char* argv[]) {
  const std::string level = argc > 1 ? argv[1] : "";
  if (level != "characters" && level != "pins") {
    std::fprintf(stderr, "segment_platform: the level is \"%s\", expected characters and pins\n", level.c_str());
    return 2;
  }
  level == "characters" ? run_by_characters() : run_by_pins();
  return 0;
}
