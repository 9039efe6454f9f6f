#include "lab/traces/golden_check.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "bus/baud.hpp"
#include "bus/telegram/explain.hpp"
#include "io/input/units.hpp"

namespace dsdpv1::tb::traces {
namespace {

constexpr Tick kLongestBits = 255 * 11 + 33;  // the longest telegram, and the pause before it

/// Rank of differences at one tick: a chip's outputs are the cause, its inputs the consequence.
int rank(const Signal& signal) {
  switch (signal.kind) {
    case Signal::Kind::kOutput: return 0;
    case Signal::Kind::kInput: return 1;
    default: return 2;
  }
}

std::string side_words(const Signal& signal, const Side& side) {
  return (side.changed ? "" : "still ") + level_words(signal, side.level);
}

}  // namespace

std::string what_differs(const Difference& difference) {
  const Signal& signal = difference.signal;
  const std::string name =
      signal.kind == Signal::Kind::kLine ? "the line" : fmt::format("pin {} of {}", signal.name, signal.slave);
  return fmt::format("{}: golden {}, here {}", name, side_words(signal, difference.golden),
                     side_words(signal, difference.here));
}

GoldenCheck::GoldenCheck(const Trace& golden, const scenario::Scenario& scenario)
    : golden_(golden),
      cursors_(golden.cursors()),
      levels_(cursors_.size(), kLevelX),
      numbers_(scenario),
      longest_telegram_(kLongestBits * bus::baud(scenario.baud).bit) {
  for (const Cursor& cursor : cursors_) next_.push_back(cursor.at());
  for (const scenario::Slave& slave : scenario.slaves) accesses_.push_back(slave.kind->make_access_reader());
}

void GoldenCheck::change(std::size_t signal, Tick at, Level level) {
  if (at != now_) reached(at);
  if (difference_) return;
  now_ = at;
  if (!is_wrong(signal) && !matches(signal, at, level)) wrong_.push_back({signal, levels_[signal], level});
  levels_[signal] = level;
  note_access(signal, at, level);
}

bool GoldenCheck::is_wrong(std::size_t signal) const {
  return std::any_of(
      wrong_.begin(), wrong_.end(), [signal](const Wrong& each) { return each.signal == signal; });
}

bool GoldenCheck::matches(std::size_t signal, Tick at, Level level) {
  Cursor& golden = cursors_[signal];
  if (golden.at() != at || golden.level() != level) return false;
  golden.step();
  next_[signal] = golden.at();
  ++matched_;
  return true;
}

void GoldenCheck::note_access(std::size_t signal, Tick at, Level level) {
  if (golden_.signals()[signal].kind != Signal::Kind::kInput) return;
  if (AccessReader* reader = accesses_[numbers_.slave(signal)].get()) reader->pin(at, numbers_.pin(signal), level);
}

Tick GoldenCheck::earliest() const {
  Tick least = bus::kNever;
  for (const Tick next : next_) least = std::min(least, next);
  return least;
}

/// All changes of the golden at now_ were compared by now, and no change before `now` follows.
void GoldenCheck::reached(Tick now) {
  if (difference_ || now == now_) return;
  if (!wrong_.empty() || earliest() < now) settle();
}

/// Changes that only one side has, at the first tick with any.
void GoldenCheck::settle() {
  const Tick at = wrong_.empty() ? earliest() : now_;
  for (const Wrong& each : wrong_) {
    const bool changes = next_[each.signal] == at;
    const Level golden = changes ? cursors_[each.signal].level() : each.before;
    find(at, each.signal, {golden, changes}, {each.after, true});
  }
  for (std::size_t i = 0; i < cursors_.size(); ++i)
    if (next_[i] == at) find(at, i, {cursors_[i].level(), true}, {levels_[i], false});
  heard_all_ = heard_ && heard_->end >= at;
}

/// Keeps the first difference of the highest rank.
void GoldenCheck::find(Tick at, std::size_t signal, const Side& golden, const Side& here) {
  const Signal& found = golden_.signals()[signal];
  if (difference_ && rank(difference_->signal) <= rank(found)) return;
  difference_ = Difference{at, found, golden, here};
  const AccessReader* reader = signal < numbers_.line() ? accesses_[numbers_.slave(signal)].get() : nullptr;
  access_ = reader != nullptr ? reader->words() : "";
}

void GoldenCheck::telegram(const HeardTelegram& heard) {
  if (heard_all_) return;
  heard_all_ = difference_ && heard.telegram.end >= difference_->at;
  if (!difference_ || heard.telegram.start <= difference_->at) heard_ = heard.telegram;
}

std::string GoldenCheck::telegram_words() const {
  if (!heard_) return "nothing so far";
  const bool readable = heard_->decoded.readable;
  const std::string words = readable ? bus::explain_line(heard_->decoded.telegram) : std::string("not readable");
  const std::string telegram = fmt::format("{} ({})", words, bytes_text(heard_->decoded.bytes));
  if (heard_->end < difference_->at)
    return fmt::format("idle since {}, before that {}", cycle_text(heard_->end), telegram);
  return fmt::format("{}, from {} to {}", telegram, cycle_text(heard_->start), cycle_text(heard_->end));
}

std::string GoldenCheck::words() const {
  std::string text = fmt::format("first difference  {}\n                  {}\non the bus        {}\n",
                                 cycle_text(difference_->at), what_differs(*difference_), telegram_words());
  if (!access_.empty()) text += fmt::format("last access       {}\n", access_);
  return text;
}

}  // namespace dsdpv1::tb::traces
