// States of the slave, and the edge at which a telegram's effects are there (A40).
#include "model/spc3/ram_store.hpp"

#include <algorithm>

#include "model/spc3/reasons.hpp"

namespace dsdpv1::spc3 {

using profibus::kNever;

RamStore::RamStore(profibus::EventLog& log, const Config& config, Interrupt& interrupt, profibus::Station& station)
    : log_(log),
      config_(config),
      variant_(row(config.variant)),
      interrupt_(interrupt),
      station_(station),
      ram_(config),
      blocks_(ram_, log) {}

void RamStore::reset() {
  modes_ = ModeRegisters();
  user_watchdog_.reset();
  locked_ = false;
  data_exchanges_ = outputs_missed_ = 0;
  forget();
  station_.reset();
  refresh();
}

// A17, A18: buffers as after RESET.
void RamStore::forget() {
  din_.reset();
  dout_.reset();
  diag_.reset();
  blocks_.reset();
  due_ = kNever;
  events_ = 0;
  delivers_ = clears_ = has_control_ = filled_ = cfg_held_ = false;
  open_gates();
}

void RamStore::start(Cycle now) {
  if (variant_.start_clears_control) ram_.set_cell(regs::kOrgGcCommand, 0);
  locked_ = ram_.cell(regs::kOrgNoAddressChange) == regs::kAddressChangeLocked;
  if (!modes_.has0(regs::kMode0DpMode)) log_.at_cycle(now, Reason::kNoDpMode);
  station_.start(now, slave_config());
  if (config_.tsdr_at_search != 0 && modes_.min_tsdr != 0) station_.set_min_tsdr(modes_.min_tsdr);
}

void RamStore::stop(Cycle now) {
  station_.stop(now);
  eval(now);
  forget();
  modes_.clear1(regs::kMode1GoOffline);
}

void RamStore::derive() {
  ram_.set_large(variant_.has_more_modes && modes_.has2(regs::kMode2Ram4k), variant_.ram_size);
  station_.set_rules(rules());
  station_.set_baud_control(modes_.baud_control(config_));
}

void RamStore::refresh() {
  derive();
  if (!online()) return;
  if (config_.address_cells != 0) {
    locked_ = ram_.cell(regs::kOrgNoAddressChange) == regs::kAddressChangeLocked;
    station_.set_address(slave_config().address);
  }
  station_.configure(slave_config());
}

profibus::SlaveConfig RamStore::slave_config() const {
  profibus::SlaveConfig config;
  config.address = ram_.cell(regs::kOrgAddress) & profibus::kAddressMask;
  config.ident = static_cast<std::uint16_t>(ram_.word(regs::kOrgIdentLow));
  config.sync_supported = modes_.has0(regs::kMode0SyncSupported);
  config.freeze_supported = modes_.has0(regs::kMode0FreezeSupported);
  config.address_change = ram_.cell(regs::kOrgSsaPointer) != 0 && !locked_;
  return config;
}

profibus::SlaveRules RamStore::rules() const {
  profibus::SlaveRules rules;
  rules.dpv1_status = false;
  rules.has_saps = modes_.has0(regs::kMode0DpMode);
  if (variant_.has_more_modes && modes_.has2(regs::kMode2NoGcCheck)) rules.control_reserved = 0;
  rules.fresh_outputs = true;
  rules.fresh_inputs = config_.fresh_56 != 0;
  return rules;
}

// --- the slave's states ----------------------------------------------------------------------------------------------

void RamStore::entered(Cycle now, DpState from, DpState to) {
  const bool leaves = from == DpState::kDataExch;
  if (leaves) open_gates();
  if (to != DpState::kOffline && (leaves || from == DpState::kOffline)) clear_outputs(now);
  effect(now, leaves || to == DpState::kDataExch ? regs::kEventDataEx : std::uint16_t{0});
}

void RamStore::left(Cycle now, bool by_watchdog) {
  if (by_watchdog && due_ == kNever) due_ = now;
  blocks_.drop(Block::kPrm);
  blocks_.drop(Block::kCfg);
  cfg_held_ = false;
  open_gates();
  clear_outputs(now);
  effect(now, by_watchdog ? regs::kEventWdTimeout : std::uint16_t{0});
}

void RamStore::open_gates() { sync_ = freeze_ = false; }

void RamStore::baud(Cycle now, profibus::BaudIndex index) {
  if (index.known())
    effect(now, regs::kEventBaudDetect);
  else if (config_.tsdr_at_search == 0)
    station_.set_min_tsdr(modes_.default_min_tsdr(config_));  // A33
}

// --- effects ---------------------------------------------------------------------------------------------------------

// Those of the user or a watchdog join a telegram's that are on their way.
void RamStore::effect(Cycle now, std::uint16_t events) {
  events_ = static_cast<std::uint16_t>(events_ | events);
  if (due_ != kNever) return;
  due_ = by_user_ ? now : now + delay_of(config_, config_.event_delay);
}

void RamStore::eval(Cycle now) {
  if (diag_.sending() && !station_.answers() && diag_.sent()) exchange_diag();
  if (now < due_) return;
  due_ = kNever;
  if (std::exchange(delivers_, false)) deliver_outputs(false);
  if (std::exchange(clears_, false)) deliver_outputs(true);
  if (std::exchange(has_control_, false)) ram_.set_cell(regs::kOrgGcCommand, control_);
  const std::uint16_t of_blocks = blocks_.deliver();
  interrupt_.raise(static_cast<std::uint16_t>(std::exchange(events_, std::uint16_t{0}) | of_blocks));
}

// --- bytes -----------------------------------------------------------------------------------------------------------

int RamStore::length(Address cell) const { return std::min<int>(ram_.cell(cell), profibus::kMaxIo); }

// `size` bytes of a buffer after its first `skip`, copied: a buffer may go beyond the end of the RAM (A3). A4: none
// without its pointer.
View RamStore::bytes(Cycle now, Address pointer, int size, int skip) {
  if (size + skip > 0 && ram_.cell(pointer) == 0) {
    log_.at_cycle(now, Reason::kNoPointer, pointer);
    return {nullptr, View::kNoBuffer};
  }
  const int begin = ram_.buffer(pointer) + skip;
  for (int i = 0; i < size; ++i) answer_[static_cast<std::size_t>(i)] = ram_.read(begin + i);
  return {answer_.data(), size};
}

}  // namespace dsdpv1::spc3
