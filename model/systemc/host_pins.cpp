#include "model/systemc/host_pins.hpp"

#include "model/systemc/data_wires.hpp"
#include "model/systemc/has_process.hpp"

namespace dsdpv1::systemc {

HostPins::HostPins(const sc_core::sc_module_name& name, const AccessTiming& timing) : sc_module(name), timing_(timing) {
  require_resolution();
  socket.register_b_transport(this, &HostPins::b_transport);
  socket_64.register_b_transport(this, &HostPins::b_transport);
  socket_8.register_b_transport(this, &HostPins::b_transport);
  A.initialize(HostAccess::kIdleAddress);
  for (sc_core::sc_out<bool>* strobe : {&CSR, &RD, &WR}) strobe->initialize(true);
  DSDPV1_HAS_PROCESS(HostPins);
  SC_THREAD(run);  // the only process that writes the pins, for all initiators
}

void HostPins::b_transport(tlm::tlm_generic_payload& payload, sc_core::sc_time& delay) {
  payload.set_dmi_allowed(false);
  payload.set_response_status(ahead_of(payload) != nullptr ? tlm::TLM_GENERIC_ERROR_RESPONSE
                                                           : judge(payload, kDpramSize));
  if (!payload.is_response_ok()) return;
  wait_for(delay);
  const sc_core::sc_scoped_lock turn(host_bus_);
  for (unsigned int i = 0; i < payload.get_data_length() && payload.is_response_ok(); ++i) {
    if (!is_enabled(payload, i)) continue;
    unsigned char& byte = payload.get_data_ptr()[i];
    const auto address = static_cast<std::uint16_t>(payload.get_address() + i);
    if (!carry_out(maker_.make(payload.is_write(), address, byte, timing_of(payload, timing_))))
      payload.set_response_status(tlm::TLM_GENERIC_ERROR_RESPONSE);
    else if (payload.is_read())
      byte = static_cast<unsigned char>(sampled_);
  }
}

/// Returns false if a read found no certain level at D, or a write violates table 15.
bool HostPins::carry_out(const HostAccess& access) {
  while (busy_) wait(end_);  // the access of a killed initiator is still running
  access_ = access;
  busy_ = true;
  begin_.notify(sc_core::SC_ZERO_TIME);
  while (busy_) wait(end_);
  return access_.is_right() && (access_.is_write() || sampled_ >= 0);
}

void HostPins::run() {
  D.write(wires(kLevelZ));
  for (;;) {
    wait(begin_);
    const Tick start = current_tick();
    sampled_ = kLevelX;
    for (const HostAccess::Edge& edge : access_) {
      if (const sc_core::sc_time rest = time_until(start + edge.at); rest > sc_core::SC_ZERO_TIME) wait(rest);
      move(edge);
    }
    wait(time_until(start + access_.duration()));
    busy_ = false;
    end_.notify(sc_core::SC_ZERO_TIME);
  }
}

void HostPins::move(const HostAccess::Edge& edge) {
  switch (edge.pin) {
    case Pin::kA: A.write(static_cast<unsigned int>(edge.level)); break;
    case Pin::kCsr: CSR.write(edge.level != 0); break;
    case Pin::kRd: RD.write(edge.level != 0); break;
    case Pin::kWr: WR.write(edge.level != 0); break;
    case Pin::kDIn: D.write(wires(edge.level)); break;
    default:
      wait(sc_core::SC_ZERO_TIME);  // then the chip's change of D at this tick is visible
      sampled_ = level_of(D.read());
  }
}

}  // namespace dsdpv1::systemc
