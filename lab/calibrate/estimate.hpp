#pragma once
// One number out of many doubtful measurements of it.
#include <cstddef>
#include <optional>
#include <vector>

#include "lab/calibrate/time_base.hpp"

namespace dsdpv1::calibrate {

/// One measurement.
struct Instance {
  Tick at = 0;
  Span span;        ///< the number lies in it
  double best = 0;  ///< most likely
};

struct Outlier {
  Tick at = 0;
  double by = 0;  ///< how far it is outside of the estimate; negative: below
};

struct Estimate {
  Span span;
  std::size_t count = 0;          ///< of instances
  std::vector<Outlier> outliers;  ///< instances that do not agree with `span`, the worst first
  bool by_mean = false;           ///< `span` is narrower than what bounds alone give

  /// The only whole number in the span.
  std::optional<long long> whole() const;
};

/// The values that most instances agree with. With `time` their mean narrows that down, where the chip's edges drift
/// past the samples, so that the errors of sampling are spread. No instances: count 0. One whose `lo` is above its
/// `hi` is none.
Estimate estimate(const std::vector<Instance>& instances, const TimeBase* time = nullptr);

}  // namespace dsdpv1::calibrate
