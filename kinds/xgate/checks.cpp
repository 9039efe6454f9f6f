#include "kinds/xgate/checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>

namespace dsdpv1::xgate_checks {

Checks::Checks(const checks::Limits& limits, const tb::PinTable& pins, const xgate::Config& config, unsigned spi_mode)
    : PinFrames(config, spi_mode),
      sck_takes_at_(spi_mode == 0 || spi_mode == 3),
      history_(pins),
      recorder_(rules(), limits, history_),
      own_rate_limit_(recorder_.limit(Check::kLineRate).value != checks::kNoLimit),
      own_gap_limit_(recorder_.limit(Check::kFrameGap).value != checks::kNoLimit),
      rxd_(timing()),
      link_(recorder_, this->config()) {
  if (recorder_.limit(Check::kResetAwaited).value == checks::kNoLimit)
    recorder_.set_limit(Check::kResetAwaited, Tick{config.power_up} * profibus::kTicksPerCycle);
  follow_rate();
}

/// The limits follow the rate, unless the scenario has them.
void Checks::follow_rate() {
  rxd_.set_timing(timing());
  link_.set_times(longest_gap(), by_spi() ? 0 : rxd_.bit() / 2);
  if (!own_rate_limit_) recorder_.set_limit(Check::kLineRate, rxd_.bit() / 3);
  if (!own_gap_limit_) recorder_.set_limit(Check::kFrameGap, longest_gap());
}

bool Checks::applies(checks::CheckId check) const {
  switch (static_cast<Check>(check.index)) {
    case Check::kLineRate:
    case Check::kLineStop:
    case Check::kAnswerAwaited: return !by_spi();
    case Check::kSckPeriod:
    case Check::kNssBytes: return by_spi();
    default: return true;
  }
}

/// Time passes with these pins alone: a wave or a trace brings the others, too, and finds the same.
void Checks::pin(Tick at, tb::PinNumber pin, tb::Level level) {
  if ((watched() & tb::mask_of(pin)) == 0) return;
  advance(at);
  history_.add(at, pin, level);
  if (pin == kit::kReset) reset(at, level == 0);
  PinFrames::pin(at, pin, level);
  if (in_reset_) return;
  switch (pin) {
    case xgate::kInt: return link_.interrupt(at, level == 0);
    case xgate::kHostRxd: return by_spi() ? void() : rxd_.change(at, level != 0);
    case xgate::kSck: return sck(at, level != 0);
    case xgate::kNss: selected_ = level == 0; return taken_.reset();
    default: return;
  }
}

void Checks::reset(Tick at, bool low) {
  in_reset_ = low;
  rxd_.restart();
  selected_ = false;
  taken_.reset();
  link_.reset(at, low);
}

/// The pins' bytes first: a frame may end before.
void Checks::advance(Tick at) {
  recorder_.now(at);
  if (in_reset_) return;
  if (const auto byte = rxd_.pass(at)) {
    recorder_.value(
        Check::kLineRate, byte->begin, byte->off, [] { return std::string("an edge in the byte"); });
    recorder_.kept(Check::kLineStop, byte->begin, byte->stop_ok, [] { return std::string("the stop bit is low"); });
  }
  PinFrames::run(at - 1);
  link_.pass(at);
}

// --- SPI -------------------------------------------------------------------------------------------------------------

void Checks::sck(Tick at, bool level) {
  if (!selected_ || level != sck_takes_at_) return;
  if (taken_) recorder_.value(Check::kSckPeriod, at, at - *taken_, [] { return std::string("in a frame of NSS"); });
  taken_ = at;
}

void Checks::nss_rose(Tick at, unsigned bits) {
  recorder_.kept(
      Check::kNssBytes, at, bits % 8 == 0, [&] { return fmt::format("after {} bits of a byte", bits % 8); });
}

// --- time ------------------------------------------------------------------------------------------------------------

void Checks::telegram(Tick now, const bus::WireTelegram& /*telegram*/) { advance(now); }

void Checks::finish(Tick end) {
  advance(end);
  if (!in_reset_) PinFrames::run(end + 1);
}

}  // namespace dsdpv1::xgate_checks
