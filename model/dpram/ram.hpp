#pragma once
// The 2 KB dual-port RAM of the family. A cell that the user wrote with violated timing keeps the captured value and is
// marked unknown until the next correct write (ruling P11).
#include <array>
#include <bitset>

#include "registers/dsdpv1_regs.hpp"

namespace dsdpv1::dpram {

class Ram {
 public:
  std::uint8_t read(regs::Address address) const { return cells_[index(address)]; }
  void write(regs::Address address, std::uint8_t value) {
    cells_[index(address)] = value;
    unknown_.reset(index(address));
  }
  /// All cells, for the owner of the RAM; a write of theirs leaves the marks.
  std::uint8_t* cells() { return cells_.data(); }
  void mark_unknown(regs::Address address) { unknown_.set(index(address)); }
  bool unknown(regs::Address address) const { return unknown_.test(index(address)); }

  template <class Archive>
  void store(Archive& archive) {
    auto& [cells, unknown] = *this;
    archive(cells);
    archive.bits(unknown);
  }

 private:
  static constexpr std::size_t index(regs::Address address) { return address % regs::kDpramSize; }

  std::array<std::uint8_t, regs::kDpramSize> cells_{};
  std::bitset<regs::kDpramSize> unknown_;
};

}  // namespace dsdpv1::dpram
