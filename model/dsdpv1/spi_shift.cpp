#include "model/dsdpv1/spi_shift.hpp"

#include <algorithm>

#include "model/dsdpv1/reasons.hpp"

namespace dsdpv1 {

void SpiShift::reset() {
  listening_ = false;
  bits_ = bits_before_ = 0;
  bits_at_ = byte_at_ = rose_at_ = sck_rise_ = sck_fall_ = sck_fall_before_ = Wire::kLongAgo;
  flip_ = hold_due_ = false;
  flip_seen_ = profibus::Synchroniser(false);
  tx_ = tx_before_ = {0xFF, 0xFF};
  miso_ = kLevelZ;
  pending_count_ = 0;
}

void SpiShift::listen(Cycle now) {
  listening_ = true;
  listening_since_ = now * profibus::kTicksPerCycle;
  rose_at_ = Wire::kLongAgo;
  bits_ = bits_before_ = 0;
  if (!xss_.level()) {
    miso_ = 1;
    first_rise_ = true;
  }
}

Level SpiShift::level(Pin pin) const {
  switch (pin) {
    case Pin::kXss: return xss_.level();
    case Pin::kSck: return sck_.level();
    case Pin::kMosi: return mosi_.level();
    default: return miso_;
  }
}

// --- XSS -------------------------------------------------------------------------------------------------------------

void SpiShift::set_xss(Tick at, bool level) {
  if (level == xss_.level()) return;
  if (!listening_) xss_seen_.eval(at / profibus::kTicksPerCycle);  // in reset it is not called elsewhere
  xss_.set(at, level);
  xss_seen_.set(at, level);
  if (!level) fell_at_ = at;
  if (!listening_) return;
  level ? end_frame(at) : begin_frame(at);
}

void SpiShift::begin_frame(Tick at) {
  report(at, Reason::kSpiXssHigh, at - rose_at_, strobe_);
  if (sck_.before(at) && at > listening_since_) log_.at_tick(at, Reason::kSpiSckIdle, 0);
  bits_ = bits_before_ = 0;
  bits_at_ = at;
  first_rise_ = true;
  hold_due_ = false;
  sck_rise_ = sck_fall_ = sck_fall_before_ = Wire::kLongAgo;
  miso_ = 1;
}

// An edge of SCK at the same tick counts, whichever is reported first.
void SpiShift::end_frame(Tick at) {
  const unsigned bits = bits_at_ == at ? bits_before_ : bits_;
  const Tick fall = sck_fall_ == at ? sck_fall_before_ : sck_fall_;
  report(at, Reason::kSpiXssLag, at - fall, strobe_);
  if (sck_.before(at)) log_.at_tick(at, Reason::kSpiSckIdle, 1);
  if (bits % 8 != 0) log_.at_tick(at, Reason::kSpiBits, bits % 8, bits / 8);
  rose_at_ = at;
  if (bits_at_ != at) bits_before_ = bits_;
  bits_at_ = at;
  bits_ = 0;
  miso_ = kLevelZ;
  pending_count_ = 0;
}

// --- SCK, MOSI -------------------------------------------------------------------------------------------------------

void SpiShift::set_sck(Tick at, bool level) {
  if (level == sck_.level()) return;
  sck_.set(at, level);
  if (!listening_ || at <= listening_since_ || xss_.before(at)) return;
  level ? rise(at) : fall(at);
}

void SpiShift::rise(Tick at) {
  if (first_rise_)
    report(at, Reason::kSpiXssLead, at - fell_at_, strobe_);
  else
    report(at, Reason::kSpiSckLow, at - sck_fall_, strobe_);
  first_rise_ = false;
  const bool ended = xss_.level();  // at this tick, told before
  const unsigned bits = ended ? bits_before_ : bits_;
  sck_rise_ = at;
  rise_bit_ = bits;
  check_data(at);
  shift_ = static_cast<std::uint8_t>(shift_ << 1 | (mosi_.before(at) ? 1 : 0));
  if (!ended) {
    bits_before_ = bits_;
    bits_at_ = at;
    bits_ = bits + 1;
  }
  if ((bits + 1) % 8 != 0) return;
  byte_ = shift_;
  byte_at_ = at;
  flip_ = !flip_;
  flip_seen_.set(at, flip_);
}

void SpiShift::check_data(Tick at) {
  report(at, Reason::kSpiMosiSetup, at - mosi_.changed_before(at), data_, rise_bit_);
  hold_due_ = !mosi_.changes(at);
  if (mosi_.changes(at)) report(at, Reason::kSpiMosiHold, 0, data_, rise_bit_);
}

void SpiShift::fall(Tick at) {
  const unsigned bits = xss_.level() ? bits_before_ : bits_;
  report(at, Reason::kSpiSckHigh, at - sck_rise_, strobe_);
  if (bits == 0) return;
  sck_fall_before_ = sck_fall_;
  sck_fall_ = at;
  if (xss_.level()) return;  // MISO is released at this tick
  const std::array<std::uint8_t, 2>& tx = loaded_at_ == at ? tx_before_ : tx_;
  const unsigned bit = 7 - bits % 8;
  if (pending_count_ < kPending)
    pending_[pending_count_++] = {at + delay_, static_cast<Level>(tx[bits / 8 % 2] >> bit & 1)};
}

void SpiShift::set_mosi(Tick at, bool level) {
  if (level == mosi_.level()) return;
  mosi_.set(at, level);
  if (!hold_due_ || !listening_ || xss_.before(at)) return;
  hold_due_ = false;
  report(at, Reason::kSpiMosiHold, at - sck_rise_, data_, rise_bit_);
}

void SpiShift::report(Tick at, profibus::Reason reason, Tick seen, std::uint32_t limit, unsigned bit) {
  if (seen < limit) log_.at_tick(at, reason, static_cast<unsigned>(seen), limit, bit);
}

// --- MISO ------------------------------------------------------------------------------------------------------------

void SpiShift::keep_tx(Cycle now) {
  const Tick at = now * profibus::kTicksPerCycle;
  if (loaded_at_ != at) tx_before_ = tx_;
  loaded_at_ = at;
}

void SpiShift::load(Cycle now, int slot, std::uint8_t value) {
  keep_tx(now);
  tx_.at(static_cast<std::size_t>(slot % 2)) = value;
}

void SpiShift::clear_tx(Cycle now) {
  keep_tx(now);
  tx_ = {0xFF, 0xFF};
}

void SpiShift::drive() {
  miso_ = pending_[0].level;
  std::copy(pending_.begin() + 1, pending_.begin() + pending_count_, pending_.begin());
  --pending_count_;
}

}  // namespace dsdpv1
