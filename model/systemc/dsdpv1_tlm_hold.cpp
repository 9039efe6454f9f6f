// The TLM module and the ownership of the DPRAM: accesses without it, direct memory access, and how far an initiator
// may run.
#include <algorithm>
#include <cstdio>
#include <string>

#include "model/systemc/dsdpv1_tlm.hpp"

namespace dsdpv1::systemc {
namespace {

sc_core::sc_time latency(const HostAccess& access) { return to_time(access.duration()); }

}  // namespace

// --- accesses without the DPRAM --------------------------------------------------------------------------------------

/// Before an access that begins at access_start_. False: it is refused.
bool TlmModule::may_access(std::uint16_t address) {
  if (ownership_ == Ownership::kReport) return true;
  wait_until(access_start_);
  return holds() || (ownership_ == Ownership::kWait && wait_for_hold(address));
}

bool TlmModule::wait_for_hold(std::uint16_t address) {
  const Tick until = current_tick() + hold_within_;
  for (; !holds() && current_tick() < until; catch_up()) {
    const bool asked = R_REQ.read() && R_STA.read();
    const Tick next = zero() + std::max(chip().next_event(), chip().now() + profibus::kTicksPerCycle);
    plan();
    wait(time_until(asked ? std::min(next, until) : until),
         RESET.value_changed_event() | R_REQ.value_changed_event() | R_STA.value_changed_event());
  }
  plan();
  access_start_ = earliest();
  if (!holds()) report_no_hold(address);
  return holds();
}

void TlmModule::report_no_hold(std::uint16_t address) const {
  const char* why = "the chip does not give it";
  if (!RESET.read())
    why = "RESET is low";
  else if (!R_STA.read())
    why = "R_STA is low";
  if (!R_REQ.read()) why = "R_REQ is low, nobody asks for it";
  char cell[8];
  std::snprintf(cell, sizeof cell, "B%03X", unsigned{address});
  const std::string text = std::string(name()) + ": the access of " + cell + " has waited " +
                           to_time(hold_within_).to_string() + " for the DPRAM: " + why;
  SC_REPORT_WARNING("/dsdpv1/ownership", text.c_str());
}

// --- direct memory access --------------------------------------------------------------------------------------------

bool TlmModule::direct_mem_ptr(Payload& payload, tlm::tlm_dmi& dmi) {
  dmi.init();
  dmi.set_end_address(kDpramSize - 1);
  sync();
  payload.set_dmi_allowed(gives_dmi());
  if (!gives_dmi()) return false;
  dmi_given_ = true;
  dmi.set_dmi_ptr(chip_.direct());
  dmi.allow_read_write();
  dmi.set_read_latency(latency(HostAccess::read(0, timing_)));
  dmi.set_write_latency(latency(HostAccess::write(0, 0, timing_)));
  return true;
}

template <class Socket>
void TlmModule::withdraw_dmi(Socket& socket) {
  if (is_bound(socket)) socket->invalidate_direct_mem_ptr(0, kDpramSize - 1);
}

void TlmModule::end_dmi() {
  dmi_given_ = false;
  withdraw_dmi(host_socket);
  withdraw_dmi(host_socket_64);
  withdraw_dmi(host_socket_8);
}

// --- how far an initiator may run ------------------------------------------------------------------------------------

bool TlmModule::user_holds() {
  sync();
  return holds();
}

sc_core::sc_time TlmModule::ahead_until() {
  return user_holds() && !hears_host() && !in_access() ? sc_core::sc_max_time() : sc_core::sc_time_stamp();
}

sc_core::sc_time TlmModule::next_action() {
  sync();
  const Tick next = std::min({chip().next_seen(), next_of_line(), next_of_host(), from_chip_.next(), next_answered()});
  return next == profibus::kNever ? sc_core::sc_max_time() : to_time(next + zero());
}

}  // namespace dsdpv1::systemc
