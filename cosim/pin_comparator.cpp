#include "cosim/pin_comparator.hpp"

#include <algorithm>

namespace dsdpv1::cosim {

void PinComparator::begin(PinNumber pin, Level model, Level rtl) {
  states_.at(pin).model = model;
  states_.at(pin).rtl = rtl;
  touched_ |= tb::mask_of(pin);
}

std::optional<PinDifference> PinComparator::settle(Tick horizon) {
  std::optional<PinDifference> found = compare(0);  // the levels at the beginning, once
  while (!found) {
    Tick at = horizon;
    if (model_next_ < model_.size()) at = std::min(at, model_[model_next_].at);
    if (rtl_next_ < rtl_.size()) at = std::min(at, rtl_[rtl_next_].at);
    if (at >= horizon) break;
    take(at);
    found = compare(at);
  }
  if (!found) found = overdue(horizon);
  if (model_next_ == model_.size() && rtl_next_ == rtl_.size()) {
    model_.clear();
    rtl_.clear();
    model_next_ = rtl_next_ = 0;
  }
  return found;
}

void PinComparator::take(Tick at) {
  for (; model_next_ < model_.size() && model_[model_next_].at == at; ++model_next_) {
    const Change& change = model_[model_next_];
    states_.at(change.pin).model = change.level;
    states_.at(change.pin).model_touched = true;
    touched_ |= tb::mask_of(change.pin);
  }
  for (; rtl_next_ < rtl_.size() && rtl_[rtl_next_].at == at; ++rtl_next_) {
    const Change& change = rtl_[rtl_next_];
    states_.at(change.pin).rtl = change.level;
    states_.at(change.pin).rtl_touched = true;
    touched_ |= tb::mask_of(change.pin);
  }
}

std::optional<PinDifference> PinComparator::compare(Tick at) {
  std::optional<PinDifference> found;
  for (PinNumber pin = 0; pin < kMostPins && touched_ != 0 && !found; ++pin) {
    if ((touched_ & tb::mask_of(pin)) == 0) continue;
    touched_ &= ~tb::mask_of(pin);
    found = tolerance(pin) == 0 ? compare_exact(at, pin) : compare_tolerant(at, pin);
  }
  return found;
}

std::optional<PinDifference> PinComparator::compare_exact(Tick at, PinNumber pin) {
  State& now = states_.at(pin);
  if (!matches(now.model, now.rtl)) return PinDifference{at, pin, now.model, now.rtl};
  if (now.model_touched && now.model != tb::kLevelX) ++matched_;
  now.model_touched = now.rtl_touched = false;
  return std::nullopt;
}

std::optional<PinDifference> PinComparator::compare_tolerant(Tick at, PinNumber pin) {
  State& now = states_.at(pin);
  if (!now.model_touched && !now.rtl_touched) return compare_exact(at, pin);  // the levels at the beginning
  if (now.model_touched) now.model_ahead.push_back({at, now.model});
  if (now.rtl_touched) now.rtl_ahead.push_back({at, now.rtl});
  now.model_touched = now.rtl_touched = false;
  while (!now.model_ahead.empty() && !now.rtl_ahead.empty()) {
    const Late model = now.model_ahead.front(), rtl = now.rtl_ahead.front();
    if (!matches(model.level, rtl.level) || std::abs(model.at - rtl.at) > tolerance(pin))
      return PinDifference{std::max(model.at, rtl.at), pin, model.level, rtl.level};
    now.model_ahead.pop_front();
    now.rtl_ahead.pop_front();
    ++matched_;
  }
  return std::nullopt;
}

std::optional<PinDifference> PinComparator::overdue(Tick horizon) {
  for (PinNumber pin = 0; pin < kMostPins; ++pin) {
    const State& now = states_.at(pin);
    const Tick oldest = horizon - tolerance(pin) - 1;
    if (!now.model_ahead.empty() && now.model_ahead.front().at < oldest)
      return PinDifference{now.model_ahead.front().at, pin, now.model_ahead.front().level, std::nullopt};
    if (!now.rtl_ahead.empty() && now.rtl_ahead.front().at < oldest)
      return PinDifference{now.rtl_ahead.front().at, pin, std::nullopt, now.rtl_ahead.front().level};
  }
  return std::nullopt;
}

}  // namespace dsdpv1::cosim
