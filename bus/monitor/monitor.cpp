#include "bus/monitor/monitor.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "bus/telegram/explain.hpp"

namespace dsdpv1::bus {

namespace {

constexpr Tick kMillibits = 1000;

std::string hex(const Bytes& bytes) {
  std::string text;
  for (const std::uint8_t byte : bytes) text += fmt::format(" {:02X}", byte);
  return text;
}

/// Nanoseconds with three digits: a tick is 1/12 ns.
std::string nanoseconds(Tick at) {
  return fmt::format("{}.{:03}", at / kTicksPerNs, at % kTicksPerNs * 1000 / kTicksPerNs);
}

}  // namespace

const char* name(FlagKind kind) {
  switch (kind) {
    case FlagKind::kCollision: return "collision";
    case FlagKind::kGap: return "gap";
    case FlagKind::kSynViolated: return "T_SYN violated";
    case FlagKind::kTsdrEarly: return "TSDR early";
    case FlagKind::kTsdrLate: return "TSDR late";
    case FlagKind::kCharacterError: return "character error";
    case FlagKind::kTelegramError: return "telegram error";
    case FlagKind::kUnanswered: return "unanswered";
    case FlagKind::kUnexpectedAnswer: return "unexpected answer";
    case FlagKind::kGlitch: return "glitch";
    case FlagKind::kTwoMasters: return "two masters";
  }
  return "";
}

double WireTelegram::tsdr_bits() const {
  return static_cast<double>(tsdr.value_or(0)) / static_cast<double>(bus::baud(baud).bit);
}

Monitor::Monitor(Segment& segment) {
  segment.attach("monitor", this);
  receiver_.on_character = [this](const ReceivedCharacter& received) { character(received); };
  receiver_.on_run = [this](const CharacterRun& run) { return take_run(run); };
  receiver_.on_false_start = [this](Tick at) { flag(FlagKind::kGlitch, at, "low for less than half a bit"); };
  segment.on_collision = [this, earlier = std::move(segment.on_collision)](const Collision& collision) {
    if (earlier) earlier(collision);
    flag(FlagKind::kCollision, collision.at, fmt::format("{} drives while {} does", collision.second, collision.first));
  };
}

void Monitor::set_baud(int index) {
  bit_ = bus::baud(index).bit;
  baud_ = index;
  receiver_.set_bit(bit_);
  receiver_.reset(true);
  decoder_ = {};
  skipping_ = false;
  pending_.reset();
  announce();
}

Tick Monitor::next() const {
  if (receiver_.receiving()) return receiver_.next();
  return std::min(idle_at(), slot_end());
}

Tick Monitor::idle_at() const { return active_ ? *last_end_ + bits(kSynBits) : kNever; }

Tick Monitor::slot_end() const {
  // The first character of an answer ends the slot time.
  if (!pending_ || decoder_.begun()) return kNever;
  return pending_->end + slot();
}

Tick Monitor::slot() const { return bits(slot_bits_.value_or(bus::baud(baud_).slot_bits)); }

// Faults are flagged when they occur, so a run may only be taken at its end if it cannot cause any: a telegram that
// does not follow a broken one. With on_character each character is reported in time.
bool Monitor::run_begins(const CharacterRun& run) {
  if (skipping_ || decoder_.begun() || !is_telegram(run.bytes, run.size) ||
      !receiver_.set_run(run, on_character != nullptr))
    return false;
  announce();
  return true;
}

void Monitor::run(Tick now) {
  receiver_.run(now);
  if (receiver_.receiving()) return;
  if (now >= idle_at()) idle();
  if (now >= slot_end()) give_up_waiting(now);
}

void Monitor::character(const ReceivedCharacter& received) {
  if (on_character) on_character(received);
  idle_before(received.start);
  if (!decoder_.begun() && !skipping_) begin_telegram(received.start);
  if (skipping_ && on_skipped) on_skipped(received);
  check_character(received);
  last_end_ = received.end;
  active_ = true;
  if (skipping_) return;
  current_.end = received.end;
  if (auto decoded = decoder_.feed(received.byte)) finish_telegram(std::move(*decoded));
}

/// A valid telegram, which can cause no flag before its end.
bool Monitor::take_run(const CharacterRun& run) {
  if (on_character) return false;
  idle_before(run.start);
  begin_telegram(run.start);
  last_end_ = current_.end = run.end();
  active_ = true;
  finish_telegram(decode(Bytes(run.bytes, run.bytes + run.size)));
  return true;
}

void Monitor::idle_before(Tick start) {
  if (!last_end_ || start - *last_end_ >= bits(kSynBits)) idle();
}

void Monitor::begin_telegram(Tick start) {
  current_ = {};
  current_.start = start;
  current_.baud = baud_;
  quiet_from_ = last_end_;
}

void Monitor::check_character(const ReceivedCharacter& received) {
  if (decoder_.begun()) {
    const Tick gap = received.start - *last_end_;
    if (gap * kMillibits > gap_tolerance_ * bit_)
      flag(FlagKind::kGap, received.start, fmt::format("{} before byte {}", in_bits(gap), decoder_.bytes().size()));
  }
  if (received.ok()) return;
  current_.character_errors = true;
  flag(FlagKind::kCharacterError, received.start,
       fmt::format("{}{}{} in byte {:02X}", received.parity_ok ? "" : "wrong parity",
                   received.parity_ok || received.stop_ok ? "" : " and ", received.stop_ok ? "" : "low stop bit",
                   received.byte));
}

void Monitor::finish_telegram(Decoded decoded) {
  WireTelegram telegram = std::move(current_);
  current_ = {};
  telegram.decoded = std::move(decoded);
  classify(telegram);
  count(telegram);
  if (on_telegram) on_telegram(telegram);
}

void Monitor::classify(WireTelegram& telegram) {
  if (telegram.decoded.error != DecodeError::kNone) {
    flag(FlagKind::kTelegramError, telegram.end, describe(telegram.decoded.error));
    skipping_ = telegram.decoded.error != DecodeError::kTruncated;
    pending_.reset();  // answered, although wrongly
    return;
  }
  if (telegram.decoded.telegram.is_response())
    answer(telegram);
  else
    request(telegram);
}

void Monitor::request(const WireTelegram& wire) {
  const Telegram& telegram = wire.decoded.telegram;
  if (pending_) give_up_waiting(wire.start);
  check_syn(wire);
  check_token(wire);
  if (!telegram.is_request()) return;
  ++statistics_.stations[telegram.da].requests;
  if (telegram.wants_answer() && !wire.character_errors) pending_ = Pending{wire.end, telegram.da};
}

void Monitor::check_syn(const WireTelegram& telegram) {
  if (!quiet_from_) return;
  const Tick quiet = telegram.start - *quiet_from_;
  if (quiet < bits(kSynBits))
    flag(FlagKind::kSynViolated, telegram.start, fmt::format("{} after the last activity", in_bits(quiet)));
}

void Monitor::check_token(const WireTelegram& telegram) {
  if (telegram.character_errors) return;
  const Tick quiet = telegram.start - quiet_from_.value_or(telegram.start);
  if (auto wrong = token_.hear(telegram.decoded.telegram, telegram.end, quiet, slot()))
    flag(FlagKind::kTwoMasters, telegram.start, std::move(*wrong));
}

void Monitor::answer(WireTelegram& wire) {
  const Telegram& telegram = wire.decoded.telegram;
  const bool short_acknowledge = telegram.kind == TelegramKind::kSc;
  if (!pending_ || (!short_acknowledge && telegram.sa != pending_->da)) {
    const std::string who = short_acknowledge ? "SC" : fmt::format("answer of station {}", telegram.sa);
    flag(FlagKind::kUnexpectedAnswer, wire.start, pending_ ? fmt::format("{} instead of {}", who, pending_->da) : who);
    return;
  }
  wire.station = pending_->da;
  if (!untimed || !untimed(wire.start)) {
    wire.tsdr = wire.start - pending_->end;
    if (!wire.character_errors) measure(wire);
  }
  pending_.reset();
}

void Monitor::measure(const WireTelegram& telegram) {
  const std::uint8_t station = telegram.station;
  const auto own = station_limits_.find(station);
  const TsdrLimits& limits = own != station_limits_.end() ? own->second : limits_;
  const int max_bits = limits.max_bits.value_or(bus::baud(baud_).max_tsdr_bits);
  const Tick tsdr = *telegram.tsdr;
  const auto words = [&](const char* than, int limit) {
    return fmt::format("station {} answered after {}, {} {}", station, in_bits(tsdr), than, limit);
  };
  if (tsdr < bits(limits.min_bits)) flag(FlagKind::kTsdrEarly, telegram.start, words("min_TSDR is", limits.min_bits));
  if (tsdr > bits(max_bits)) flag(FlagKind::kTsdrLate, telegram.start, words("max_TSDR is", max_bits));
  StationStatistics& statistics = statistics_.stations[station];
  ++statistics.answers;
  statistics.tsdr_min = std::min(statistics.tsdr_min, tsdr);
  statistics.tsdr_max = std::max(statistics.tsdr_max, tsdr);
  statistics.tsdr_sum += tsdr;
}

void Monitor::count(const WireTelegram& telegram) {
  if (!telegram.right()) {
    ++statistics_.wrong;
    return;
  }
  ++statistics_.telegrams;
  ++statistics_.by_kind.at(static_cast<std::size_t>(telegram.decoded.telegram.kind));
}

void Monitor::idle() {
  active_ = false;
  skipping_ = false;
  if (auto decoded = decoder_.finish()) finish_telegram(std::move(*decoded));
}

void Monitor::give_up_waiting(Tick now) {
  ++statistics_.stations[pending_->da].unanswered;
  flag(FlagKind::kUnanswered, now, fmt::format("station {} did not answer", pending_->da));
  pending_.reset();
}

void Monitor::flag(FlagKind kind, Tick at, std::string text) {
  ++statistics_.flags.at(static_cast<std::size_t>(kind));
  if (on_flag) on_flag({kind, at, std::move(text)});
}

std::string Monitor::in_bits(Tick ticks) const {
  return fmt::format("{:.2f} bit times", static_cast<double>(ticks) / static_cast<double>(bit_));
}

std::string format_line(const WireTelegram& telegram) {
  std::string line = fmt::format("{:>16} ns  {:>6}  ", nanoseconds(telegram.start), baud(telegram.baud).name);
  if (telegram.tsdr) line += fmt::format("TSDR {:.2f} ({} ns)  ", telegram.tsdr_bits(), nanoseconds(*telegram.tsdr));
  if (telegram.decoded.error == DecodeError::kNone)
    line += explain_line(telegram.decoded.telegram);
  else
    line += fmt::format("wrong telegram, {}:{}", describe(telegram.decoded.error), hex(telegram.decoded.bytes));
  return telegram.character_errors ? line + "  (with character errors)" : line;
}

std::string format_line(const Flag& flag) {
  return fmt::format("{:>16} ns  FLAG {}: {}", nanoseconds(flag.at), name(flag.kind), flag.text);
}

}  // namespace dsdpv1::bus
