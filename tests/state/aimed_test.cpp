// Chips are saved at critical moments: a chip restored there behaves as the first.
#include <gtest/gtest.h>

#include <array>
#include <memory>

#include "tests/state/life.hpp"

namespace dsdpv1::state_test {
namespace {

// Gives a chip another history.
void disturb(Chip& chip, Heard& heard) {
  chip.set(777, Pin::kReset, 1);
  chip.set(5'000'000, Pin::kRReq, 1);
  chip.advance(7'777'777);
  heard = {};
}

class AimedLives : public ::testing::TestWithParam<Way> {};

TEST_P(AimedLives, GoOnFromEachMoment) {
  const Way way = GetParam();
  for (const Aimed& each : aimed()) {
    const Recorded& slave = each.stimulus;
    SCOPED_TRACE(slave.name);
    Heard expected, heard;
    const auto unbroken = make_chip(slave.config, way, expected);
    std::array<std::unique_ptr<Chip>, 2> restored = {make_chip(slave.config, way, heard),
                                                     make_chip(slave.config, way, heard)};
    disturb(*restored[1], heard);
    std::size_t inputs = 0, which = 0;
    for (const Moment& moment : each.moments) {
      for (Chip* chip : {unbroken.get(), restored[which].get()}) {
        for (std::size_t i = inputs; i < moment.inputs; ++i)
          chip->set(slave.inputs[i].at, slave.inputs[i].pin, slave.inputs[i].level);
        chip->advance(moment.at);
      }
      inputs = moment.inputs;
      const std::vector<std::uint8_t> state = restored[which]->save();
      ASSERT_TRUE(state == unbroken->save()) << "at tick " << moment.at;
      which = 1 - which;
      restored[which]->restore(state.data(), state.size());
      ASSERT_TRUE(state == restored[which]->save()) << "at tick " << moment.at;
      ASSERT_EQ(asked(*restored[which], slave.config, way), asked(*unbroken, slave.config, way))
          << "at tick " << moment.at;
    }
    for (Chip* chip : {unbroken.get(), restored[which].get()}) play(*chip, slave, inputs, slave.end);
    EXPECT_TRUE(heard == expected);
    EXPECT_EQ(asked(*restored[which], slave.config, way), asked(*unbroken, slave.config, way));
    EXPECT_FALSE(way != Way::kDoze && expected.pins.empty()) << "something happens";
  }
}

TEST(Acts, GoOnInARestoredChip) {
  for (const Act& act : acts()) {
    SCOPED_TRACE(act.name);
    Heard expected, heard;
    const auto unbroken = make_chip(act.config, Way::kDoze, expected),
               restored = make_chip(act.config, Way::kDoze, heard);
    act.before(*unbroken);
    expected = {};
    const std::vector<std::uint8_t> state = unbroken->save();
    disturb(*restored, heard);
    restored->restore(state.data(), state.size());
    for (Chip* chip : {unbroken.get(), restored.get()}) act.rest(*chip);
    EXPECT_TRUE(heard == expected);
    EXPECT_EQ(asked(*restored, act.config, Way::kDoze), asked(*unbroken, act.config, Way::kDoze));
    EXPECT_TRUE(restored->save() == unbroken->save());
  }
}

const auto kName = [](const auto& each) { return words(each.param); };
INSTANTIATE_TEST_SUITE_P(Short, AimedLives, ::testing::Values(Way::kSkip, Way::kDoze), kName);
INSTANTIATE_TEST_SUITE_P(Nightly, AimedLives, ::testing::Values(Way::kStep), kName);

}  // namespace
}  // namespace dsdpv1::state_test
