#pragma once
// The user CPU's controllers on the sockets of a DSDPV1-RSU's serial ports in SystemC.
#include <tlm_utils/simple_initiator_socket.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <systemc>
#include <vector>

#include "kinds/dsdpv1/user_cpu/uart_master.hpp"
#include "kinds/user_cpu/spi_master.hpp"
#include "model/systemc/has_process.hpp"
#include "model/systemc/rsu_tlm.hpp"

namespace dsdpv1::user_cpu {

/// A thread with a socket that executes transactions in sequence, so that the timeline continues meanwhile.
template <class Extension>
class TlmSender : public sc_core::sc_module {
 public:
  explicit TlmSender(const sc_core::sc_module_name& name) : sc_module(name) {
    payload_.set_extension(extension_);
    DSDPV1_HAS_PROCESS(TlmSender);
    SC_THREAD(run);
    thread_ = sc_core::sc_get_current_process_handle();
  }
  tlm_utils::simple_initiator_socket<TlmSender> socket{"socket"};

  /// The transaction begins at `at`, not before the present time; `extension` has its options. From the timeline's
  /// thread.
  void begin(Tick at, tlm::tlm_command command, std::vector<std::uint8_t> bytes, const Extension& extension);
  const std::vector<std::uint8_t>& bytes() const { return bytes_; }
  /// Drops a transaction in progress; the pins idle. From a SystemC process.
  void reset();

 private:
  void run();

  std::vector<std::uint8_t> bytes_;
  tlm::tlm_generic_payload payload_;
  Extension* extension_ = new Extension;  ///< owned by payload_
  sc_core::sc_process_handle thread_;
  sc_core::sc_event start_{"start"};
};

/// A transfer by one transaction: one action begins it, at the next it is complete.
template <class Base>
class TlmTransfer : public Base {
 public:
  using Base::Base;
  Tick next() const override { return state_ == State::kBegun ? begin_ : this->done() ? bus::kNever : end_; }
  void run(Tick /*now*/) override {
    if (state_ == State::kBegun) start(begin_);
    state_ = state_ == State::kBegun ? State::kRunning : State::kDone;
  }
  bool done() const override { return state_ == State::kDone; }

 protected:
  void set_times(Tick begin, Tick duration) {
    begin_ = begin;
    end_ = begin + duration;
    state_ = State::kBegun;
  }

 private:
  enum class State : std::uint8_t { kBegun, kRunning, kDone };
  virtual void start(Tick at) = 0;

  State state_ = State::kDone;
  Tick begin_ = 0, end_ = 0;
};

/// Both ports of a chip.
class TlmSerialPorts : public sc_core::sc_module {
 public:
  TlmSerialPorts(const sc_core::sc_module_name& name, dsdpv1::systemc::RsuTlmModule& chip);

  std::unique_ptr<SpiMaster> make_spi_master(const SpiTiming& timing);
  std::unique_ptr<UartSender> make_uart_sender(const UartTiming& timing);
  /// As TlmSender.
  void reset();

 private:
  TlmSender<dsdpv1::systemc::SpiFrameExtension> spi_{"spi"};
  TlmSender<dsdpv1::systemc::UartTelegramExtension> uart_{"uart"};
};

}  // namespace dsdpv1::user_cpu
