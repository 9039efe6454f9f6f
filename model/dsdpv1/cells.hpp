#pragma once
// Cells that only the chip may write (P6).
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

}  // namespace dsdpv1
