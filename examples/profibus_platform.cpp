// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0
// A PROFIBUS segment in SystemC: a master of class 1, the chip, and a user CPU that runs the C driver. They go from
// power-on to data exchange, and the device answers each output byte with its complement as an input.
//
//   profibus_platform tlm     the chip with a TLM-2.0 socket
//   profibus_platform pins    the chip with the pins of table 1: the same results at the same times
#include <cstdio>
#include <string>
#include <systemc>

#include "bus/master/master1.hpp"
#include "driver/dsdpv1.h"
#include "driver/systemc/driver_cpu.hpp"
#include "model/systemc/dsdpv1_pins.hpp"
#include "model/systemc/dsdpv1_tlm.hpp"
#include "model/systemc/host_pins.hpp"
#include "tb/systemc/segment_port.hpp"
#include "tb/systemc/timeline_module.hpp"

namespace bus = dsdpv1::bus;
namespace systemc_bench = dsdpv1::systemc_bench;
using dsdpv1::systemc::DriverCpu;
using sc_core::sc_signal;
using sc_core::SC_US;

namespace {

constexpr std::uint8_t kSlave = 9, kMaster = 2;
constexpr std::uint16_t kIdent = 0x0C0D;
const std::uint8_t kCfg[] = {0x13, 0x23};  // four bytes of inputs, four of outputs

void say(double seconds, const std::string& what, const std::uint8_t* bytes = nullptr, std::size_t count = 0) {
  std::printf("%10.3f us  %s", seconds * 1e6, what.c_str());
  for (std::size_t i = 0; i < count; ++i) std::printf(" %02X", unsigned{bytes[i]});
  std::printf("\n");
}

// --- the device ------------------------------------------------------------------------------------------------------

dsdpv1_config config() {
  dsdpv1_config c{};
  c.address = kSlave;
  c.ident = kIdent;
  c.max_input = c.max_output = 4;
  c.max_cfg = c.cfg_length = sizeof kCfg;
  c.max_prm = DSDPV1_MAX_PRM;
  c.cfg = kCfg;
  return c;
}

void bring_up(DriverCpu& cpu) {
  cpu.spend(sc_core::sc_time(1, SC_US));
  cpu.set_reset(true);
  dsdpv1_error error = dsdpv1_wait_ready(&cpu.device());
  const dsdpv1_config own = config();
  if (error == DSDPV1_OK) error = dsdpv1_initialise(&cpu.device(), &own);
  say(cpu.now().to_seconds(), std::string("device: initialised: ") + dsdpv1_error_text(error));
}

/// The program of the user CPU.
void run_device(DriverCpu& cpu) {
  std::uint8_t inputs[4] = {}, outputs[DSDPV1_MAX_IO];
  bring_up(cpu);
  for (;;) {
    if (cpu.wait_for_intr0(sc_core::sc_time(100, SC_US))) dsdpv1_service(&cpu.device());
    dsdpv1_exchange_result result{};
    result.outputs = outputs;
    result.capacity = sizeof outputs;
    dsdpv1_exchange(&cpu.device(), DSDPV1_INPUT_NEWEST, inputs, sizeof inputs, &result);
    if (!result.outputs_new || result.length != sizeof inputs) continue;
    if (inputs[0] != static_cast<std::uint8_t>(~outputs[0]))
      say(cpu.now().to_seconds(), "device: outputs", outputs, result.length);
    for (std::size_t i = 0; i < sizeof inputs; ++i) inputs[i] = static_cast<std::uint8_t>(~outputs[i]);
  }
}

// --- the master ------------------------------------------------------------------------------------------------------

bus::SlaveParameters slave() {
  bus::SlaveParameters parameters;
  parameters.address = kSlave;
  parameters.ident = kIdent;
  parameters.cfg = {kCfg[0], kCfg[1]};
  parameters.input_length = parameters.output_length = 4;
  return parameters;
}

bus::MasterConfig master_config() {
  bus::MasterConfig own;
  own.address = kMaster;
  own.baud = 0;  // 12 Mbit/s
  return own;
}

double seconds(bus::Tick at) { return dsdpv1::systemc::to_time(at).to_seconds(); }

// --- the platform ----------------------------------------------------------------------------------------------------

struct Platform {
  bus::Segment segment;
  bus::Timeline timeline;
  bus::Master1 master{segment, master_config()};
  systemc_bench::TimelineModule agents{"agents", timeline};
  systemc_bench::SegmentPort line{"line", segment, agents};
  DriverCpu cpu{"cpu", run_device};
  sc_signal<bool> reset{"reset"}, r_req{"r_req"}, r_sta{"r_sta"}, l_req{"l_req"}, l_sta{"l_sta"}, intr0{"intr0"};
  sc_signal<bool> pbrxd{"pbrxd", true}, pbtxd{"pbtxd", true}, pbrts{"pbrts"};

  Platform() {
    timeline.add(master);
    master.add_slave(slave());
    master.set_outputs(kSlave, {1, 2, 3, 4});
    master.on_state = [](bus::Tick at, std::uint8_t, bus::SlaveState, bus::SlaveState to) {
      say(seconds(at), std::string("master: slave is ") + bus::name(to));
    };
    master.on_inputs = [this](bus::Tick at, std::uint8_t address) {
      const bus::Bytes& inputs = master.slave(address).inputs;
      say(seconds(at), "master: inputs", inputs.data(), inputs.size());
    };
    cpu.RESET(reset), cpu.R_REQ(r_req), cpu.R_STA(r_sta), cpu.L_REQ(l_req), cpu.L_STA(l_sta), cpu.INTR0(intr0);
    line.PBRXD(pbrxd), line.PBTXD(pbtxd), line.PBRTS(pbrts);
  }

  /// Handshake, INTR0 and bus: pins in either view.
  template <class Chip>
  void connect(Chip& chip) {
    chip.RESET(reset), chip.R_REQ(r_req), chip.R_STA(r_sta), chip.L_REQ(l_req), chip.L_STA(l_sta), chip.INTR0(intr0);
    chip.PBRXD(pbrxd), chip.PBTXD(pbtxd), chip.PBRTS(pbrts);
  }

  void run() {
    master.start();
    sc_core::sc_start(4, sc_core::SC_MS);
    master.set_outputs(kSlave, {0x0A, 0x0B, 0x0C, 0x0D});
    sc_core::sc_start(1, sc_core::SC_MS);
    std::printf("%llu exchanges\n", static_cast<unsigned long long>(master.slave(kSlave).counters.data_exchanges));
  }
};

void run_tlm() {
  Platform platform;
  dsdpv1::systemc::TlmModule chip("chip");
  platform.connect(chip);
  platform.cpu.socket.bind(chip.host_socket);
  platform.run();
}

void run_pins() {
  Platform platform;
  dsdpv1::systemc::PinModule chip("chip");
  dsdpv1::systemc::HostPins host("host");
  sc_signal<sc_dt::sc_uint<11>> a{"a"};
  sc_core::sc_signal_rv<8> d{"d"};
  sc_signal<bool> csr{"csr"}, rd{"rd"}, wr{"wr"}, pbf{"pbf"}, br{"br"}, ready{"ready"};
  platform.connect(chip);
  chip.A(a), chip.D(d), chip.CSR(csr), chip.RD(rd), chip.WR(wr), chip.PBF(pbf), chip.BR(br), chip.READY(ready);
  host.A(a), host.D(d), host.CSR(csr), host.RD(rd), host.WR(wr);
  platform.cpu.socket.bind(host.socket);
  platform.run();
}

}  // namespace

int sc_main(int argc, char* argv[]) {
  const std::string view = argc > 1 ? argv[1] : "";
  if (view != "tlm" && view != "pins") {
    std::fprintf(stderr, "profibus_platform: the view is \"%s\", expected tlm and pins\n", view.c_str());
    return 2;
  }
  view == "tlm" ? run_tlm() : run_pins();
  return 0;
}
