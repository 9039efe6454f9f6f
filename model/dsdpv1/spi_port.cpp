#include "model/dsdpv1/spi_port.hpp"

#include <algorithm>

#include "model/dsdpv1/reasons.hpp"

namespace dsdpv1 {
namespace {

constexpr regs::Address kOwnership = regs::kOwnership, kUTimer = regs::kUTimer;
constexpr Tick kWriteGap = 32400;  // SP9: 2.7 us

unsigned saturated(std::int64_t value) { return static_cast<unsigned>(std::min<std::int64_t>(value, 0xFFFF)); }

std::uint8_t reply_start(Command command) {
  return command == Command::kRead ? 0x80 : command == Command::kWrite ? 0xA0 : 0xC0;
}

}  // namespace

void SpiPort::reset() {
  shift_.reset();
  commit_.reset();
  frame_ = Frame::kNone;
  flip_ = false;
  gap_until_ = 0;
  write_ended_ = Wire::kLongAgo;
  frame_over_ = replies_ = frame_holds_ = claimed_ = false;
  judge_at_ = load_at_ = u_at_ = profibus::kNever;
}

Cycle SpiPort::next() const { return std::min({shift_.next(), u_at_, load_at_, judge_at_, commit_.next()}); }

void SpiPort::eval(Cycle now, const ChipSide& side) {
  shift_.eval(now);
  if (now == u_at_) end_u_timer(now);
  const bool fell = xss_ && !shift_.xss(), rose = !xss_ && shift_.xss(), byte = flip_ != shift_.flip();
  xss_ = shift_.xss();
  flip_ = shift_.flip();
  if (shift_.listening()) {
    if (fell) frame_begins(now);
    if (byte && frame_ != Frame::kNone) hand_over(now, side);
    if (rose && frame_ != Frame::kNone) frame_ends(now);
  } else if (xss_) {
    shift_.listen(now);
  }
  if (now == load_at_) {
    load_at_ = profibus::kNever;
    shift_.load(now, load_slot_, load_value_);
  }
  if (now == judge_at_) {
    judge(now, side);
    if (fell && side.owns && commit_.waits()) begins_with_wait(now);
  }
  commit_.eval(now, side.owns, side.data_exch);
}

// --- frames ----------------------------------------------------------------------------------------------------------

void SpiPort::frame_begins(Cycle now) {
  bytes_ = 0;
  telegram_.restart();
  const bool too_soon = report_gap(now);
  if (commit_.waits()) log_.at_cycle(now, Reason::kSpiWriteWaits);
  frame_ = too_soon || commit_.waits() ? Frame::kDeaf : Frame::kRequest;
}

// X at the J of a write that has to wait (5.2).
void SpiPort::begins_with_wait(Cycle now) {
  if (frame_ == Frame::kNone) return;
  log_.at_cycle(now, Reason::kSpiWriteWaits);
  frame_ = Frame::kDeaf;
}

// Whether the frame is not heard as it begins too soon after a write.
bool SpiPort::report_gap(Cycle now) {
  const bool deaf = now < gap_until_;
  const Tick ticks = shift_.fell_at() - write_ended_;
  if (deaf || ticks < kWriteGap) log_.at_cycle(now, Reason::kSpiWriteGap, saturated(ticks), kWriteGap, deaf);
  return deaf;
}

void SpiPort::hand_over(Cycle now, const ChipSide& side) {
  const int slot = bytes_++;
  if (frame_ == Frame::kRequest)
    take_request(now);
  else if (frame_ == Frame::kComplete && replies_) {
    load_at_ = now + 1;
    load_slot_ = slot;
    load_value_ = next_reply_byte(side);
  }
}

void SpiPort::take_request(Cycle now) {
  const bool complete = telegram_.add(shift_.byte());
  if (bytes_ == 1) {
    if (!telegram_.is_telegram()) log_.at_cycle(now, Reason::kTelegramStart, shift_.byte());
    if (!telegram_.is_telegram() || !telegram_.is_for(address_)) frame_ = Frame::kDeaf;
    return;
  }
  if (!complete) return;
  frame_ = Frame::kComplete;
  request_ = telegram_.request();
  frame_over_ = replies_ = false;
  judge_at_ = now + 1;
  if (request_.command == Command::kRead) return;
  gap_until_ = now + config_.spi_write_gap;
  write_ended_ = shift_.byte_at();
}

void SpiPort::frame_ends(Cycle now) {
  shift_.clear_tx(now);
  load_at_ = profibus::kNever;
  if (frame_ == Frame::kRequest && bytes_ > 0)
    log_.at_cycle(now, Reason::kTelegramCut, static_cast<unsigned>(bytes_), static_cast<unsigned>(telegram_.bytes()));
  if (frame_ == Frame::kComplete) {
    frame_over_ = true;
    if (replies_) report_cut(now, bytes_ - request_.bytes - static_cast<int>(config_.spi_reply_gap));
  }
  replies_ = frame_holds_ = false;
  frame_ = Frame::kNone;
}

// --- judgement -------------------------------------------------------------------------------------------------------

void SpiPort::judge(Cycle now, const ChipSide& side) {
  judge_at_ = profibus::kNever;
  bool good = false;
  std::uint8_t code = kCrcWrong;
  if (request_.crc_right())
    code = judge_right(now, side, good);
  else
    log_.at_cycle(now, Reason::kTelegramCrc, request_.crc, request_.computed);
  begin_reply(now, side, good, code);
}

std::uint8_t SpiPort::judge_right(Cycle now, const ChipSide& side, bool& good) {
  const std::uint8_t code = telegram_.judge(request_, now, log_);
  good = code == 0 && !refused(now, side);
  if (good) carry_out(now);
  restart_u_timer(now);
  return code;
}

// SP9, SP13, SP16.
bool SpiPort::refused(Cycle now, const ChipSide& side) {
  if (request_.command == Command::kRead) return false;
  const bool claims = request_.command == Command::kWrite && request_.covers(kOwnership) &&
                      (telegram_.data()[kOwnership - request_.base()] & regs::kOwnershipHost) != 0;
  const bool exchange = request_.command == Command::kExchange;
  if (commit_.busy())
    log_.at_cycle(now, Reason::kSpiBusy, 2);
  else if (side.owns && (claims || exchange))
    log_.at_cycle(now, Reason::kSpiBusy, exchange ? 1 : 0);
  else
    return false;
  return true;
}

void SpiPort::carry_out(Cycle now) {
  if (request_.command == Command::kExchange) {
    commit_.read_and_write(now, request_, telegram_.data());
    frame_holds_ = !frame_over_;
    return;
  }
  report_no_claim(now);
  if (request_.command == Command::kRead) return;
  if (request_.covers(kOwnership))
    set_claimed(now, (telegram_.data()[kOwnership - request_.base()] & regs::kOwnershipHost) != 0);
  commit_.write(now, request_, telegram_.data(), kOwnership);
}

void SpiPort::report_no_claim(Cycle now) {
  const bool only_ownership = request_.base() == kOwnership && request_.length == 1;
  if (claimed_ || only_ownership) return;
  log_.at_cycle(now, Reason::kSpiNoClaim, request_.address, static_cast<unsigned>(request_.length),
                request_.command == Command::kWrite);
}

void SpiPort::set_claimed(Cycle now, bool claimed) {
  if (claimed == claimed_) return;
  claimed_ = claimed;
  if (claimed) {
    claimed_at_ = now;
    log_.at_cycle(now, Reason::kSpiClaimed);
  } else {
    log_.at_cycle(now, Reason::kSpiReleased, saturated(now - claimed_at_));
  }
}

// --- reply -----------------------------------------------------------------------------------------------------------

void SpiPort::begin_reply(Cycle now, const ChipSide& side, bool good, std::uint8_t code) {
  int data = 0;
  if (good && request_.command == Command::kRead) data = request_.length;
  if (good && request_.command == Command::kExchange) data = SpiReply::kOutputs;
  const unsigned start = (good ? reply_start(request_.command) : 0xE0U) + static_cast<unsigned>(address_);
  reply_.begin(static_cast<std::uint8_t>(start), code, data, static_cast<int>(config_.spi_reply_gap));
  if (frame_over_) return report_cut(now, 0);
  replies_ = true;
  for (const int slot : {request_.bytes, request_.bytes + 1}) shift_.load(now, slot, next_reply_byte(side));
}

std::uint8_t SpiPort::next_reply_byte(const ChipSide& side) {
  const int wanted = reply_.wants();
  if (wanted < 0) return reply_.take(0);
  const regs::Address base = request_.command == Command::kExchange ? regs::kOutput : request_.base();
  return reply_.take(read(static_cast<regs::Address>(base + wanted), side));
}

std::uint8_t SpiPort::read(regs::Address address, const ChipSide& side) const {
  if (address == kOwnership) return ownership(side.owns);
  return side.starts_up ? std::uint8_t{0} : ram_.read(address);
}

void SpiPort::report_cut(Cycle now, int sent) {
  const int size = reply_.size();
  if (size == 0 || sent < size)
    log_.at_cycle(now, Reason::kSpiReplyCut, static_cast<unsigned>(std::max(sent, 0)), static_cast<unsigned>(size));
}

// --- U_Timer ---------------------------------------------------------------------------------------------------------

void SpiPort::restart_u_timer(Cycle now) {
  const bool runs = config_.u_timer > 0 && claimed_ && (ram_.read(kUTimer) & regs::kUTimerEnable) != 0;
  u_at_ = runs ? now + config_.u_timer : profibus::kNever;
}

void SpiPort::end_u_timer(Cycle now) {
  u_at_ = profibus::kNever;
  claimed_ = false;
  log_.at_cycle(now, Reason::kSpiUTimer, saturated(config_.u_timer));
}

}  // namespace dsdpv1
