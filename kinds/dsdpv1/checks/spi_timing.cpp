#include "kinds/dsdpv1/checks/spi_timing.hpp"

#include <fmt/format.h>

#include <utility>

#include "bus/time_text.hpp"

namespace dsdpv1::checks {

void SpiTiming::record(Check check, Tick at, Tick measured) {
  recorder_.get().value(
      check, at, measured, [this] { return fmt::format("bit {} of the frame", bits_); });
}

void SpiTiming::pin(Tick at, Pin pin, Level level) {
  end_frame_before(at);
  switch (pin) {
    case Pin::kXss: return xss(at, level != 0);
    case Pin::kSck: return level != 0 ? sck_rose(at) : sck_fell(at);
    case Pin::kMosi: return mosi_changed(at);
    case Pin::kMiso: return miso_changed(at, level >= 0);
    default: return;
  }
}

void SpiTiming::xss(Tick at, bool level) {
  if (level) {
    rose_ = at;
    lag_due_ = true;
    return;
  }
  bits_ = 0;
  if (rose_ != kNotYet) record(Check::kXssGap, at, at - rose_);
  fell_ = at;
  rose_ = kNotYet;
  sck_rose_.reset();
  sck_fell_.reset();
  hold_.reset();
}

void SpiTiming::end_frame_before(Tick at) {
  if (!lag_due_ || rose_ >= at) return;
  lag_due_ = false;
  hold_.reset();
  if (sck_fell_) record(Check::kXssLag, rose_, rose_ - *sck_fell_);
}

void SpiTiming::sck_rose(Tick at) {
  if (!selected(at)) return;
  if (bits_ == 0)
    record(Check::kXssLead, at, at - fell_);
  else if (sck_fell_)
    record(Check::kSckLow, at, at - *sck_fell_);
  if (sck_rose_) record(Check::kSckPeriod, at, at - *sck_rose_);
  if (hold_) record(Check::kMosiHold, *hold_, at - *hold_);  // stable at least until now
  const bool together = mosi_changed_ == at;
  record(Check::kMosiSetup, at, at - (together ? mosi_changed_before_ : mosi_changed_));
  hold_.reset();
  if (together)
    record(Check::kMosiHold, at, 0);
  else
    hold_ = at;
  sck_rose_ = at;
  ++bits_;
}

void SpiTiming::sck_fell(Tick at) {
  if (!selected(at) || !sck_rose_) return;
  record(Check::kSckHigh, at, at - *sck_rose_);
  sck_fell_ = at;
}

void SpiTiming::mosi_changed(Tick at) {
  if (mosi_changed_ != at) mosi_changed_before_ = std::exchange(mosi_changed_, at);
  if (!hold_ || !selected(at)) return;
  record(Check::kMosiHold, *hold_, at - *hold_);
  hold_.reset();
}

/// At XSS's edges MISO is driven or released, which is not a bit.
void SpiTiming::miso_changed(Tick at, bool driven) {
  if (!driven || !selected(at) || !sck_fell_) return;
  const Tick delay = at - *sck_fell_;
  recorder_.get().kept(Check::kMisoDelay, at, delay <= Tick{settings_.get().spi_miso_delay}, [this, delay] {
    return fmt::format("bit {} of the frame after {}", bits_, bus::short_time(delay));
  });
}

void SpiTiming::finish(Tick end) { end_frame_before(end + 1); }

}  // namespace dsdpv1::checks
