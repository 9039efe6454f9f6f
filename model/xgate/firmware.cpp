#include "model/xgate/firmware.hpp"

#include <algorithm>

#include "model/xgate/reasons.hpp"

namespace dsdpv1::xgate {
namespace {

constexpr Cycle kWatchdogUnit = 10 * profibus::kCyclesPerMs;

}  // namespace

void Firmware::set_reset(Cycle now, bool low) {
  const bool is_low = state_ == ModuleState::kReset;
  if (low == is_low) return;
  bus_.reset();
  link_.reset();
  leds_.reset();
  given_ = dog_on_ = bitten_ = false;
  shown_until_ = dog_ends_ = profibus::kNever;
  opens_ = low ? profibus::kNever : now + config_.power_up;
  state_ = low ? ModuleState::kReset : ModuleState::kPower;
}

// --- the host --------------------------------------------------------------------------------------------------------

void Firmware::receive(Cycle now, std::uint8_t byte) {
  if (serves() && !link_.receive(now, byte)) log_.at_cycle(now, Reason::kLost, byte);
}

void Firmware::end_byte(Cycle now, std::uint8_t mosi) {
  if (serves()) link_.end_byte(now, mosi);
}

bool Firmware::interrupt() const {
  const bool answer = config_.port == Port::kSpi && link_.answer_waits();
  return serves() && (bus_.wants_host() || bitten_ || answer);
}

/// The answer to the command on the line (4.3.1). Each bears the flag of an acknowledged alarm until a command has it.
void Firmware::carry_out(Cycle now) {
  const Frame& frame = link_.command();
  feed(now);
  answer_.command = frame.command;
  answer_.data.size = 0;
  Error wrong = link_.fault();
  if (!wrong) wrong = run(now, frame);
  answer_.special = static_cast<std::uint8_t>(kOneSegment | (bus_.acknowledged() ? kAlarmFlag : 0));
  if (wrong) {
    log_.at_cycle(now, Reason::kError, frame.command, wrong.type, wrong.code);
    compose_error(frame.command, answer_.special, wrong, config_.errors, link_.wire());
  } else {
    compose(answer_, link_.wire());
  }
  link_.answer(now);
}

// --- time ------------------------------------------------------------------------------------------------------------

void Firmware::eval(Cycle now) {
  if (now >= opens_) {
    opens_ = profibus::kNever;
    state_ = config_pin_low_ ? ModuleState::kConfiguring : ModuleState::kReady;
  }
  if (now >= shown_until_) shown_until_ = profibus::kNever;
  bus_.eval(now);
  watch(now);
  link_.eval(now);
  if (link_.due(now)) carry_out(now);
}

Cycle Firmware::next(Cycle now) const {
  return std::min({opens_, bus_.next(), dog_ends_, shown_until_, link_.next(), leds_.next(shown_leds(), now)});
}

/// X12: the host has been silent for too long.
void Firmware::watch(Cycle now) {
  if (now < dog_ends_) return;
  dog_ends_ = profibus::kNever;
  bitten_ = true;
  log_.at_cycle(now, Reason::kWatchdog, dog_value_);
  if (started()) bus_.leave_master(now);
}

void Firmware::feed(Cycle now) {
  bitten_ = false;
  shown_until_ = now + config_.host_shown;
  const bool watches = dog_on_ && config_.watchdog == WatchdogUse::kHost;
  dog_ends_ = watches ? now + dog_value_ * kWatchdogUnit : profibus::kNever;
}

/// Table 2.3, X26.
ShownLeds Firmware::shown_leds() const {
  using profibus::DpState;
  const DpState dp = bus_.state();
  const bool runs = started(), prm = runs && dp == DpState::kWaitPrm, cfg = runs && dp == DpState::kWaitCfg,
             data = runs && dp == DpState::kDataExch;
  const bool tool = state_ == ModuleState::kConfiguring, host = shown_until_ != profibus::kNever;
  return {{{prm || data, data}, {prm || cfg, false}, {tool || host, true}, {tool || (data && !host), true}}};
}

}  // namespace dsdpv1::xgate
