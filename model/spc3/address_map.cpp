#include "model/spc3/address_map.hpp"

#include "model/spc3/reasons.hpp"

namespace dsdpv1::spc3 {
namespace {

using profibus::kNever;

// Bits of mode register 1 that the user sets and clears; bit 7 of the VPC3+ has no effect.
constexpr std::uint8_t kStays = regs::kMode1EnChangeCfg | regs::kMode1ResUserWd | 0x80;

constexpr std::uint8_t byte_of(std::uint16_t word, bool high) {
  return static_cast<std::uint8_t>(high ? word >> 8 : word & 0xFF);
}
constexpr bool is_high(Address address) { return (address & 1U) != 0; }

}  // namespace

void AddressMap::reset() {
  stops_ = violated_ = false;
  user_timer_ = touched_ = kNever;
}

Address AddressMap::in_map(Address address) const { return static_cast<Address>(address % addresses(config_.variant)); }

// --- the read side ---------------------------------------------------------------------------------------------------

std::uint8_t AddressMap::read(Cycle now, Address address) {
  touched_ = now;
  address = in_map(address);
  if (address < regs::kOrg) {
    store_.set_by_user(true);
    const std::uint8_t answer = command(now, address);
    store_.set_by_user(false);
    return answer;
  }
  constexpr Address kErrorCounters = 0x7FC, kErrorCountersEnd = 0x800;
  if (variant_.has_more_modes && address >= kErrorCounters && address < kErrorCountersEnd)
    log_.at_cycle(now, Reason::kErrorCounter, address);
  const std::uint8_t value = store_.ram().read(address);
  take_violation(now);
  return value;
}

std::uint8_t AddressMap::command(Cycle now, Address address) {
  switch (address) {
    case regs::kNewDin: return store_.new_din(now);
    case regs::kNextDout: return store_.next_dout();
    case regs::kNewDiag: return store_.new_diag(now);
    case regs::kPrmOk: return store_.prm_verdict(now, true);
    case regs::kPrmNotOk: return store_.prm_verdict(now, false);
    case regs::kCfgOk: return store_.cfg_verdict(now, true);
    case regs::kCfgNotOk: return store_.cfg_verdict(now, false);
    case regs::kSsaFree: return store_.free_ssa();
    default: return peek(address);
  }
}

bool AddressMap::is_command(Address address) {
  return address == regs::kNewDin || address == regs::kNextDout || address == regs::kSsaFree ||
         (address >= regs::kNewDiag && address <= regs::kCfgNotOk);
}

std::uint8_t AddressMap::peek(Address address) const {
  address = in_map(address);
  const bool high = is_high(address), more = variant_.has_more_modes;
  switch (address) {
    case regs::kIrr:
    case regs::kIrr + 1: return byte_of(interrupt_.irr(), high);
    case regs::kIr:
    case regs::kIr + 1: return byte_of(interrupt_.ir(), high);
    case regs::kStatus:
    case regs::kStatus + 1: return status(high);
    case regs::kMode0:
    case regs::kMode0 + 1: return more ? byte_of(store_.modes().mode0, high) : std::uint8_t{0};
    case regs::kDinSm: return store_.din().states().code();
    case regs::kDoutSm: return store_.dout().states().code();
    case regs::kDiagSm: return store_.diag().code();
    case regs::kMode1Read: return more ? mode1() : std::uint8_t{0};
    default: return address < regs::kOrg ? std::uint8_t{0} : store_.ram().peek(address);
  }
}

// M table 4.4; A8.
std::uint8_t AddressMap::status(bool high) const {
  const DpState state = station_.slave().state();
  const bool online = state != DpState::kOffline;
  if (high) {
    const unsigned rate = static_cast<unsigned>(online ? station_.tried().code() : profibus::kBaudUnknown.code());
    return static_cast<std::uint8_t>(rate | (variant_.has_more_modes ? config_.type : 0U) << 4);
  }
  if (!online) return static_cast<std::uint8_t>((store_.diag().flag() ? 4U : 0U) | (violated_ ? 8U : 0U));
  const unsigned dp = static_cast<unsigned>(state) - static_cast<unsigned>(DpState::kWaitPrm);
  return static_cast<std::uint8_t>(1U | (store_.diag().flag() ? 4U : 0U) | (violated_ ? 8U : 0U) | dp << 4 |
                                   static_cast<unsigned>(station_.watchdog()) << 6);
}

std::uint8_t AddressMap::mode1() const {
  return static_cast<std::uint8_t>(store_.modes().mode1 | (store_.online() ? regs::kMode1Start : 0U));
}

// --- the write side --------------------------------------------------------------------------------------------------

void AddressMap::write(Cycle now, Address address, std::uint8_t value) {
  touched_ = now;
  address = in_map(address);
  if (address >= regs::kOrg) return write_cell(now, address, value);
  store_.set_by_user(true);
  write_register(now, address, value);
  store_.set_by_user(false);
}

void AddressMap::write_register(Cycle now, Address address, std::uint8_t value) {
  const bool high = is_high(address);
  ModeRegisters& modes = store_.modes();
  switch (address) {
    case regs::kIrr:
    case regs::kIrr + 1: return interrupt_.set_irr(high, value);
    case regs::kIar:
    case regs::kIar + 1: return interrupt_.acknowledge(static_cast<std::uint16_t>(high ? value << 8 : value));
    case regs::kImr:
    case regs::kImr + 1: return interrupt_.set_imr(high, value);
    case regs::kMode0:
    case regs::kMode0 + 1: return write_mode0(now, address, value);
    case regs::kMode1S: return set_mode1(now, value);
    case regs::kMode1R: return modes.clear1(value & kStays);
    case regs::kWdBaudControl: modes.wd_baud_control = value; return store_.refresh();
    case regs::kMinTsdr: modes.min_tsdr = value; return station_.set_min_tsdr(value);
    case regs::kMode2:
      if (!variant_.has_more_modes) return;
      modes.mode2 = value;
      return store_.refresh();
    case regs::kMode3: modes.mode3 = value; return;
    default: return;
  }
}

void AddressMap::write_mode0(Cycle now, Address address, std::uint8_t value) {
  if (store_.online()) return log_.at_cycle(now, Reason::kMode0Online, address, value);
  if (is_high(address) && (value & regs::kMode0WdTest >> 8) != 0) log_.at_cycle(now, Reason::kWdTest);
  store_.modes().set_mode0(is_high(address), value);
  store_.refresh();
}

// A55: START when OFFLINE, else Go_Offline.
void AddressMap::set_mode1(Cycle now, std::uint8_t bits) {
  const bool online = store_.online();
  store_.modes().set1(bits & kStays);
  if ((bits & regs::kMode1Eoi) != 0) interrupt_.end(now, store_.modes().eoi_gap(config_));
  if (!online) {
    if ((bits & regs::kMode1Start) != 0) start(now);
    return;
  }
  if ((bits & regs::kMode1UserLeaveMaster) != 0) station_.leave_master(now);
  if ((bits & regs::kMode1GoOffline) != 0) {
    stops_ = true;
    store_.modes().set1(regs::kMode1GoOffline);
  } else if ((bits & regs::kMode1Start) != 0) {
    log_.at_cycle(now, Reason::kStartOnline);
  }
}

void AddressMap::write_cell(Cycle now, Address address, std::uint8_t value) {
  if (store_.online() && address < regs::kBuffers && !may_write(address))
    log_.at_cycle(now, Reason::kOrganisationOnline, address, value);
  store_.ram().write(address, value);
  take_violation(now);
  if (address < regs::kBuffers) store_.refresh();
}

// A5.
bool AddressMap::may_write(Address address) const {
  constexpr Address kSpare = 0x3E;
  if (address == regs::kOrgReadCfgLength || address >= kSpare) return true;
  if (address == regs::kOrgDiagLength + store_.diag().user() - 1) return true;
  const bool is_io = address >= regs::kOrgDoutLength && address < regs::kOrgDinPointer + 3;
  return is_io && station_.slave().state() == DpState::kWaitCfg;
}

void AddressMap::poke(Address address, std::uint8_t value) {
  address = in_map(address);
  if (address < regs::kOrg) return;
  store_.ram().poke(address, value);
  if (address < regs::kBuffers) store_.refresh();
}

// --- MAC -------------------------------------------------------------------------------------------------------------

void AddressMap::start(Cycle now) {
  violated_ = stops_ = false;
  log_.at_cycle(now, Reason::kStart, store_.ram().cell(regs::kOrgAddress), store_.ram().word(regs::kOrgIdentLow));
  store_.start(now);
  begin_timer(now);
}

void AddressMap::stop(Cycle now) {
  stops_ = false;
  user_timer_ = kNever;
  store_.set_by_user(true);
  store_.stop(now);
  store_.set_by_user(false);
  interrupt_.raise(regs::kEventMacReset);
  log_.at_cycle(now, Reason::kOffline);
}

void AddressMap::take_violation(Cycle now) {
  const int address = store_.ram().take_violation();
  if (address == Ram::kNone) return;
  log_.at_cycle(now, Reason::kRamViolation, static_cast<unsigned>(address), static_cast<unsigned>(variant_.ram_size),
                static_cast<unsigned>(store_.ram().inside(address)));
  violated_ = true;
  if (config_.violation != 0) return;
  if (store_.online())
    stops_ = true;
  else
    interrupt_.raise(regs::kEventMacReset);
}

void AddressMap::eval(Cycle now) {
  if (now == touched_) touched_ = kNever;
  take_violation(now);
  if (stops_ && station_.quiet(now) && store_.next() == kNever) stop(now);
  if (now < user_timer_) return;
  interrupt_.raise(regs::kEventUserTimer);
  begin_timer(now);
}

void AddressMap::begin_timer(Cycle now) {
  const int ms = store_.modes().has0(regs::kMode0UserTimeBase) ? 10 : 1;
  user_timer_ = variant_.has_user_timer ? now + ms * profibus::kCyclesPerMs : kNever;
}

}  // namespace dsdpv1::spc3
