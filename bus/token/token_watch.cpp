#include "bus/token/token_watch.hpp"

#include <fmt/format.h>

#include <iterator>

#include "bus/token/active_stations.hpp"

namespace dsdpv1::bus {

namespace {

constexpr Tick kLeastTimeout = 6;  // T_TO of address 0, in slot times

}  // namespace

bool TokenWatch::may_send(const Telegram& telegram, Tick quiet, Tick slot) const {
  if (!holder_ || telegram.sa == *holder_ || quiet >= kLeastTimeout * slot) return true;
  if (telegram.sa == passer_ && !holder_heard_) return true;
  return false;
}

std::optional<std::string> TokenWatch::hear(const Telegram& telegram, Tick end, Tick quiet, Tick slot) {
  std::optional<std::string> wrong;
  if (!may_send(telegram, quiet, slot))
    wrong = fmt::format("master {} sends while {} has the token", telegram.sa, *holder_);
  if (telegram.kind == TelegramKind::kSd4)
    passed(telegram, end);
  else if (holder_ && (several_ || !wrong))
    holder_ = telegram.sa;  // another one: claimed, or two masters at once, of which the last one counts
  holder_heard_ = telegram.kind != TelegramKind::kSd4 || telegram.da == telegram.sa;
  return wrong;
}

void TokenWatch::passed(const Telegram& token, Tick end) {
  const bool repeated = token.sa == passer_ && token.da == holder_ && token.sa != token.da && !holder_heard_;
  several_ = several_ || token.sa != token.da;
  passer_ = token.sa;
  holder_ = token.da;
  for (auto it = received_.begin(); it != received_.end();)
    it = token_skips(token.sa, token.da, it->first) ? received_.erase(it) : std::next(it);
  const auto before = received_.find(token.da);
  if (before != received_.end() && !repeated) rotations_[token.da].add(end - before->second);
  received_[token.da] = end;
}

}  // namespace dsdpv1::bus
