#pragma once
// Time in a comparison: whole units of the finer of the two time scales, so nothing is rounded.
#include <cstdint>
#include <optional>
#include <string>

#include "bus/time.hpp"

namespace dsdpv1::tb::compare {

using Time = std::int64_t;          ///< in units of a Scale
using Femtoseconds = std::int64_t;  ///< times from users: up to 9223 s

/// The forms of a duration, for error messages.
constexpr const char* kDurationForm = "a number with a unit fs, ps, ns, us, ms, s or cycles (of 48 MHz), like 10ns";

/// "10ns", "-1.5us", "2cycles"; nullopt for anything else.
std::optional<Femtoseconds> parse_duration(const std::string& text);

class Scale {
 public:
  /// Units of 10^exponent seconds, -15 to 2.
  explicit Scale(int exponent) : exponent_(exponent) {}
  int exponent() const { return exponent_; }
  /// Converts to the nearest unit.
  Time from(Femtoseconds duration) const;
  /// Converts from a coarser scale; nullopt beyond 2^62 units.
  std::optional<Time> from(std::uint64_t time, int exponent) const;
  /// To the nearest tick; the model's times are whole ticks, rounded to a picosecond.
  bus::Tick tick(Time time) const;
  std::uint64_t picoseconds(Time time) const;
  /// The exact time: "1766604167 ps".
  std::string text(Time time) const;

 private:
  int exponent_;
};

}  // namespace dsdpv1::tb::compare
