#include "tb/bench/wave_recorder.hpp"

namespace tb {

using dsdpv1::Level;
using dsdpv1::Pin;

namespace {

/// The data bus as everybody on it sees it: two drivers at once are X.
Level resolved(Level user, Level chip) {
  if (user == dsdpv1::kLevelZ) return chip;
  return chip == dsdpv1::kLevelZ || chip == user ? user : dsdpv1::kLevelX;
}

}  // namespace

WaveRecorder::WaveRecorder(const std::string& path, bus::Segment& segment) : writer_(open_wave(path)) {
  writer_->open_scope("bus");
  line_ = writer_->wire("line", 1);
  telegram_ = writer_->words("telegram");
  writer_->close_scope();
  segment.attach("waves", this);
}

std::size_t WaveRecorder::add_chip(const std::string& name, const dsdpv1::Chip& chip) {
  ChipSignals signals;
  signals.chip = &chip;
  writer_->open_scope(name);
  for (int i = 0; i < dsdpv1::kPinCount; ++i) {
    const Pin pin = static_cast<Pin>(i);
    if (pin == Pin::kDOut) continue;  // D is one bus: both directions are shown as D
    signals.pins.at(static_cast<std::size_t>(i)) =
        writer_->wire(pin == Pin::kDIn ? "D" : dsdpv1::name(pin), dsdpv1::width(pin));
  }
  signals.dp_state = writer_->words("dp_state");
  signals.rm_entries = {writer_->words("rm_30"), writer_->words("rm_2F")};
  writer_->close_scope();
  chips_.push_back(signals);
  return chips_.size() - 1;
}

void WaveRecorder::add_master(const std::string& master, const std::vector<std::string>& members,
                              const std::string& initial) {
  writer_->open_scope(master);
  const std::string prefix = master + ".";
  for (const std::string& member : members) master_states_[prefix + member] = {writer_->words(member), initial};
  writer_->close_scope();
}

void WaveRecorder::begin() {
  writer_->set(0, line_, 1);
  writer_->say(0, telegram_, "-");
  for (std::size_t chip = 0; chip < chips_.size(); ++chip) {
    for (int i = 0; i < dsdpv1::kPinCount; ++i)
      pin(chip, 0, static_cast<Pin>(i), chips_[chip].chip->level(static_cast<Pin>(i)));
    dp_state(chip, 0, "OFFLINE");
    for (int channel = 0; channel < profibus::kC2Channels; ++channel) rm_entry(chip, 0, channel, "not in use");
  }
  for (const auto& [name, state] : master_states_) writer_->say(0, state.signal, state.initial);
}

void WaveRecorder::pin(std::size_t chip, bus::Tick at, Pin pin, Level level) {
  ChipSignals& signals = chips_[chip];
  if (pin != Pin::kDIn && pin != Pin::kDOut) {
    writer_->set(at, signals.pins.at(static_cast<std::size_t>(pin)), level);
    return;
  }
  (pin == Pin::kDIn ? signals.user_data : signals.chip_data) = level;
  writer_->set(at, signals.pins.at(static_cast<std::size_t>(Pin::kDIn)),
               resolved(signals.user_data, signals.chip_data));
}

void WaveRecorder::dp_state(std::size_t chip, bus::Tick at, const std::string& word) {
  writer_->say(at, chips_[chip].dp_state, word);
}

void WaveRecorder::rm_entry(std::size_t chip, bus::Tick at, int channel, const std::string& words) {
  writer_->say(at, chips_[chip].rm_entries.at(static_cast<std::size_t>(channel)), words);
}

void WaveRecorder::master_state(const std::string& master, const std::string& member, bus::Tick at,
                                const std::string& word) {
  writer_->say(at, master_states_.at(master + "." + member).signal, word);
}

void WaveRecorder::telegram(bus::Tick at, const std::string& words) { writer_->say(at, telegram_, words); }

}  // namespace tb
