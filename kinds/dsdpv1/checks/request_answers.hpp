#pragma once
// The user answers the acyclic requests that it has fetched (U8).
#include <array>
#include <optional>

#include "kinds/dsdpv1/checks/check.hpp"
#include "kinds/dsdpv1/checks/duty.hpp"
#include "kinds/dsdpv1/checks/user_hold.hpp"
#include "model/profibus/event.hpp"
#include "tb/chip/checks/recorder.hpp"

namespace dsdpv1::checks {

class RequestAnswers {
 public:
  explicit RequestAnswers(Recorder& recorder) : recorder_(recorder) {}

  /// RESET is low: nothing is owed.
  void reset() { channels_ = {}; }
  void hold(const UserHold& hold, const UserHolds& holds);
  /// An event of the chip: U, the timer of the user on C2 (V3), has ended.
  void event(const profibus::Event& event);
  void pass(Tick now);

 private:
  struct Channel {
    Duty duty;
    std::optional<AcyclicHeader> asked;  ///< absent if it was not read for certain
  };
  void serve(std::size_t which, const UserHold& hold, const UserHolds& holds);
  void judge(std::size_t which, const AcyclicHeader& given, Tick at);

  Recorder& recorder_;
  std::array<Channel, 2> channels_;  ///< C1, C2
};

}  // namespace dsdpv1::checks
