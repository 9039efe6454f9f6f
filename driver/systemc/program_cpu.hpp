// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
#pragma once
// Common base of the user CPUs of SystemC platforms, for every port: a thread that runs a program with the driver, its
// local time, RESET and INTR0.
#include <tlm.h>
#include <tlm_utils/tlm_quantumkeeper.h>

#include <functional>
#include <systemc>

#include "driver/dsdpv1.h"

namespace dsdpv1::systemc {

/// Speed of the CPU. The defaults are about those of a Cortex-M3 at 72 MHz.
struct DriverCpuOptions {
  sc_core::sc_time pin_read{17.5, sc_core::SC_NS};  ///< sampling L_REQ or L_STA
  sc_core::sc_time pin_write{14, sc_core::SC_NS};   ///< setting R_REQ, R_STA or RESET
  sc_core::sc_time overhead{83.5, sc_core::SC_NS};  ///< instructions between two accesses, frames or telegrams
};

/// Base of DriverCpu, SpiDriverCpu and UartDriverCpu; not for direct use. The thread is a loosely-timed initiator with
/// a tlm_quantumkeeper. It synchronises (waits for its local time) before it sets or samples a pin and at the end of
/// each quantum; with a global quantum of zero, always.
/// looks at one, and whenever the quantum is over. With a global quantum of zero it always does.
class ProgramCpu : public sc_core::sc_module {
 public:
  /// Low until `set_reset`. May stay unbound.
  sc_core::sc_port<sc_core::sc_signal_inout_if<bool>, 1, sc_core::SC_ZERO_OR_MORE_BOUND> RESET{"RESET"};
  /// Its fall is reported to the driver (dsdpv1_on_intr0). If unbound, dsdpv1_exchange_result shows it.
  sc_core::sc_port<sc_core::sc_signal_in_if<bool>, 1, sc_core::SC_ZERO_OR_MORE_BOUND> INTR0{"INTR0"};

  // For the program, in its thread.

  /// Opened without a judge: every configuration is accepted. To supply one, open it again with the CPU's `port` and
  /// your judge (dsdpv1_open, dsdpv1_open_spi, dsdpv1_open_uart).
  dsdpv1_device& device() { return device_; }
  /// Reports the error /dsdpv1/driver_cpu when RESET is not bound.
  void set_reset(bool level);
  /// Models other work of the CPU.
  void spend(const sc_core::sc_time& time);
  /// Waits until INTR0 falls, unless it has fallen since the last call; false if `at_most` passes without a fall.
  bool wait_for_intr0(const sc_core::sc_time& at_most);
  /// Waits until simulation time reaches the CPU's local time. Call it before accessing parts of the platform that do
  /// not go through this class.
  void sync();
  /// Local time: simulation time plus the CPU's lead.
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
