#pragma once
// The station to which the pins belong, as the telegrams on the line show it. Its address is learnt from its answers:
// while the chip drives the line (RTS) no other station does.
#include <cstdint>
#include <optional>

#include "bus/monitor/monitor.hpp"

namespace dsdpv1::checks {

using bus::Tick;

class OwnStation {
 public:
  /// RESET is active: the address must be learnt again.
  void reset();
  /// The chip begins or ends to drive the line.
  void drives(Tick at, bool on);
  /// Any telegram on the line, before the questions below about it.
  void telegram(const bus::WireTelegram& telegram);

  /// A request to this station without a fault.
  bool is_asked(const bus::WireTelegram& telegram) const;
  /// ... a Data_Exchange.
  bool is_exchange(const bus::WireTelegram& telegram) const;
  /// The request that the last telegram has answered, if it was not a repetition, which is not executed (S26); else
  /// null.
  const bus::WireTelegram* answered() const { return answered_ ? &request_ : nullptr; }

 private:
  bool is_framed(const bus::WireTelegram& telegram) const;
  bool answers(const bus::WireTelegram& telegram) const;

  std::optional<std::uint8_t> address_;
  bool driving_ = false;
  Tick began_ = 0, ended_ = 0;
  bus::WireTelegram request_;  ///< the last new one; without bytes: none
  bool open_ = false;          ///< it has not been answered yet
  bool answered_ = false;
};

}  // namespace dsdpv1::checks
