#pragma once
// Something that the user owes from a time on: an action that no pin shows when it is left out.
#include <optional>

#include "tb/chip/checks/recorder.hpp"

namespace dsdpv1::checks {

class Duty {
 public:
  /// A duty that has begun keeps its time.
  void begins(Tick at) {
    if (!since_) since_ = at;
  }
  /// It is void.
  void ends() { *this = {}; }
  std::optional<Tick> since() const { return since_; }

  /// The user does it at `at`; `text()` describes it. Measured unless its violation has been reported.
  template <class Text>
  void met(Recorder& recorder, CheckId check, Tick at, const Text& text) {
    if (since_ && !missed_) recorder.value(check, *since_, at - *since_, text, Act::omitted(*since_, at));
    ends();
  }
  /// Time advances to `now`: a violation once the limit has passed.
  template <class Text>
  void pass(Recorder& recorder, CheckId check, Tick now, const Text& text) {
    if (!since_ || missed_ || now - *since_ <= recorder.limit(check).value) return;
    missed_ = true;
    recorder.value(check, *since_, now - *since_, text, Act::omitted(*since_, now));
  }

 private:
  std::optional<Tick> since_;
  bool missed_ = false;
};

}  // namespace dsdpv1::checks
