// From a run's end and its result to verdict and reason.
#include "lab/regress/outcome.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>

namespace dsdpv1 {
namespace {

using tb::campaign::Ended;
using tb::campaign::Json;
using tb::campaign::kSignalled;
using tb::regress::Outcome;
using tb::regress::outcome_of;
using tb::regress::Verdict;

Ended ended(int exit, const std::string& output = "", bool too_long = false) {
  return {0, exit, output, 1.25, too_long};
}

Json result(bool passed) {
  return {{"passed", passed},
          {"violations", 0},
          {"slaves", Json::array()},
          {"events", Json::array()},
          {"expectations", {{{"text", "first"}, {"passed", true}, {"seen", "a"}}}}};
}

TEST(RegressOutcome, PassedHasNoReason) {
  const Outcome outcome = outcome_of(ended(0, "a warning\n"), result(true));
  EXPECT_EQ(outcome.verdict, Verdict::kPassed);
  EXPECT_EQ(outcome.reason, "");
  EXPECT_EQ(outcome.output, "");
}

TEST(RegressOutcome, FailureIsTheFirstExpectationThatIsNotMet) {
  Json failed = result(false);
  failed["expectations"].push_back({{"text", "second"}, {"passed", false}, {"seen", "b"}});
  failed["expectations"].push_back({{"text", "third"}, {"passed", false}, {"seen", "c"}});
  EXPECT_EQ(outcome_of(ended(1), failed).reason, "not met: second; seen: b");
}

TEST(RegressOutcome, FailureIsTheFirstViolationWhenAllExpectationsAreMet) {
  Json failed = result(false);
  const Json listed = {{{"at_ns", 1500}, {"text", "too early"}}};
  failed["checks"] = {{{"id", "TIMING_TW"}, {"violations", 1}, {"slave", "s"}, {"listed", listed}}};
  EXPECT_EQ(outcome_of(ended(1), failed).reason, "TIMING_TW at 1.500 us: too early");
}

TEST(RegressOutcome, FailureHasTheLineOfTheFirmware) {
  Json failed = result(false);
  const auto reason = [&failed](const Json& where) {
    const Json listed = {{{"at_ns", 1500}, {"text", "too long"}, {"where", where}}};
    failed["checks"] = {{{"id", "A"}, {"violations", 1}, {"slave", "s"}, {"listed", listed}}};
    return outcome_of(ended(1), failed).reason;
  };
  Json where = {{"file", "a.c"}, {"line", 7}, {"function", "take"}, {"pc", "0x08000104"}, {"stayed_ns", nullptr}};
  EXPECT_EQ(reason(where), "A at 1.500 us: too long, at a.c:7 in take()");
  where["stayed_ns"] = 1501;
  EXPECT_EQ(reason(where), "A at 1.500 us: too long, in take() at a.c:7 for 1.501 us");
  where = {{"file", ""}, {"line", 0}, {"function", ""}, {"pc", "0x08000104"}, {"stayed_ns", nullptr}};
  EXPECT_EQ(reason(where), "A at 1.500 us: too long, at 0x08000104");
  EXPECT_EQ(reason(nullptr), "A at 1.500 us: too long");
}

TEST(RegressOutcome, DifferenceOfALockstepRunIsWhatItSays) {
  EXPECT_EQ(outcome_of(ended(1, "differs at cycle 7\nmore\n"), result(true)).reason, "differs at cycle 7");
}

TEST(RegressOutcome, RunWithoutAResultIsWhatItHasSaidLast) {
  EXPECT_EQ(outcome_of(ended(1, "warning\ninternal error: x\n"), Json()).reason, "internal error: x");
  EXPECT_EQ(outcome_of(ended(1), Json()).reason, "its run ended with exit code 1 and no result");
}

TEST(RegressOutcome, RefusedCrashedAndHungAreFailuresOfTheirOwn) {
  const Outcome refused = outcome_of(ended(2, "s.yaml:1: wrong\n"), Json());
  EXPECT_EQ(refused.verdict, Verdict::kRefused);
  EXPECT_EQ(refused.reason, "s.yaml:1: wrong");
  const Outcome crashed = outcome_of(ended(kSignalled + SIGSEGV, "last words\n"), Json());
  EXPECT_EQ(crashed.verdict, Verdict::kCrashed);
  EXPECT_EQ(crashed.reason, "killed by signal 11 (SIGSEGV)");
  EXPECT_EQ(crashed.output, "last words\n");
  const Outcome hung = outcome_of(ended(kSignalled + SIGKILL, "", true), Json());
  EXPECT_EQ(hung.verdict, Verdict::kHung);
  EXPECT_EQ(hung.reason, "still ran after 1.2 s and was killed");
}

TEST(RegressOutcome, IsReadBackFromItsJson) {
  Outcome outcome = outcome_of(ended(2, "wrong"), Json());
  outcome.files = {"run.log"};
  const Outcome again = tb::regress::outcome_of(json_of(outcome));
  EXPECT_EQ(json_of(again), json_of(outcome));
  Json other = json_of(outcome);
  other["verdict"] = "splendid";
  EXPECT_THROW(tb::regress::outcome_of(other), nlohmann::json::exception);
}

TEST(RegressOutcome, OfAScenarioItsEventsWereSeen) {
  Json run = result(true);
  run["events"] = {{{"code", "BAUD_FOUND"}, {"severity", "info"}},
                   {{"code", "BAUD_FOUND"}, {"severity", "info"}},
                   {{"code", "SAP_STATE"}, {"severity", "refusal"}}};
  run["refused"] = {{{"code", "SAP_STATE"}, {"count", 20000}}};
  run["violated"] = {{{"code", "HOST_TC"}, {"count", 2}}, {{"code", "HOST_TC"}, {"count", 3}}};
  EXPECT_EQ(tb::regress::seen_of(run)["codes"], Json({{"BAUD_FOUND", 2}, {"SAP_STATE", 20000}, {"HOST_TC", 5}}));
}

TEST(RegressOutcome, OfRandomCasesAndStimuliTheCodesAndSituationsWereSeen) {
  Json run = {{"coverage", {{"codes", {{"A", 0}, {"B", 4}}}, {"situations", {{"g", {{"x", 1}, {"y", 0}}}}}}}};
  EXPECT_EQ(tb::regress::seen_of(run), Json({{"codes", {{"B", 4}}}, {"situations", {{"g", {{"x", 1}}}}}}));
  run["coverage"]["situations"] = nullptr;
  EXPECT_EQ(tb::regress::seen_of(run), Json({{"codes", {{"B", 4}}}, {"situations", Json::object()}}));
}

TEST(RegressOutcome, WithoutAResultNothingWasSeen) {
  EXPECT_TRUE(tb::regress::seen_of(Json()).is_null());
  EXPECT_TRUE(tb::regress::seen_of(Json::parse("{", nullptr, false)).is_null());
}

}  // namespace
}  // namespace dsdpv1
