#include "tb/report/html/distribution.hpp"

#include <algorithm>

namespace dsdpv1::tb::html {

void Distribution::add(bus::Tick value) {
  ++count_;
  sum_ += value;
  least_ = std::min(least_, value);
  greatest_ = std::max(greatest_, value);
  ++values_[rounded(value)];
  while (values_.size() > kMost) put_together();
}

void Distribution::put_together() {
  step_ *= 2;
  std::map<bus::Tick, std::uint64_t> wider;
  for (const auto& [value, count] : values_) wider[rounded(value)] += count;
  values_.swap(wider);
}

}  // namespace dsdpv1::tb::html
