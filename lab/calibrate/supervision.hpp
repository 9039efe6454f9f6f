#pragma once
// Supervision over time: BAUD_CONTROL watches the rate, the watchdog of a Set_Prm its holder (EN 50170, DP slave).
// Derived from the telegrams and a wire that shows the found rate; unknown if these do not decide.
#include <optional>

#include "lab/calibrate/conversation.hpp"

namespace dsdpv1::calibrate {

/// `offset` cycles after a recorded edge.
struct Moment {
  Tick edge = 0;
  Span offset;
};

/// The station's decision of the telegram.
inline Moment decision_of(const LineTelegram& telegram) { return {telegram.last_start, telegram.decision()}; }
/// Cycles from the moment to `at`.
Span since(const TimeBase& time, const Moment& moment, Tick at);

struct Supervised {
  enum class State : std::uint8_t { kUnknown, kBaudControl, kDpControl };
  /// An acknowledged Set_Prm with Lock: a later data exchange shows that it was accepted.
  struct Prm {
    double watchdog = 0;  ///< cycles; 0: none
    std::uint8_t master = 0;
    std::optional<Moment> heard;  ///< the master's last telegram; absent: unknown
  };

  State state = State::kUnknown;
  Moment last;  ///< start of its time; not in kUnknown
  std::optional<Prm> prm;
};

class Supervision {
 public:
  /// `rate`: high while a rate is found; used if it is in the capture.
  Supervision(const Conversation& all, const TimeBase& time, const Trace& rate) : all_(all), time_(time), rate_(rate) {}

  /// The state before `at`; call in order of time. A watchdog whose time has passed is reported as running.
  const Supervised& before(Tick at);

 private:
  void take(const Exchange& exchange);
  void end_watchdog(const Moment& now);
  void trigger(std::uint8_t master, const Moment& now);
  void execute(const Exchange& exchange, const Moment& now);
  void in_exchange(const Moment& now);
  void baud_control(const Moment& now);
  void rate_found(Tick at);

  const Conversation& all_;
  const TimeBase& time_;
  const Trace& rate_;
  std::size_t exchange_ = 0;
  Supervised now_;
  Tick searched_ = -1;  ///< rises of the wire up to here are processed
};

}  // namespace dsdpv1::calibrate
