#pragma once
// Converts the times of a capture to cycles of the chip: samples, jitter, and two crystals.
#include <algorithm>

#include "bus/baud.hpp"
#include "bus/time.hpp"

namespace dsdpv1::calibrate {

using bus::Tick;

constexpr double kCyclesPerMs = 48'000;

/// From `lo` to `hi`, both included.
struct Span {
  double lo = 0, hi = 0;

  bool contains(double value) const { return lo <= value && value <= hi; }
  double middle() const { return (lo + hi) / 2; }
  double width() const { return hi - lo; }
  Span operator+(double offset) const { return {lo + offset, hi + offset}; }
};

inline bool overlap(const Span& a, const Span& b) { return a.lo <= b.hi && b.lo <= a.hi; }
inline Span common(const Span& a, const Span& b) { return {std::max(a.lo, b.lo), std::min(a.hi, b.hi)}; }

/// An edge recorded at t was in (t - period - jitter, t + jitter].
struct TimeBase {
  double period = 0;  ///< from one sample to the next, nominal cycles
  double jitter = 0;  ///< additional error of an edge, skew between channels included, nominal cycles
  Span scale{1, 1};   ///< cycles of the chip in a nominal cycle of the capture's clock

  static double nominal(Tick ticks) { return static_cast<double>(ticks) / static_cast<double>(bus::kTicksPerCycle); }
  /// Error of the distance of two edges, nominal cycles.
  double doubt() const { return period + 2 * jitter; }
  /// Cycles of the chip between two recorded edges.
  Span between(Tick from, Tick to) const {
    const double distance = nominal(to - from);
    return {scaled(distance - doubt(), false), scaled(distance + doubt(), true)};
  }
  double best(Tick from, Tick to) const { return nominal(to - from) * scale.middle(); }
  /// Ticks of the capture for cycles of the chip.
  Tick ticks(double cycles) const {
    return static_cast<Tick>(cycles / scale.middle() * static_cast<double>(bus::kTicksPerCycle));
  }
  /// A few cycles more than the error of an edge.
  Tick margin() const { return ticks(doubt() + 1); }

 private:
  double scaled(double distance, bool up) const { return distance * ((distance > 0) == up ? scale.hi : scale.lo); }
};

}  // namespace dsdpv1::calibrate
