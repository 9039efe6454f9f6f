// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
#pragma once
// A user CPU on the parallel port, for SystemC platforms: a thread that runs a program with the portable C driver. This
// module's socket and pins are the driver's port.
//
//   dsdpv1::systemc::DriverCpu cpu("cpu", [](dsdpv1::systemc::DriverCpu& cpu) {
//     cpu.set_reset(true);
//     if (dsdpv1_wait_ready(&cpu.device()) == DSDPV1_OK) dsdpv1_initialise(&cpu.device(), &config);
//     for (;;) {
//       if (cpu.wait_for_intr0(sc_core::sc_time(100, sc_core::SC_US))) dsdpv1_service(&cpu.device());
//       dsdpv1_exchange(&cpu.device(), DSDPV1_INPUT_NEWEST, inputs, sizeof inputs, &result);
//     }
//   });
//   cpu.socket.bind(chip.host_socket);
//   cpu.R_REQ(r_req), cpu.R_STA(r_sta), cpu.L_REQ(l_req), cpu.L_STA(l_sta), cpu.RESET(reset), cpu.INTR0(intr0);
//
// Ports, time and decoupling: docs/systemc.md.
#include <tlm.h>
#include <tlm_utils/simple_initiator_socket.h>

#include <cstdint>
#include <functional>
#include <systemc>

#include "driver/systemc/program_cpu.hpp"

namespace dsdpv1::systemc {

class DriverCpu : public ProgramCpu {
 public:
  using Program = std::function<void(DriverCpu&)>;

  /// Accesses of one byte, at the addresses of the DPRAM: 0x000..0x7FF.
  tlm_utils::simple_initiator_socket<DriverCpu> socket{"socket"};
  sc_core::sc_out<bool> R_REQ{"R_REQ"}, R_STA{"R_STA"};
  sc_core::sc_in<bool> L_REQ{"L_REQ"}, L_STA{"L_STA"};

  /// `program` starts at time 0 with all pins low; after it returns, the CPU does nothing.
  DriverCpu(const sc_core::sc_module_name& name, Program program, DriverCpuOptions options = {});

  const dsdpv1_port& port() const { return port_; }
  std::uint64_t accesses() const { return accesses_.count(); }
  /// The accesses that ended ahead of simulation time (temporal decoupling).
  std::uint64_t accesses_ahead() const { return accesses_.ahead(); }

 private:
  dsdpv1_port make_port();
  bool get_pin(const sc_core::sc_in<bool>& pin);

  dsdpv1_port port_;
  ByteAccesses accesses_{*this};
};

}  // namespace dsdpv1::systemc
