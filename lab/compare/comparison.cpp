#include "lab/compare/comparison.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <numeric>

#include "io/input/input_error.hpp"
#include "lab/compare/clock_edges.hpp"

namespace dsdpv1::tb::compare {
namespace {

constexpr Time kEver = std::numeric_limits<Time>::max();
constexpr std::uint32_t kProgressEvery = 1U << 14U;

FileResult file_result(const Side& side) {
  return {side.path(), side.nets().all().size(), side.begin(), side.end(), !side.next()};
}

std::vector<SignalResult> unseen(const std::vector<Pair>& pairs) {
  std::vector<SignalResult> results;
  results.reserve(pairs.size());
  for (const Pair& pair : pairs) results.push_back({pair.name, 0, 0, {}});
  return results;
}

}  // namespace

Comparison::Comparison(const std::string& a, const std::string& b, Options options, const MakeSurroundings& make)
    : options_(std::move(options)),
      a_(a, options_.scope_a),
      b_(b, options_.scope_b),
      pairs_(match(a_.nets(), b_.nets(), options_)),
      levels_(options_.x, options_.z),
      touched_(pairs_.pairs.size()),
      masks_(options_.masks, a_, b_, pairs_.pairs),
      watchers_(a_, make),
      scale_(std::min(a_.exponent(), b_.exponent())),
      states_(pairs_.pairs.size()) {
  for (std::uint32_t i = 0; i < pairs_.pairs.size(); ++i) {
    const Pair& pair = pairs_.pairs[i];
    probes_.emplace_back(a_.watch(pair.a, touched_, i), b_.watch(pair.b, touched_, i));
    states_[i].tolerance = pair.tolerance ? scale_.from(*pair.tolerance) : tolerance();
  }
  result_.scale = scale_;
  result_.tolerance = tolerance();
  result_.signals = unseen(pairs_.pairs);
  result_.only_a = pairs_.only_a;
  result_.only_b = pairs_.only_b;
  result_.left_out = pairs_.left_out;
  result_.strict = options_.strict;
  if (options_.strict) result_.alone = pairs_.alone;
  if (!options_.tolerance && b_.exponent() > a_.exponent()) result_.rounded = *scale_.from(1, b_.exponent());
}

/// A's times are rounded by up to its unit. B's unit allows nothing: a coarse one would make any B equal.
Time Comparison::tolerance() const {
  if (options_.tolerance) return scale_.from(*options_.tolerance);
  return a_.exponent() == b_.exponent() ? 0 : *scale_.from(1, a_.exponent());
}

Result Comparison::run() {
  start();
  if (options_.clock)
    go_by_clock();
  else
    go_by_changes();
  return finish();
}

void Comparison::start() {
  a_.start(scale_, 0);
  b_.start(scale_, scale_.from(options_.shift));
  from_ = std::max(a_.begin(), b_.begin());
  if (options_.from) from_ = std::max(from_, scale_.from(*options_.from));
  to_ = options_.to ? scale_.from(*options_.to) : kEver;
  a_.advance(from_);
  b_.advance(from_);
  check_window();
  a_.restart_events();
  b_.restart_events();
  touched_.add_all();
}

void Comparison::check_window() const {
  if (from_ <= to_ && !passed(from_)) return;
  const auto span = [&](const Side& side) {
    return fmt::format("{} to {}{}", scale_.text(side.begin()), side.next() ? "beyond " : "", scale_.text(side.end()));
  };
  throw InputError(a_.path(), 0,
                   fmt::format("has nothing to compare from {} on: it goes from {}, {} from {}, expected "
                               "--from, --to and --shift that leave a time both have",
                               scale_.text(from_), span(a_), b_.path(), span(b_)));
}

/// True when a file has ended before this time.
bool Comparison::passed(Time time) const { return (!a_.next() && time > a_.end()) || (!b_.next() && time > b_.end()); }

std::optional<Time> Comparison::next_change() const {
  const Time next = std::min(a_.next().value_or(kEver), b_.next().value_or(kEver));
  if (next == kEver || next > to_ || passed(next)) return std::nullopt;
  return next;
}

void Comparison::go_by_changes() {
  compare_at(from_);
  while (const std::optional<Time> next = next_change()) {
    a_.advance(*next);
    b_.advance(*next);
    compare_at(*next);
    tell_progress();
  }
}

/// The values before the edge, which a flip-flop would sample.
void Comparison::go_by_clock() {
  ClockEdges edges(*options_.clock, a_, b_, scale_, scale_.from(options_.shift));
  for (auto edge = edges.next(); edge && *edge <= to_; edge = edges.next()) {
    if (*edge <= from_) continue;
    a_.advance(*edge - 1);
    b_.advance(*edge - 1);
    if (passed(*edge)) break;
    compare_at(*edge);
    tell_progress();
  }
  a_.advance(to_);  // to the end of the files
  b_.advance(to_);
}

void Comparison::compare_at(Time now) {
  const bool off = a_.off() || b_.off();
  if (off != off_) touched_.add_all();
  off_ = off;
  masks_.settle(touched_);
  if (!watchers_.empty()) watchers_.settle(scale_.tick(now));
  confirm_until(now);
  for (const std::uint32_t pair : touched_.list()) compare(pair, now);
  touched_.clear();
  confirm_until(now);
}

void Comparison::compare(std::uint32_t pair, Time now) {
  State& state = states_[pair];
  const std::string_view a = a_.value(probes_[pair].first), b = b_.value(probes_[pair].second);
  const bool hidden = off_ || masks_.hide(pair);
  const bool differs = !hidden && !levels_.match(pairs_.pairs[pair].a.net.kind, a, b);
  if (!hidden) ++result_.signals[pair].compared;
  if (differs && !state.differs) begins_to_differ(pair, now, a, b);
  state.differs = differs;
  if (wave_) wave_->set(scale_, now, pair, a, b, differs);
}

void Comparison::begins_to_differ(std::uint32_t pair, Time now, std::string_view a, std::string_view b) {
  State& state = states_[pair];
  const WaveKind kind = pairs_.pairs[pair].a.net.kind;
  ++state.times;
  if (!result_.signals[pair].first) state.began = {now, value_text(a, kind), value_text(b, kind)};
  state.differs = true;
  open_.push({now + state.tolerance + (state.tolerance != 0 ? 1 : 0), pair, state.times});
}

/// A pair whose tolerance has passed differs if it still does.
void Comparison::confirm_until(Time now) {
  while (!open_.empty()) {
    const Open open = open_.top();
    const State& state = states_[open.pair];
    if (open.deadline > now) return;
    open_.pop();
    if (state.differs && state.times == open.times) confirm(open.pair, now);
  }
}

void Comparison::confirm(std::uint32_t pair, Time now) {
  SignalResult& signal = result_.signals[pair];
  ++signal.differences;
  if (signal.first) return;
  signal.first = states_[pair].began;
  const std::optional<std::size_t> before = result_.first;
  if (before &&
      std::pair(result_.signals[*before].first->at, *before) <= std::pair(signal.first->at, std::size_t{pair}))
    return;
  result_.first = pair;
  result_.surroundings = watchers_.lines(pairs_.pairs[pair].a.net.scope, scale_.tick(now));
}

/// Later than the tolerance allows, and before --to.
bool Comparison::b_ends_first() const {
  return until_ < to_ && !b_.next() && (a_.next() || a_.end() > b_.end() + tolerance());
}

/// Equal says something only if a difference could have shown.
void Comparison::check_enough() const {
  const auto compared = [](std::uint64_t sum, const SignalResult& signal) { return sum + signal.compared; };
  const std::uint64_t values =
      std::accumulate(result_.signals.begin(), result_.signals.end(), std::uint64_t{0}, compared);
  const auto less = [](const State& a, const State& b) { return a.tolerance < b.tolerance; };
  const Time longest = std::max_element(states_.begin(), states_.end(), less)->tolerance;
  const std::string what =
      fmt::format("compared with {} from {} to {}", b_.path(), scale_.text(from_), scale_.text(until_));
  if (values == 0)
    throw InputError(a_.path(), 0,
                     "has no value that was " + what + ", expected --mask, --clock and pauses that leave some");
  if (options_.clock ? steps_ == 1 : until_ == from_)
    throw InputError(a_.path(), 0,
                     "has a single instant that was " + what + ", expected a longer window or more edges");
  if (until_ - from_ <= longest)
    throw InputError(a_.path(), 0,
                     fmt::format("was {}, which is not longer than the tolerance of {}, expected a longer window or "
                                 "a shorter --tolerance",
                                 what, scale_.text(longest)));
}

Result Comparison::finish() {
  until_ = to_;
  if (!a_.next()) until_ = std::min(until_, a_.end());
  if (!b_.next()) until_ = std::min(until_, b_.end());
  confirm_until(until_);
  result_.a = file_result(a_);
  result_.b = file_result(b_);
  result_.from = from_;
  result_.to = until_;
  if (options_.to) result_.wanted = to_;
  result_.b_ends_first = options_.strict && b_ends_first();
  if (result_.equal()) check_enough();
  if (wave_) wave_->finish(scale_, until_);
  return std::move(result_);
}

void Comparison::tell_progress() {
  if (++steps_ % kProgressEvery == 0 && progress_) progress_(std::min(a_.share(), b_.share()));
}

}  // namespace dsdpv1::tb::compare
