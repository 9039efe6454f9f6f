#pragma once
// The user takes the chip's blocks in time and whole, and judges those that it has to judge (U1 to U3).
#include <array>
#include <optional>

#include "kinds/dsdpv1/checks/check.hpp"
#include "kinds/dsdpv1/checks/user_hold.hpp"
#include "tb/chip/checks/duty.hpp"
#include "tb/chip/checks/recorder.hpp"

namespace dsdpv1::checks {

class ServedBlocks {
 public:
  explicit ServedBlocks(Recorder& recorder) : recorder_(recorder) {}

  /// RESET is low: nothing is owed.
  void reset();
  void intr0_fell(Tick at) { intr0_.begins(at); }
  /// The chip has acknowledged a request on C1 or C2, for which it has no interrupt.
  void request_came(Tick at) { request_.begins(at); }
  /// A hold has ended; `holds` has the bytes read.
  void hold(const UserHold& hold, const UserHolds& holds);
  /// Time advances without an access.
  void pass(Tick now);

 private:
  void owe_nothing();
  void initialise(const UserHolds& holds);
  void note_modes(const UserHold& hold);
  void judge_whole(const UserHold& hold, const UserHolds& holds);
  void judge_flags(const UserHold& hold);
  void judge_verdicts(const UserHold& hold);
  bool is_judged_by_user(std::size_t kind) const;

  Recorder& recorder_;
  Duty intr0_, request_;
  std::array<Duty, kChipBlocks.size()> flags_;  ///< as kChipBlocks; that of the outputs is unused
  std::array<Duty, 2> verdicts_;                ///< on parameters, on configuration
  /// Judging modes of the initialisation in force, and of one that the chip has not accepted yet.
  std::optional<std::array<std::uint8_t, 2>> modes_, coming_modes_;
};

}  // namespace dsdpv1::checks
