#pragma once
// Cells that only the chip may write, and those whose bits only the chip may set (P6).
#include <array>

#include "model/dpram/ram.hpp"

namespace dsdpv1 {

namespace detail {
constexpr std::array<bool, regs::kDpramSize> make_chips_cells() {
  std::array<bool, regs::kDpramSize> cells{};
  for (const regs::Cell& cell : regs::kMap)
    for (std::size_t address = cell.first; address <= cell.last; ++address)
      cells[address] = cell.chip_writes && !cell.user_writes;
  return cells;
}
inline constexpr std::array<bool, regs::kDpramSize> kChipsCells = make_chips_cells();
}  // namespace detail

/// A write by the user has no meaning (P6).
inline bool chips_own(regs::Address address) { return detail::kChipsCells[address % regs::kDpramSize]; }

/// The user may clear bits of these cells but sets none.
inline bool chip_sets_bits(regs::Address address) {
  switch (address % regs::kDpramSize) {
    case regs::kChipStatus1:
    case regs::kChipStatus2:
    case regs::kChipCommand1:
    case regs::kChipCommand2: return true;
    default: return false;
  }
}

/// Those bits that a write by the user sets but may not.
inline std::uint8_t bits_set(regs::Address address, std::uint8_t before, std::uint8_t written) {
  return chip_sets_bits(address) ? static_cast<std::uint8_t>(written & ~before) : std::uint8_t{0};
}

}  // namespace dsdpv1
