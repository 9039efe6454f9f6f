#include "kinds/spc3/checks/use_rules.hpp"

#include <fmt/format.h>

#include <string>

namespace dsdpv1::spc3_checks {

void UseRules::accessed(const RegisterAccess& access, bool may_resize) {
  recorder_.kept(Check::kUseRam, access.at, access.address < chip_.ram_end(), [&] {
    return fmt::format("{:03X}H is beyond the RAM, which ends at {:03X}", access.address, chip_.ram_end());
  });
  if (!chip_.online()) return;
  if (access.address < regs::kBuffers) return organisation(access, may_resize);
  data(access, false);
  if (!access.write) return;
  data(access, true);
  diagnosis(access);
}

/// A write of the same value changes nothing.
void UseRules::organisation(const RegisterAccess& access, bool may_resize) {
  const bool is_mode0 = access.address == regs::kMode0 || access.address == regs::kMode0 + 1;
  const bool is_cell = access.address >= regs::kOrg && access.address <= regs::kOrgSpecPrmLength;
  if (!access.write || (!is_mode0 && !is_cell)) return;
  const bool kept = is_cell && (chip_.cell(access.address) == access.value || may_write(access.address, may_resize));
  recorder_.kept(Check::kUseOrganisation, access.at, kept,
                 [&] { return fmt::format("{:02X} to {:02X}H online", access.value, access.address); });
}

bool UseRules::may_write(Address address, bool may_resize) const {
  if (address == regs::kOrgReadCfgLength) return true;
  if (address == regs::kOrgDiagLength + chip_.diag_user() - 1) return true;
  return may_resize && address >= regs::kOrgDoutLength && address < regs::kOrgDinPointer + 3;
}

void UseRules::data(const RegisterAccess& access, bool inputs) {
  const int length = chip_.cell(inputs ? regs::kOrgDinLength : regs::kOrgDoutLength);
  const int user = inputs ? chip_.din_user() : chip_.dout_user();
  for (int number = 1; number <= 3; ++number) {
    const int pointer = (inputs ? regs::kOrgDinPointer : regs::kOrgDoutPointer) + number - 1;
    if (!chip_.buffer(static_cast<Address>(pointer), length).has(access.address)) continue;
    recorder_.kept(Check::kUseData, access.at, number == user, [&] {
      return fmt::format("{:03X}H is in buffer {} of {}, the user's is {}", access.address, number,
                         inputs ? "Din" : "Dout", user);
    });
  }
}

void UseRules::diagnosis(const RegisterAccess& access) {
  for (int number = 1; number <= 2; ++number) {
    const auto length = static_cast<Address>(regs::kOrgDiagLength + number - 1);
    const auto pointer = static_cast<Address>(regs::kOrgDiagPointer + number - 1);
    if (!chip_.buffer(pointer, chip_.cell(length)).has(access.address)) continue;
    recorder_.kept(Check::kUseDiag, access.at, number == chip_.diag_user(), [&] {
      return fmt::format("{:03X}H is in diagnosis buffer {}, {}", access.address, number,
                         chip_.diag_user() == 0 ? "New_Diag has answered 0" : "which is the chip's");
    });
  }
}

}  // namespace dsdpv1::spc3_checks
