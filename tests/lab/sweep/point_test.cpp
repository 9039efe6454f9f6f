// The values from a run's result file, and their form in the tables.
#include "lab/sweep/point.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lab/sweep/table.hpp"

namespace dsdpv1 {
namespace {

using nlohmann::json;
using tb::sweep::Plan;
using tb::sweep::Point;
using tb::sweep::point_of;

json run() {
  return {{"violations", 0},
          {"slaves", {{{"user_cpu", {{"bad_reads", 0}}}}}},
          {"expectations", json::array()},
          {"events", json::array()}};
}

json check(const std::string& id, const json& margin, int violations = 0) {
  return {{"id", id},  {"rule", ""}, {"count", 5}, {"violations", violations}, {"worst_margin_ns", margin},
          {"at_ns", 7}};
}

Point with_margin(double margin) {
  json made = run();
  made["checks"] = json::array({check("HOST_TW", margin, margin < 0 ? 1 : 0)});
  return point_of(0, "", made);
}

TEST(SweepPoint, HoldsWhenTheRunPassedWithoutViolationAndBadRead) {
  EXPECT_TRUE(point_of(0, "", run()).holds());
  EXPECT_FALSE(point_of(1, "", run()).holds());
  json bad = run();
  bad["slaves"][0]["user_cpu"]["bad_reads"] = 2;
  EXPECT_FALSE(point_of(0, "", bad).holds());
  EXPECT_EQ(point_of(0, "", bad).reason(), "2 reads of unknown data");
}

TEST(SweepPoint, ViolatedCheckDoesNotHoldThoughTheRunPassed) {
  EXPECT_TRUE(with_margin(0).holds());
  EXPECT_FALSE(with_margin(-3.5).holds());
  json allowed = run();
  allowed["checks"] = json::array({check("HOST_TW", -1, 3)});
  allowed["checks"][0]["allowed"] = 3;  // a count, as in the result of a run
  EXPECT_TRUE(point_of(0, "", allowed).holds());
  allowed["checks"][0]["allowed"] = 2;
  EXPECT_FALSE(point_of(0, "", allowed).holds());
}

TEST(SweepPoint, WorstMarginIsTheLeastOfAllChecksAndSlaves) {
  json made = run();
  made["checks"] = json::array({check("A", 5.5), check("B", nullptr), check("C", 7), check("C", 2.25)});
  const Point point = point_of(0, "", made);
  ASSERT_NE(point.worst(), nullptr);
  EXPECT_EQ(point.worst()->id, "C");
  EXPECT_EQ(point.worst()->margin_ns, 2.25);
  EXPECT_EQ(point.checks.size(), 3U);
  EXPECT_EQ(point.check("C")->count, 10);
  EXPECT_EQ(point_of(0, "", run()).worst(), nullptr);
}

TEST(SweepPoint, FirstViolationIsTheEarliestThatIsNotAllowed) {
  json made = run();
  const auto event = [](double at, const char* code, bool allowed) {
    return json{{"at_ns", at},        {"slave", "s"}, {"code", code}, {"severity", "violation"},
                {"allowed", allowed}, {"text", "t"}};
  };
  made["events"] = {event(10, "ALLOWED", true), event(3000, "LATE", false), event(2000, "EARLY", false)};
  EXPECT_EQ(point_of(1, "", made).reason(), "EARLY at 2.000 us: t");
  made["slaves"][0]["user_cpu"]["bad_reads"] = 2;
  EXPECT_EQ(point_of(1, "", made).reason(), "2 reads of unknown data; EARLY at 2.000 us: t");
  made["slaves"][0]["user_cpu"]["bad_reads"] = 0;
  made["checks"] = json::array({check("HOST_TW", -1, 1)});
  made["checks"][0]["listed"] = {{{"at_ns", 1000}, {"margin_ns", -1}, {"text", "too early"}}};
  EXPECT_EQ(point_of(1, "", made).reason(), "HOST_TW at 1.000 us: too early");
}

TEST(SweepPoint, ReasonOfAFailureIsWhatTheRunSaysOrWhatWasNotMet) {
  EXPECT_EQ(point_of(2, "s.yaml:1: wrong", nullptr).reason(), "s.yaml:1: wrong");
  EXPECT_FALSE(point_of(2, "s.yaml:1: wrong", nullptr).possible());
  json made = run();
  made["expectations"] = {{{"text", "first"}, {"passed", true}}, {{"text", "second"}, {"passed", false}}};
  EXPECT_EQ(point_of(1, "", made).reason(), "not met: second");
  EXPECT_EQ(point_of(137, "", nullptr).reason(), "exit code 137");
}

TEST(SweepTable, CsvHasARowAPointAndQuotesWhatNeedsIt) {
  const Plan plan{"s.yaml", {}, "", {{"a.x", {"1", "2"}}}};
  const std::string text = tb::sweep::csv(plan, {with_margin(1.5), point_of(2, "wrong, \"x\"", nullptr)});
  EXPECT_EQ(text,
            "point,a.x,holds,exit_code,violations,bad_reads,worst_check,worst_margin_ns,first_violation,"
            "first_violation_at_ns,reason,HOST_TW_violations,HOST_TW_margin_ns\n"
            "0,1,yes,0,0,0,HOST_TW,1.500,,,,0,1.500\n"
            "1,2,not possible,2,0,0,,,,,\"wrong, \"\"x\"\"\",,\n");
}

TEST(SweepTable, SummarySaysWhereItHoldsAndWhereTheViolationBegins) {
  const Plan plan{"s.yaml", {}, "", {{"d", {"0", "1", "2", "3"}}, {"e", {"7", "8"}}}};
  const Point bad = point_of(2, "worse", nullptr), border = point_of(1, "at the border", nullptr),
              good = with_margin(2);
  const std::string text = tb::sweep::summary(plan, {bad, good, border, good, good, good, good, with_margin(1)});
  EXPECT_THAT(text, testing::HasSubstr("  7  2, 3              0, 1         1: at the border\n"));
  EXPECT_THAT(text, testing::HasSubstr("  8  all               none\n"));
  EXPECT_THAT(text, testing::HasSubstr("the timing holds at 6 of 8 points, 1 are not possible\n"));
  EXPECT_THAT(text, testing::HasSubstr("least margin where it holds: 1.000 ns (HOST_TW) at d=3, e=8\n"));
}

TEST(SweepTable, RunsOfValuesAreShortened) {
  const Plan plan{"s.yaml", {}, "", {{"d", {"0", "1", "2", "3", "4", "5"}}}};
  const Point bad = point_of(1, "x", nullptr), good = with_margin(2);
  EXPECT_THAT(tb::sweep::summary(plan, {good, bad, good, good, good, bad}), testing::HasSubstr("0, 2..4"));
}

}  // namespace
}  // namespace dsdpv1
