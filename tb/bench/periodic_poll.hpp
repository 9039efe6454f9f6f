#pragma once
// Calls a function periodically during a run, which may end it.
#include <functional>

#include "bus/timeline.hpp"

namespace dsdpv1::tb {

class PeriodicPoll : public bus::Agent {
 public:
  static constexpr bus::Tick kPeriod = 100 * bus::kTicksPerUs;

  bus::Tick next() const override { return stopped_ ? bus::kNever : next_; }
  void run(bus::Tick now) override {
    next_ = now + kPeriod;
    stopped_ = poll && !poll(now);
  }
  void stop() {
    stopped_ = true;
    announce();
  }
  bool stopped() const { return stopped_; }

  std::function<bool(bus::Tick now)> poll;  ///< false: ends the run

 private:
  bus::Tick next_ = 0;
  bool stopped_ = false;
};

}  // namespace dsdpv1::tb
