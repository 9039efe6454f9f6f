#pragma once
// A user CPU for SystemC platforms: a thread that runs a program with the portable C driver. The driver's port is this
// module's socket and pins.
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
#include <tlm_utils/tlm_quantumkeeper.h>

#include <cstdint>
#include <functional>
#include <systemc>

#include "driver/dsdpv1.h"

namespace dsdpv1::systemc {

/// How fast the CPU is. The defaults are about those of a Cortex-M3 at 72 MHz.
struct DriverCpuOptions {
  sc_core::sc_time pin_read{17.5, sc_core::SC_NS};  ///< looking at L_REQ or L_STA
  sc_core::sc_time pin_write{14, sc_core::SC_NS};   ///< moving R_REQ, R_STA or RESET
  sc_core::sc_time overhead{83.5, sc_core::SC_NS};  ///< instructions between two accesses
};

/// The thread is a loosely-timed initiator with a tlm_quantumkeeper. It synchronises, that is, waits for its local
/// time, before it moves a pin and before it looks at one, and whenever the quantum is over. With a global quantum of
/// zero it always does.
class DriverCpu : public sc_core::sc_module {
 public:
  using Program = std::function<void(DriverCpu&)>;

  /// Accesses of one byte, at the addresses of the DPRAM: 0x000..0x7FF.
  tlm_utils::simple_initiator_socket<DriverCpu> socket{"socket"};
  sc_core::sc_out<bool> R_REQ{"R_REQ"}, R_STA{"R_STA"};
  sc_core::sc_in<bool> L_REQ{"L_REQ"}, L_STA{"L_STA"};
  /// Low until `set_reset`. May stay unbound.
  sc_core::sc_port<sc_core::sc_signal_inout_if<bool>, 1, sc_core::SC_ZERO_OR_MORE_BOUND> RESET{"RESET"};
  /// A fall is told to the driver (dsdpv1_on_intr0). May stay unbound: then it shows by dsdpv1_exchange_result.
  sc_core::sc_port<sc_core::sc_signal_in_if<bool>, 1, sc_core::SC_ZERO_OR_MORE_BOUND> INTR0{"INTR0"};

  /// `program` begins at time 0, with all pins low; when it returns, the CPU does nothing any more.
  DriverCpu(const sc_core::sc_module_name& name, Program program, DriverCpuOptions options = {});

  // What follows is for the program, in its thread.

  /// Open, and without a judge: every configuration is accepted. Who judges opens it again with `port` and a judge of
  /// their own (dsdpv1_open).
  dsdpv1_device& device() { return device_; }
  const dsdpv1_port& port() const { return port_; }

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

  std::uint64_t accesses() const { return accesses_; }
  /// Of these those that were over before simulation time was there (temporal decoupling).
  std::uint64_t accesses_ahead() const { return accesses_ahead_; }

 private:
  void run();
  void intr0_changed();
  dsdpv1_port make_port();
  void set_pin(sc_core::sc_signal_inout_if<bool>& pin, bool level);
  bool get_pin(const sc_core::sc_in<bool>& pin);
  std::uint8_t access(tlm::tlm_command command, std::uint16_t address, std::uint8_t value);
  void report_failed_access() const;

  Program program_;
  DriverCpuOptions options_;
  dsdpv1_port port_;
  dsdpv1_device device_;
  tlm::tlm_generic_payload payload_;
  tlm_utils::tlm_quantumkeeper keeper_;
  sc_core::sc_event intr0_event_{"intr0_event"};
  bool intr0_fell_ = false;
  std::uint64_t accesses_ = 0, accesses_ahead_ = 0;
};

}  // namespace dsdpv1::systemc
