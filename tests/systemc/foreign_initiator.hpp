#pragma once
// An initiator that knows nothing of this project but the socket, the wires and tlm_quantumkeeper: a hold of the DPRAM
// after the other, forty writes in each.
#include <gtest/gtest.h>
#include <tlm_utils/simple_initiator_socket.h>
#include <tlm_utils/tlm_quantumkeeper.h>

#include <cstdint>
#include <stdexcept>
#include <systemc>

#include "model/systemc/sim_time.hpp"
#include "tests/systemc/bench.hpp"

namespace dsdpv1 {

class ForeignInitiator : public sc_core::sc_module {
 public:
  static constexpr int kHolds = 10, kWrites = 40;

  tlm_utils::simple_initiator_socket<ForeignInitiator> socket{"socket"};
  sc_core::sc_out<bool> R_REQ{"R_REQ"}, R_STA{"R_STA"};
  // Its mistakes.
  bool forgets_to_synchronise = false, begins_without_a_hold = false, fails = false;
  Tick asks = 3 * kUs;  ///< from R_REQ to R_STA; the chip's longest access without work
  Tick stays = kUs;     ///< from R_STA to the first write
  bool reads = false;   ///< each second cell, after the writes
  int accesses = 0, ahead = 0, thrown = 0;

  explicit ForeignInitiator(const sc_core::sc_module_name& name) : sc_module(name) {
    SC_HAS_PROCESS(ForeignInitiator);
    SC_THREAD(run);
    process_ = sc_core::sc_get_current_process_handle();
  }
  void kill() { process_.kill(); }

 private:
  void run() {
    wait(systemc::to_time(100 * kUs));
    keeper_.reset();
    if (begins_without_a_hold) violate();
    for (int hold = 0; hold < kHolds; ++hold) {
      R_REQ.write(true);
      pass(asks);
      R_STA.write(true);
      pass(stays);
      for (int i = 0; i < kWrites; ++i)
        access(tlm::TLM_WRITE_COMMAND, address_of(i), static_cast<std::uint8_t>(hold + i));
      for (int i = 0; reads && i < kWrites; i += 2) access(tlm::TLM_READ_COMMAND, address_of(i), 0);
      if (!forgets_to_synchronise) keeper_.sync();
      R_STA.write(false);
      R_REQ.write(false);
      pass(5 * kUs);
    }
  }
  static std::uint16_t address_of(int cell) { return static_cast<std::uint16_t>(0x130 + cell); }
  void violate() {
    try {
      access(tlm::TLM_WRITE_COMMAND, address_of(0), 0);
    } catch (const sc_core::sc_report&) {
      ++thrown;
    }
  }
  void pass(Tick ticks) {
    keeper_.inc(systemc::to_time(ticks));
    keeper_.sync();
  }
  void access(tlm::tlm_command command, std::uint16_t address, std::uint8_t value) {
    tlm::tlm_generic_payload payload;
    payload.set_command(command);
    payload.set_address(address);
    payload.set_data_ptr(&value);
    payload.set_data_length(1);
    payload.set_streaming_width(1);
    const sc_core::sc_time before = sc_core::sc_time_stamp();
    sc_core::sc_time delay = keeper_.get_local_time();
    try {
      socket->b_transport(payload, delay);
    } catch (const std::runtime_error&) {  // of a listener
      ++thrown;
    }
    if (!fails) EXPECT_EQ(payload.get_response_status(), tlm::TLM_OK_RESPONSE);
    ++accesses;
    ahead += sc_core::sc_time_stamp() == before ? 1 : 0;
    keeper_.set(delay);
    if (keeper_.need_sync()) keeper_.sync();
  }

  sc_core::sc_process_handle process_;
  tlm_utils::tlm_quantumkeeper keeper_;
};

}  // namespace dsdpv1
