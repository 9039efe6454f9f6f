#pragma once
// Margins in bins that grow 1, 2, 5, 10 ... from 1 ns to 1 s.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "bus/time.hpp"

namespace dsdpv1::checks {

class Histogram {
 public:
  static constexpr std::size_t kEdges = 28;
  static constexpr std::size_t kBins = kEdges + 2;  ///< below 0, from 0 to the first edge, ..., from the last edge on

  /// Returns the bin.
  std::size_t add(bus::Tick margin) {
    const std::size_t bin = bin_of(margin);
    count_in(bin);
    return bin;
  }
  void count_in(std::size_t bin) { ++counts_.at(bin); }
  std::uint64_t count(std::size_t bin) const { return counts_.at(bin); }
  /// Minimum margin of a bin in ticks; bin 0 (violated) has none and returns -kNever.
  static bus::Tick from(std::size_t bin) {
    if (bin == 0) return -bus::kNever;
    return bin == 1 ? 0 : edges().at(bin - 2);
  }
  /// The margin at which the next bin begins, kNever for the last.
  static bus::Tick to(std::size_t bin) { return bin + 1 == kBins ? bus::kNever : from(bin + 1); }

 private:
  static const std::array<bus::Tick, kEdges>& edges() {
    static constexpr std::array<bus::Tick, kEdges> kEdgeTicks = [] {
      std::array<bus::Tick, kEdges> ticks{};
      bus::Tick decade = bus::kTicksPerNs;
      for (std::size_t i = 0; i < kEdges; ++i) {
        const bus::Tick step = i % 3 == 0 ? 1 : i % 3 == 1 ? 2 : 5;
        ticks[i] = decade * step;
        if (i % 3 == 2) decade *= 10;
      }
      return ticks;
    }();
    return kEdgeTicks;
  }
  static std::size_t bin_of(bus::Tick margin) {
    if (margin < 0) return 0;
    const auto& all = edges();
    return 1 + static_cast<std::size_t>(std::upper_bound(all.begin(), all.end(), margin) - all.begin());
  }

  std::array<std::uint64_t, kBins> counts_{};
};

}  // namespace dsdpv1::checks
