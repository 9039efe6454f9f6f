#pragma once
// Times of a run at which a function is called before any agent acts.
#include <algorithm>
#include <functional>
#include <vector>

#include "bus/timeline.hpp"

namespace dsdpv1::tb {

/// The first agent of its timeline.
class Marks : public bus::Agent {
 public:
  /// To be called before the run.
  void add(bus::Tick at) {
    times_.insert(std::upper_bound(times_.begin(), times_.end(), at, std::greater<>()), at);
    announce();
  }
  bool empty() const { return times_.empty(); }

  bus::Tick next() const override { return times_.empty() ? bus::kNever : times_.back(); }
  void run(bus::Tick now) override {
    while (!times_.empty() && times_.back() <= now) times_.pop_back();
    on_mark(now);
  }

  std::function<void(bus::Tick now)> on_mark;

 private:
  std::vector<bus::Tick> times_;  ///< the earliest last
};

}  // namespace dsdpv1::tb
