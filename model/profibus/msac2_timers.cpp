// The timers of C2 (figure 11; rulings V3, V12): F limits the time to the master's poll, I to its next request, U to
// the user's answer.
#include <algorithm>

#include "model/profibus/msac2.hpp"

namespace dsdpv1::profibus {
namespace {

constexpr unsigned kFTimer = 1, kITimer = 2, kUTimer = 3;

}  // namespace

void Msac2::eval(Cycle now) {
  for (int channel = 0; channel < kC2Channels; ++channel)
    if (now >= std::min(channel_at(channel).watch, channel_at(channel).user)) expire(now, channel);
}

Cycle Msac2::next() const {
  Cycle next = kNever;
  for (const Channel& channel : channels_) next = std::min({next, channel.watch, channel.user});
  return next;
}

void Msac2::expire(Cycle now, int number) {
  const Channel& channel = channel_at(number);
  if (channel.state == State::kAborted) {
    log_.at_cycle(now, Reason::kC2Freed, sap_of(number), channel.master);
    return free(now, number);
  }
  const bool watch = now >= channel.watch;
  const unsigned timer = !watch ? kUTimer : channel.state == State::kOpen ? kITimer : kFTimer;
  log_.at_cycle(now, Reason::kC2Timeout, sap_of(number), timer, channel.master);
  abort(now, number, kTimeout);
}

}  // namespace dsdpv1::profibus
