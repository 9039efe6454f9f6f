#pragma once
// So that a host cannot fill the terminal and the log by connecting and hanging up.
#include <cstdint>

#include "tb/serve/framing.hpp"

namespace dsdpv1::tb::serve {

/// The first lines of each second are said, the others counted.
class LineLimit {
 public:
  static constexpr std::uint64_t kMost = 40;
  static constexpr std::chrono::seconds kSpan{1};

  /// Whether a line may be said now. left_out() comes first.
  bool allows(WallTime now);
  /// How many were not said in a second that is over, or at all when nothing comes `after`; they are told of once.
  std::uint64_t left_out(WallTime now, bool after = true);

 private:
  WallTime begun_{};
  std::uint64_t count_ = 0;  ///< since then, 0: no second has begun
};

}  // namespace dsdpv1::tb::serve
