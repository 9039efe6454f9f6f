#include "kinds/systemc/recording.hpp"

#include <algorithm>
#include <string_view>
#include <utility>

namespace dsdpv1::tb {
namespace {

scenario::Scenario scenario_of(const RecordingOptions& options, const ChipKind& kind,
                               std::shared_ptr<const OwnSettings> settings, const checks::Limits& limits,
                               const std::vector<std::string>& allowed) {
  scenario::Scenario scenario;
  scenario.name = options.name;
  scenario.baud = options.baud.value_or(0);
  scenario.end = bus::kNever;
  scenario.kind = &kind;
  scenario.chip = settings;
  static_cast<checks::Limits&>(scenario.checks) = limits;
  scenario.checks.mode = options.checks;
  scenario::Slave slave;
  slave.name.text = options.name;
  slave.kind = &kind;
  slave.chip = std::move(settings);
  scenario.slaves.push_back(std::move(slave));
  for (const std::string& code : allowed) scenario.allow.push_back({{code, 0}, {}, 0});
  return scenario;
}

/// kMostPins: there is none with this name.
PinNumber named(const PinTable& pins, std::string_view name) {
  const auto found = std::find_if(pins.begin(), pins.end(), [&](const PinInfo& pin) { return pin.name == name; });
  return found == pins.end() ? PinNumber{kMostPins} : static_cast<PinNumber>(found - pins.begin());
}

}  // namespace

Recording::Recording(const RecordingOptions& options, const ChipKind& kind, std::shared_ptr<const OwnSettings> settings,
                     const checks::Limits& limits, const std::vector<std::string>& allowed,
                     std::unique_ptr<RecordedChip> chip)
    : kind_(kind),
      places_(kind.board_pins()),
      r_req_(named(kind.pins(), "R_REQ")),
      r_sta_(named(kind.pins(), "R_STA")),
      inside_(options.wave.inside),
      by_pins_(options.accesses_by_pins),
      rate_given_(options.baud.has_value()),
      scenario_(scenario_of(options, kind, std::move(settings), limits, allowed)),
      chip_(std::move(chip)),
      checks_(scenario_, options.checks, observers_),
      hosts_(scenario_, !options.log.empty() || !options.wave.path.empty(), observers_),
      journal_(scenario_, observers_, log_form(options.log, false, false)),
      others_(segment_.attach("line", nullptr)),
      own_(segment_.attach(options.name, nullptr)),
      reads_line_(rate_given_) {
  result_.engine = options.engine;
  result_.view = options.view;
  if (!options.wave.path.empty()) waves_.emplace(options.wave, segment_, timeline_);
  monitor_.emplace(segment_);
  monitor_->set_baud(scenario_.baud);
  monitor_->on_telegram = [this](const bus::WireTelegram& each) {
    observers_.tell(&Observer::telegram, HeardTelegram(timeline_.now(), each));
  };
  monitor_->on_flag = [this](const bus::Flag& each) { observers_.tell(&Observer::flag, each); };
  monitor_->on_skipped = [this](const bus::ReceivedCharacter& each) { observers_.tell(&Observer::skipped, each); };
  if (waves_)
    monitor_->on_character = [this](const bus::ReceivedCharacter& each) {
      observers_.tell(&Observer::character, timeline_.now(), each);
    };
  timeline_.add(*monitor_);
  hosts_.add_to(timeline_);
  checks_.add(scenario_.slaves.front(), *chip_);
  if (waves_) waves_->add_chip(options.name, kind_, *chip_, hosts_.port(0));
  if (!options.log.empty()) journal_.open(options.log);
  if (!options.capture.empty()) capture_.emplace(CaptureRequest{options.capture, 257, "dsdpv1"}, scenario_.baud, 0);
  add_observers();
}

void Recording::add_observers() {
  observers_.add(answers_);
  if (checks_.on()) observers_.add(checks_);
  if (hosts_.reads_any()) observers_.add(hosts_);
  if (waves_) observers_.add(*waves_);
  if (capture_) observers_.add(*capture_);
  observers_.add(journal_);
}

PinMask Recording::pins() const {
  if (waves_) return all_of(kind_.pins());
  const PinMask line = mask_of(places_.rxd) | mask_of(places_.txd) | mask_of(places_.rts);
  const PinMask all = all_of(kind_.pins());
  return (checks_.pins(scenario_.slaves.front()) | hosts_.pins(0) | line | mask_of(places_.reset)) & all;
}

// --- what the module reports -----------------------------------------------------------------------------------------

void Recording::pin(Tick now, Tick at, PinNumber pin, Level level) {
  if (finished_) return;
  if (at > now) return put_ahead({Ahead::What::kPin, at, pin, level});
  note_late(at, pin);
  pass_until(at);
  pass_pin(in_order(at), pin, level);
}

/// It is passed on before the changes of its read, which follow.
void Recording::sample(Tick now, Tick at) {
  if (finished_) return;
  if (at <= now) {
    pass_until(now);  // of reads before
    return observers_.read(0, at);
  }
  const Tick place = ahead_.empty() ? now : std::max(now, ahead_.back().at);
  put_ahead({Ahead::What::kSample, place, 0, 0, at});
}

void Recording::event(Tick now, const profibus::Event& event) {
  if (finished_) return;
  if (event.at > now) return put_ahead({Ahead::What::kEvent, event.at, 0, 0, 0, event});
  pass_until(event.at);
  pass_event(event);
}

void Recording::accessed(Tick now, const systemc::AccessReport& access) {
  if (finished_) return;
  ++socket_.accesses;
  socket_.failed += access.ok ? 0 : 1;
  if (access.ahead) {
    ++socket_.ahead;
    socket_.furthest = std::max(socket_.furthest, access.end - now);
  }
  if (by_pins_ || access.value < 0) return;
  const Ahead item = {Ahead::What::kAccess, access.end, 0, access.value, 0, {}, access.address, access.write};
  if (access.end > now) return put_ahead(item);
  pass_until(access.end);
  pass(item);
}

void Recording::advanced(Tick to) {
  if (finished_ || !looks_inside()) return;
  pass_until(to);
  run_to(to - 1);
  chip_->look_inside(in_order(to), observers_);
}

/// An initiator that has not synchronised: accesses that come later are already carried out.
void Recording::note_late(Tick at, PinNumber pin) {
  const bool is_prompt = pin == r_req_ || pin == r_sta_ || pin == places_.reset;
  if (!is_prompt || ahead_.empty() || ahead_.back().at <= at) return;
  if (socket_.late_pins++ != 0) return;
  socket_.late_pin = kind_.pins()[pin].name;
  socket_.late_at = at;
  socket_.late_until = ahead_.back().at;
}

// --- in order of time ------------------------------------------------------------------------------------------------

void Recording::put_ahead(const Ahead& item) {
  auto place = ahead_.end();
  while (place != ahead_.begin() && std::prev(place)->at > item.at) --place;
  ahead_.insert(place, item);
}

void Recording::pass_until(Tick at) {
  while (!ahead_.empty() && ahead_.front().at <= at) {
    const Ahead item = ahead_.front();
    ahead_.pop_front();
    pass(item);
  }
}

void Recording::pass(const Ahead& item) {
  switch (item.what) {
    case Ahead::What::kPin: return pass_pin(in_order(item.at), item.pin, item.level);
    case Ahead::What::kSample: return observers_.read(0, item.sample);
    case Ahead::What::kEvent: return pass_event(item.event);
    case Ahead::What::kAccess:
      run_to(item.at);
      observers_.accessed(0, in_order(item.at), item.address, static_cast<std::uint8_t>(item.level), item.write);
  }
}

/// At one tick the chip acts first, then the monitor, then users and masters.
void Recording::pass_pin(Tick at, PinNumber pin, Level level) {
  if (!begun_) begin();
  run_to(kind_.pins()[pin].input ? at : at - 1);
  chip_->told(pin, level);
  observers_.pin(0, at, pin, level);
  if (pin == r_req_ || pin == r_sta_) note_handshake(at, pin, level != 0);
  if (pin == places_.rxd) rxd_ = level != 0;
  if (pin == places_.txd) txd_ = level != 0;
  if (pin == places_.rts) rts_ = level != 0;
  if (pin == places_.rxd || pin == places_.txd || pin == places_.rts) drive_line(at);
}

void Recording::pass_event(const profibus::Event& event) {
  run_to(event.at - 1);
  if (event.reason == profibus::Reason::kBaudFound) {
    monitor_->set_baud(event.a);
    reads_line_ = true;
  } else if (event.reason == profibus::Reason::kBaudLost) {
    reads_line_ = rate_given_;
  }
  observers_.event(0, event);
}

/// The chip does not receive while it sends: its own levels may come back at the pin.
void Recording::drive_line(Tick at) {
  if (!reads_line_) return;
  const auto others = [&] { segment_.drive(others_, at, !rts_ && !rxd_, false); };
  if (rts_) others();
  segment_.drive(own_, at, rts_, txd_);
  if (!rts_) others();
}

void Recording::note_handshake(Tick at, PinNumber pin, bool level) {
  pin == r_req_ ? holds_.r_req(at, level) : holds_.r_sta(at, level);
}

void Recording::begin() {
  begun_ = true;
  if (waves_) waves_->begin();
}

void Recording::run_to(Tick at) {
  if (at <= timeline_.now()) return;
  timeline_.run_until(at);
  constexpr Tick kFlushed = 100 * bus::kTicksPerUs;
  if (journal_.run_log() == nullptr || at - flushed_ < kFlushed) return;
  flushed_ = at;
  journal_.run_log()->flush(at - 1);
}

/// The wave takes nothing that is earlier than what it has.
Tick Recording::in_order(Tick at) {
  passed_ = std::max(passed_, at);
  return waves_ ? passed_ : at;
}

void Recording::Answers::telegram(const HeardTelegram& heard) {
  if (heard.telegram.tsdr && heard.telegram.station == own.address()) tsdr.add(heard.telegram.tsdr_bits());
}

// --- the end ---------------------------------------------------------------------------------------------------------

void Recording::finish(Tick end) {
  if (finished_) return;
  if (!begun_) begin();
  pass_until(end);
  run_to(end);
  finished_ = true;
  collect(end);
  close_files(end);
}

void Recording::collect(Tick end) {
  result_.scenario = scenario_.name;
  result_.simulated = end;
  result_.telegrams = monitor_->statistics().telegrams;
  result_.wrong_telegrams = monitor_->statistics().wrong;
  SlaveResult slave;
  slave.name = scenario_.name;
  slave.status = chip_->status();
  slave.tsdr = answers_.tsdr;
  slave.user.port = holds_.counters();
  slave.user.program.reset();
  slave.user.cpu.accesses = socket_.accesses;
  if (socket_.accesses != 0) slave.socket = socket_;
  result_.slaves.push_back(std::move(slave));
  checks_.finish(end);
  result_.checks = checks_.results();
  result_.checks_mode = checks_.mode();
  result_.checks_off = checks_.left_out();
  result_.violations = journal_.violations() + checks_.failures();
  journal_.fill(result_);
  result_.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - since_).count();
}

void Recording::close_files(Tick end) {
  RunLog* const log = journal_.run_log();
  if (waves_) waves_->check();
  if (log != nullptr) log->check();
  if (capture_) capture_->check();
  if (waves_) waves_->finish(std::max(end, passed_));
  if (log != nullptr) log->finish();
  if (capture_) capture_->finish();
}

}  // namespace dsdpv1::tb
