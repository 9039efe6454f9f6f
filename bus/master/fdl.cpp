#include "bus/master/fdl.hpp"

#include <algorithm>
#include <utility>

namespace dsdpv1::bus {

namespace {

/// Functions with a frame count bit (EN 50170: SDA, SRD and MSRD).
bool counts_frames(const Telegram& telegram) {
  switch (telegram.function()) {
    case fc::kSdaLow:
    case fc::kSdaHigh:
    case fc::kMsrd:
    case fc::kSrdLow:
    case fc::kSrdHigh: return telegram.is_request();
    default: return false;
  }
}

}  // namespace

MasterFdl::MasterFdl(Segment& segment, const std::string& name, std::uint8_t address, const BusParameters& parameters)
    : address_(address),
      parameters_(parameters),
      segment_(segment),
      station_(segment.attach(name, this)),
      sender_(segment, station_) {
  receiver_.on_character = [this](const ReceivedCharacter& received) { character(received); };
  receiver_.on_run = [this](const CharacterRun& run) { return take_run(run); };
  set_baud(0, 0);
}

void MasterFdl::set_baud(Tick now, int index) {
  segment_.cut_run(now);
  bit_ = baud(index).bit;
  baud_ = index;
  sender_.set_timing(bit_, parameters_.clock_ppm);
  receiver_.set_bit(bit_);
  listener_.set_bit(bit_);
  receiver_.reset(segment_.level_at(station_));
  plan_changed();
}

void MasterFdl::start(Tick now, FdlRequest request) {
  request_ = std::move(request);
  result_ = {};
  compose();
  state_ = State::kWaitBus;
  ready_at_ = std::max(ready_at_, now);
  plan_changed();
}

void MasterFdl::respond(Tick request_end, const Telegram& answer) {
  request_ = {};
  bytes_ = encode(answer);
  wants_answer_ = false;
  responding_ = true;
  slot_end_ = request_end + bits(kMinTsdrBits);
  state_ = State::kResponding;
  plan_changed();
}

void MasterFdl::compose() {
  if (request_.raw) {
    wants_answer_ = request_.wants_answer;
    result_.request = request_.telegram;
    restart_series(request_.telegram.da);
    return;
  }
  Telegram& telegram = request_.telegram;
  if (counts_frames(telegram)) {
    const Series& series = series_.at(telegram.da);
    const unsigned count = !series.started ? fc::kFcb : series.fcb ? fc::kFcb | fc::kFcv : fc::kFcv;
    telegram.fc = static_cast<std::uint8_t>(telegram.fc | count);
  }
  bytes_ = encode(telegram);
  wants_answer_ = telegram.wants_answer();
  result_.request = telegram;
}

void MasterFdl::abort(Tick now) {
  plan_changed();
  sender_.abort(now);
  decoder_ = {};
  listener_.reset();
  if (idle()) return;
  if (!std::exchange(responding_, false)) return finish(FdlOutcome::kAborted);
  state_ = State::kIdle;
}

Tick MasterFdl::earliest_start() const { return std::max(ready_at_, quiet_deadline()); }

Tick MasterFdl::next() const {
  if (state_ == State::kSending) return std::min(sender_.next(), receiver_.next());
  if (state_ == State::kResponding) return std::min(slot_end_, receiver_.next());
  if (receiver_.receiving()) return receiver_.next();
  switch (state_) {
    case State::kWaitBus: return earliest_start();
    case State::kWaitAnswer:
    case State::kAwaitActivity: return slot_end_;
    case State::kReceiving:
    case State::kDraining: return quiet_deadline();
    default: return kNever;
  }
}

void MasterFdl::run(Tick now) {
  if (state_ == State::kSending) {
    receiver_.run(now);  // receives its own characters only while it sends a token
    sender_.run(now);
    if (!sender_.busy()) sent();
    return;
  }
  receiver_.run(now);
  if (state_ == State::kResponding && now >= slot_end_) return send(now);  // even while another station sends
  if (state_ != State::kIdle && !receiver_.receiving() && now >= next()) deadline(now);
}

void MasterFdl::deadline(Tick now) {
  switch (state_) {
    case State::kWaitBus: return send(now);
    case State::kAwaitActivity:
    case State::kWaitAnswer: return no_answer(now);
    case State::kReceiving: {  // the answer was cut off
      if (const auto decoded = decoder_.finish()) result_.raw = decoded->bytes;
      return wrong_answer(now);
    }
    case State::kDraining: return wrong_answer(now);
    default: return;
  }
}

void MasterFdl::line_changed(Tick at, bool level) {
  if (state_ == State::kSending && !reads_back()) return;  // it would receive itself
  if (receiver_.line_changed(at, level)) plan_changed();
}

bool MasterFdl::run_begins(const CharacterRun& run) {
  if (state_ == State::kSending) return !reads_back();  // it would receive itself
  if (!receiver_.set_run(run)) return false;
  plan_changed();
  return true;
}

void MasterFdl::run_cut(Tick at, bool /*level*/) {
  sender_.run_cut(at);
  receiver_.cut_run(at);
  plan_changed();
}

void MasterFdl::send(Tick now) {
  state_ = State::kSending;
  result_.request_start = now;
  result_.raw.clear();
  echo_.clear();
  receiver_.reset(segment_.level_at(station_));
  listener_.reset();
  if (request_.raw)
    sender_.send(now, *request_.raw);
  else
    sender_.send(now, bytes_);
  sender_.run(now);
}

void MasterFdl::sent() {
  last_activity_ = sender_.end();
  result_.request_end = last_activity_;
  receiver_.reset(segment_.level_at(station_));
  if (std::exchange(responding_, false)) {
    state_ = State::kIdle;
    return;
  }
  if (reads_back()) result_.read_back = echo_ == bytes_;
  if (wants_answer_ || request_.await_activity) {
    state_ = wants_answer_ ? State::kWaitAnswer : State::kAwaitActivity;
    slot_end_ = last_activity_ + bits(parameters_.slot(baud_));
    return;
  }
  const bool token = request_.telegram.kind == TelegramKind::kSd4;
  ready_at_ = last_activity_ + bits(token ? parameters_.id1(baud_) : parameters_.id2(baud_));
  finish(FdlOutcome::kSent);
}

void MasterFdl::character(const ReceivedCharacter& received) {
  if (state_ == State::kSending) {
    echo_.push_back(received.byte);
    return;
  }
  last_activity_ = received.end;
  if (state_ == State::kAwaitActivity) finish(FdlOutcome::kSent);
  if (state_ == State::kWaitAnswer) {
    state_ = State::kReceiving;
    result_.answer_start = received.start;
  }
  if (state_ != State::kReceiving) return listen(received);
  result_.answer_end = received.end;
  if (!received.ok()) {
    state_ = State::kDraining;
    result_.raw = decoder_.bytes();
    result_.raw.push_back(received.byte);
    decoder_ = {};
    return;
  }
  if (const auto decoded = decoder_.feed(received.byte)) take(*decoded);
}

/// Takes the awaited answer as a whole: one valid telegram.
bool MasterFdl::take_run(const CharacterRun& run) {
  if (state_ != State::kWaitAnswer || decoder_.begun() || !is_telegram(run.bytes, run.size)) return false;
  state_ = State::kReceiving;
  result_.answer_start = run.start;
  result_.answer_end = last_activity_ = run.end();
  take(decode(Bytes(run.bytes, run.bytes + run.size)));
  return true;
}

void MasterFdl::listen(const ReceivedCharacter& received) {
  if (!on_heard) return;
  if (const auto heard = listener_.feed(received)) on_heard(*heard);
}

void MasterFdl::take(const Decoded& decoded) {
  result_.raw = decoded.bytes;
  if (on_heard && decoded.error == DecodeError::kNone && !decoded.telegram.is_response()) {
    const HeardTelegram heard{decoded.telegram, result_.answer_start, result_.answer_end};
    finish(FdlOutcome::kAborted);
    return on_heard(heard);
  }
  if (decoded.error != DecodeError::kNone || !answers_request(decoded.telegram)) {
    state_ = State::kDraining;
    return;
  }
  result_.answer = decoded.telegram;
  succeed();
}

bool MasterFdl::answers_request(const Telegram& answer) const {
  if (request_.raw || answer.kind == TelegramKind::kSc) return true;
  const Telegram& asked = request_.telegram;
  const auto mirrors = [](std::optional<std::uint8_t> sap, std::optional<std::uint8_t> of) {
    return !sap || sap == of;
  };
  return answer.is_response() && answer.sa == asked.da && answer.da == address_ && mirrors(answer.dsap, asked.ssap) &&
         mirrors(answer.ssap, asked.dsap);
}

void MasterFdl::succeed() {
  ready_at_ = last_activity_ + bits(parameters_.id1(baud_));
  if (!request_.raw && counts_frames(request_.telegram)) {
    Series& series = series_.at(request_.telegram.da);
    series.started = true;
    series.fcb = (request_.telegram.fc & fc::kFcb) == 0;
  }
  finish(FdlOutcome::kAnswered);
}

void MasterFdl::no_answer(Tick now) {
  ++result_.timeouts;
  retry_or(FdlOutcome::kNoAnswer, now);
}

void MasterFdl::wrong_answer(Tick now) {
  ++result_.errors;
  retry_or(FdlOutcome::kBadAnswer, now);
}

void MasterFdl::retry_or(FdlOutcome outcome, Tick now) {
  // FDL status is not repeated: it looks for stations that usually do not exist.
  const bool token = request_.telegram.kind == TelegramKind::kSd4;  // the ring repeats it
  const bool repeat = !request_.raw && !token && request_.telegram.function() != fc::kFdlStatus;
  if (repeat && result_.retries < parameters_.retries(baud_)) {
    ++result_.retries;
    state_ = State::kWaitBus;
    ready_at_ = now;
    return;
  }
  ready_at_ = now;
  if (!request_.raw) restart_series(request_.telegram.da);
  finish(outcome);
}

void MasterFdl::finish(FdlOutcome outcome) {
  state_ = State::kIdle;
  result_.outcome = outcome;
  if (on_done) on_done(std::exchange(result_, {}));
}

}  // namespace dsdpv1::bus
