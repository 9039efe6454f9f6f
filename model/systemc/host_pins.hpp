#pragma once
// Converts transactions to pins of the host port: connects a TLM-2.0 user CPU to the PinModule, or to RTL of the chip.
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

/// Every byte of a transaction is one access with the same pin timing as in TlmModule; its time passes inside
/// b_transport.
class HostPins : public sc_core::sc_module {
 public:
  /// DPRAM 0x000..0x7FF, with the responses of TlmModule::host_socket. Each access is a synchronisation point, with any
  /// quantum. An access whose initiator is reset or killed runs to its end. No debug transport, no DMI.
  tlm_utils::simple_target_socket_optional<HostPins> socket{"socket"};
  /// The same for initiators of another BUSWIDTH.
  tlm_utils::simple_target_socket_optional<HostPins, 64> socket_64{"socket_64"};
  tlm_utils::simple_target_socket_optional<HostPins, 8> socket_8{"socket_8"};

  sc_core::sc_out<sc_dt::sc_uint<11>> A{"A"};            ///< 0x7FF between accesses
  sc_core::sc_inout_rv<8> D{"D"};                        ///< Z except for writes
  sc_core::sc_out<bool> CSR{"CSR"}, RD{"RD"}, WR{"WR"};  ///< low-active

  explicit HostPins(const sc_core::sc_module_name& name, const AccessTiming& timing = {});

 private:
  void b_transport(tlm::tlm_generic_payload& payload, sc_core::sc_time& delay);
  bool carry_out(const HostAccess& access);
  void run();
  void move(const HostAccess::Edge& edge);

  AccessTiming timing_;
  sc_core::sc_mutex host_bus_{"host_bus"};  ///< serialises the accesses of several initiators
  HostAccessMaker maker_;
  HostAccess access_;        ///< the running one
  bool busy_ = false;        ///< ... while there is one
  Level sampled_ = kLevelX;  ///< level of D in it
  sc_core::sc_event begin_{"begin"}, end_{"end"};
};

}  // namespace dsdpv1::systemc
