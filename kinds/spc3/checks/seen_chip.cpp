#include "kinds/spc3/checks/seen_chip.hpp"

namespace dsdpv1::spc3_checks {
namespace {

constexpr int kDiagBuffers = 2;
/// The user's buffer in an answer of New_Din, Next_Dout, New_Diag.
constexpr int user_in(std::uint8_t answer) { return answer & regs::kSmD; }

}  // namespace

std::optional<std::uint16_t> events_in(const RegisterAccess& access) {
  if (access.write || access.address > regs::kIr + 1) return std::nullopt;
  return static_cast<std::uint16_t>((access.address & 1U) != 0 ? access.value << 8 : access.value);
}

void SeenChip::reset() {
  offline();
  mode0_ = {};
  mode1_ = 0;
  mode2_ = regs::kMode2Reset;
  res_user_wd_.reset();
  mac_reset_ = false;
}

void SeenChip::offline() {
  online_ = has_inputs_ = false;
  dout_user_ = din_user_ = 2;
  diag_user_ = 1;
  diag_next_ = 0;
}

// --- memory ----------------------------------------------------------------------------------------------------------

int SeenChip::ram_end() const { return is_large() ? static_cast<int>(cells_.size()) : variant_.ram_size; }

std::size_t SeenChip::inside(int address) const {
  while (address >= ram_end()) address -= kStep;
  return static_cast<std::size_t>(address);
}

Span SeenChip::buffer(Address pointer, int length) const {
  const int begin = cell(pointer) << shift();
  return {begin, begin + length};
}

std::optional<std::uint16_t> SeenChip::mode0() const {
  if (!mode0_[0] || !mode0_[1]) return std::nullopt;
  return static_cast<std::uint16_t>(*mode0_[0] | *mode0_[1] << 8);
}

bool SeenChip::takes_res_user_wd(Tick at) {
  const bool takes = res_user_wd_ && *res_user_wd_ <= at;
  if (takes) res_user_wd_.reset();
  return takes;
}

// --- accesses --------------------------------------------------------------------------------------------------------

bool SeenChip::starts(const RegisterAccess& access) const {
  return access.write && access.address == regs::kMode1S && (access.value & regs::kMode1Start) != 0 && !online_;
}

void SeenChip::accessed(const RegisterAccess& access) {
  if (starts(access)) start();
  if (access.address < regs::kOrg) return access.write ? written(access) : read(access);
  cells_.at(inside(access.address)) = access.value;
  known_.set(inside(access.address));
}

/// From now on the chip writes outputs.
void SeenChip::start() {
  online_ = true;
  for (Address i = 0; i < regs::kOrgDoutPointerSize; ++i) {
    const auto pointer = static_cast<Address>(regs::kOrgDoutPointer + i);
    const Span outputs = buffer(pointer, cell(regs::kOrgDoutLength));
    for (int address = outputs.begin; address < outputs.end; ++address) known_.reset(inside(address));
  }
}

void SeenChip::written(const RegisterAccess& access) {
  const std::uint8_t value = access.value;
  switch (access.address) {
    case regs::kIrr: mac_reset_ = mac_reset_ && (value & regs::kEventMacReset) != 0; return;
    case regs::kIar: mac_reset_ = mac_reset_ && (value & regs::kEventMacReset) == 0; return;
    case regs::kMode0:
    case regs::kMode0 + 1:
      if (!online_) mode0_.at(access.address & 1U) = value;
      return;
    case regs::kMode1S:
      mode1_ |= value;
      if ((value & regs::kMode1ResUserWd) != 0 && !res_user_wd_) res_user_wd_ = access.at;
      return;
    case regs::kMode1R:
      mode1_ &= static_cast<std::uint8_t>(~value);
      if ((value & regs::kMode1ResUserWd) != 0) res_user_wd_.reset();
      return;
    case regs::kMode2: mode2_ = value; return;
    default: return;
  }
}

void SeenChip::read(const RegisterAccess& access) {
  const std::uint8_t value = access.value;
  if (const auto events = events_in(access)) return look_at_events(*events, access.address);
  switch (access.address) {
    case regs::kStatus:
      if ((value & regs::kStatusPassiveIdle) == 0) offline();
      return;
    case regs::kDinSm: din_user_ = (value & regs::kSmU) >> regs::kSmUShift; return;
    case regs::kNewDin:
      din_user_ = user_in(value);
      has_inputs_ = true;
      return;
    case regs::kDoutSm: dout_user_ = (value & regs::kSmU) >> regs::kSmUShift; return;
    case regs::kNextDout: dout_user_ = user_in(value); return;
    case regs::kDiagSm:
      return diag_is((value & regs::kDiagSmFirst) == regs::kDiagOwnerUser                                ? 1
                     : (value & regs::kDiagSmSecond) >> regs::kDiagSmSecondShift == regs::kDiagOwnerUser ? 2
                                                                                                         : 0);
    case regs::kNewDiag: return diag_is(user_in(value));
    default: return;
  }
}

void SeenChip::diag_is(int user) {
  if (user == 0 && diag_user_ != 0) diag_next_ = kDiagBuffers + 1 - diag_user_;
  diag_user_ = user;
}

/// MAC_Reset counts once; an old Diag_Buffer_Changed, which the user has left, may let a write pass.
void SeenChip::look_at_events(std::uint16_t events, Address address) {
  if ((events & regs::kEventDiagChanged) != 0 && diag_user_ == 0) diag_user_ = diag_next_;
  const bool mac_reset = (events & regs::kEventMacReset) != 0;
  if (mac_reset && !mac_reset_) offline();
  if (mac_reset || address == regs::kIrr) mac_reset_ = mac_reset;
}

}  // namespace dsdpv1::spc3_checks
