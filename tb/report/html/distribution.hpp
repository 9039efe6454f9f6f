#pragma once
// How often each duration was seen, in bounded memory.
#include <cstdint>
#include <map>

#include "bus/time.hpp"

namespace dsdpv1::tb::html {

/// Values are kept as they are while there are few different ones; when there are more than kMost, neighbours are put
/// together. Count, least, greatest and sum stay exact.
class Distribution {
 public:
  static constexpr std::size_t kMost = 4096;

  void add(bus::Tick value);
  std::uint64_t count() const { return count_; }
  /// 0 without values.
  bus::Tick least() const { return count_ == 0 ? 0 : least_; }
  bus::Tick greatest() const { return greatest_; }
  double mean() const { return count_ == 0 ? 0 : static_cast<double>(sum_) / static_cast<double>(count_); }
  /// Values are rounded down to multiples of this, ticks.
  bus::Tick step() const { return step_; }
  const std::map<bus::Tick, std::uint64_t>& values() const { return values_; }

 private:
  bus::Tick rounded(bus::Tick value) const { return value - value % step_; }
  void put_together();

  std::map<bus::Tick, std::uint64_t> values_;
  bus::Tick step_ = 1, least_ = bus::kNever, greatest_ = 0, sum_ = 0;
  std::uint64_t count_ = 0;
};

}  // namespace dsdpv1::tb::html
