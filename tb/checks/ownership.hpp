#pragma once
// Who owns the DPRAM (5.1; H1, H2, P12), from R_REQ, R_STA, L_STA and the begin and end of the user's accesses.
//
// Pins that change at the same tick may be told in any order: what lasts no time breaks no rule.
#include <optional>

#include "tb/checks/recorder.hpp"

namespace checks {

class Ownership {
 public:
  explicit Ownership(Recorder& recorder) : recorder_(recorder) {}

  /// RESET is low: nothing of what was going on is judged any more. Levels stay.
  void reset();
  void r_req(Tick at, bool level);
  void r_sta(Tick at, bool level);
  void l_sta(Tick at, bool level);
  void access_began(Tick at);
  void access_ended(Tick at);
  /// The run ends: what still lasts is judged as if it ended now.
  void finish(Tick at);

  /// Since when R_REQ has been high, absent while it is low.
  std::optional<Tick> requested_since() const { return r_req_ ? std::optional(r_req_rose_) : std::nullopt; }

 private:
  bool owns() const { return r_req_ && r_sta_; }
  void ownership_may_have_changed(Tick at);
  void ownership_lost(Tick at);
  void end_both_own(Tick at);
  void end_without_request(Tick at);
  void end_without_ownership(Tick at);

  Recorder& recorder_;
  bool r_req_ = false, r_sta_ = false, l_sta_ = false, owned_ = false;
  Tick r_req_rose_ = 0, r_sta_rose_ = 0, l_sta_fell_ = 0, owned_since_ = 0;
  std::optional<Tick> r_sta_fell_;  ///< in the present request
  std::optional<Tick> both_own_since_;
  std::optional<Tick> no_request_since_;  ///< R_STA high without R_REQ
  bool accessing_ = false;
  std::optional<Tick> last_access_end_;  ///< in the present ownership
  std::optional<Tick> not_owned_since_;  ///< an access runs without ownership
  bool began_not_owned_ = false;         ///< ... and began so; else it was lost on the way
};

}  // namespace checks
