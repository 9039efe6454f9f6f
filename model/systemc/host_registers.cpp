#include "model/systemc/host_registers.hpp"

#include <algorithm>

#include "model/profibus/state_frame.hpp"
#include "model/systemc/has_process.hpp"

namespace dsdpv1::systemc {
namespace {

constexpr profibus::StateFrame kRegistersFrame = {0x5248'3156'5044'5344, 1};  // "DSDPV1HR"

constexpr std::uint8_t bit(bool level, std::uint8_t mask) { return level ? mask : std::uint8_t{0}; }

}  // namespace

HostRegisters::HostRegisters(const sc_core::sc_module_name& name, const HostRegistersOptions& options)
    : sc_module(name), options_(options) {
  require_resolution();
  serve(socket);
  serve(socket_64);
  serve(socket_8);
  DSDPV1_HAS_PROCESS(HostRegisters);
  SC_METHOD(intr0_fell);
  dont_initialize();
  sensitive << INTR0.negedge_event();
  SC_METHOD(drive);  // the only process that writes the signals, for all initiators
  dont_initialize();
  sensitive << written_;
}

template <class Socket>
void HostRegisters::serve(Socket& target) {
  target.register_b_transport(this, &HostRegisters::b_transport);
  target.register_transport_dbg(this, &HostRegisters::transport_dbg);
}

void HostRegisters::b_transport(Payload& payload, sc_core::sc_time& delay) {
  payload.set_dmi_allowed(false);
  payload.set_response_status(judge(payload, kSize, options_.base));
  if (!payload.is_response_ok()) return;
  delay += to_time(options_.access);
  wait_for(delay);
  for (unsigned int i = 0; i < payload.get_data_length(); ++i)
    if (is_enabled(payload, i)) access(payload, i);
  if (payload.is_write()) wait(sc_core::SC_ZERO_TIME);  // the signals have their levels
}

unsigned int HostRegisters::transport_dbg(Payload& payload) {
  const sc_dt::uint64 offset = payload.get_address() - options_.base;
  const bool known = payload.get_address() >= options_.base && offset < kSize;
  if (!known || payload.get_data_ptr() == nullptr || payload.get_command() == tlm::TLM_IGNORE_COMMAND) return 0;
  const auto count = static_cast<unsigned int>(std::min<sc_dt::uint64>(payload.get_data_length(), kSize - offset));
  for (unsigned int i = 0; i < count; ++i) access(payload, i);
  return count;
}

void HostRegisters::access(Payload& payload, unsigned int index) {
  unsigned char& byte = payload.get_data_ptr()[index];
  const sc_dt::uint64 offset = payload.get_address() - options_.base + index;
  if (payload.is_write())
    write(offset, byte);
  else
    byte = read(offset);
}

std::uint8_t HostRegisters::read(sc_dt::uint64 offset) const {
  switch (offset) {
    case kRequest: return request_;
    case kState:
      return static_cast<std::uint8_t>(bit(L_REQ.read(), kLReq) | bit(L_STA.read(), kLSta) | bit(INTR0.read(), kIntr0));
    case kInterrupt: return bit(interrupt_, 1);
    case kReset: return reset_;
    default: return 0;
  }
}

void HostRegisters::write(sc_dt::uint64 offset, std::uint8_t value) {
  switch (offset) {
    case kRequest: request_ = value & (kReq | kSta); break;
    case kInterrupt: interrupt_ = interrupt_ && (value & 1U) == 0; break;
    case kReset: reset_ = value & 1U; break;
    default: return;
  }
  written_.notify();
}

std::vector<std::uint8_t> HostRegisters::save() {
  profibus::StateWriter writer;
  profibus::begin_frame(writer, kRegistersFrame);
  store(writer);
  return profibus::end_frame(writer.take());
}

void HostRegisters::restore(const std::vector<std::uint8_t>& state) {
  profibus::StateReader reader = profibus::open_frame(state.data(), state.size(), kRegistersFrame);
  store(reader);
  profibus::check_frame(reader);
  written_.notify();
}

void HostRegisters::intr0_fell() {
  interrupt_ = true;
  written_.notify();
}

void HostRegisters::drive() {
  R_REQ.write((request_ & kReq) != 0);
  R_STA.write((request_ & kSta) != 0);
  RESET.write(reset_ != 0);
  IRQ.write(interrupt_);
}

}  // namespace dsdpv1::systemc
