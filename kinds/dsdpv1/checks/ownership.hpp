#pragma once
// Ownership of the DPRAM (5.1; H1, H2, P12), from R_REQ, R_STA, L_STA and the begin and end of the user's accesses.
//
// While R_REQ or R_STA is high the chip is held off; only with both high may the user access the DPRAM. In a release
// they may fall separately, in either order: the first fall ends the right to access, and the second lets the chip in.
//
// Pins that change at the same tick may be reported in any order: states of zero length break no rule.
#include <optional>

#include "kinds/dsdpv1/checks/check.hpp"
#include "model/dsdpv1/pins.hpp"
#include "tb/chip/checks/recorder.hpp"

namespace dsdpv1::checks {

class Ownership {
 public:
  explicit Ownership(Recorder& recorder) : recorder_(recorder) {}

  /// RESET has become low or high: all running measurements are dropped, and pin changes while it is low are not
  /// judged. Levels are kept.
  void reset(Tick at, bool low);
  void r_req(Tick at, bool level);
  void r_sta(Tick at, bool level);
  void l_sta(Tick at, bool level);
  /// The user CPU tells its looks.
  void hears_looks() { hears_looks_ = true; }
  bool judges_looks() const { return hears_looks_; }
  /// Before R_STA rises: the last look at L_REQ or L_STA; negative: none.
  void looked(dsdpv1::Pin pin, Tick at) { (pin == dsdpv1::Pin::kLReq ? l_req_look_ : l_sta_look_) = at; }
  void access_began(Tick at);
  void access_ended(Tick at);
  /// End of the run: judges running measurements as if they ended now.
  void finish(Tick at);

  /// Since when the user has held the chip off, but not before the end of a reset; absent while R_REQ and R_STA are
  /// low.
  std::optional<Tick> held_off_since() const;

 private:
  bool owns() const { return r_req_ && r_sta_; }
  bool holds_off() const { return r_req_ || r_sta_; }
  void record(Check check, Tick at, Tick measured, const std::optional<Act>& act = {});
  void r_sta_rose(Tick at);
  void judge_looks(Tick at);
  void holding_off_may_have_changed(Tick at, bool before);
  void ownership_may_have_changed(Tick at);
  void ownership_lost(Tick at);
  void end_both_own(Tick at);
  void end_alone(Tick at);
  void end_without_ownership(Tick at);

  Recorder& recorder_;
  bool in_reset_ = true;
  Tick reset_changed_ = 0;
  bool r_req_ = false, r_sta_ = false, l_sta_ = false, owned_ = false;
  Tick r_req_rose_ = 0, r_sta_rose_ = -1, l_sta_fell_ = 0, owned_since_ = 0;
  bool hears_looks_ = false;
  Tick l_req_look_ = -1, l_sta_look_ = -1;
  Tick held_off_since_ = 0;  ///< R_REQ or R_STA rose when both were low
  Tick freed_ = -1;          ///< both have been low since then
  std::optional<Tick> both_own_since_;
  std::optional<Tick> alone_since_;  ///< R_STA rose without R_REQ
  bool accessing_ = false;
  std::optional<Tick> last_access_end_;  ///< in the present ownership
  std::optional<Tick> not_owned_since_;  ///< an access runs without ownership
  bool began_not_owned_ = false;         ///< ... and began so; else ownership was lost during it
};

}  // namespace dsdpv1::checks
