#pragma once
// Prevents a host from filling the terminal and the log by connecting and hanging up repeatedly.
#include <cstdint>

#include "tb/serve/framing.hpp"

namespace dsdpv1::tb::serve {

/// Prints the first lines of each second and counts the others.
class LineLimit {
 public:
  static constexpr std::uint64_t kMost = 40;
  static constexpr std::chrono::seconds kSpan{1};

  /// True if a line may be printed now. Call left_out() first.
  bool allows(WallTime now);
  /// The number of lines suppressed in a past second, or in total if nothing comes `after`; returned once.
  std::uint64_t left_out(WallTime now, bool after = true);

 private:
  WallTime begun_{};
  std::uint64_t count_ = 0;  ///< in this second, 0: none has begun
};

}  // namespace dsdpv1::tb::serve
