#include "model/profibus/telegram_rx.hpp"

#include <algorithm>

#include "model/profibus/fdl_times.hpp"
#include "model/profibus/request.hpp"

namespace dsdpv1::profibus {
namespace {

constexpr int kSd2Header = 4;  // SD2 LE LEr SD2
constexpr int kSd2Frame = 6;   // header, FCS, ED
constexpr int kMinLe = 4, kMaxLe = 249;

int expected_size(std::uint8_t delimiter) {
  switch (delimiter) {
    case sd::kSd1: return 6;
    case sd::kSd2: return kSd2Header;  // until LE is known
    case sd::kSd3: return 14;
    case sd::kSd4: return 3;
    case sd::kSc: return 1;
    default: return 0;
  }
}

int address_offset(std::uint8_t delimiter) { return delimiter == sd::kSd2 ? kSd2Header : 1; }

std::uint8_t fcs_of(const std::uint8_t* bytes, int size) {
  unsigned sum = 0;
  for (int i = 0; i < size; ++i) sum += bytes[i];
  return static_cast<std::uint8_t>(sum);
}

}  // namespace

int addressee(const std::uint8_t* bytes, std::size_t size) {
  const int length = static_cast<int>(size);
  if (bytes[0] == sd::kSc || bytes[0] == sd::kSd4) return length == expected_size(bytes[0]) ? kForNobody : kNoTelegram;
  const bool variable = bytes[0] == sd::kSd2 && length > kSd2Header;
  if (variable && (bytes[1] != bytes[2] || bytes[1] < kMinLe || bytes[1] > kMaxLe || bytes[3] != sd::kSd2))
    return kNoTelegram;
  const int expected = variable ? bytes[1] + kSd2Frame : expected_size(bytes[0]), offset = address_offset(bytes[0]);
  if (length != expected || length <= kSd2Header) return kNoTelegram;
  const bool right = bytes[length - 2] == fcs_of(bytes + offset, length - offset - 2) && bytes[length - 1] == sd::kEd;
  return right ? bytes[offset] & kAddressMask : kNoTelegram;
}

void TelegramRx::reset() {
  restart();
  unsynced_ = 0;
}

void TelegramRx::restart() {
  state_ = State::kWaitSyn;
  given_up_ = false;
}

void TelegramRx::set_quiet(bool quiet) {
  quiet_ = quiet;
  if (quiet) unsynced_ = 0;
}

void TelegramRx::cut(Cycle now) {
  if (in_telegram()) fail(now, Reason::kCutByAnswer, static_cast<unsigned>(count_));
  restart();
}

void TelegramRx::character(Cycle now, const Character& character, int bit) {
  const bool after_syn = is_syn(character.idle, bit);
  const bool after_gap = character.idle > bit;
  if (in_telegram() && !after_syn) {
    if (state_ == State::kComplete) return fail(now, Reason::kOversized);
    if (after_gap) return fail(now, Reason::kGap, static_cast<unsigned>(count_), static_cast<unsigned>(expected_));
  }
  const bool first = after_syn || !in_telegram();
  if (after_syn) report_unsynced(now);
  if (first && !after_gap) {  // the rest of a telegram that was abandoned, or that began during the chip's own answer
    if (!given_up_) count_unsynced();
    return;
  }
  if (first) begin_telegram(character.idle, bit);
  if (!character.parity_ok) return fail(now, Reason::kParity, static_cast<unsigned>(count_), character.value);
  if (!character.stop_ok) return fail(now, Reason::kFraming, static_cast<unsigned>(count_), character.value);

  telegram_.end = character.start + static_cast<Cycle>(kBitsPerCharacter) * bit;
  deadline_ = decided(telegram_.end, bit);
  if (first)
    begin(now, character.value);
  else
    take(now, character.value);
}

bool TelegramRx::take_whole(const std::uint8_t* bytes, int size, Cycle idle, Cycle end, int bit) {
  if (idle <= bit) return false;
  begin_telegram(idle, bit);
  telegram_.end = end;
  deadline_ = decided(end, bit);
  std::copy_n(bytes, size, bytes_.begin());
  count_ = expected_ = size;
  check_end(end);
  return true;
}

bool TelegramRx::pass_whole(Cycle idle, int bit) {
  if (idle <= bit) return false;
  begin_telegram(idle, bit);
  return true;
}

void TelegramRx::begin_telegram(Cycle idle, int bit) {
  count_ = 0;
  given_up_ = false;
  telegram_.synced = is_syn(idle, bit);
  telegram_.idle_bits = static_cast<int>(idle / bit);
}

void TelegramRx::begin(Cycle now, std::uint8_t value) {
  expected_ = expected_size(value);
  if (expected_ == 0) return fail(now, Reason::kStartDelimiter, value);
  state_ = State::kReceiving;
  take(now, value);
}

void TelegramRx::take(Cycle now, std::uint8_t value) {
  bytes_[static_cast<std::size_t>(count_++)] = value;
  if (bytes_[0] == sd::kSd2 && count_ <= kSd2Header && !check_sd2_header(now, value)) return;
  if (count_ == expected_) check_end(now);
}

bool TelegramRx::check_sd2_header(Cycle now, std::uint8_t value) {
  if (count_ == 3) {
    const int le = bytes_[1];
    if (le != value || le < kMinLe || le > kMaxLe) {
      fail(now, Reason::kLength, bytes_[1], value);
      return false;
    }
  }
  if (count_ == kSd2Header) {
    if (value != sd::kSd2) {
      fail(now, Reason::kRepeatedDelimiter, value);
      return false;
    }
    expected_ = bytes_[1] + kSd2Frame;
  }
  return true;
}

void TelegramRx::check_end(Cycle now) {
  state_ = State::kComplete;
  telegram_.sd = bytes_[0];
  if (bytes_[0] == sd::kSc) return;
  const auto* body = &bytes_[static_cast<std::size_t>(address_offset(bytes_[0]))];
  telegram_.da = body[0];
  telegram_.sa = body[1];
  if (bytes_[0] == sd::kSd4) return;
  telegram_.fc = body[2];
  telegram_.data = body + 3;
  telegram_.size = expected_ - address_offset(bytes_[0]) - 5;  // DA SA FC, FCS ED
  const std::uint8_t fcs = fcs_of(body, telegram_.size + 3);
  const std::uint8_t received = body[telegram_.size + 3], ed = body[telegram_.size + 4];
  telegram_.fcs = fcs;
  if (received != fcs) return fail(now, Reason::kFcs, received, fcs);
  if (ed != sd::kEd) return fail(now, Reason::kEndDelimiter, ed);
}

bool TelegramRx::eval(Cycle now, bool receiving) {
  if (!in_telegram() || receiving || now < deadline_) return false;
  if (state_ == State::kReceiving) {
    fail(now, Reason::kGap, static_cast<unsigned>(count_), static_cast<unsigned>(expected_));
    return false;
  }
  state_ = State::kWaitSyn;
  return true;
}

void TelegramRx::fail(Cycle now, Reason reason, unsigned a, unsigned b) {
  state_ = State::kWaitSyn;
  if (!telegram_.synced) return count_unsynced();
  given_up_ = true;
  if (!quiet_) log_.at_cycle(now, reason, a, b);
}

void TelegramRx::count_unsynced() {
  given_up_ = true;
  if (!quiet_ && unsynced_ < kMostUnsynced) ++unsynced_;
}

// A telegram in progress ends before its bytes do.
bool TelegramRx::is_possible() const {
  if (state_ != State::kReceiving) return true;
  const bool length_known = bytes_[0] == sd::kSd2 && count_ >= 3;
  if (length_known && (bytes_[1] < kMinLe || bytes_[1] > kMaxLe)) return false;
  const bool header_over = bytes_[0] == sd::kSd2 && count_ >= kSd2Header;
  const int expected = header_over ? bytes_[1] + kSd2Frame : expected_size(bytes_[0]);
  return expected_ == expected && count_ > 0 && count_ < expected;
}

void TelegramRx::report_unsynced(Cycle now) {
  if (unsynced_ > 0) log_.at_cycle(now, Reason::kFaultyUnsynced, unsynced_);
  unsynced_ = 0;
}

}  // namespace dsdpv1::profibus
