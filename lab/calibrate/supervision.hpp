#pragma once
// Who is watched when: the rate by the state BAUD_CONTROL, the holder by the watchdog of its Set_Prm (EN 50170, DP
// slave). Worked out from the telegrams and a wire that shows the found rate; where these do not tell, it is not known.
#include <optional>

#include "lab/calibrate/conversation.hpp"

namespace dsdpv1::calibrate {

/// `offset` cycles behind a recorded edge.
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
  /// A Set_Prm with Lock that was acknowledged: who exchanges data later had it accepted.
  struct Prm {
    double watchdog = 0;  ///< cycles; 0: none
    std::uint8_t master = 0;
    std::optional<Moment> heard;  ///< the master's last telegram; nothing: not known
  };

  State state = State::kUnknown;
  Moment last;  ///< since when its time runs; not in kUnknown
  std::optional<Prm> prm;
};

class Supervision {
 public:
  /// `rate`: high while a rate is found; its edges count where it is in the capture.
  Supervision(const Conversation& all, const TimeBase& time, const Trace& rate) : all_(all), time_(time), rate_(rate) {}

  /// As it was before `at`, in order of time. A watchdog whose time has passed is told as running.
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
  Tick searched_ = -1;  ///< rises of the wire until there are taken
};

}  // namespace dsdpv1::calibrate
