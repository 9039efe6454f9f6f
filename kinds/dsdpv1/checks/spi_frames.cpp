#include "kinds/dsdpv1/checks/spi_frames.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "bus/time_text.hpp"

namespace dsdpv1::checks {
namespace {

constexpr Tick kWriteGap = 32'400;  // 2.7 us
constexpr std::uint8_t kIdle = 0xFF, kErrorReply = 7, kOwner = 0x02;
constexpr std::size_t kReplyHeader = 2;

}  // namespace

void SpiFrames::reset() {
  service_.reset();
  accesses_.reset();
  forget_frame();
  last_write_.reset();
  owned_since_.reset();
  exclusive_since_.reset();
  effect_ = Effect::kNone;
}

// --- frames ----------------------------------------------------------------------------------------------------------

void SpiFrames::frame_began(Tick at) {
  judge_gap(at);
  heard_ = heard(at);
  request_.clear();
  reply_.clear();
  for_card_ = complete_ = replied_ = false;
}

void SpiFrames::frame_ended(Tick at) {
  settle();
  if (exclusive_since_) owner_gone(*std::exchange(exclusive_since_, std::nullopt), at);
}

void SpiFrames::judge_gap(Tick at) {
  if (!last_write_) return;
  recorder_.value(Check::kWriteGap, at, at - *last_write_, [this, at] {
    return std::string("after a write's last bit") + (heard(at) ? "" : ": this frame is not heard");
  });
  if (at - *last_write_ >= kWriteGap && heard(at)) last_write_.reset();
}

/// SP9, in cycles as counted by the chip.
bool SpiFrames::heard(Tick fell) const {
  return !last_write_ || fell / kTicksPerCycle >= *last_write_ / kTicksPerCycle + Tick{settings_.spi_write_gap};
}

void SpiFrames::byte(Tick at, std::uint8_t mosi, std::uint8_t miso) {
  if (heard_) complete_ ? reply_byte(at, miso) : request_byte(at, mosi);
}

// --- telegrams -------------------------------------------------------------------------------------------------------

void SpiFrames::request_byte(Tick at, std::uint8_t byte) {
  if (!request_.empty() && !for_card_) return;
  request_.add(byte);
  for_card_ = request_.begins() && settings_.is_own(request_.card());
  if (for_card_ && request_.complete()) request_complete(at);
}

void SpiFrames::request_complete(Tick at) {
  complete_ = true;
  idle_bytes_ = 0;
  asked_ = at;
  if (request_.kind() != TelegramKind::kRead) last_write_ = at;
  effect_ = Effect::kNone;
  if (!request_.right()) return;
  if (request_.kind() == TelegramKind::kExchange) effect_ = Effect::kReadAndWrite;
  if (const auto value = request_.written(kOwnershipCell))
    effect_ = (*value & kOwner) != 0 ? Effect::kClaim : Effect::kRelease;
}

void SpiFrames::reply_byte(Tick at, std::uint8_t byte) {
  if (replied_) return;
  if (reply_.empty()) judge_reply(at, byte != kIdle);
  if (reply_.empty() && byte == kIdle) return;
  reply_.add(byte);
  if (reply_.bytes().size() == 1) {
    if (byte >> 5 == kErrorReply) effect_ = Effect::kNone;
    settle();
  }
  replied_ = reply_.complete(request_);
  if (!replied_) return;
  accesses_.replied(request_, reply_, asked_, at);
  if (found_released()) release(at);
}

/// Ownership not released by the host has ended by U_Timer (SP17).
bool SpiFrames::found_released() const {
  if (!owned_since_ || request_.kind() != TelegramKind::kRead || !request_.right() || !request_.covers(kOwnershipCell))
    return false;
  return (reply_.bytes()[kReplyHeader + kOwnershipCell - request_.address()] & kOwner) == 0;
}

/// Once per telegram, when its reply begins or must begin (SP6).
void SpiFrames::judge_reply(Tick at, bool begins) {
  const unsigned gap = idle_bytes_++;
  if (begins ? gap <= settings_.spi_reply_gap : gap == settings_.spi_reply_gap)
    recorder_.kept(Check::kMisoReply, at, begins && gap == settings_.spi_reply_gap, [begins, gap] {
      return begins ? "the reply comes after " + std::to_string(gap) + " bytes" : std::string("no reply");
    });
}

/// The telegram was not refused: it takes effect from its last bit.
void SpiFrames::settle() {
  const Effect effect = std::exchange(effect_, Effect::kNone);
  if (effect == Effect::kClaim && !owned_since_) {
    owned_since_ = asked_;
    accesses_.claimed(asked_);
  }
  if (effect == Effect::kReadAndWrite) exclusive_since_ = asked_;
  if (effect == Effect::kRelease && owned_since_) release(asked_);
}

// --- ownership -------------------------------------------------------------------------------------------------------

void SpiFrames::release(Tick at) {
  const Tick since = *std::exchange(owned_since_, std::nullopt);
  accesses_.released(at);
  recorder_.value(
      Check::kOwned, at, at - since, [since] { return "owned since " + bus::short_time(since); },
      Act::omitted(since, at));
  owner_gone(since, at);
}

void SpiFrames::owner_gone(Tick since, Tick at) {
  if (!held_off_since()) service_.held_off(since, at);
}

std::optional<Tick> SpiFrames::held_off_since() const {
  if (owned_since_) return owned_since_;
  if (exclusive_since_) return exclusive_since_;
  if (effect_ == Effect::kClaim || effect_ == Effect::kReadAndWrite) return asked_;
  return std::nullopt;
}

void SpiFrames::telegram(Tick now, const bus::WireTelegram& telegram) {
  pass(now);
  service_.telegram(now, telegram, held_off_since());
}

void SpiFrames::finish(Tick end) {
  pass(end + 1);
  settle();
  service_.finish(end, held_off_since());
  if (owned_since_) release(end);
}

}  // namespace dsdpv1::checks
