#pragma once
// From transactions to the pins of the host port: a user CPU of TLM-2.0 at the PinModule, or at RTL of the chip.
//
//   dsdpv1::systemc::HostPins host("host");
//   cpu.socket.bind(host.socket);
//   host.A(a), host.D(d), host.CSR(csr), host.RD(rd), host.WR(wr);     // and the same signals at the chip
#include <tlm_utils/simple_target_socket.h>

#include <cstdint>
#include <systemc>

#include "model/dsdpv1/host_access.hpp"
#include "model/systemc/host_transaction.hpp"
#include "model/systemc/sim_time.hpp"

namespace dsdpv1::systemc {

/// Every byte of a transaction is one access, whose pins move at the ticks at which TlmModule has them; the time passes
/// inside b_transport.
class HostPins : public sc_core::sc_module {
 public:
  /// DPRAM 0x000..0x7FF, with the responses of TlmModule::host_socket. Each access is a synchronisation point, with any
  /// quantum. An initiator that is reset or killed in an access leaves that to its end. No debug transport, no DMI.
  tlm_utils::simple_target_socket<HostPins> socket{"socket"};

  sc_core::sc_out<sc_dt::sc_uint<11>> A{"A"};            ///< 0x7FF between accesses
  sc_core::sc_inout_rv<8> D{"D"};                        ///< Z but for writes
  sc_core::sc_out<bool> CSR{"CSR"}, RD{"RD"}, WR{"WR"};  ///< low-active

  explicit HostPins(const sc_core::sc_module_name& name, const AccessTiming& timing = {});

 private:
  void b_transport(tlm::tlm_generic_payload& payload, sc_core::sc_time& delay);
  bool carry_out(const HostAccess& access);
  void run();
  void move(const HostAccess::Edge& edge);

  AccessTiming timing_;
  sc_core::sc_mutex host_bus_;  ///< accesses of several initiators follow each other
  HostAccessMaker maker_;
  HostAccess access_;        ///< the running one
  bool busy_ = false;        ///< ... while there is one
  Level sampled_ = kLevelX;  ///< what D was in it
  sc_core::sc_event begin_{"begin"}, end_{"end"};
};

}  // namespace dsdpv1::systemc
