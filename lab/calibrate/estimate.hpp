#pragma once
// Estimates one number from many inexact measurements.
#include <cstddef>
#include <optional>
#include <vector>

#include "lab/calibrate/time_base.hpp"

namespace dsdpv1::calibrate {

/// One measurement.
struct Instance {
  Tick at = 0;
  Span span;        ///< contains the number
  double best = 0;  ///< most likely
};

struct Outlier {
  Tick at = 0;
  double by = 0;  ///< distance from the estimate; negative: below
};

struct Estimate {
  Span span;
  std::size_t count = 0;          ///< of instances
  std::vector<Outlier> outliers;  ///< instances that do not agree with `span`, the worst first
  bool by_mean = false;           ///< the mean has narrowed `span` further than the bounds alone

  /// The only whole number in the span.
  std::optional<long long> whole() const;
};

/// The values that most instances agree with. With `time` their mean narrows them further if the chip's edges drift
/// past the samples, so that the sampling errors are spread. No instances: count 0. An instance with `lo` above `hi` is
/// ignored.
Estimate estimate(const std::vector<Instance>& instances, const TimeBase* time = nullptr);

}  // namespace dsdpv1::calibrate
