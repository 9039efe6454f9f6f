#pragma once
// A stimulus played to model and reference RTL, and the situations that occurred.
#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "cosim/random/play_options.hpp"
#include "cosim/random/random_cases.hpp"

namespace dsdpv1::cosim {

/// The effects of a stimulus, in model and RTL.
class Played {
 public:
  explicit Played(const Stimulus& stimulus, PlayOptions options = quick_options(), Tick limit = Tick{1} << 40) {
    options.limit = limit;
    const std::unique_ptr<PlayListener> watch = options.kind->random()->watch(*options.chip, situations_);
    options.listeners.push_back(watch.get());
    result_ = play(stimulus, reference_top(options, 0, 1), options);
    EXPECT_FALSE(result_.difference);
  }
  std::uint64_t count(const char* group, const std::string& item) const { return situations_.of({group, item}); }
  Tick end() const { return static_cast<Tick>(result_.counts.cycles) * profibus::kTicksPerCycle; }

 private:
  PlayResult result_;
  Situations situations_;
};

}  // namespace dsdpv1::cosim
