// What a single run is in JUnit's XML.
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
  result.passed = true;
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
  EXPECT_THAT(cases[0].output, HasSubstr("PASSED"));
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
  result.occurrences = {{12'000, "demo", "HOST_TS", profibus::Severity::kViolation, "WR too short", false},
                        {24'000, "demo", "HOST_TD", profibus::Severity::kViolation, "D too short", true},
                        {36'000, "demo", "BAUD_FOUND", profibus::Severity::kInfo, "found", false}};
  const std::vector<tb::JunitCase> cases = tb::run_cases(result);
  EXPECT_EQ(cases[1].failure, "1 violations that the scenario does not allow\n1.000 us demo: HOST_TS: WR too short\n");
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
  result.lockstep->difference = tb::LockstepResult::Difference{"demo", 12'000, "L_REQ is 1, RTL has 0", "", "", ""};
  EXPECT_EQ(tb::run_cases(result).back().failure, "demo at 1.000 us: L_REQ is 1, RTL has 0");
}

}  // namespace
}  // namespace dsdpv1
