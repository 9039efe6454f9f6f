#include "io/waves/wave_selection.hpp"

#include <fmt/format.h>
#include <fnmatch.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "bus/baud.hpp"
#include "io/input/input_error.hpp"
#include "io/input/suggest.hpp"

namespace dsdpv1::tb {
namespace {

constexpr bus::Tick kHalfCycle = bus::kTicksPerCycle / 2;
constexpr bus::Tick kLate = bus::kTicksPerMs;  // the most that a trigger may be late
constexpr std::string_view kNotRecorded = "(not recorded)";

}  // namespace

SelectedWave::SelectedWave(std::unique_ptr<WaveWriter> writer, WaveSelection selection)
    : writer_(std::move(writer)), selection_(std::move(selection)) {
  if (!selection_.clock) return;
  writer_->open_scope(kClockScope);
  clock_ = writer_->wire("CLK", 1);
  writer_->close_scope();
}

// --- declarations ----------------------------------------------------------------------------------------------------

void SelectedWave::open_scope(const std::string& name) {
  scopes_.push_back(name);
  writer_->open_scope(name);
}

void SelectedWave::close_scope() {
  scopes_.pop_back();
  writer_->close_scope();
}

SelectedWave::Signal SelectedWave::wire(const std::string& name, int width) { return declare(name, false, width); }
SelectedWave::Signal SelectedWave::words(const std::string& name) { return declare(name, true, 0); }

bool SelectedWave::fits(const std::string& pattern, const std::string& path) const {
  return ::fnmatch(pattern.c_str(), path.c_str(), 0) == 0;
}

std::string SelectedWave::path_of(const std::string& name) const {
  std::string path;
  for (const std::string& scope : scopes_) path += scope + ".";
  return path + name;
}

bool SelectedWave::wants(const std::string& path, bool is_word) const {
  if (is_word && selection_.wires_only) return false;
  const std::vector<std::string>& patterns = selection_.signals;
  return patterns.empty() ||
         std::any_of(patterns.begin(), patterns.end(), [&](const std::string& pattern) { return fits(pattern, path); });
}

SelectedWave::Signal SelectedWave::declare(const std::string& name, bool is_word, int width) {
  names_.push_back(path_of(name));
  Declared declared;
  declared.is_word = is_word;
  declared.selected = wants(names_.back(), is_word);
  if (declared.selected && is_word) declared.signal = writer_->words(name);
  if (declared.selected && !is_word) declare_wires(declared, name, width);
  signals_.push_back(std::move(declared));
  return static_cast<Signal>(signals_.size() - 1);
}

/// Handles of a writer are consecutive.
void SelectedWave::declare_wires(Declared& declared, const std::string& name, int width) {
  if (!selection_.wires_only || width == 1) {
    declared.signal = writer_->wire(name, width);
    return;
  }
  declared.wires = width;
  declared.signal = writer_->wire(name + "[0]", 1);
  for (int i = 1; i < width; ++i) writer_->wire(fmt::format("{}[{}]", name, i), 1);
}

void SelectedWave::check_patterns() const {
  for (const std::string& pattern : selection_.signals)
    if (std::none_of(names_.begin(), names_.end(), [&](const std::string& name) { return fits(pattern, name); }))
      throw InputError(fmt::format("--wave-signals {} fits no signal{}, expected patterns of {}", pattern,
                                   did_you_mean(pattern, names_), join(names_)));
}

// --- windows ---------------------------------------------------------------------------------------------------------

void SelectedWave::set(bus::Tick at, Signal signal, int level) {
  Declared& declared = signals_.at(signal);
  if (!declared.selected) return;
  advance(at);
  if (!open_) return keep({at, signal, {level, {}}});
  declared.value.level = level;
  write(at, declared);
}

void SelectedWave::say(bus::Tick at, Signal signal, std::string_view word) {
  Declared& declared = signals_.at(signal);
  if (!declared.selected) return;
  advance(at);
  if (!open_) return keep({at, signal, {0, std::string(word)}});
  declared.value.word = word;
  write(at, declared);
}

/// Opens or closes windows whose begin or end is due by `at`.
void SelectedWave::advance(bus::Tick at) {
  if (open_ && at <= end_of_window()) return;
  const bool wanted = !selection_.on_trigger || until_ >= selection_.from;
  const bool begins = wanted && closed_at_ < 0 && at >= selection_.from;
  if (!open_ && begins) open(selection_.from);
  if (open_ && at > end_of_window()) close();
}

void SelectedWave::keep(Change change) {
  const bus::Tick at = change.at;
  kept_.push_back(std::move(change));
  forget_before(selection_.on_trigger ? at - selection_.around - kLate : at + 1);
}

void SelectedWave::forget_before(bus::Tick at) {
  for (; !kept_.empty() && kept_.front().at < at; kept_.pop_front()) {
    Declared& signal = signals_[kept_.front().signal];
    signal.value = std::move(kept_.front().value);
    signal.told = true;
  }
}

void SelectedWave::trigger(bus::Tick at) {
  if (!selection_.on_trigger) return;
  advance(at);
  until_ = std::max(until_, at + selection_.around);
  if (!open_ && at >= selection_.from) open(std::max({at - selection_.around, closed_at_ + 1, selection_.from}));
}

void SelectedWave::begin_again(bus::Tick from, bus::Tick to) {
  set_window(from, to);
  kept_.clear();
  for (Declared& signal : signals_) signal.told = false;
}

/// Every signal has its value of `at`; then come the changes since.
void SelectedWave::open(bus::Tick at) {
  at = std::max<bus::Tick>(at, 0);
  forget_before(at);
  open_ = true;
  next_clock_ = (at / kHalfCycle + 1) * kHalfCycle;
  if (selection_.clock) writer_->set(at, clock_, at / kHalfCycle % 2 == 0 ? 1 : 0);
  for (const Declared& signal : signals_)
    if (signal.selected && signal.told) write_value(at, signal, signal.value);
  for (; !kept_.empty() && kept_.front().at <= end_of_window(); kept_.pop_front()) write_kept(kept_.front());
  if (!kept_.empty()) close();  // reported late: it is over
}

/// Later changes belong to no window; without this the signals would look constant.
void SelectedWave::close() {
  closed_at_ = end_of_window();
  tick_to(closed_at_);
  open_ = false;
  if (!selection_.on_trigger) return;
  if (selection_.clock) writer_->set(closed_at_, clock_, WaveWriter::kUnknown);
  for (const Declared& signal : signals_)
    if (signal.selected) write_value(closed_at_, signal, {WaveWriter::kUnknown, std::string(kNotRecorded)});
}

void SelectedWave::write_kept(Change& change) {
  Declared& signal = signals_[change.signal];
  signal.value = std::move(change.value);
  write(change.at, signal);
}

void SelectedWave::write(bus::Tick at, Declared& signal) {
  signal.told = true;
  tick_to(at);
  write_value(at, signal, signal.value);
}

void SelectedWave::write_value(bus::Tick at, const Declared& signal, const Value& value) {
  if (signal.is_word) return writer_->say(at, signal.signal, value.word);
  if (signal.wires == 1) return writer_->set(at, signal.signal, value.level);
  for (int i = 0; i < signal.wires; ++i)
    writer_->set(at, signal.signal + static_cast<Signal>(i), value.level < 0 ? value.level : (value.level >> i) & 1);
}

/// CLK up to and including `at`.
void SelectedWave::tick_to(bus::Tick at) {
  if (!selection_.clock) return;
  for (; next_clock_ <= at; next_clock_ += kHalfCycle)
    writer_->set(next_clock_, clock_, next_clock_ / kHalfCycle % 2 == 0);
}

// --- the file --------------------------------------------------------------------------------------------------------

void SelectedWave::save(bus::Tick at) {
  advance(at);
  if (open_) writer_->save(at);
}

void SelectedWave::finish(bus::Tick end) {
  advance(end);
  if (!has_window()) {
    if (selection_.clock) writer_->set(0, clock_, WaveWriter::kUnknown);
    for (const Declared& signal : signals_)
      if (signal.selected) write_value(0, signal, {WaveWriter::kUnknown, std::string(kNotRecorded)});
  }
  if (open_) tick_to(end);
  writer_->finish(open_ || selection_.on_trigger || !has_window() ? end : selection_.to);
}

}  // namespace dsdpv1::tb
