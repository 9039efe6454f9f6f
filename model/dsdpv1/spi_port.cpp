#include "model/dsdpv1/spi_port.hpp"

#include <algorithm>

#include "model/dsdpv1/reasons.hpp"

namespace dsdpv1 {
namespace {

constexpr Tick kWriteGap = 32400;  // SP9: 2.7 us

unsigned saturated(std::int64_t value) { return static_cast<unsigned>(std::min<std::int64_t>(value, 0xFFFF)); }

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

// A frame begins (X) at the judgement (J) of a write that must wait (5.2).
void SpiPort::begins_with_wait(Cycle now) {
  if (frame_ == Frame::kNone) return;
  log_.at_cycle(now, Reason::kSpiWriteWaits);
  frame_ = Frame::kDeaf;
}

// Reports a frame that begins too soon after a write. Returns true if it must be ignored.
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

// --- ownership ------------------------------------------------------------------------------------------------------

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

// --- U_Timer ---------------------------------------------------------------------------------------------------------

void SpiPort::restart_u_timer(Cycle now) {
  const bool runs = config_.u_timer > 0 && claimed_ && (ram_.read(regs::kUTimer) & regs::kUTimerEnable) != 0;
  u_at_ = runs ? now + config_.u_timer : profibus::kNever;
}

void SpiPort::end_u_timer(Cycle now) {
  u_at_ = profibus::kNever;
  claimed_ = false;
  log_.at_cycle(now, Reason::kSpiUTimer, saturated(config_.u_timer));
}

}  // namespace dsdpv1
