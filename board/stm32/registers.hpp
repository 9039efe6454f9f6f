#pragma once
// The registers of a peripheral, declared once, as RM0008 has them (STM32F103xE): a table in the peripheral's .cpp.
// Fields that the board does not follow are tagged there; the end of a run names those that the firmware asked for.
#include <array>
#include <cstdint>
#include <initializer_list>
#include <vector>

namespace dsdpv1::arm {

struct RegisterEntry {
  std::uint32_t offset = 0;
  const char* name = nullptr;
  std::uint32_t reset = 0;
  std::uint32_t writable = 0;  ///< bits that keep what is written; all others stay
};

/// A field that the board does not follow.
struct Tag {
  std::uint32_t offset = 0;
  unsigned bit = 0, bits = 1;  ///< its lowest bit, and how many
  const char* name = nullptr;
  std::uint32_t as = 0;    ///< the value that the board behaves as
  std::uint32_t with = 0;  ///< bits of the register: the field means nothing while all of them are 0

  std::uint32_t value_in(std::uint32_t word) const { return word >> bit & ((2U << (bits - 1)) - 1); }
};

using RegisterList = std::initializer_list<RegisterEntry>;
using TagList = std::initializer_list<Tag>;

/// Both lists outlive it.
class RegisterTable {
 public:
  constexpr RegisterTable(RegisterList registers, TagList tags) : registers_(registers), tags_(tags) {
    for (const RegisterEntry& each : registers)
      if (each.offset < kQuick) plain_ |= 1U << each.offset / 4;
    for (const Tag& each : tags)
      if (each.offset < kQuick) plain_ &= ~(1U << each.offset / 4);
  }
  constexpr RegisterList registers() const { return registers_; }
  /// A quick answer for most accesses: there is a register, and it has no tags.
  bool is_plain(std::uint32_t offset) const { return offset < kQuick && (plain_ >> offset / 4 & 1U) != 0; }
  /// Null: no register is there.
  const RegisterEntry* find(std::uint32_t offset) const;
  /// Tags that `word`, written there, gives another value than the board's.
  std::vector<const Tag*> asked(std::uint32_t offset, std::uint32_t word) const;

 private:
  static constexpr std::uint32_t kQuick = 32 * 4;
  RegisterList registers_;
  TagList tags_;
  std::uint32_t plain_ = 0;  ///< by word
};

/// Values of the registers of a table, `kWords` words from offset 0 on.
template <const RegisterTable& kTable, std::size_t kWords>
class RegisterWords {
 public:
  // NOLINTBEGIN(readability-redundant-parentheses): clang sees some round kTable
  RegisterWords() {
    for (const RegisterEntry& each : kTable.registers()) words_.at(each.offset / 4) = each.reset;
  }
  std::uint32_t& operator[](std::uint32_t offset) { return words_[offset / 4]; }
  std::uint32_t operator[](std::uint32_t offset) const { return words_[offset / 4]; }
  /// 0 where no register is.
  std::uint32_t read(std::uint32_t offset) const { return offset / 4 < kWords ? words_[offset / 4] : 0; }
  void write(std::uint32_t offset, std::uint32_t value) {
    if (const RegisterEntry* to = kTable.find(offset))
      words_[offset / 4] = (words_[offset / 4] & ~to->writable) | (value & to->writable);
  }
  // NOLINTEND(readability-redundant-parentheses)

 private:
  std::array<std::uint32_t, kWords> words_{};
};

}  // namespace dsdpv1::arm
