// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
#pragma once
// Common bases of the user CPUs of SystemC platforms, for every chip and port: a thread that runs a program with the
// driver, its local time, its pins and its accesses.
#include <tlm.h>
#include <tlm_utils/tlm_quantumkeeper.h>

#include <cstdint>
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

/// Base of all user CPUs; not for direct use. The thread is a loosely-timed initiator with a tlm_quantumkeeper. It
/// synchronises (waits for its local time) before it sets or samples a pin and at the end of each quantum; with a
/// global quantum of zero, always.
class CpuThread : public sc_core::sc_module {
 public:
  /// Low until `set_reset`. May stay unbound.
  sc_core::sc_port<sc_core::sc_signal_inout_if<bool>, 1, sc_core::SC_ZERO_OR_MORE_BOUND> RESET{"RESET"};

  // For the program, in its thread.

  /// Reports the error /dsdpv1/driver_cpu when RESET is not bound.
  void set_reset(bool level);
  /// Models other work of the CPU.
  void spend(const sc_core::sc_time& time);
  /// Waits until simulation time reaches the CPU's local time. Call it before accessing parts of the platform that do
  /// not go through this class.
  void sync();
  /// Local time: simulation time plus the CPU's lead.
  sc_core::sc_time now() const { return keeper_.get_current_time(); }

 protected:
  CpuThread(const sc_core::sc_module_name& name, std::function<void()> program, DriverCpuOptions options);
  const DriverCpuOptions& options() const { return options_; }
  tlm_utils::tlm_quantumkeeper& keeper() { return keeper_; }
  void set_pin(sc_core::sc_signal_inout_if<bool>& pin, bool level);

 private:
  friend class ByteAccesses;
  void run();

  std::function<void()> program_;
  DriverCpuOptions options_;
  tlm_utils::tlm_quantumkeeper keeper_;
};

/// Base of the CPUs of the DSDPV1: DriverCpu, SpiDriverCpu and UartDriverCpu.
class ProgramCpu : public CpuThread {
 public:
  /// Its fall is reported to the driver (dsdpv1_on_intr0). If unbound, dsdpv1_exchange_result shows it.
  sc_core::sc_port<sc_core::sc_signal_in_if<bool>, 1, sc_core::SC_ZERO_OR_MORE_BOUND> INTR0{"INTR0"};

  /// Opened without a judge: every configuration is accepted. To supply one, open it again with the CPU's `port` and
  /// your judge (dsdpv1_open, dsdpv1_open_spi, dsdpv1_open_uart).
  dsdpv1_device& device() { return device_; }
  /// Waits until INTR0 falls, unless it has fallen since the last call; false if `at_most` passes without a fall.
  bool wait_for_intr0(const sc_core::sc_time& at_most);

 protected:
  ProgramCpu(const sc_core::sc_module_name& name, std::function<void()> program, DriverCpuOptions options);

 private:
  void intr0_changed();

  dsdpv1_device device_;
  sc_core::sc_event intr0_event_{"intr0_event"};
  bool intr0_fell_ = false;
};

/// Transactions of one byte each, sent by a CPU's thread.
class ByteAccesses {
 public:
  explicit ByteAccesses(CpuThread& cpu);
  /// The byte read; 0xFF, and the warning /dsdpv1/driver_cpu, if the target refuses the access.
  template <class Socket>
  std::uint8_t read(Socket& socket, std::uint16_t address) {
    return access(*socket.operator->(), tlm::TLM_READ_COMMAND, address, 0xFF);
  }
  /// The warning as for read().
  template <class Socket>
  void write(Socket& socket, std::uint16_t address, std::uint8_t value) {
    access(*socket.operator->(), tlm::TLM_WRITE_COMMAND, address, value);
  }
  std::uint64_t count() const { return count_; }
  /// Those that ended ahead of simulation time (temporal decoupling).
  std::uint64_t ahead() const { return ahead_; }

 private:
  std::uint8_t access(tlm::tlm_fw_transport_if<>& target, tlm::tlm_command command, std::uint16_t address,
                      std::uint8_t value);
  void report_failure() const;

  CpuThread& cpu_;
  tlm::tlm_generic_payload payload_;
  std::uint64_t count_ = 0, ahead_ = 0;
};

}  // namespace dsdpv1::systemc
