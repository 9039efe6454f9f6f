#include "tb/serve/host_line.hpp"

#include <algorithm>
#include <utility>

#include "bus/telegram/telegram.hpp"

namespace dsdpv1::tb::serve {
namespace {

/// The telegram in `bytes` if they are one, else nullopt.
std::optional<bus::Telegram> telegram_of(const bus::Bytes& bytes) {
  bus::TelegramDecoder decoder;
  for (const std::uint8_t byte : bytes)
    if (const auto decoded = decoder.feed(byte))
      return decoded->readable ? std::optional(decoded->telegram) : std::nullopt;
  return std::nullopt;
}

}  // namespace

HostLine::HostLine(bus::Segment& segment, int baud)
    : station_(segment.attach("host", this)),
      sender_(segment, station_),
      bit_(bus::baud(baud).bit),
      slot_(bus::baud(baud).slot_bits * bit_) {
  sender_.set_timing(bit_);
  receiver_.set_bit(bit_);
  receiver_.on_character = [this](const bus::ReceivedCharacter& character) { heard(character); };
}

bool HostLine::send(Tick at, bus::Bytes bytes, std::optional<std::size_t> wrong_at) {
  const std::optional<bus::Telegram> telegram = telegram_of(bytes);
  const bool answer = telegram && telegram->is_response();
  const bool wants_answer = telegram && telegram->is_request() && telegram->wants_answer();
  if (answer) owed_ = false;
  ++statistics_.telegrams;
  waiting_bytes_ += bytes.size();
  waiting_.push_back({at, std::move(bytes), answer, wants_answer, false, wrong_at});
  announce();
  return wants_answer;
}

bool HostLine::is_answer(const bus::Bytes& bytes) {
  const std::optional<bus::Telegram> telegram = telegram_of(bytes);
  return telegram && telegram->is_response();
}

bool HostLine::owes_answer(Tick now) const {
  const bool waits = std::any_of(waiting_.begin(), waiting_.end(),
                                 [](const Waiting& each) { return each.wants_answer && !each.of_nobody; });
  return waits || (owed_ && (slot_end_ == 0 || slot_runs(now)));
}

void HostLine::forget() {
  owed_ = false;
  for (Waiting& telegram : waiting_) telegram.of_nobody = true;
  heard_.clear();
  deaf_ = true;
}

bus::Bytes HostLine::take_heard(Tick now, bool whole_only) {
  if (heard_.empty() || now < last_activity_) return {};
  const bool may_follow = receiver_.receiving() || now < last_activity_ + bits(2);
  if (whole_only && may_follow && heard_.size() < kMostWhole) return {};
  statistics_.heard_bytes += heard_.size();
  owed_ = false;
  return std::exchange(heard_, {});
}

bool HostLine::busy(Tick now) const {
  return sender_.busy() || !waiting_.empty() || receiver_.receiving() || !heard_.empty() || slot_runs(now);
}

Tick HostLine::next() const {
  if (sender_.busy()) return sender_.next();
  if (receiver_.receiving()) return receiver_.next();
  return waiting_.empty() ? bus::kNever : earliest(waiting_.front());
}

void HostLine::run(Tick now) {
  if (sender_.busy()) {
    sender_.run(now);
    if (!sender_.busy()) receiver_.reset(true);
    return;
  }
  receiver_.run(now);
  if (!receiver_.receiving() && !waiting_.empty() && earliest(waiting_.front()) <= now) start(now);
}

Tick HostLine::earliest(const Waiting& telegram) const {
  const Tick idle = last_activity_ + bits(telegram.answer ? bus::kMinTsdrBits : bus::kSynBits);
  return std::max({telegram.at, idle, telegram.answer ? 0 : slot_end_});
}

void HostLine::start(Tick now) {
  const Waiting telegram = std::move(waiting_.front());
  waiting_.pop_front();
  waiting_bytes_ -= telegram.bytes.size();
  deaf_ = telegram.of_nobody;
  if (now > telegram.at) {
    ++statistics_.held_back;
    statistics_.longest_held_back = std::max(statistics_.longest_held_back, now - telegram.at);
  }
  statistics_.sent_bytes += telegram.bytes.size();
  bus::WireFaults faults;
  faults.wrong_parity_at = telegram.wrong_at;
  sender_.send(now, bus::characters(telegram.bytes, faults));
  last_activity_ = sender_.end();
  slot_end_ = telegram.wants_answer ? last_activity_ + slot_ : 0;
  owed_ = telegram.wants_answer && !telegram.of_nobody;
  began_ = now;
  sender_.run(now);
}

/// The host does not receive itself, like a transceiver whose receiver is off while it sends.
void HostLine::line_changed(Tick at, bool level) {
  if (!sender_.busy() && receiver_.line_changed(at, level)) announce();
}

void HostLine::heard(const bus::ReceivedCharacter& character) {
  if (character.start >= std::max(last_activity_ + bits(bus::kSynBits), slot_end_)) deaf_ = false;
  if (!deaf_) heard_.push_back(character.byte);
  last_activity_ = character.end;
  slot_end_ = 0;  // answered; the next telegram must keep T_SYN
}

}  // namespace dsdpv1::tb::serve
