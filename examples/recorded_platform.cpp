// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0
// A platform that judges its own firmware, at full speed: the chip's TLM module with a quantum of 10 us, a user CPU
// with the C driver, a master, and a ChipRecorder. It prints the summary with the margin of each check; its exit code
// is the verdict.
//
//   recorded_platform           0: passed
//   recorded_platform hasty     1: R_STA rises too early, and the checks say so
//   recorded_platform right F   also F.log, F.fst and F.pcapng
#include <tlm.h>

#include <cstdio>
#include <string>
#include <systemc>

#include "bus/master/master1.hpp"
#include "driver/dsdpv1.h"
#include "driver/systemc/driver_cpu.hpp"
#include "kinds/systemc/chip_recorder.hpp"
#include "model/systemc/dsdpv1_tlm.hpp"
#include "tb/systemc/segment_port.hpp"
#include "tb/systemc/timeline_module.hpp"

namespace bus = dsdpv1::bus;
namespace systemc_bench = dsdpv1::systemc_bench;
using dsdpv1::systemc::ChipRecorder;
using dsdpv1::systemc::DriverCpu;
using sc_core::SC_MS;
using sc_core::SC_NS;
using sc_core::sc_signal;
using sc_core::sc_time;
using sc_core::SC_US;

namespace {

constexpr std::uint8_t kSlave = 9;
const std::uint8_t kCfg[] = {0x20};  // one byte of outputs

/// The firmware: takes the outputs, every 100 us.
void run_device(DriverCpu& cpu) {
  dsdpv1_config own{};
  own.address = kSlave;
  own.ident = 0x0C0D;
  own.max_output = 1;
  own.max_cfg = own.cfg_length = sizeof kCfg;
  own.max_prm = DSDPV1_MAX_PRM;
  own.cfg = kCfg;
  cpu.spend(sc_time(1, SC_US));
  cpu.set_reset(true);
  if (dsdpv1_wait_ready(&cpu.device()) != DSDPV1_OK) return;
  dsdpv1_initialise(&cpu.device(), &own);
  for (;;) {
    if (cpu.wait_for_intr0(sc_time(100, SC_US))) dsdpv1_service(&cpu.device());
    std::uint8_t outputs[DSDPV1_MAX_IO];
    dsdpv1_exchange_result result{};
    result.outputs = outputs;
    result.capacity = sizeof outputs;
    dsdpv1_exchange(&cpu.device(), DSDPV1_INPUT_NEWEST, nullptr, 0, &result);
  }
}

struct Platform {
  bus::Segment segment;
  bus::Timeline timeline;
  bus::Master1 master{segment, {}};
  systemc_bench::TimelineModule agents{"agents", timeline};
  systemc_bench::SegmentPort line{"line", segment, agents};
  dsdpv1::systemc::TlmModule chip{"chip"};
  DriverCpu cpu{"cpu", run_device};
  sc_signal<bool> reset{"reset"}, r_req{"r_req"}, r_sta{"r_sta"}, hasty{"hasty"}, l_req{"l_req"}, l_sta{"l_sta"};
  sc_signal<bool> intr0{"intr0"}, pbrxd{"pbrxd", true}, pbtxd{"pbtxd", true}, pbrts{"pbrts"};

  explicit Platform(bool is_hasty) {
    timeline.add(master);
    bus::SlaveParameters slave;
    slave.address = kSlave;
    slave.ident = 0x0C0D;
    slave.cfg = {kCfg[0]};
    slave.output_length = 1;
    master.add_slave(slave);
    cpu.socket.bind(chip.host_socket);
    cpu.RESET(reset), cpu.R_REQ(r_req), cpu.R_STA(r_sta), cpu.L_REQ(l_req), cpu.L_STA(l_sta), cpu.INTR0(intr0);
    chip.RESET(reset), chip.R_REQ(r_req), chip.R_STA(is_hasty ? hasty : r_sta), chip.L_REQ(l_req), chip.L_STA(l_sta);
    chip.INTR0(intr0), chip.PBRXD(pbrxd), chip.PBTXD(pbtxd), chip.PBRTS(pbrts);
    line.PBRXD(pbrxd), line.PBTXD(pbtxd), line.PBRTS(pbrts);
    if (is_hasty) sc_core::sc_spawn([this] { hurry(); });
  }
  /// A short-circuited wire: R_STA follows R_REQ after 20 ns.
  void hurry() {
    for (;;) {
      sc_core::wait(r_req.value_changed_event());
      sc_core::wait(20, SC_NS);
      hasty.write(r_req.read());
    }
  }
};

}  // namespace

int sc_main(int argc, char* argv[]) {
  tlm::tlm_global_quantum::instance().set(sc_time(10, SC_US));
  Platform platform(argc > 1 && std::string(argv[1]) == "hasty");
  dsdpv1::systemc::RecorderOptions options;
  options.name = "device";
  if (argc > 2) {
    options.log = std::string(argv[2]) + ".log";
    options.wave = std::string(argv[2]) + ".fst";
    options.capture = std::string(argv[2]) + ".pcapng";
  }
  ChipRecorder recorder(options);
  recorder.attach(platform.chip);  // before the simulation starts
  platform.master.start();
  sc_core::sc_start(20, SC_MS);
  recorder.finish();
  std::fputs(recorder.summary(true).c_str(), stdout);
  return recorder.exit_code();
}
