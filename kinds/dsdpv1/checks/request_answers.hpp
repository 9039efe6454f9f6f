#pragma once
// The user answers the acyclic requests that it has fetched (U8).
#include <array>
#include <optional>

#include "kinds/dsdpv1/checks/check.hpp"
#include "kinds/dsdpv1/checks/user_hold.hpp"
#include "model/profibus/event.hpp"
#include "tb/chip/checks/duty.hpp"
#include "tb/chip/checks/recorder.hpp"

namespace dsdpv1::checks {

class RequestAnswers {
 public:
  explicit RequestAnswers(Recorder& recorder) : recorder_(recorder) {}

  /// RESET is low: nothing is owed.
  void reset() {
    channels_ = {};
    c1_unfetched_ = false;
  }
  void hold(const UserHold& hold, const UserHolds& holds);
  /// An event of the chip: the user's timer U on C2 (V3) has ended, or data exchange with a C1 request open (V1); a
  /// request or an answer on C1. `owned`: the user holds the DPRAM, so that no request comes between look and answer.
  void event(const profibus::Event& event, bool owned);
  /// `chip_tells`: the end of U comes as an event.
  void pass(Tick now, bool chip_tells);

 private:
  struct Channel {
    Duty duty;
    std::optional<AcyclicHeader> asked;  ///< absent if it was not read for certain
  };
  void serve(std::size_t which, const UserHold& hold, const UserHolds& holds);
  void answered(std::size_t which, const AcyclicHeader& given, Tick at);
  void judge(std::size_t which, const AcyclicHeader& given, Tick at);
  void no_answer_on_c2(Tick at, const char* text);
  void c1_answered(Tick at, bool owned);

  Recorder& recorder_;
  std::array<Channel, 2> channels_;  ///< C1, C2
  bool c1_unfetched_ = false;        ///< the request that is open on C1
};

}  // namespace dsdpv1::checks
