#include "kinds/dsdpv1/checks/user_hold.hpp"

#include <algorithm>

namespace dsdpv1::checks {

void UserHolds::began(Tick at) {
  const std::uint8_t left_1 = hold_.chip_1.after, left_2 = hold_.chip_2.after;
  hold_ = {};
  hold_.began = at;
  hold_.chip_1.before = hold_.chip_1.after = left_1;
  hold_.chip_2.before = hold_.chip_2.after = left_2;
}

const UserHold& UserHolds::ended(Tick at, HoldOf what) {
  hold_.what = what;
  hold_.ended = at;
  return hold_;
}

FlagsInHold* UserHolds::flags(Address address) {
  switch (address) {
    case regs::kChipCommand1: return &hold_.chip_1;
    case regs::kChipCommand2: return &hold_.chip_2;
    case regs::kUserCommand1: return &hold_.user_1;
    case regs::kUserCommand2: return &hold_.user_2;
    default: return nullptr;
  }
}

void UserHolds::accessed(const Access& access) { access.write ? wrote(access) : read(access); }

void UserHolds::read(const Access& access) {
  if (access.address >= kFirst) {
    read_.at(access.address / 64) |= std::uint64_t{1} << access.address % 64;
    values_.at(access.address) = access.value.value_or(0);
    any_read_ = true;
    uncertain_ = uncertain_ || !access.value;
    return;
  }
  if (!access.value) return;
  if (access.address == regs::kChipStatus1 && !cleared_initialised_)
    hold_.initialised = (*access.value & regs::kChipStatus1Initialised) != 0;
  if (access.address == regs::kAccessCount && !hold_.chip_came) hold_.chip_came = *access.value == 1;
  FlagsInHold* const byte = flags(access.address);
  if (byte == nullptr) return;
  if (!byte->looked_at()) {
    byte->read = *access.value;
    byte->before = *access.value;
  }
  byte->after = *access.value;
}

void UserHolds::wrote(const Access& access) {
  if (!access.value) return;
  note_block(access.address, *access.value);
  if (access.address == regs::kChipStatus1 && (*access.value & regs::kChipStatus1Initialised) == 0)
    cleared_initialised_ = true;
  FlagsInHold* const byte = flags(access.address);
  if (byte == nullptr) return;
  byte->after = *access.value;
  byte->written = true;
}

void UserHolds::note_block(Address address, std::uint8_t value) {
  if (address >= regs::kInit && address < regs::kInitCrc) {
    std::uint8_t& cell = init_.at(address - regs::kInit);
    init_changed_ = init_changed_ || cell != value;
    cell = value;
  }
  if (address >= regs::kC1 && address < regs::kC1Data) answers_[0].at(address - regs::kC1) = value;
  if (address >= regs::kC2 && address < regs::kC2Data) answers_[1].at(address - regs::kC2) = value;
}

void UserHolds::taken(Address command, std::uint8_t flag) {
  FlagsInHold* const byte = flags(command);
  byte->taken = static_cast<std::uint8_t>(byte->taken | flag);
  byte->after = static_cast<std::uint8_t>(byte->after & ~flag);
}

void UserHolds::announced(Address command, std::uint8_t flag) {
  FlagsInHold* const byte = flags(command);
  byte->after = static_cast<std::uint8_t>(byte->after | flag);
  byte->written = true;
}

void UserHolds::forget_reads() {
  uncertain_ = false;
  if (any_read_) read_ = {};
  any_read_ = false;
}

bool UserHolds::has_read(unsigned first, unsigned count) const {
  while (count != 0) {
    const unsigned bit = first % 64, n = std::min(64 - bit, count);
    const std::uint64_t some = (n == 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << n) - 1) << bit;
    if ((read_.at(first / 64) & some) != some) return false;
    first += n;
    count -= n;
  }
  return true;
}

std::optional<bool> UserHolds::read_all(const Block& block) const {
  if (uncertain_) return std::nullopt;
  const unsigned header = static_cast<unsigned>(block.data - block.first);
  if (!has_read(block.first, header)) return false;
  const bool only_header = block.command == regs::kChipCommand2 && values_.at(block.first) == regs::kFunctionNumRead;
  const unsigned most = static_cast<unsigned>(block.crc - block.data);
  const unsigned count = only_header ? 0 : std::min<unsigned>(values_.at(block.data - 1U), most);
  return has_read(block.data, count);
}

std::optional<AcyclicHeader> UserHolds::request_read(const Block& request) const {
  AcyclicHeader header{};
  if (uncertain_ || !has_read(request.first, header.size())) return std::nullopt;
  for (std::size_t i = 0; i < header.size(); ++i) header.at(i) = values_.at(request.first + i);
  return header;
}

}  // namespace dsdpv1::checks
