#pragma once
// The times at which both sides are sampled: the edges of a clock of one of them, A's when both have it. Its file is
// read a second time.
#include "lab/compare/side.hpp"

namespace dsdpv1::tb::compare {

class ClockEdges {
 public:
  /// Throws InputError when neither side has the clock, or it is not a single bit.
  ClockEdges(const Clock& clock, const Side& a, const Side& b, const Scale& scale, Time shift_of_b);
  /// nullopt at the end of the file.
  std::optional<Time> next();

 private:
  bool rising_;
  Side side_;
  Touched touched_;
  Probe probe_;
};

}  // namespace dsdpv1::tb::compare
