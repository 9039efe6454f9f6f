#include "kinds/dsdpv1/checks/cell_rules.hpp"

#include <fmt/format.h>

namespace dsdpv1::checks {
namespace {

/// The meaningful bits of B00A..B011, by the side that sets them.
struct FlagByte {
  Address address;
  std::uint8_t chip_sets, user_sets;
  bool user_only;  ///< the chip never writes it
};
constexpr std::array<FlagByte, 8> kFlags = {{
    {regs::kChipStatus1, regs::kChipStatus1Initialised, 0, false},
    {regs::kChipStatus2,
     regs::kChipStatus2InitCrc | regs::kChipStatus2InputCrc | regs::kChipStatus2DiagCrc | regs::kChipStatus2C1Crc |
         regs::kChipStatus2C2Crc,
     0, false},
    {regs::kUserStatus1, 0, 0, true},
    {regs::kUserStatus2, 0, 0, true},
    {regs::kChipCommand1, regs::kChipCommand1Output | regs::kChipCommand1Prm | regs::kChipCommand1Cfg, 0, false},
    {regs::kChipCommand2, regs::kChipCommand2C1 | regs::kChipCommand2C2, 0, false},
    {regs::kUserCommand1, 0,
     regs::kUserCommand1Input | regs::kUserCommand1Diag | regs::kUserCommand1Init | regs::kUserCommand1CfgVerdict |
         regs::kUserCommand1PrmVerdict,
     false},
    {regs::kUserCommand2, 0, regs::kUserCommand2C1 | regs::kUserCommand2C2 | regs::kUserCommand2InputClear, false},
}};

bool is_command_of_chip(Address address) { return address == regs::kChipCommand1 || address == regs::kChipCommand2; }
bool is_command_of_user(Address address) { return address == regs::kUserCommand1 || address == regs::kUserCommand2; }

constexpr std::uint8_t bits(unsigned value) { return static_cast<std::uint8_t>(value); }

}  // namespace

CellRules::CellRules(Recorder& recorder) : recorder_(recorder) {
  for (const regs::Cell& cell : regs::kMap) {
    for (unsigned address = cell.first; address <= cell.last; ++address) {
      chip_writes_[address] = cell.chip_writes;
      only_chip_writes_[address] = cell.chip_writes && !cell.user_writes;
    }
  }
  reset();
}

void CellRules::reset() {
  cells_ = {};
  known_ = ~chip_writes_;
  hold_ = {};
  count_left_.reset();
  flags_left_ = {};
  fetched_ = {};
}

void CellRules::hold_began() {
  known_ &= ~chip_writes_;
  hold_ = {};
}

void CellRules::hold_ended(Tick at) {
  if (hold_.accesses == 0) return;
  check_count(at);
  check_crcs_written(at);
  check_crcs_fetched(at);
  check_verdicts(at);
  hold_ = {};
}

std::optional<std::uint8_t> CellRules::look(Address address) const {
  return known_[address] ? std::optional(cells_.at(address)) : std::nullopt;
}

void CellRules::learn(Address address, const std::optional<std::uint8_t>& value) {
  known_[address] = value.has_value();
  if (value) cells_.at(address) = *value;
  if (value && address >= kFirstFlags && address <= kLastFlags) flags_left_.at(address - kFirstFlags) = *value;
}

void CellRules::accessed(const Access& access) {
  ++hold_.accesses;
  access.write ? wrote(access) : read(access);
}

// --- reads -----------------------------------------------------------------------------------------------------------

void CellRules::read(const Access& access) {
  if (access.address == regs::kAccessCount) count_read(access);
  if (access.address >= kFirstFlags && access.address <= kLastFlags) check_what_chip_did(access);
  if (access.address >= regs::kOutput) note_read_of_block(access.address);
  learn(access.address, access.value);
}

void CellRules::count_read(const Access& access) {
  const bool first = !hold_.count && !hold_.counted_unknown && hold_.increments + hold_.wrong_counts == 0;
  hold_.count = access.value;
  hold_.counted_unknown = !access.value;
  if (!first || !access.value) return;
  recorder_.kept(Check::kCountByChip, access.began, *access.value == 1 || access.value == count_left_, [&] {
    return fmt::format("B006 is {:02X}, neither 01 nor {}", *access.value,
                       count_left_ ? fmt::format("{:02X}, which the user left", *count_left_) : "written by the user");
  });
}

void CellRules::note_read_of_block(Address address) {
  for (std::size_t i = 0; i < kChipBlocks.size(); ++i) {
    const Block& block = kChipBlocks.at(i);
    if (address < block.first || address > block.crc + 1) continue;
    if (address < block.data) hold_.header_read.set(i);
    if (address >= block.data && address < block.crc) hold_.data_read.set(i);
    if (address == block.crc) hold_.crc_high_read.set(i);
    if (address == block.crc + 1) hold_.crc_low_read.set(i);
  }
}

/// The first read in a hold shows how the chip changed the values that the user left.
void CellRules::check_what_chip_did(const Access& access) {
  const std::size_t place = access.address - kFirstFlags;
  if (hold_.flags_seen[place] || !access.value) return;
  hold_.flags_seen.set(place);
  const FlagByte& flags = kFlags.at(place);
  const std::uint8_t left = flags_left_.at(place), now = *access.value;
  std::uint8_t wrong = 0;
  if (flags.user_only) wrong = bits(left ^ now);
  if (is_command_of_chip(access.address)) wrong = bits(left & ~now & flags.chip_sets);
  if (is_command_of_user(access.address)) wrong = bits(now & ~left & flags.user_sets);
  if (!flags.user_only && !is_command_of_chip(access.address) && !is_command_of_user(access.address)) return;
  recorder_.kept(Check::kFlagByChip, access.began, wrong == 0,
                 [&] { return fmt::format("B{:03X} is {:02X}, the user left {:02X}", access.address, now, left); });
}

// --- writes ----------------------------------------------------------------------------------------------------------

void CellRules::wrote(const Access& access) {
  check_whose_cell(access);
  if (access.address == regs::kAccessCount) count_written(access);
  if (access.address >= kFirstFlags && access.address <= kLastFlags) {
    const std::optional<std::uint8_t> before = look(access.address);
    hold_.flags_seen.set(access.address - kFirstFlags);
    if (access.value && before) check_what_user_did(access, *before);
    if (access.value) note_announcements(access, before);
    if (access.value && access.address == regs::kUserCommand1) note_verdicts(*access.value, before.value_or(0));
    if (access.value && access.address == regs::kChipCommand1) note_fetched(*access.value, before);
  }
  for (std::size_t i = 0; i < kUserBlocks.size(); ++i) {
    const Block& block = kUserBlocks.at(i);
    if (access.address >= block.first && access.address <= block.crc + 1) hold_.written.set(i);
  }
  learn(access.address, access.value);
}

/// P6: of cells with flags of the chip the user only clears bits, also reserved ones. FLAG_BY_USER judges the flags.
void CellRules::check_whose_cell(const Access& access) {
  const bool has_flags = access.address >= kFirstFlags && access.address <= kLastFlags;
  const std::uint8_t of_chip = has_flags ? kFlags.at(access.address - kFirstFlags).chip_sets : std::uint8_t{0};
  const std::optional<std::uint8_t> before = of_chip != 0 ? look(access.address) : std::nullopt;
  const std::uint8_t set = before && access.value ? bits(*access.value & ~*before & ~of_chip) : bits(0);
  recorder_.kept(Check::kCellOfChip, access.at, !only_chip_writes_[access.address] && set == 0, [&] {
    return set == 0 ? fmt::format("the user writes B{:03X}", access.address)
                    : fmt::format("the user sets bits {:02X} of B{:03X}", set, access.address);
  });
}

void CellRules::count_written(const Access& access) {
  count_left_ = access.value;
  if (hold_.counted_unknown || !access.value) {
    hold_.counted_unknown = true;  // a result computed from X is not judged
    return;
  }
  const bool right = hold_.count && *access.value == bits(*hold_.count + 1U);
  ++(right ? hold_.increments : hold_.wrong_counts);
  hold_.count = access.value;
}

/// A new initialisation may withdraw earlier announcements (D11).
void CellRules::check_what_user_did(const Access& access, std::uint8_t before) {
  const FlagByte& flags = kFlags.at(access.address - kFirstFlags);
  if (flags.user_only) return;
  const std::uint8_t now = *access.value;
  const std::uint8_t set = bits(now & ~before & flags.chip_sets), cleared = bits(before & ~now & flags.user_sets);
  const bool initialises = access.address == regs::kUserCommand1 && (now & regs::kUserCommand1Init) != 0;
  const bool right = set == 0 && (cleared == 0 || initialises);
  recorder_.kept(Check::kFlagByUser, access.at, right, [&] {
    return fmt::format("the user writes {:02X} to B{:03X}, which is {:02X}", now, access.address, before);
  });
}

void CellRules::note_announcements(const Access& access, std::optional<std::uint8_t> before) {
  const std::uint8_t now = *access.value;
  for (std::size_t i = 0; i < kUserBlocks.size(); ++i) {
    const Block& block = kUserBlocks.at(i);
    if (block.command != access.address) continue;
    const bool announced = (now & block.flag) != 0 && (!before || (*before & block.flag) == 0 || hold_.written[i]);
    hold_.announced[i] = announced || (hold_.announced[i] && (now & block.flag) != 0);
  }
  for (std::size_t i = 0; i < kChipBlocks.size(); ++i) {
    const Block& block = kChipBlocks.at(i);
    if (block.command != access.address || !before) continue;
    if ((*before & ~now & block.flag) != 0) hold_.flag_cleared.set(i);
  }
}

// --- the end of a hold -----------------------------------------------------------------------------------------------

void CellRules::check_count(Tick at) {
  if (hold_.counted_unknown) return;
  const bool counted = hold_.increments + hold_.wrong_counts != 0;
  recorder_.kept(
      Check::kCountByUser, at, hold_.increments == 1 && hold_.wrong_counts == 0,
      [this] {
        if (hold_.wrong_counts != 0) return std::string("B006 was written with another value than the one read plus 1");
        return fmt::format("B006 was incremented {} times in a hold of {} accesses", hold_.increments, hold_.accesses);
      },
      counted ? Act::written(regs::kAccessCount, at) : Act::done(at));
}

void CellRules::check_crcs_written(Tick at) {
  for (std::size_t i = 0; i < kUserBlocks.size(); ++i)
    if (hold_.announced[i]) check_crc_written(kUserBlocks.at(i), at);
}

void CellRules::check_crc_written(const Block& block, Tick at) {
  const Look cell = [this](Address address) { return look(address); };
  const std::optional<unsigned> count = covered(block, cell);
  const std::optional<std::uint16_t> right = count ? crc_over(block.first, *count, cell) : std::nullopt;
  const auto high = look(block.crc), low = look(static_cast<Address>(block.crc + 1));
  if (!right || !high || !low) return;
  const auto written = static_cast<std::uint16_t>(*high << 8 | *low);
  const bool exchanged = written == static_cast<std::uint16_t>(*right << 8 | *right >> 8);
  recorder_.kept(
      Check::kCrcWritten, at, written == *right,
      [&] {
        return fmt::format("{}: CRC {:04X} in B{:03X}, {:04X} is right for {} bytes from B{:03X}{}", block.name,
                           written, block.crc, *right, *count, block.first,
                           exchanged ? ": its bytes are exchanged" : "");
      },
      Act::written(block.command, at));
}

/// Reading only the length is not a fetch, unless the flag is cleared with it.
void CellRules::check_crcs_fetched(Tick at) {
  for (std::size_t i = 0; i < kChipBlocks.size(); ++i) {
    const bool fetched = hold_.data_read[i] || (hold_.header_read[i] && hold_.flag_cleared[i]);
    if (!fetched) continue;
    const Block& block = kChipBlocks.at(i);
    recorder_.kept(
        Check::kCrcFetched, at, hold_.crc_high_read[i] && hold_.crc_low_read[i],
        [&block] { return fmt::format("{} fetched without the CRC in B{:03X}", block.name, block.crc); },
        hold_.flag_cleared[i] ? Act::written(block.command, at) : Act::done(at));
  }
}

// --- verdicts --------------------------------------------------------------------------------------------------------

/// A verdict that was set before does not belong to this hold, and one withdrawn in it does not count.
void CellRules::note_verdicts(std::uint8_t now, std::uint8_t before) {
  for (std::size_t i = 0; i < kJudgedBlocks.size(); ++i) {
    const std::uint8_t given = kJudgedBlocks.at(i).verdict;
    hold_.verdicts[i] = (now & given) != 0 && ((before & given) == 0 || hold_.verdicts[i]);
  }
}

void CellRules::note_fetched(std::uint8_t now, const std::optional<std::uint8_t>& before) {
  for (std::size_t i = 0; i < kJudgedBlocks.size(); ++i) {
    const std::uint8_t flag = kJudgedBlocks.at(i).block.flag;
    if ((now & flag) == 0 && (!before || (*before & flag) != 0)) fetched_.set(i);
  }
}

/// True if the block's flag is set. If it was set before and not read in this hold, it still is, because only the user
/// clears it. Otherwise a newer block may have come; but a user who has cleared nothing since the last verdict has
/// fetched nothing.
std::optional<bool> CellRules::stands_unfetched(std::size_t verdict) const {
  constexpr std::size_t kPlace = regs::kChipCommand1 - kFirstFlags;
  const bool stood = (flags_left_.at(kPlace) & kJudgedBlocks.at(verdict).block.flag) != 0;
  if (stood || hold_.flags_seen[kPlace]) return stood;
  return fetched_[verdict] ? std::nullopt : std::optional(true);
}

/// At the release: the order of writes within the hold does not matter, because the chip sees them all at once.
void CellRules::check_verdicts(Tick at) {
  for (std::size_t i = 0; i < kJudgedBlocks.size(); ++i) {
    if (!hold_.verdicts[i]) continue;
    if (const std::optional<bool> stands = stands_unfetched(i))
      recorder_.kept(
          Check::kVerdictUnfetched, at, !*stands,
          [this, &judged = kJudgedBlocks.at(i)] {
            const auto& [block, verdict] = judged;
            const bool seen = (flags_left_.at(regs::kChipCommand1 - kFirstFlags) & block.flag) != 0;
            const std::string flag = flag_name(block.command, block.flag);
            return fmt::format(
                "verdict on the {} ({}), {}", block.name, flag_name(regs::kUserCommand1, verdict),
                seen ? "whose flag " + flag + " still stands" : "and " + flag + " was not cleared since the last one");
          },
          Act::written(regs::kUserCommand1, at));
    fetched_.reset(i);
  }
}

}  // namespace dsdpv1::checks
