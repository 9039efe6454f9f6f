// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
#pragma once
// A user CPU for a chip of the SPC3 family, for SystemC platforms: a thread that runs a program with the family's
// driver. This module's socket is the driver's port.
//
//   dsdpv1::systemc::Spc3DriverCpu cpu("cpu", [](dsdpv1::systemc::Spc3DriverCpu& cpu) {
//     while (spc3_initialise(&cpu.device(), &config) == SPC3_ERR_NOT_OFFLINE) cpu.spend(...);
//     spc3_start(&cpu.device());
//     for (;;) {
//       if (cpu.wait_for_interrupt(sc_core::sc_time(100, sc_core::SC_US))) spc3_service(&cpu.device());
//       spc3_get_outputs(&cpu.device(), &outputs);
//     }
//   });
//   cpu.socket.bind(chip.host_socket);
//   cpu.RESET(reset), cpu.X_INT(x_int);
//
// Ports, time and decoupling: docs/systemc.md.
#include <tlm.h>
#include <tlm_utils/simple_initiator_socket.h>

#include <cstdint>
#include <functional>
#include <systemc>

#include "driver/spc3/spc3.h"
#include "driver/systemc/program_cpu.hpp"

namespace dsdpv1::systemc {

class Spc3DriverCpu : public CpuThread {
 public:
  using Program = std::function<void(Spc3DriverCpu&)>;

  /// Accesses of one byte, in Intel order: 0x000..0x7FF.
  tlm_utils::simple_initiator_socket<Spc3DriverCpu> socket{"socket"};
  /// May stay unbound: the program polls spc3_service.
  sc_core::sc_port<sc_core::sc_signal_in_if<bool>, 1, sc_core::SC_ZERO_OR_MORE_BOUND> X_INT{"X_INT"};

  /// `program` starts at time 0; after it returns, the CPU does nothing. RESET of the chip is high-active.
  Spc3DriverCpu(const sc_core::sc_module_name& name, Program program, DriverCpuOptions options = {});

  /// Opened without an application. To supply one, open it again: spc3_open(&cpu.device(), &cpu.port(), &application).
  spc3_device& device() { return device_; }
  const spc3_port& port() const { return port_; }
  /// Waits until X/INT is at its active level, `active_high` as in spc3_config; false if `at_most` passes before.
  /// Without X_INT it only waits.
  bool wait_for_interrupt(const sc_core::sc_time& at_most, bool active_high = false);
  std::uint64_t accesses() const { return accesses_.count(); }
  /// The accesses that ended ahead of simulation time (temporal decoupling).
  std::uint64_t accesses_ahead() const { return accesses_.ahead(); }

 private:
  spc3_port port_{};
  spc3_device device_{};
  ByteAccesses accesses_{*this};
};

}  // namespace dsdpv1::systemc
