// Compares a run with a handmade golden: the differences that count, and the first of them.
#include "lab/traces/golden_check.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/lab/traces/small.hpp"

namespace dsdpv1 {
namespace {

using tb::traces::GoldenCheck;
using testing::HasSubstr;
using traces_test::Changes;

class GoldenChecks : public testing::Test {
 protected:
  GoldenCheck& compare(const Changes& golden, const Changes& here) {
    golden_ = traces_test::trace_of(scenario_, golden);
    check_ = std::make_unique<GoldenCheck>(*golden_, scenario_);
    traces_test::play(*check_, scenario_, here);
    check_->finish();
    return *check_;
  }
  std::string difference(const Changes& golden, const Changes& here) {
    compare(golden, here);
    if (!check_->difference()) return "none";
    return std::to_string(check_->difference()->at) + " " + what_differs(*check_->difference());
  }
  tb::scenario::Scenario scenario_ = traces_test::small_scenario();
  std::unique_ptr<tb::traces::Trace> golden_;
  std::unique_ptr<GoldenCheck> check_;
};

TEST_F(GoldenChecks, TheSameChangesAreNoDifference) {
  const Changes changes = {{"L_REQ", 250, 1}, {"L_STA", 250, 1}, {"L_REQ", 500, 0}};
  const GoldenCheck& check = compare(changes, changes);
  EXPECT_FALSE(check.difference());
  EXPECT_EQ(check.same(), 3U);
}

TEST_F(GoldenChecks, TheOrderOfSignalsWithinATickDoesNotMatter) {
  EXPECT_EQ(difference({{"L_REQ", 250, 1}, {"L_STA", 250, 1}}, {{"L_STA", 250, 1}, {"L_REQ", 250, 1}}), "none");
}

TEST_F(GoldenChecks, ButTheOrderOfOneSignalsLevelsDoes) {
  EXPECT_EQ(difference({{"D_OUT", 250, -2}, {"D_OUT", 250, 7}}, {{"D_OUT", 250, 7}, {"D_OUT", 250, -2}}),
            "250 pin D_OUT of io: golden X, here 07");
}

TEST_F(GoldenChecks, AnotherLevelIsFound) {
  EXPECT_EQ(difference({{"A", 250, 0x12}}, {{"A", 250, 0x13}}), "250 pin A of io: golden 012, here 013");
}

TEST_F(GoldenChecks, AChangeThatTheGoldenDoesNotHaveIsFound) {
  EXPECT_EQ(difference({{"L_REQ", 500, 1}}, {{"L_STA", 250, 1}, {"L_REQ", 500, 1}}),
            "250 pin L_STA of io: golden still 0, here 1");
}

TEST_F(GoldenChecks, AChangeThatIsMissingIsFoundAtItsTickWhateverElseFollows) {
  EXPECT_EQ(difference({{"L_REQ", 500, 1}, {"L_STA", 750, 1}}, {{"L_STA", 750, 1}}),
            "500 pin L_REQ of io: golden 1, here still 0");
}

TEST_F(GoldenChecks, ALateChangeIsOneThatIsMissing) {
  EXPECT_EQ(difference({{"L_REQ", 500, 1}}, {{"L_REQ", 750, 1}}), "500 pin L_REQ of io: golden 1, here still 0");
}

TEST_F(GoldenChecks, AnEarlyChangeIsOneTooMany) {
  EXPECT_EQ(difference({{"L_REQ", 500, 1}}, {{"L_REQ", 250, 1}}), "250 pin L_REQ of io: golden still 0, here 1");
}

TEST_F(GoldenChecks, WhatIsMissingAtTheEndIsFound) {
  EXPECT_EQ(difference({{"READY", 900'000, 1}}, {}), "900000 pin READY of io: golden 1, here still 0");
}

TEST_F(GoldenChecks, ALevelOfPowerOnIsCompared) {
  golden_ = traces_test::trace_of(scenario_, {});
  check_ = std::make_unique<GoldenCheck>(*golden_, scenario_);
  for (std::size_t i = 0; i < golden_->signals().size(); ++i)
    check_->change(i, 0, i == traces_test::signal_of(scenario_, "INTR0") ? 1 : 0);
  check_->finish();
  ASSERT_TRUE(check_->difference());
  EXPECT_THAT(check_->words(), HasSubstr("cycle 0 (0.000 us)\n                  pin INTR0 of io: golden 0, here 1"));
}

TEST_F(GoldenChecks, OfSeveralAtOneTickAnOutputComesFirstThenAnInputThenTheLine) {
  EXPECT_EQ(difference({}, {{"line", 500, 1}, {"PBRXD", 500, 1}, {"PBTXD", 500, 1}}),
            "500 pin PBTXD of io: golden still 0, here 1");
  EXPECT_EQ(difference({}, {{"line", 500, 1}, {"PBRXD", 500, 1}}), "500 pin PBRXD of io: golden still 0, here 1");
  EXPECT_EQ(difference({}, {{"line", 500, 1}}), "500 the line: golden still 0, here 1");
}

TEST_F(GoldenChecks, TheUsersAccessAtTheDifferenceIsNamedNotALaterOne) {
  Changes golden = {{"CSR", 100, 1}, {"RD", 900, 1},     {"CSR", 1000, 0},   {"RD", 1000, 0}, {"A", 1000, 0x410},
                    {"RD", 2000, 1}, {"INTR0", 2500, 1}, {"A", 3000, 0x411}, {"RD", 3000, 0}};
  Changes here = golden;
  here.erase(here.begin() + 6);
  compare(golden, here);
  EXPECT_THAT(check_->words(), HasSubstr("last access       read B410 at cycle 4 (0.083 us)\n"));
}

TEST_F(GoldenChecks, WithoutATelegramOnTheBusTheRunGoesOnForTheLengthOfOne) {
  compare({}, {{"L_REQ", 250, 1}});
  EXPECT_FALSE(check_->done(1'000'000));
  EXPECT_TRUE(check_->done(4'000'000));
  EXPECT_THAT(check_->words(), HasSubstr("on the bus        nothing so far\n"));
}

}  // namespace
}  // namespace dsdpv1
