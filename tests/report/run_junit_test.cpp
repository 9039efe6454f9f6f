// A single run in JUnit's XML.
#include "tb/report/run_junit.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace dsdpv1 {
namespace {

using testing::HasSubstr;

tb::RunResult made_up() {
  tb::RunResult result;
  result.scenario = "A scenario";
  result.file = "s.yaml";
  result.engine = "skip";
  result.view = "pins";
  result.wall_s = 1.5;
  result.expectations = {{"demo: dp_state DATA_EXCH", 12, true, "", false},
                         {"demo: outputs 01", 13, false, "outputs 02", false},
                         {"demo: driver_errors 0", 14, false, "", true}};
  return result;
}

TEST(RunJunit, HasACaseForTheRunItsViolationsAndEachExpectation) {
  const std::vector<tb::JunitCase> cases = tb::run_cases(made_up());
  ASSERT_EQ(cases.size(), 5U);
  EXPECT_EQ(cases[0].name, "run, engine skip, view pins");
  EXPECT_EQ(cases[0].seconds, 1.5);
  EXPECT_THAT(cases[0].output, HasSubstr("FAILED: 1 expectation not met"));
  EXPECT_EQ(cases[1].name, "no violation that the scenario does not allow");
  EXPECT_EQ(cases[2].name, "line 12: demo: dp_state DATA_EXCH");
  for (const tb::JunitCase& each : cases) {
    EXPECT_EQ(each.suite, "s.yaml");
    EXPECT_EQ(each.failure.has_value(), each.name == "line 13: demo: outputs 01") << each.name;
  }
  EXPECT_EQ(cases[3].failure, "not met: demo: outputs 01; seen: outputs 02");
  EXPECT_THAT(cases[4].output, HasSubstr("left out"));
}

TEST(RunJunit, ViolationsAreListedButForThoseThatTheScenarioAllows) {
  tb::RunResult result = made_up();
  result.violations = 1;
  result.violated = {{"demo", "HOST_TS", "B31A", "WR too short", 12'000, 13'000, 4, false},
                     {"demo", "HOST_TD", "", "D too short", 24'000, 24'000, 1, true}};
  const std::vector<tb::JunitCase> cases = tb::run_cases(result);
  EXPECT_EQ(cases[1].failure, "4 times demo HOST_TS at B31A, first at 1.000 us: WR too short\n");
}

TEST(RunJunit, EachCheckIsACase) {
  static const checks::Rule kRule = {"TIMING_TS", checks::Bound::kMin, 150, 0, "WR is low long enough", "", "", "", ""};
  tb::RunResult result = made_up();
  result.checks.resize(2);
  result.checks[0].slave = result.checks[1].slave = "demo";
  result.checks[0].rule = result.checks[1].rule = &kRule;
  result.checks[1].record.violations = 2;
  result.checks[1].listed.resize(2);
  result.checks[1].listed[0].at = 12'000;
  result.checks[1].listed[0].text = "too short";
  const std::vector<tb::JunitCase> cases = tb::run_cases(result);
  EXPECT_EQ(cases[2].name, "demo: TIMING_TS");
  EXPECT_FALSE(cases[2].failure);
  EXPECT_EQ(cases[3].failure, "violated 2 times, first at 1.000 us: too short\nWR is low long enough\n");
  result.checks_mode = tb::ChecksMode::kReport;
  EXPECT_FALSE(tb::run_cases(result)[3].failure);
  EXPECT_THAT(tb::run_cases(result)[3].output, HasSubstr("violated 2 times"));
}

TEST(RunJunit, ARunInWhichNothingWasJudgedHasFailed) {
  EXPECT_THAT(tb::run_cases(tb::RunResult{})[0].failure, testing::Optional(HasSubstr("nothing judged")));
}

TEST(RunJunit, ARunThatWasInterruptedHasFailed) {
  tb::RunResult result = made_up();
  result.interrupted = true;
  result.simulated = 12'000;
  EXPECT_EQ(tb::run_cases(result)[0].failure, "interrupted at 1.000 us");
}

TEST(RunJunit, ADifferenceOfModelAndRtlIsACaseOfItsOwn) {
  tb::RunResult result = made_up();
  result.lockstep.emplace();
  EXPECT_EQ(tb::run_cases(result).back().name, "model and RTL are the same");
  EXPECT_FALSE(tb::run_cases(result).back().failure);
  result.lockstep->difference = tb::LockstepDifference{12'000, "L_REQ is 1, RTL has 0", "", "", "", {}, {}, "demo"};
  EXPECT_EQ(tb::run_cases(result).back().failure, "demo at 1.000 us: L_REQ is 1, RTL has 0");
}

}  // namespace
}  // namespace dsdpv1
