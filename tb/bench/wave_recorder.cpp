#include "tb/bench/wave_recorder.hpp"

#include <fmt/format.h>

#include <string_view>

#include "io/input/units.hpp"

namespace dsdpv1::tb {

namespace {

/// The level of a bus: two drivers at once give X.
Level resolved(Level user, Level chip) {
  if (user == kLevelZ) return chip;
  return chip == kLevelZ || chip == user ? user : kLevelX;
}

/// The other direction's pin of the same bus; `pin` itself if it is on none.
std::size_t other_direction(const PinTable& pins, std::size_t pin) {
  for (std::size_t i = 0; i < pins.size(); ++i)
    if (i != pin && pins[pin].bus != nullptr && pins[i].bus != nullptr &&
        std::string_view(pins[i].bus) == pins[pin].bus)
      return i;
  return pin;
}

constexpr const char* kBus = "bus";  // a station of the log

bool concerns(const bus::WireTelegram& telegram, std::uint8_t station) {
  if (telegram.station == station) return true;
  const bus::Decoded& decoded = telegram.decoded;
  return decoded.readable && decoded.telegram.is_request() &&
         (decoded.telegram.da == station || decoded.telegram.da == bus::kBroadcast);
}

WaveSelection selection_of(const WaveOptions& options) {
  WaveSelection selection = options.selection;
  selection.on_trigger = !options.on.empty() && !options.asleep;
  if (options.asleep) selection.from = bus::kNever;
  return selection;
}

}  // namespace

WaveRecorder::WaveRecorder(const WaveOptions& options, bus::Segment& segment, const bus::Timeline& timeline)
    : timeline_(timeline),
      on_(options.on),
      inside_(options.inside),
      asleep_(options.asleep),
      writer_(std::make_unique<SelectedWave>(file(options), selection_of(options))) {
  writer_->open_scope(kBus);
  line_ = writer_->wire("line", 1);
  character_ = writer_->words("character");
  telegram_ = writer_->words("telegram");
  event_signals_[kBus] = writer_->words("flag");
  writer_->close_scope();
  segment.attach("waves", this);
}

std::unique_ptr<WaveWriter> WaveRecorder::file(const WaveOptions& options) {
  if (!asleep_) return open_wave(options.path, options.date);
  auto wave = std::make_unique<DeferredWave>(options.path, options.date);
  deferred_ = wave.get();
  return wave;
}

void WaveRecorder::add_chip(const std::string& name, const ChipKind& kind, const ChipView& chip,
                            const char* host_port) {
  const PinTable& pins = kind.pins();
  ChipSignals signals;
  signals.kind = &kind;
  signals.chip = &chip;
  signals.pins.resize(pins.size());
  writer_->open_scope(name);
  for (std::size_t i = 0; i < pins.size(); ++i) {
    PinSignal& own = signals.pins[i];
    own.pin = &pins[i];
    const std::size_t other = other_direction(pins, i);
    own.other = static_cast<PinNumber>(other);
    own.signal = other < i ? signals.pins[other].signal
                           : writer_->wire(own.pin->bus != nullptr ? own.pin->bus : own.pin->name, own.pin->width);
  }
  if (host_port != nullptr) {
    signals.request = writer_->words(fmt::format("{}_request", host_port));
    signals.reply = writer_->words(fmt::format("{}_reply", host_port));
  }
  signals.dp_state = writer_->words("dp_state");
  signals.service = writer_->words("service");
  signals.user = writer_->words("user");
  event_signals_[name] = writer_->words("event");
  signals.rm_entries = {writer_->words("rm_30"), writer_->words("rm_2F")};
  if (inside_) signals.inside = add_inside(kind);
  writer_->close_scope();
  chips_.push_back(signals);
}

std::vector<WaveRecorder::Signal> WaveRecorder::add_inside(const ChipKind& kind) {
  std::vector<Signal> signals;
  writer_->open_scope("inside");
  for (const InnerSignal& each : kind.inner_signals())
    signals.push_back(each.width == 0 ? writer_->words(each.name) : writer_->wire(each.name, each.width));
  writer_->close_scope();
  return signals;
}

void WaveRecorder::add_master(const std::string& master, const std::vector<std::string>& members,
                              const std::string& initial) {
  writer_->open_scope(master);
  const std::string prefix = master + ".";
  for (const std::string& member : members) master_states_[prefix + member] = {writer_->words(member), initial};
  writer_->close_scope();
}

void WaveRecorder::begin() {
  writer_->check_patterns();
  set(0, line_, 1);
  for (const Signal each : {character_, telegram_}) say(0, each, "-");
  for (const auto& [station, signal] : event_signals_) say(0, signal, "-");
  for (std::size_t chip = 0; chip < chips_.size(); ++chip) {
    for (std::size_t i = 0; i < chips_[chip].pins.size(); ++i) {
      const auto number = static_cast<PinNumber>(i);
      pin(chip, 0, number, chips_[chip].chip->level(number));
    }
    say(0, chips_[chip].dp_state, "OFFLINE");
    for (const Signal each : {chips_[chip].service, chips_[chip].user}) say(0, each, "-");
    for (const std::optional<Signal>& each : {chips_[chip].request, chips_[chip].reply})
      if (each) say(0, *each, "-");
    for (const Signal row : chips_[chip].rm_entries) say(0, row, "not in use");
  }
  for (const auto& [name, state] : master_states_) say(0, state.signal, state.initial);
}

/// Words were recorded during sleep; levels are read now.
void WaveRecorder::wake(bus::Tick now, bus::Tick from, bus::Tick to, bool line) {
  asleep_ = false;
  deferred_->open();
  if (now == 0) {
    writer_->begin_again(from, to);
    return begin();
  }
  set(now, line_, line ? 1 : 0);
  for (std::size_t chip = 0; chip < chips_.size(); ++chip)
    for (std::size_t i = 0; i < chips_[chip].pins.size(); ++i) {
      const auto number = static_cast<PinNumber>(i);
      show(now, chip, number, chips_[chip].chip->level(number));
    }
  writer_->set_window(from, to);
}

void WaveRecorder::pin(std::size_t chip, bus::Tick at, PinNumber pin, Level level) {
  if (asleep_) return;
  PinSignal& own = chips_[chip].pins[pin];
  make_changes(at, turn_of(*own.pin, chip));
  if (own.follows || (own.has_followed && own.level == level)) return;
  show(at, chip, pin, level);
}

void WaveRecorder::show(bus::Tick at, std::size_t chip, PinNumber pin, Level level) {
  std::vector<PinSignal>& pins = chips_[chip].pins;
  PinSignal& own = pins[pin];
  own.level = level;
  const Level shown = own.other == pin ? level
                      : own.pin->input ? resolved(level, pins[own.other].level)
                                       : resolved(pins[own.other].level, level);
  set(at, own.signal, shown);
}

// --- runs ------------------------------------------------------------------------------------------------------------

bool WaveRecorder::run_begins(const bus::CharacterRun& run) {
  if (asleep_) return takes_runs_;
  make_changes(run.start, Turn::kLast);
  end_run();
  if (!takes_runs_) return false;
  run_.begin(run);
  followers_.push_back({0, 0, true, false});
  return true;
}

void WaveRecorder::run_cut(bus::Tick at, bool /*level*/) {
  if (run_.is_under_way()) make_changes_before(at, Turn::kLast);
  end_run();
}

void WaveRecorder::end_run() {
  run_.end();
  for (const Follower& each : followers_)
    if (!each.is_line) chips_[each.chip].pins[each.pin].follows = false;
  followers_.clear();
  next_follower_ = 0;
  sender_ = Turn::kMaster;
}

/// A sender's pin changes before the line.
void WaveRecorder::follows(std::size_t slave, PinNumber pin) {
  if (asleep_) return;
  PinSignal& own = chips_[slave].pins[pin];
  own.follows = own.has_followed = true;
  const Follower follower{slave, pin, false, own.pin->input};
  if (follower.is_input) return followers_.push_back(follower);
  sender_ = slave;
  followers_.insert(followers_.begin(), follower);
}

/// The user's side changes inputs, a bus at any time, and outputs that follow an input at once.
std::size_t WaveRecorder::turn_of(const PinInfo& pin, std::size_t chip) const {
  return pin.input || pin.bus != nullptr || chips_[chip].chip->is_in_users_turn() ? Turn::kLast : chip;
}

/// A chip that receives the line has already made its own changes at that time.
std::size_t WaveRecorder::turn_of(const Follower& follower) const {
  return follower.is_input ? std::max(sender_, follower.chip) : sender_;
}

void WaveRecorder::make_changes_before(bus::Tick at, std::size_t turn) {
  while (run_.is_under_way() && (run_.at() < at || (run_.at() == at && turn_of(followers_[next_follower_]) < turn))) {
    make_change(followers_[next_follower_]);
    if (++next_follower_ < followers_.size()) continue;
    next_follower_ = 0;
    run_.go_on();
  }
  if (!run_.is_under_way()) end_run();
}

void WaveRecorder::make_change(const Follower& follower) {
  const Level level = run_.level() ? 1 : 0;
  if (follower.is_line) return set(run_.at(), line_, level);
  if (chips_[follower.chip].pins[follower.pin].level != level) show(run_.at(), follower.chip, follower.pin, level);
}

// ---------------------------------------------------------------------------------------------------------------------

void WaveRecorder::inside(std::size_t slave, bus::Tick at, std::size_t signal, Level level, const std::string& word) {
  make_changes(at, slave);
  const Signal own = chips_[slave].inside[signal];
  if (chips_[slave].kind->inner_signals()[signal].width == 0)
    say(at, own, word);
  else
    set(at, own, level);
}

void WaveRecorder::character(bus::Tick now, const bus::ReceivedCharacter& heard) {
  const char* const wrong = !heard.stop_ok ? " no stop bit" : !heard.parity_ok ? " wrong parity" : "";
  make_changes(now, Turn::kMonitor);
  say(now, character_, fmt::format("{:02X}{}", heard.byte, wrong));
}

/// A service is shown at the slave to which it is addressed, or that answers.
void WaveRecorder::telegram(const HeardTelegram& heard) {
  make_changes(heard.now, Turn::kMonitor);
  say(heard.now, telegram_, heard.words());
  for (const ChipSignals& chip : chips_)
    if (concerns(heard.telegram, chip.chip->address())) say(heard.now, chip.service, heard.words());
}

/// A telegram that ends with a silence is known late, and shown then.
void WaveRecorder::host_telegram(std::size_t slave, const HostTelegram& telegram) {
  const ChipSignals& chip = chips_[slave];
  make_changes(telegram.known, Turn::kLast);
  say(telegram.known, *(telegram.reply ? chip.reply : chip.request),
      fmt::format("{}{}  {}", telegram.words,
                  telegram.wrong.empty() ? "" : fmt::format("  [wrong: {}]", telegram.wrong),
                  bytes_text(telegram.bytes)));
}

void WaveRecorder::event(std::size_t slave, const profibus::Event& event) {
  make_changes(event.at, slave);
  const ChipSignals& chip = chips_[slave];
  if (event.reason == profibus::Reason::kDpState)
    say(event.at, chip.dp_state, name(static_cast<profibus::DpState>(event.b)));
  if (event.reason == profibus::Reason::kRmEntry)
    say(event.at, chip.rm_entries.at(static_cast<std::size_t>(profibus::kC2FirstSap - event.a)),
        chip.kind->describe(event));
}

void WaveRecorder::master_state(bus::Tick now, const std::string& master, const std::string& member,
                                const std::string& state) {
  make_changes(now, Turn::kMaster);
  say(now, master_states_.at(master + "." + member).signal, state);
}

bool WaveRecorder::opens_window(const std::string& code, bool violation) const {
  return std::any_of(
      on_.begin(), on_.end(),
      [&](const std::string& wanted) { return wanted == code || (violation && wanted == kAnyViolation); });
}

void WaveRecorder::counted(bus::Tick at, const std::string& station, const std::string& code, bool violation,
                           std::uint64_t count) {
  make_changes(at, Turn::kMonitor);
  const auto signal = event_signals_.find(station);
  if (signal != event_signals_.end()) say(at, signal->second, fmt::format("{} {}", code, count));
  if (!opens_window(code, violation)) return;
  if (!asleep_)
    writer_->trigger(at);
  else if (!triggered_)
    triggered_ = {at, station, code};
}

}  // namespace dsdpv1::tb
