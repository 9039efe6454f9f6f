#pragma once
// An initiator at the socket of a chip of the SPC3 family.
#include <tlm_utils/simple_initiator_socket.h>

#include <cstdint>
#include <systemc>
#include <utility>
#include <vector>

#include "model/systemc/spc3_tlm.hpp"
#include "tests/systemc/bench.hpp"

namespace dsdpv1 {

namespace regs = spc3::regs;
using sc_core::sc_time;
using sc_core::SC_ZERO_TIME;
using systemc::current_tick;
using systemc::Spc3TlmModule;
using systemc::to_tick;
using systemc::to_time;

constexpr Tick kAccess = 2000;  ///< the default

struct Outcome {
  tlm::tlm_response_status response = tlm::TLM_INCOMPLETE_RESPONSE;
  Tick took = 0, delay_left = 0;
  std::vector<std::uint8_t> data;
};

/// An initiator; its methods block, so they belong to a thread.
struct Initiator : sc_core::sc_module {
  tlm_utils::simple_initiator_socket<Initiator> socket{"socket"};
  tlm::tlm_generic_payload payload;
  explicit Initiator(const sc_core::sc_module_name& name) : sc_module(name) {}

  Outcome send(tlm::tlm_command command, sc_dt::uint64 address, std::vector<std::uint8_t> data,
               sc_time delay = SC_ZERO_TIME) {
    payload.set_command(command);
    payload.set_address(address);
    payload.set_data_ptr(data.empty() ? nullptr : data.data());
    payload.set_data_length(static_cast<unsigned>(data.size()));
    if (!keep_width) payload.set_streaming_width(static_cast<unsigned>(data.size()));
    const Tick begin = current_tick();
    socket->b_transport(payload, delay);
    return {payload.get_response_status(), current_tick() - begin, to_tick(delay), data};
  }
  Outcome write(sc_dt::uint64 address, std::vector<std::uint8_t> data, const sc_time& delay = SC_ZERO_TIME) {
    return send(tlm::TLM_WRITE_COMMAND, address, std::move(data), delay);
  }
  Outcome read(sc_dt::uint64 address, std::size_t count, const sc_time& delay = SC_ZERO_TIME) {
    return send(tlm::TLM_READ_COMMAND, address, std::vector<std::uint8_t>(count, 0xEE), delay);
  }
  bool keep_width = false;
};

}  // namespace dsdpv1
