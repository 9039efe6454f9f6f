#pragma once
// The user waits for the chip after RESET and initialises it once (U7, U9).
#include <optional>

#include "kinds/dsdpv1/checks/check.hpp"
#include "kinds/dsdpv1/checks/port_timing.hpp"
#include "kinds/dsdpv1/checks/user_hold.hpp"
#include "registers/dsdpv1_regs.hpp"
#include "tb/chip/checks/recorder.hpp"

namespace dsdpv1::checks {

class StartOrder {
 public:
  explicit StartOrder(Recorder& recorder) : recorder_(recorder) {}

  /// RESET is low.
  void reset() {
    state_ = State::kUnseen;
    initialised_.reset();
    chip_came_.reset();
  }
  /// `same`: its initialisation, if it has one, is the earlier one.
  void hold(const UserHold& hold, bool same);
  void accessed(const Access& access) {
    if (state_ != State::kJudged) judge(access);
  }

 private:
  enum class State : std::uint8_t {
    kUnseen,
    kSeen,    ///< the user has read B004 = C5
    kJudged,  ///< ... or has written; the rest is not judged
  };
  void judge(const Access& access);

  Recorder& recorder_;
  State state_ = State::kUnseen;
  std::optional<Tick> initialised_;  ///< and not refused, as far as the user knows
  std::optional<bool> chip_came_;    ///< since then, by B006; absent if the user has not looked
};

}  // namespace dsdpv1::checks
