// Replays the pins of all scenarios to a chip that runs through and to one that is saved and restored at random ticks,
// each time into a chip with another history: the pins, the events and the state, byte by byte, must be the same.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <memory>
#include <ostream>
#include <random>

#include "tests/state/life.hpp"

namespace dsdpv1::state_test {
namespace {

using profibus::kTicksPerCycle;

/// Half of the ticks anywhere, half soon after an input: within characters, accesses, frames.
std::vector<Tick> random_ticks(const Recorded& slave, int count, std::mt19937& random) {
  std::vector<Tick> ticks;
  const auto below = [&](Tick limit) { return static_cast<Tick>(random() % static_cast<std::uint64_t>(limit)); };
  for (int i = 0; i < count; ++i) {
    const Input& near = slave.inputs[static_cast<std::size_t>(below(static_cast<Tick>(slave.inputs.size())))];
    ticks.push_back(std::min(slave.end, i % 2 == 0 ? below(slave.end) : near.at + below(20 * kTicksPerCycle)));
  }
  std::sort(ticks.begin(), ticks.end());
  return ticks;
}

class Lives {
 public:
  Lives(const Recorded& slave, Way way)
      : slave_(slave),
        way_(way),
        unbroken_(make_chip(slave.config, way, expected_)),
        restored_{make_chip(slave.config, way, heard_), make_chip(slave.config, way, heard_)} {
    restored_[1]->set(777, Pin::kReset, 1);  // another history, which must not show
    restored_[1]->set(5'000'000, Pin::kRReq, 1);
    restored_[1]->advance(7'777'777);
    heard_ = {};
  }

  void run(const std::vector<Tick>& ticks) {
    auto next = ticks.begin();
    for (const Input& each : slave_.inputs) {
      for (; next != ticks.end() && *next < each.at; ++next) move_on(*next);
      for (Chip* chip : {unbroken_.get(), &now()}) chip->set(each.at, each.pin, each.level);
    }
    for (; next != ticks.end(); ++next) move_on(*next);
    move_on(slave_.end);
    compare();
  }

 private:
  Chip& now() { return *restored_[which_]; }
  void move_on(Tick at) {
    for (Chip* chip : {unbroken_.get(), &now()}) chip->advance(at);
    const std::vector<std::uint8_t> state = now().save();
    ASSERT_TRUE(state == unbroken_->save()) << "at tick " << at;
    which_ = 1 - which_;
    now().restore(state.data(), state.size());
    ASSERT_EQ(now().now(), at);
    ASSERT_EQ(now().next_event(), unbroken_->next_event()) << "at tick " << at;
    ASSERT_TRUE(state == now().save()) << "at tick " << at;
    ASSERT_EQ(asked(now(), slave_.config, way_), asked(*unbroken_, slave_.config, way_)) << "at tick " << at;
  }
  void compare() const {
    EXPECT_TRUE(heard_ == expected_);
    EXPECT_FALSE(expected_.pins.empty() && expected_.events.empty()) << "something happens";
  }

  const Recorded& slave_;
  const Way way_;
  Heard expected_, heard_;
  std::unique_ptr<Chip> unbroken_;
  std::array<std::unique_ptr<Chip>, 2> restored_;
  std::size_t which_ = 0;
};

struct Case {
  std::string scenario;
  Way way;
  int ticks;  ///< per slave
};
void PrintTo(const Case& each, std::ostream* out) { *out << each.scenario << words(each.way); }

class RecordedLives : public ::testing::TestWithParam<Case> {};

TEST_P(RecordedLives, GoOnFromASavedStateAtRandomTicks) {
  std::mt19937 random(17);
  for (const Recorded& slave : recorded(GetParam().scenario)) {
    SCOPED_TRACE(slave.name);
    Lives(slave, GetParam().way).run(random_ticks(slave, GetParam().ticks, random));
    if (HasFatalFailure()) return;
  }
}

std::vector<Case> cases(std::initializer_list<Way> ways, int ticks) {
  std::vector<Case> all;
  for (const Way way : ways)
    for (const std::string& scenario : recorded_scenarios()) all.push_back({scenario, way, ticks});
  return all;
}
std::string name_of(const ::testing::TestParamInfo<Case>& info) { return info.param.scenario + words(info.param.way); }

// The conformance tests also cover dozing and step: they restore their chips from time to time.
INSTANTIATE_TEST_SUITE_P(Short, RecordedLives, ::testing::ValuesIn(cases({Way::kSkip}, 30)), name_of);
INSTANTIATE_TEST_SUITE_P(Nightly, RecordedLives, ::testing::ValuesIn(cases({Way::kSkip, Way::kDoze, Way::kStep}, 1000)),
                         name_of);

}  // namespace
}  // namespace dsdpv1::state_test
