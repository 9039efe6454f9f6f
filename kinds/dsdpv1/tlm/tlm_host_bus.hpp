#pragma once
// The HostBus on the TLM socket of a chip in SystemC.
#include <tlm_utils/simple_initiator_socket.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <systemc>

#include "kinds/dsdpv1/tlm/tlm_chip.hpp"
#include "kinds/dsdpv1/tlm/tlm_serial.hpp"
#include "kinds/user_cpu/host_bus.hpp"

namespace dsdpv1::user_cpu {

/// An access is one transaction with two edges: the first begins it, the second has its result. If no other agent has a
/// turn between them, it is executed ahead of simulation time, in the timeline's thread; otherwise by a separate
/// thread, so that the timeline continues meanwhile. The module moves the same pins at the same ticks as PinHostBus
/// does.
class TlmHostBus : public sc_core::sc_module, public HostBus {
 public:
  TlmHostBus(const sc_core::sc_module_name& name, systemc_bench::TlmChip& chip);

  /// Called at the begin of an access; a read samples D at `sample`.
  std::function<void(Tick at, const Access& access, Tick sample)> on_begin;
  /// As HostBus::looked.
  std::function<void(const Looks& last)> on_looked;
  /// Called when R_REQ or R_STA changes.
  std::function<void(Tick at, const char* pin, bool level)> on_handshake;

  /// The user CPU is reset: drops an access, frame or telegram in progress and releases the pins. From a SystemC
  /// process.
  void reset();

  std::unique_ptr<SpiMaster> make_spi_master(const SpiTiming& timing) override;
  std::unique_ptr<UartSender> make_uart_sender(const UartTiming& timing) override;
  void set_r_req(Tick at, bool level) override;
  void set_r_sta(Tick at, bool level) override;
  bool l_req(Tick at) override;
  bool l_sta(Tick at) override;
  void looked(const Looks& last) override {
    if (on_looked) on_looked(last);
  }
  bool intr0(Tick at) override;
  unsigned lamps(Tick at) override;
  void begin(Tick at, const Access& access, const AccessTiming& timing) override;
  Tick next_edge() const override;
  void run_edges(Tick until) override;
  Tick end() const override { return end_; }
  std::uint8_t read_value() const override { return value_; }
  bool last_read_was_bad() const override { return bad_; }

 private:
  enum class State : std::uint8_t { kIdle, kBegun, kRunning };

  void initiate();
  bool run_ahead();
  void transport(sc_core::sc_time& delay);
  bool is_high(Tick at, dsdpv1::Pin pin);

  systemc_bench::TlmChip& chip_;
  std::optional<TlmSerialPorts> serial_;  ///< for a DSDPV1-RSU
  tlm_utils::simple_initiator_socket<TlmHostBus> socket_{"socket"};
  sc_core::sc_process_handle initiator_;
  sc_core::sc_event start_{"start"};
  Access access_;
  tlm::tlm_generic_payload payload_;
  dsdpv1::systemc::AccessTimingExtension* timing_ = new dsdpv1::systemc::AccessTimingExtension;  ///< owned by payload_
  dsdpv1::HostAccessMaker maker_;
  State state_ = State::kIdle;
  Tick begin_ = 0, end_ = 0;
  std::uint8_t value_ = 0xFF;
  bool bad_ = false;
};

}  // namespace dsdpv1::user_cpu
