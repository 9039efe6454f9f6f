#include "tb/dsdpv1/systemc/tlm_host_bus.hpp"

#include "model/systemc/sim_time.hpp"

namespace user_cpu {

TlmHostBus::TlmHostBus(const sc_core::sc_module_name& name, systemc_bench::TlmChip& chip)
    : sc_module(name), chip_(chip) {
  payload_.set_extension(timing_);
  payload_.set_data_length(1);
  payload_.set_streaming_width(1);
  socket_.bind(chip.module().host_socket);
  SC_HAS_PROCESS(TlmHostBus);
  SC_THREAD(initiate);
  initiator_ = sc_core::sc_get_current_process_handle();
}

void TlmHostBus::reset() {
  running_ = false;
  start_.cancel();
  chip_.set_r_req(false);
  chip_.set_r_sta(false);
  if (sc_core::sc_is_running()) initiator_.reset();
}

void TlmHostBus::set_r_req(Tick at, bool level) {
  if (on_handshake) on_handshake(at, "R_REQ", level);
  chip_.set_r_req(level);
}

void TlmHostBus::set_r_sta(Tick at, bool level) {
  if (on_handshake) on_handshake(at, "R_STA", level);
  chip_.set_r_sta(level);
}

bool TlmHostBus::l_req(Tick /*at*/) { return is_high(dsdpv1::Pin::kLReq); }

bool TlmHostBus::l_sta(Tick /*at*/) { return is_high(dsdpv1::Pin::kLSta); }

bool TlmHostBus::intr0(Tick /*at*/) { return is_high(dsdpv1::Pin::kIntr0); }

unsigned TlmHostBus::lamps(Tick /*at*/) {
  const auto bit = [this](dsdpv1::Pin pin) { return static_cast<unsigned>(is_high(pin)); };
  return bit(dsdpv1::Pin::kPbf) | bit(dsdpv1::Pin::kBr) << 1U | bit(dsdpv1::Pin::kReady) << 2U;
}

bool TlmHostBus::is_high(dsdpv1::Pin pin) {
  chip_.module().sync();
  return chip_.module().chip().level(pin) == 1;
}

void TlmHostBus::begin(Tick at, const Access& access, const AccessTiming& timing) {
  access_ = access;
  timing_->timing = timing;
  const dsdpv1::HostAccess& edges = maker_.make(access.write, access.address, access.value, timing);
  end_ = at + edges.duration();
  if (on_begin) on_begin(at, access, at + edges.sample());
  running_ = true;
  const Tick now = dsdpv1::systemc::current_tick();
  if (at > now)
    start_.notify(dsdpv1::systemc::to_time(at) - sc_core::sc_time_stamp());
  else
    start_.notify(sc_core::SC_ZERO_TIME);  // after the handshake pins that were set just now
}

void TlmHostBus::run_edges(Tick /*now*/) { running_ = false; }

void TlmHostBus::initiate() {
  for (;;) {
    wait(start_);
    sc_core::sc_time delay = sc_core::SC_ZERO_TIME;
    std::uint8_t byte = access_.write ? access_.value : std::uint8_t{0xFF};
    payload_.set_command(access_.write ? tlm::TLM_WRITE_COMMAND : tlm::TLM_READ_COMMAND);
    payload_.set_address(access_.address);
    payload_.set_data_ptr(&byte);
    socket_->b_transport(payload_, delay);
    if (!access_.write) {
      value_ = byte;
      bad_ = payload_.is_response_error();
    }
  }
}

}  // namespace user_cpu
