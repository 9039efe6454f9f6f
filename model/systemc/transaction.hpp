#pragma once
// Transactions of a user CPU for a socket with the addresses of a chip: requirements for their payloads.
#include <tlm.h>

#include <algorithm>
#include <cstdint>

namespace dsdpv1::systemc {

/// TLM_OK_RESPONSE for a valid transaction at the `size` addresses from `first` on (docs/systemc.md has the others).
tlm::tlm_response_status judge(const tlm::tlm_generic_payload& payload, sc_dt::uint64 size, sc_dt::uint64 first = 0);

/// True if byte `index` of the data is accessed.
bool is_enabled(const tlm::tlm_generic_payload& payload, unsigned int index);

/// The platform's initiators treat the delay returned by b_transport as elapsed time.
inline bool is_decoupled() { return tlm::tlm_global_quantum::instance().get() > sc_core::SC_ZERO_TIME; }

/// Waits until a transaction's annotated delay has passed.
void wait_for(sc_core::sc_time& delay);

/// A target socket that may stay unbound has an initiator.
template <class Socket>
bool is_bound(Socket& socket) {
  return socket.get_base_port().size() > 0;
}
void report_unbound(const char* socket, const char* why);
/// Reports a socket that must be bound, before the simulation.
template <class Socket>
void require_bound(Socket& socket, const char* why) {
  if (!is_bound(socket)) report_unbound(socket.name(), why);
}

/// transport_dbg with the addresses of a module below `size`: the number of bytes.
template <class Module>
unsigned int transport_debug(Module& module, tlm::tlm_generic_payload& payload, sc_dt::uint64 size) {
  const sc_dt::uint64 first = payload.get_address();
  unsigned char* data = payload.get_data_ptr();
  if (first >= size || data == nullptr || payload.get_command() == tlm::TLM_IGNORE_COMMAND) return 0;
  if (sc_core::sc_is_running()) module.sync();
  const auto count = static_cast<unsigned int>(std::min<sc_dt::uint64>(payload.get_data_length(), size - first));
  for (unsigned int i = 0; i < count; ++i) {
    const auto address = static_cast<std::uint16_t>(first + i);
    if (payload.is_write())
      module.poke(address, data[i]);
    else
      data[i] = module.peek(address);
  }
  return count;
}

}  // namespace dsdpv1::systemc
