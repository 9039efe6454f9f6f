#include "lab/replay/listener.hpp"

#include <algorithm>

#include "bus/baud.hpp"

namespace dsdpv1::tb::replay {

Listener::Listener(const Recording& recording, const std::vector<PlacedTelegram>& placed)
    : recording_(recording), placed_(placed), heard_(placed.size()), asks_(placed.size()) {
  auto request = recording.requests.begin();
  for (std::size_t i = 0; i < placed.size() && request != recording.requests.end(); ++i) {
    if (placed[i].telegram != request->telegram) continue;
    requests_[request->telegram] = i;
    asks_[i] = true;
    ++request;
  }
}

/// Called at the end of the telegram's last stop bit, or later for a broken one.
void Listener::telegram(const HeardTelegram& heard) {
  if (!shift_) return;
  const Tick start = heard.telegram.start - *shift_, bit = bus::baud(heard.telegram.baud).bit;
  const auto after = std::upper_bound(placed_.begin(), placed_.end(), start + bit,
                                      [](Tick at, const PlacedTelegram& each) { return at < each.start; });
  if (after == placed_.begin()) return;
  const PlacedTelegram& last = *(after - 1);
  const auto index = static_cast<std::size_t>(after - 1 - placed_.begin());
  if (start >= last.end) return take_answer(heard.telegram, start, last);
  heard_[index].whole = heard.telegram.right();
  heard_[index].has_rate = model_has_rate(recording_.telegrams[last.telegram].baud);
}

void Listener::take_answer(const bus::WireTelegram& wire, Tick start, const PlacedTelegram& before) {
  Heard& heard = heard_[static_cast<std::size_t>(&before - placed_.data())];
  const bool asked = asks_[static_cast<std::size_t>(&before - placed_.data())] && !heard.answer;
  const Answer answer{start, start - before.end, recording_.telegrams[before.telegram].baud, wire.right(),
                      wire.decoded.bytes};
  if (asked)
    heard.answer = answer;
  else
    unasked_.push_back(answer);
}

const Heard* Listener::of(std::size_t telegram) const {
  const auto found = requests_.find(telegram);
  return found == requests_.end() ? nullptr : &heard_[found->second];
}

}  // namespace dsdpv1::tb::replay
