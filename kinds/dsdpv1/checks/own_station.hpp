#pragma once
// The station to which the pins belong, as the telegrams on the line show it. Its address is learnt from its answers:
// while PBRTS is high only the chip drives the line.
#include <cstdint>
#include <optional>

#include "bus/monitor/monitor.hpp"

namespace dsdpv1::checks {

using bus::Tick;

class OwnStation {
 public:
  /// RESET is low: the address must be learnt again.
  void reset();
  void pbrts(Tick at, bool level);
  /// Any telegram on the line, before the questions below about it.
  void telegram(const bus::WireTelegram& telegram);

  /// A request to this station without a fault.
  bool is_asked(const bus::WireTelegram& telegram) const;
  /// ... a Data_Exchange.
  bool is_exchange(const bus::WireTelegram& telegram) const;
  /// An answer of this station without a fault.
  bool answers(const bus::WireTelegram& telegram) const;

 private:
  bool is_framed(const bus::WireTelegram& telegram) const;

  std::optional<std::uint8_t> address_;
  bool sending_ = false;
  Tick pbrts_rose_ = 0, pbrts_fell_ = 0;
};

}  // namespace dsdpv1::checks
