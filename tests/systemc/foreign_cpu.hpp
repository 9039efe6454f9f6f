#pragma once
// A user CPU as a platform has it: a thread with a tlm_quantumkeeper and one socket, which knows addresses only, and a
// bus that maps them.
#include <tlm_utils/simple_initiator_socket.h>
#include <tlm_utils/simple_target_socket.h>
#include <tlm_utils/tlm_quantumkeeper.h>

#include <cstring>
#include <functional>
#include <utility>

#include "tests/systemc/bench.hpp"

namespace dsdpv1 {

template <unsigned int kWidth = 32>
class ForeignCpu : public sc_core::sc_module {
 public:
  using Program = std::function<void(ForeignCpu&)>;
  tlm_utils::simple_initiator_socket<ForeignCpu, kWidth> socket{"socket"};
  tlm::tlm_response_status response = tlm::TLM_INCOMPLETE_RESPONSE;  ///< of the last transaction
  bool dmi_hint = false;                                             ///< of the last transaction
  int accesses = 0, ahead = 0, withdrawn = 0;

  ForeignCpu(const sc_core::sc_module_name& name, Program program) : sc_module(name), program_(std::move(program)) {
    socket.register_invalidate_direct_mem_ptr(this, &ForeignCpu::invalidate);
    SC_HAS_PROCESS(ForeignCpu);
    SC_THREAD(run);
  }

  void write(sc_dt::uint64 address, std::uint8_t value) { transport(tlm::TLM_WRITE_COMMAND, address, &value, 1); }
  std::uint8_t read(sc_dt::uint64 address) {
    std::uint8_t value = 0xEE;
    transport(tlm::TLM_READ_COMMAND, address, &value, 1);
    return value;
  }
  void transport(tlm::tlm_command command, sc_dt::uint64 address, std::uint8_t* data, unsigned int length) {
    tlm::tlm_generic_payload payload;
    fill(payload, command, address, data, length);
    const sc_core::sc_time before = sc_core::sc_time_stamp();
    sc_core::sc_time delay = keeper_.get_local_time();
    socket->b_transport(payload, delay);
    response = payload.get_response_status();
    dmi_hint = payload.is_dmi_allowed();
    ++accesses;
    ahead += sc_core::sc_time_stamp() == before ? 1 : 0;
    keeper_.set(delay);
    if (keeper_.need_sync()) keeper_.sync();
  }
  bool ask_dmi(tlm::tlm_dmi& dmi) {
    tlm::tlm_generic_payload payload;
    fill(payload, tlm::TLM_READ_COMMAND, 0, nullptr, 0);
    return socket->get_direct_mem_ptr(payload, dmi);
  }
  void pass(Tick ticks) {
    keeper_.inc(systemc::to_time(ticks));
    keeper_.sync();
  }
  sc_core::sc_time now() const { return keeper_.get_current_time(); }

 private:
  static void fill(tlm::tlm_generic_payload& payload, tlm::tlm_command command, sc_dt::uint64 address,
                   std::uint8_t* data, unsigned int length) {
    payload.set_command(command);
    payload.set_address(address);
    payload.set_data_ptr(data);
    payload.set_data_length(length);
    payload.set_streaming_width(length);
  }
  void run() {
    keeper_.reset();
    program_(*this);
  }
  void invalidate(sc_dt::uint64 /*first*/, sc_dt::uint64 /*last*/) { ++withdrawn; }

  Program program_;
  tlm_utils::tlm_quantumkeeper keeper_;
};

/// A bus: addresses below kRegisters go to `chip`, the others to `registers`, as they are.
template <unsigned int kWidth = 32>
struct ForeignBus : sc_core::sc_module {
  static constexpr sc_dt::uint64 kRegisters = 0x1000;
  tlm_utils::simple_target_socket<ForeignBus, kWidth> socket{"socket"};
  tlm_utils::simple_initiator_socket<ForeignBus, kWidth> chip{"chip"}, registers{"registers"};

  explicit ForeignBus(const sc_core::sc_module_name& name) : sc_module(name) {
    socket.register_b_transport(this, &ForeignBus::b_transport);
    socket.register_transport_dbg(this, &ForeignBus::transport_dbg);
    socket.register_get_direct_mem_ptr(this, &ForeignBus::direct_mem_ptr);
    chip.register_invalidate_direct_mem_ptr(this, &ForeignBus::invalidate);
  }

 private:
  auto& target_of(const tlm::tlm_generic_payload& payload) {
    return payload.get_address() < kRegisters ? chip : registers;
  }
  void b_transport(tlm::tlm_generic_payload& payload, sc_core::sc_time& delay) {
    target_of(payload)->b_transport(payload, delay);
  }
  unsigned int transport_dbg(tlm::tlm_generic_payload& payload) { return target_of(payload)->transport_dbg(payload); }
  bool direct_mem_ptr(tlm::tlm_generic_payload& payload, tlm::tlm_dmi& dmi) {
    return target_of(payload)->get_direct_mem_ptr(payload, dmi);
  }
  void invalidate(sc_dt::uint64 first, sc_dt::uint64 last) { socket->invalidate_direct_mem_ptr(first, last); }
};

}  // namespace dsdpv1
