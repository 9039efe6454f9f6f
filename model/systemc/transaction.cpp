#include "model/systemc/transaction.hpp"

#include <string>
#include <systemc>

namespace dsdpv1::systemc {
namespace {

bool enables_are_valid(const tlm::tlm_generic_payload& payload) {
  const unsigned char* enables = payload.get_byte_enable_ptr();
  if (enables == nullptr) return true;
  const unsigned int length = payload.get_byte_enable_length();
  return length > 0 && std::all_of(enables, enables + length, [](unsigned char enable) {
           return enable == TLM_BYTE_ENABLED || enable == TLM_BYTE_DISABLED;
         });
}

}  // namespace

bool is_enabled(const tlm::tlm_generic_payload& payload, unsigned int index) {
  const unsigned char* enables = payload.get_byte_enable_ptr();
  return enables == nullptr || enables[index % payload.get_byte_enable_length()] == TLM_BYTE_ENABLED;
}

tlm::tlm_response_status judge(const tlm::tlm_generic_payload& payload, sc_dt::uint64 size, sc_dt::uint64 first) {
  const unsigned int length = payload.get_data_length();
  if (!payload.is_read() && !payload.is_write()) return tlm::TLM_COMMAND_ERROR_RESPONSE;
  if (length == 0 || payload.get_streaming_width() < length) return tlm::TLM_BURST_ERROR_RESPONSE;
  const sc_dt::uint64 offset = payload.get_address() - first;
  if (payload.get_address() < first || offset >= size || length > size - offset) return tlm::TLM_ADDRESS_ERROR_RESPONSE;
  if (!enables_are_valid(payload)) return tlm::TLM_BYTE_ENABLE_ERROR_RESPONSE;
  return payload.get_data_ptr() != nullptr ? tlm::TLM_OK_RESPONSE : tlm::TLM_GENERIC_ERROR_RESPONSE;
}

void report_unbound(const char* socket, const char* why) {
  SC_REPORT_ERROR("/dsdpv1/binding", (std::string(socket) + " is not bound, and " + why).c_str());
}

void wait_for(sc_core::sc_time& delay) {
  if (delay != sc_core::SC_ZERO_TIME) sc_core::wait(delay);
  delay = sc_core::SC_ZERO_TIME;
}

}  // namespace dsdpv1::systemc
