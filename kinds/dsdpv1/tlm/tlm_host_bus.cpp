#include "kinds/dsdpv1/tlm/tlm_host_bus.hpp"

#include "model/systemc/has_process.hpp"
#include "model/systemc/sim_time.hpp"

namespace dsdpv1::user_cpu {

TlmHostBus::TlmHostBus(const sc_core::sc_module_name& name, systemc_bench::TlmChip& chip)
    : sc_module(name), chip_(chip) {
  payload_.set_extension(timing_);
  payload_.set_data_length(1);
  payload_.set_streaming_width(1);
  socket_.bind(chip.module().host_socket);
  if (chip.rsu() != nullptr) serial_.emplace("serial", *chip.rsu());
  DSDPV1_HAS_PROCESS(TlmHostBus);
  SC_THREAD(initiate);
  initiator_ = sc_core::sc_get_current_process_handle();
}

void TlmHostBus::reset() {
  state_ = State::kIdle;
  start_.cancel();
  chip_.set_r_req(false);
  chip_.set_r_sta(false);
  if (serial_) serial_->reset();
  if (!sc_core::sc_is_running()) return;
  initiator_.reset();
  chip_.module().release_host_pins();
}

std::unique_ptr<SpiMaster> TlmHostBus::make_spi_master(const SpiTiming& timing) {
  return serial_ ? serial_->make_spi_master(timing) : HostBus::make_spi_master(timing);
}

std::unique_ptr<UartSender> TlmHostBus::make_uart_sender(const UartTiming& timing) {
  return serial_ ? serial_->make_uart_sender(timing) : HostBus::make_uart_sender(timing);
}

void TlmHostBus::set_r_req(Tick at, bool level) {
  if (on_handshake) on_handshake(at, "R_REQ", level);
  chip_.set_r_req(level);
}

void TlmHostBus::set_r_sta(Tick at, bool level) {
  if (on_handshake) on_handshake(at, "R_STA", level);
  chip_.set_r_sta(level);
}

bool TlmHostBus::l_req(Tick at) { return is_high(at, dsdpv1::Pin::kLReq); }

bool TlmHostBus::l_sta(Tick at) { return is_high(at, dsdpv1::Pin::kLSta); }

bool TlmHostBus::intr0(Tick at) { return is_high(at, dsdpv1::Pin::kIntr0); }

unsigned TlmHostBus::lamps(Tick at) {
  const auto bit = [&](dsdpv1::Pin pin) { return static_cast<unsigned>(is_high(at, pin)); };
  return bit(dsdpv1::Pin::kPbf) | bit(dsdpv1::Pin::kBr) << 1U | bit(dsdpv1::Pin::kReady) << 2U;
}

bool TlmHostBus::is_high(Tick at, dsdpv1::Pin pin) {
  chip_.module().sync(dsdpv1::systemc::time_until(at));
  return chip_.module().chip().level(pin) == 1;
}

void TlmHostBus::begin(Tick at, const Access& access, const AccessTiming& timing) {
  access_ = access;
  timing_->timing = timing;
  const dsdpv1::HostAccess& edges = maker_.make(access.write, access.address, access.value, timing);
  begin_ = at;
  end_ = at + edges.duration();
  state_ = State::kBegun;
  if (on_begin) on_begin(at, access, at + edges.sample());
}

Tick TlmHostBus::next_edge() const {
  if (state_ == State::kIdle) return bus::kNever;
  return state_ == State::kBegun ? begin_ : end_;
}

void TlmHostBus::run_edges(Tick until) {
  if (state_ == State::kRunning || (until >= end_ && run_ahead())) {
    state_ = State::kIdle;
    return;
  }
  state_ = State::kRunning;
  start_.notify(dsdpv1::systemc::time_until(begin_));  // at least a delta cycle later
}

bool TlmHostBus::run_ahead() {
  sc_core::sc_time delay = dsdpv1::systemc::time_until(begin_);
  timing_->ahead = true;
  transport(delay);
  timing_->ahead = false;
  return timing_->done;
}

void TlmHostBus::initiate() {
  for (;;) {
    wait(start_);
    sc_core::sc_time delay = sc_core::SC_ZERO_TIME;
    transport(delay);
  }
}

void TlmHostBus::transport(sc_core::sc_time& delay) {
  std::uint8_t byte = access_.write ? access_.value : std::uint8_t{0xFF};
  payload_.set_command(access_.write ? tlm::TLM_WRITE_COMMAND : tlm::TLM_READ_COMMAND);
  payload_.set_address(access_.address);
  payload_.set_data_ptr(&byte);
  payload_.set_response_status(tlm::TLM_INCOMPLETE_RESPONSE);
  socket_->b_transport(payload_, delay);
  if (access_.write) return;
  value_ = byte;
  bad_ = payload_.is_response_error();
}

}  // namespace dsdpv1::user_cpu
