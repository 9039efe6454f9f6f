#pragma once
// The ten bit rates, in the order of table 5 (and of the search), from 12 Mbit/s down to 9.6 kbit/s.
#include <array>
#include <cstddef>

#include "model/profibus/fdl_times.hpp"

namespace dsdpv1::profibus {

constexpr int kBaudCount = 10;

/// Cycles per bit (ruling S2).
constexpr std::array<int, kBaudCount> kBitCycles = {4, 8, 16, 32, 96, 256, 512, 1056, 2500, 5000};
/// max_TSDR in bit times (ruling S3, chapter 11's GSD).
constexpr std::array<int, kBaudCount> kMaxTsdr = {800, 450, 250, 150, 100, 60, 60, 250, 60, 60};

/// One of the ten rates, or none during the search. No other value can be made.
class BaudIndex {
 public:
  constexpr BaudIndex() = default;  ///< none
  static constexpr BaudIndex fastest() { return BaudIndex(0); }
  /// The next rate of the search: the next slower one, after the slowest the fastest.
  constexpr BaudIndex next() const { return known() && code_ + 1 < kBaudCount ? BaudIndex(code_ + 1) : fastest(); }

  constexpr bool known() const { return code_ < kBaudCount; }
  /// Table 5: 0 = 12 Mbit/s ... 9 = 9.6 kbit/s, 15 = none.
  constexpr int code() const { return code_; }

  // Only for a known rate.
  constexpr int bit_cycles() const { return kBitCycles[static_cast<std::size_t>(code_)]; }
  constexpr int max_tsdr() const { return kMaxTsdr[static_cast<std::size_t>(code_)]; }

  template <class Archive>
  void store(Archive& archive) {
    auto& [code] = *this;
    archive.within(0, 15, code);
    archive.check(known() || *this == BaudIndex());
  }

  friend constexpr bool operator==(BaudIndex a, BaudIndex b) { return a.code_ == b.code_; }
  friend constexpr bool operator!=(BaudIndex a, BaudIndex b) { return !(a == b); }

 private:
  explicit constexpr BaudIndex(int code) : code_(code) {}

  int code_ = 15;
};

constexpr BaudIndex kBaudUnknown{};  ///< the search is running

constexpr int kBitsPerCharacter = 11;  ///< start, 8 data, even parity, stop

}  // namespace dsdpv1::profibus
