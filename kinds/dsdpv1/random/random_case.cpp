// Builds a random case: reset, the way to data exchange, episodes, a reset again.
#include "kinds/dsdpv1/random/random_case.hpp"

#include <utility>

#include "cosim/random/random_cases.hpp"

namespace dsdpv1::cosim {
namespace {

std::unique_ptr<RandomHost> make_host(Random& random, Stimulus& stimulus, HostMode mode, Part part) {
  if (mode == HostMode::kSpi) return make_random_spi(random, stimulus);
  if (mode == HostMode::kUart) return make_random_uart(random, stimulus);
  return make_random_parallel(random, stimulus, part);
}

SearchTimes times_of(const dsdpv1::Config& config) {
  return {config.search_window_ms * bus::kTicksPerMs, config.baud_control_ms * bus::kTicksPerMs,
          static_cast<int>(config.search_window_bits)};
}

constexpr int kReady = 4200;    // cycles: B004 is C5 (H6)
constexpr int kFastEnough = 3;  // slowest rate at which reaching data exchange takes no longer than a case at 12 Mbit/s

}  // namespace

RandomCase::RandomCase(std::uint64_t seed, const tb::Dsdpv1Settings& chip)
    : leading_(chip.mode == HostMode::kParallel ? seed % kLedCases : 0),
      random_(seed),
      master_(random_, setup_, stimulus_, times_of(chip)),
      host_(make_host(random_, stimulus_, chip.mode, chip.part)),
      user_(random_, setup_, *host_) {}

Stimulus RandomCase::make() {
  power_on(leading_ != 0);
  if (!host_->is_quick()) return host_only();
  if (leading_ != 0) episode(kLeading[leading_ - 1]);
  for (int i = leading_ != 0 ? 0 : random_.between(1, 3); i > 0; --i) episode(any_theme());
  sync();
  host_->give();
  host_->break_rules();
  if (leading_ == 0 && random_.one_in(2)) reset_amid();
  return std::move(stimulus_);
}

/// For hosts whose telegrams last as long as thousands on the line.
Stimulus RandomCase::host_only() {
  for (int i = random_.between(1, 2); i > 0; --i) user_.anything();
  return std::move(stimulus_);
}

/// An initialisation, a baud rate, usually data exchange, and then the theme.
void RandomCase::episode(const Theme& theme) {
  come_up(theme);
  (this->*theme.play)();
  sync();
}

// --- the way up ------------------------------------------------------------------------------------------------------

void RandomCase::push_reset(AccessPart part, Tick within) {
  constexpr int kLongest = 20'000;  // ticks
  Action reset;
  reset.verb = Verb::kReset;
  reset.low = random_.between(1, kLongest);
  reset.during = item_of(part);
  reset.within = within;
  stimulus_.push_back(reset);
}

void RandomCase::power_on(bool sure) {
  host_->strap();
  const bool held = !sure && random_.one_in(6);
  if (held) host_->hold_through_reset();
  push_reset();
  sync();
  if (held) host_->wait(random_.between(0, kReady));
  if (held) host_->give();
  // Sometimes the user acts before the chip is ready (H6).
  host_->wait(!sure && random_.one_in(4) ? random_.between(0, kReady) : kReady);
}

/// In the right order most of the time: later steps go wrong often enough.
void RandomCase::come_up(const Theme& theme) {
  theme_ = &theme;
  setup_ = user_.any_setup();
  (this->*theme.prepare)();
  const bool sure = theme.weight == 0;
  careful(sure || !random_.one_in(6));
  master_.sure(sure);
  master_.forget_series();
  if (setup_.dpv1) user_.enable_dpv1(0x1D);  // before the initialisation (D17)
  user_.initialise();
  sync();
  if (!sure && random_.one_in(12)) user_.initialise();
  if (!sure) host_->wait(200);
  sync();
  (master_.*theme.find_rate)();
  if (setup_.rate <= kFastEnough && (sure || !random_.one_in(12))) bring_up();
  careful(false);
}

/// The usual way to data exchange, with the user's verdicts if the modes require them.
void RandomCase::bring_up() {
  if (random_.one_in(2)) master_.slave_diag();
  const bool held = random_.one_in(4);  // both blocks wait until the user releases the DPRAM
  if (held) host_->take();
  sync();
  master_.set_prm(true);
  sync();
  if (!held) host_->wait(300);
  if (setup_.prm_mode == 2) user_.verdict(true, false, !random_.one_in(8));
  sync();
  master_.check_cfg(true);
  sync();
  if (held) host_->give();
  host_->wait(300);
  if (setup_.cfg_mode == 2) user_.verdict(false, true, !random_.one_in(8));
  sync();
  if (random_.one_in(2)) master_.slave_diag();
  for (int i = random_.between(0, 3); i > 0; --i) master_.data_exchange();
}

/// From any other state.
void RandomCase::reach(DpState state) {
  sync();
  if (state == DpState::kWaitPrm) return master_.unlock();
  master_.set_prm(true);
  verdict(true, false);
  if (state == DpState::kWaitCfg) return;
  master_.check_cfg(true);
  verdict(false, true);
}

/// Accepts the blocks that the user judges.
void RandomCase::verdict(bool prm, bool cfg) {
  sync();
  if ((prm ? setup_.prm_mode : setup_.cfg_mode) != 2) return;
  host_->wait(300);
  user_.verdict(prm, cfg, true);
  sync();
}

void RandomCase::reset() {
  sync();
  host_->give();
  power_on();
  setup_ = user_.any_setup();
  user_.initialise();
  host_->wait(200);
  sync();
  master_.choose_rate();
}

/// RESET falls during telegrams, blocks of the user and accesses of the chip (H6, P10).
void RandomCase::reset_amid() {
  constexpr int kWhile = 300'000;  // ticks: a telegram at 12 Mbit/s, or a block
  sync();
  random_.one_in(3) ? master_.set_prm(true) : random_.one_in(2) ? master_.check_cfg(true) : master_.data_exchange();
  random_.one_in(2) ? user_.inputs() : user_.anything();
  push_reset();
  stimulus_.back().delay = random_.below(kWhile);
  sync();
  host_->give();
  if (random_.one_in(2)) return host_->wait(kReady);
  push_reset();
  stimulus_.back().delay = random_.below(4096 * static_cast<int>(profibus::kTicksPerCycle));  // in the start-up
  sync();
  host_->wait(kReady);
}

}  // namespace dsdpv1::cosim
