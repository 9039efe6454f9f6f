#pragma once
// In data exchange the user fetches outputs and renews inputs in time (U4, U5).
#include <optional>

#include "bus/monitor/monitor.hpp"
#include "kinds/dsdpv1/checks/check.hpp"
#include "kinds/dsdpv1/checks/user_hold.hpp"
#include "tb/chip/checks/duty.hpp"
#include "tb/chip/checks/own_station.hpp"
#include "tb/chip/checks/recorder.hpp"

namespace dsdpv1::checks {

class FreshData {
 public:
  /// `station` must outlive it.
  FreshData(Recorder& recorder, const OwnStation& station);

  /// RESET is low: no data are exchanged.
  void reset();
  void hold(const UserHold& hold);
  /// A telegram on the line, after the station. True if it acknowledges a request on C1 or C2 for the user.
  bool telegram(const bus::WireTelegram& telegram);
  void finish(Tick end);

 private:
  void exchanged(Tick at, bool outputs, bool inputs);
  void leave();
  void limit(Tick watchdog);
  void pass(Tick now);
  std::optional<Tick> exchanging_at(Tick at) const;
  void met(Duty& duty, Check check, Tick at, const char* what);
  void outputs_in(const UserHold& hold);
  void overwritten_until(Tick at);

  Recorder& recorder_;
  const OwnStation& station_;
  const bool outputs_follow_, inputs_follow_;  ///< the limit is the watchdog's, unless the scenario has one
  std::optional<Tick> exchange_, interval_;    ///< the last executed Data_Exchange, time between the last two
  Duty outputs_, inputs_;
  unsigned overwritten_ = 0;      ///< outputs that came while earlier ones waited
  std::optional<Tick> fetching_;  ///< begin of the last hold that fetched outputs
};

}  // namespace dsdpv1::checks
