#pragma once
// The RAM from 16H on. From an address beyond its end 400H is subtracted, and the violation is noted until it is taken
// (A3).
#include <array>
#include <cstddef>
#include <utility>

#include "model/spc3/config.hpp"

namespace dsdpv1::spc3 {

class Ram {
 public:
  static constexpr int kLargest = 0x1000;
  static constexpr int kNone = -1;

  explicit Ram(const Config& config) : size_(row(config.variant).ram_size) { fill(config.ram_seed); }

  /// 4 KB in segments of 16 bytes (mode register 2 bit 7), or the size of the name in segments of 8.
  void set_large(bool large, int size) {
    size_ = large ? kLargest : size;
    shift_ = large ? 4 : 3;
  }

  /// Without effect on the violation.
  std::uint8_t peek(int address) const { return bytes_[index(address)]; }
  void poke(int address, std::uint8_t value) { bytes_[index(address)] = value; }
  std::uint8_t read(int address) { return bytes_[checked(address)]; }
  void write(int address, std::uint8_t value) { bytes_[checked(address)] = value; }

  // Cells of the organisation.
  std::uint8_t cell(Address address) const { return bytes_[address]; }
  void set_cell(Address address, std::uint8_t value) { bytes_[address] = value; }
  unsigned word(Address low) const { return cell(low) | static_cast<unsigned>(cell(low + 1)) << 8; }
  void swap_cells(Address a, Address b) { std::swap(bytes_[a], bytes_[b]); }
  /// The first byte of the buffer to which a cell points.
  int buffer(Address pointer) const { return cell(pointer) << shift_; }
  /// The 8 bytes of a segment, none of which is beyond the end.
  std::uint8_t* segment(int address) { return &bytes_[checked(address)]; }

  /// The address that is accessed instead of one beyond the end.
  int inside(int address) const { return static_cast<int>(index(address)); }
  /// The first address beyond the end since the last call; kNone: none.
  int take_violation() { return std::exchange(violation_, kNone); }

  template <class Archive>
  void store(Archive& archive) {
    auto& [bytes, size, shift, violation] = *this;
    archive(bytes);
    archive.given(size, shift);
    archive.within(kNone, 2 * kLargest, violation);
  }

 private:
  std::size_t index(int address) const {
    while (address >= size_) address -= kStep;
    return static_cast<std::size_t>(address);
  }
  std::size_t checked(int address) {
    if (address >= size_ && size_ < kLargest && violation_ == kNone) violation_ = address;
    return index(address);
  }
  void fill(std::uint32_t seed);

  static constexpr int kStep = 0x400;
  std::array<std::uint8_t, kLargest> bytes_{};
  int size_, shift_ = 3;
  int violation_ = kNone;
};

// A9: zeros, or bytes of a linear congruence.
inline void Ram::fill(std::uint32_t seed) {
  if (seed == 0) return;
  for (std::uint8_t& byte : bytes_) {
    seed = seed * 1664525U + 1013904223U;
    byte = static_cast<std::uint8_t>(seed >> 24);
  }
}

}  // namespace dsdpv1::spc3
