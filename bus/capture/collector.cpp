#include "bus/capture/collector.hpp"

#include <algorithm>

#include "bus/baud.hpp"

namespace dsdpv1::bus::capture {
namespace {

std::uint32_t damage_of(DecodeError error) {
  switch (error) {
    case DecodeError::kNone: return 0;
    case DecodeError::kStartDelimiter: return damage::kStartDelimiter;
    case DecodeError::kFcs: return damage::kFcs;
    case DecodeError::kTruncated: return damage::kShort;
    case DecodeError::kLengthRange:
    case DecodeError::kLengthMismatch:
    case DecodeError::kSecondStartDelimiter:
    case DecodeError::kEndDelimiter:
    case DecodeError::kMissingSap: break;
  }
  return damage::kShape;
}

std::uint32_t damage_of(FlagKind kind) {
  switch (kind) {
    case FlagKind::kCollision:
    case FlagKind::kCharacterError: return damage::kCharacter;
    case FlagKind::kGap:
    case FlagKind::kSynViolated: return damage::kGap;
    default: return 0;
  }
}

}  // namespace

void Collector::telegram(const WireTelegram& telegram) {
  finish();
  begin(telegram);
}

void Collector::begin(const WireTelegram& telegram) {
  open_.emplace();
  open_->start = telegram.start;
  open_->end = telegram.end;
  open_->baud = telegram.baud;
  open_->bytes = telegram.decoded.bytes;
  open_->damage = damage_of(telegram.decoded.error);
  if (telegram.character_errors) open_->damage |= damage::kCharacter;
}

void Collector::flagged(const Flag& flag) {
  if (flag.kind == FlagKind::kUnanswered) {
    if (open_) add(flag);
  } else if (flags_.size() < kMostRemarks) {
    flags_.push_back(flag);
  }
}

void Collector::skipped(const ReceivedCharacter& character, int baud) {
  if (!open_ || open_->bytes.size() >= kMostBytes) {
    finish();
    open_.emplace();
    open_->start = character.start;
    open_->baud = baud;
    open_->damage = damage::kStartDelimiter;
  }
  open_->end = character.end;
  open_->bytes.push_back(character.byte);
}

void Collector::finish() {
  if (!open_) return;
  take_flags();
  take_(*open_);
  open_.reset();
}

/// Takes the flags up to the end of the open telegram; later ones belong to the next.
void Collector::take_flags() {
  const auto later = std::stable_partition(
      flags_.begin(), flags_.end(), [this](const Flag& flag) { return flag.at <= open_->end; });
  std::for_each(flags_.begin(), later, [this](const Flag& flag) { add(flag); });
  flags_.erase(flags_.begin(), later);
}

void Collector::add(const Flag& flag) {
  open_->damage |= damage_of(flag.kind);
  if (open_->remarks.size() < kMostRemarks) open_->remarks.push_back(std::string(name(flag.kind)) + ": " + flag.text);
}

}  // namespace dsdpv1::bus::capture
