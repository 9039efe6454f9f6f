// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0
// A real master at a chip of a SystemC platform, in real time: a VPC3+ with its user CPU at address 8, and a port of
// this computer. The device answers an output byte with its complement.
//
//   host_platform pty NAME [SECONDS]      a pseudo-terminal, NAME a link to it: pyprofibus, 8E1, 19.2 kbit/s
//   host_platform tcp PORT [SECONDS]      a TCP port of 127.0.0.1, 0: any free one
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>
#include <systemc>

#include "driver/spc3/spc3.h"
#include "driver/systemc/spc3_cpu.hpp"
#include "model/systemc/spc3_tlm.hpp"
#include "registers/spc3_regs.h"
#include "tb/systemc/host/host_bridge.hpp"

namespace serve = dsdpv1::tb::serve;
using dsdpv1::systemc::Spc3DriverCpu;
using dsdpv1::systemc_bench::HostBridge;
using sc_core::sc_signal;
using sc_core::sc_time;
using sc_core::SC_US;

namespace {

constexpr std::uint8_t kAddress = 8;
constexpr int kBaud = 8, kBitsPerSecond = 19'200;  // index of bus/baud.hpp
const std::uint8_t kCfg[] = {0x31};                // two bytes in, two out, as scenarios/dsdpv1.gsd

void start(Spc3DriverCpu& cpu, const std::uint8_t* inputs) {
  spc3_config config{};
  config.address = kAddress;
  config.ident = 0x0CC9;
  config.max_input = config.max_output = 2;
  config.max_prm = 16;
  config.max_cfg = 16;
  config.cfg = kCfg;
  config.cfg_length = sizeof kCfg;
  config.vpc3 = true;
  config.interrupts = SPC3_REG_EVENT_MAC_RESET | SPC3_REG_EVENT_NEW_CFG | SPC3_REG_EVENT_NEW_PRM;
  while (spc3_initialise(&cpu.device(), &config) == SPC3_ERR_NOT_OFFLINE) cpu.spend(sc_time(10, SC_US));
  spc3_set_inputs(&cpu.device(), inputs, 2);
  spc3_start(&cpu.device());
}

/// The program of the user CPU.
void run_device(Spc3DriverCpu& cpu) {
  std::uint8_t inputs[2] = {}, bytes[2] = {};
  cpu.set_reset(true);
  cpu.spend(sc_time(1, SC_US));
  cpu.set_reset(false);
  for (bool offline = true;;) {
    if (offline) start(cpu, inputs);
    offline =
        cpu.wait_for_interrupt(sc_time(500, SC_US)) && (spc3_service(&cpu.device()) & SPC3_REG_EVENT_MAC_RESET) != 0;
    spc3_serve_watchdog(&cpu.device());
    spc3_outputs outputs{bytes, sizeof bytes, 0, false, false};
    if (spc3_get_outputs(&cpu.device(), &outputs) != SPC3_OK || !outputs.fresh) continue;
    for (std::size_t i = 0; i < sizeof inputs; ++i) inputs[i] = static_cast<std::uint8_t>(~bytes[i]);
    spc3_set_inputs(&cpu.device(), inputs, sizeof inputs);
  }
}

dsdpv1::systemc::Spc3TlmOptions options() {
  dsdpv1::systemc::Spc3TlmOptions options;
  options.chip.variant = dsdpv1::spc3::Variant::kVpc3;
  return options;
}

struct Platform {
  dsdpv1::systemc_bench::SegmentModule line{"line"};
  HostBridge host;
  dsdpv1::systemc::Spc3TlmModule chip{"chip", options()};
  Spc3DriverCpu cpu{"cpu", run_device};
  sc_signal<bool> reset{"reset"}, x_int{"x_int", true};

  explicit Platform(std::unique_ptr<serve::HostConnection> port) : host("host", std::move(port), line, kBaud) {
    line.attach(chip);
    cpu.socket.bind(chip.host_socket);
    chip.RESET(reset), cpu.RESET(reset), chip.X_INT(x_int), cpu.X_INT(x_int);
  }
};

std::unique_ptr<serve::HostConnection> open_port(const std::string& kind, const std::string& place) {
  return kind == "tcp" ? serve::open_tcp("127.0.0.1", std::atoi(place.c_str()), std::chrono::seconds(10))
                       : serve::open_pty(place, kBitsPerSecond);
}

void run(const std::string& kind, const std::string& place, double seconds) {
  Platform platform(open_port(kind, place));
  std::printf("serving on %s\n", platform.host.pacing().port.c_str());
  std::fflush(stdout);
  if (seconds > 0)
    sc_core::sc_start(sc_time(seconds, sc_core::SC_SEC));
  else
    sc_core::sc_start();
  const dsdpv1::tb::Pacing pacing = platform.host.pacing();
  std::printf("%llu telegrams of the host, %.3f s given up\n", static_cast<unsigned long long>(pacing.line.telegrams),
              static_cast<double>(pacing.pace.lost) / static_cast<double>(dsdpv1::bus::kTicksPerSecond));
}

}  // namespace

int sc_main(int argc, char* argv[]) {
  const std::string kind = argc > 2 ? argv[1] : "";
  if (kind != "pty" && kind != "tcp") {
    std::fprintf(stderr, "host_platform: the port is \"%s\", expected pty NAME and tcp PORT\n", kind.c_str());
    return 2;
  }
  try {
    run(kind, argv[2], argc > 3 ? std::atof(argv[3]) : 0);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "host_platform: %s\n", error.what());
    return 2;
  }
  return 0;
}
