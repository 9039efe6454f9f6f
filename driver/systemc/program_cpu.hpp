// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
#pragma once
// What the user CPUs of SystemC platforms share, whichever port they reach the chip by: a thread that runs a program
// with the driver, its local time, RESET and INTR0.
#include <tlm.h>
#include <tlm_utils/tlm_quantumkeeper.h>

#include <functional>
#include <systemc>

#include "driver/dsdpv1.h"

namespace dsdpv1::systemc {

/// How fast the CPU is. The defaults are about those of a Cortex-M3 at 72 MHz.
struct DriverCpuOptions {
  sc_core::sc_time pin_read{17.5, sc_core::SC_NS};  ///< looking at L_REQ or L_STA
  sc_core::sc_time pin_write{14, sc_core::SC_NS};   ///< moving R_REQ, R_STA or RESET
  sc_core::sc_time overhead{83.5, sc_core::SC_NS};  ///< instructions between two accesses, frames or telegrams
};

/// Base of DriverCpu, SpiDriverCpu and UartDriverCpu; not to be used by itself. The thread is a loosely-timed initiator
/// with a tlm_quantumkeeper. It synchronises, that is, waits for its local time, before it moves a pin and before it
/// looks at one, and whenever the quantum is over. With a global quantum of zero it always does.
class ProgramCpu : public sc_core::sc_module {
 public:
  /// Low until `set_reset`. May stay unbound.
  sc_core::sc_port<sc_core::sc_signal_inout_if<bool>, 1, sc_core::SC_ZERO_OR_MORE_BOUND> RESET{"RESET"};
  /// A fall is told to the driver (dsdpv1_on_intr0). May stay unbound: then it shows by dsdpv1_exchange_result.
  sc_core::sc_port<sc_core::sc_signal_in_if<bool>, 1, sc_core::SC_ZERO_OR_MORE_BOUND> INTR0{"INTR0"};

  // What follows is for the program, in its thread.

  /// Open, and without a judge: every configuration is accepted. Who judges opens it again with `port` of the CPU and a
  /// judge of their own (dsdpv1_open, dsdpv1_open_spi, dsdpv1_open_uart).
  dsdpv1_device& device() { return device_; }
  /// Reports the error /dsdpv1/driver_cpu when RESET is not bound.
  void set_reset(bool level);
  /// Other work of the CPU.
  void spend(const sc_core::sc_time& time);
  /// Until INTR0 falls, if it has not fallen since the last call; false when `at_most` has passed without.
  bool wait_for_intr0(const sc_core::sc_time& at_most);
  /// Simulation time comes up with the CPU's local time: before anything of the platform is looked at or moved that
  /// does not go through this class.
  void sync();
  /// Local time: simulation time and what the CPU is ahead of it.
  sc_core::sc_time now() const { return keeper_.get_current_time(); }

 protected:
  ProgramCpu(const sc_core::sc_module_name& name, std::function<void()> program, DriverCpuOptions options);
  const DriverCpuOptions& options() const { return options_; }
  tlm_utils::tlm_quantumkeeper& keeper() { return keeper_; }
  void set_pin(sc_core::sc_signal_inout_if<bool>& pin, bool level);

 private:
  void run();
  void intr0_changed();

  std::function<void()> program_;
  DriverCpuOptions options_;
  dsdpv1_device device_;
  tlm_utils::tlm_quantumkeeper keeper_;
  sc_core::sc_event intr0_event_{"intr0_event"};
  bool intr0_fell_ = false;
};

}  // namespace dsdpv1::systemc
