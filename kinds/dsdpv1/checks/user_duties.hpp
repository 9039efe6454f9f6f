#pragma once
// What the user owes to chip and master, over any host port: its holds, summed up, and the rules about them.
#include "bus/monitor/monitor.hpp"
#include "kinds/dsdpv1/checks/fresh_data.hpp"
#include "kinds/dsdpv1/checks/refusals.hpp"
#include "kinds/dsdpv1/checks/request_answers.hpp"
#include "kinds/dsdpv1/checks/served_blocks.hpp"
#include "kinds/dsdpv1/checks/start_order.hpp"
#include "kinds/dsdpv1/checks/user_hold.hpp"
#include "tb/chip/checks/own_station.hpp"
#include "tb/chip/checks/recorder.hpp"

namespace dsdpv1::checks {

class UserDuties {
 public:
  /// `station` must outlive it.
  UserDuties(Recorder& recorder, const OwnStation& station)
      : start_(recorder), served_(recorder), fresh_(recorder, station), answers_(recorder), refusals_(recorder) {}

  /// RESET is low.
  void reset();
  void intr0(Tick at, bool level) {
    if (level) return;
    served_.intr0_fell(at);
    refusals_.intr0_fell();
  }
  /// A telegram on the line, at `now`.
  void telegram(Tick now, const bus::WireTelegram& telegram);
  /// An event of the chip.
  void event(const profibus::Event& event, Refusals::Port port) {
    answers_.event(event, port != Refusals::Port::kUart);
    refusals_.event(event, port);
  }
  void finish(Tick end);
  /// The chip tells its events, so that USER_REFUSED can be judged.
  bool judges_refusals() const { return refusals_.judges(); }

  // A hold of the parallel port, by B014, or of one telegram.
  void hold_began(Tick at) { holds_.began(at); }
  void accessed(const Access& access) {
    start_.accessed(access);
    holds_.accessed(access);
  }
  /// The chip clears or sets a flag as part of the user's telegram.
  void taken(Address command, std::uint8_t flag) { holds_.taken(command, flag); }
  void announced(Address command, std::uint8_t flag) { holds_.announced(command, flag); }
  void told_news() { holds_.told_news(); }
  void hold_ended(Tick at, HoldOf what);

 private:
  UserHolds holds_;
  StartOrder start_;
  ServedBlocks served_;
  FreshData fresh_;
  RequestAnswers answers_;
  Refusals refusals_;
};

}  // namespace dsdpv1::checks
