#pragma once
// The telegrams of a host on SPI or the UART as accesses to cells, as the parallel port has them.
#include "kinds/dsdpv1/checks/host_telegram.hpp"
#include "kinds/dsdpv1/checks/user_duties.hpp"

namespace dsdpv1::checks {

class SerialAccesses {
 public:
  /// `duties` must outlive it.
  explicit SerialAccesses(UserDuties& duties) : duties_(duties) {}

  /// RESET is low.
  void reset() { owned_ = false; }
  /// The host owns the DPRAM by B014 from `at` on; no longer.
  void claimed(Tick at);
  void released(Tick at);
  /// A request whose last bit came at `asked`, and its complete reply.
  void replied(const HostTelegram& request, const HostReply& reply, Tick asked, Tick at);

 private:
  void carry_out(const HostTelegram& request, const HostReply& reply);
  void access(bool write, unsigned first, const std::uint8_t* bytes, unsigned count);
  void read_and_write(const bus::Bytes& reply);
  void exchange(const HostTelegram& request, const bus::Bytes& reply);

  UserDuties& duties_;
  bool owned_ = false;
  Tick asked_ = 0, at_ = 0;  ///< of the present telegram
};

}  // namespace dsdpv1::checks
