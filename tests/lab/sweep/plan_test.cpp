// From --param to the points of a plan.
#include "lab/sweep/plan.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/input/input_error.hpp"

namespace dsdpv1 {
namespace {

using tb::sweep::parse_parameter;
using tb::sweep::Plan;
using testing::ElementsAre;

std::string error_of(const std::string& text) {
  try {
    parse_parameter(text);
  } catch (const tb::InputError& error) {
    return error.what();
  }
  return "no error";
}

std::string error_of(const Plan& plan) {
  try {
    check(plan);
  } catch (const tb::InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(SweepParameter, RangeOfWholeNumbersHasBothEnds) {
  EXPECT_THAT(parse_parameter("user_cpu.fsmc.addset=0..3").values, ElementsAre("0", "1", "2", "3"));
  EXPECT_THAT(parse_parameter("user_cpu.fsmc.datast=1..9/4").values, ElementsAre("1", "5", "9"));
  EXPECT_THAT(parse_parameter("user_cpu.fsmc.datast=1..8/4").values, ElementsAre("1", "5"));
}

TEST(SweepParameter, RangeOfTimesHasUnitsAndAStep) {
  EXPECT_THAT(parse_parameter("user_cpu.cycle=900us..1.1ms/100us").values, ElementsAre("900us", "1ms", "1.1ms"));
  EXPECT_THAT(parse_parameter("user_cpu.timing.r_req_to_r_sta=1cycles..3cycles/1cycles").values,
              ElementsAre("1cycles", "2cycles", "62.5ns"));
}

TEST(SweepParameter, ListsAndRangesMix) {
  EXPECT_THAT(parse_parameter("user_cpu.fsmc.datast=1,4..6,15").values, ElementsAre("1", "4", "5", "6", "15"));
  EXPECT_THAT(parse_parameter("baud=12M,6M").values, ElementsAre("12M", "6M"));
  EXPECT_THAT(parse_parameter("init.dpv1=false,true").values, ElementsAre("false", "true"));
  EXPECT_THAT(parse_parameter("slaves.0.gsd=../a.gsd,b.gsd").values, ElementsAre("../a.gsd", "b.gsd"));
}

TEST(SweepParameter, WrongOnesAreNamed) {
  EXPECT_EQ(error_of("user_cpu.fsmc.datast=0..256"),
            "--param user_cpu.fsmc.datast=0..256: datast is \"256\", expected a whole number from 0 to 255 HCLK");
  EXPECT_EQ(error_of("user_cpu.fsmc.datast=5..1"),
            "--param user_cpu.fsmc.datast=5..1: range 5..1 ends before it begins");
  EXPECT_EQ(error_of("user_cpu.fsmc.datast=1..5/0"),
            "--param user_cpu.fsmc.datast=1..5/0: range 1..5/0 has no step forward, expected a step above 0");
  EXPECT_EQ(error_of("user_cpu.fsmc.datast=1..x"),
            "--param user_cpu.fsmc.datast=1..x: range 1..x is not understood, expected FIRST..LAST or "
            "FIRST..LAST/STEP");
  EXPECT_EQ(error_of("user_cpu.cycle=1us..5us"),
            "--param user_cpu.cycle=1us..5us: range 1us..5us is not understood, expected FIRST..LAST/STEP in times, "
            "like 10ns..100ns/10ns");
  EXPECT_EQ(error_of("user_cpu.fsmc.addset=1,0..2"),
            "--param user_cpu.fsmc.addset=1,0..2: 1 is there twice, expected once");
  EXPECT_EQ(error_of("user_cpu.cycle=1us..1s/1us"),
            "--param user_cpu.cycle=1us..1s/1us: range 1us..1s/1us has more than 10000 values");
  EXPECT_EQ(error_of("baud=12M,11M").substr(0, 47), "--param baud=12M,11M: baud is \"11M\" (did you me");
}

TEST(SweepPlan, LastParameterChangesFastest) {
  const Plan plan{"s.yaml", {"end=1ms"}, "", {{"a.x", {"1", "2"}}, {"b", {"7", "8", "9"}}}};
  EXPECT_EQ(plan.points(), 6U);
  EXPECT_THAT(plan.values(0), ElementsAre("1", "7"));
  EXPECT_THAT(plan.values(1), ElementsAre("1", "8"));
  EXPECT_THAT(plan.values(5), ElementsAre("2", "9"));
  EXPECT_THAT(plan.settings_of(3), ElementsAre("end=1ms", "a.x=2", "b=7"));
}

TEST(SweepPlan, NamesAreShortWhereThatIsClear) {
  const Plan plan{"s.yaml", {}, "", {{"a.x", {"1"}}, {"b.x", {"1"}}, {"b.y", {"1"}}}};
  EXPECT_EQ(plan.short_name(0), "a.x");
  EXPECT_EQ(plan.short_name(2), "y");
}

TEST(SweepPlan, NeedsParametersEachOnceAndNotTooManyPoints) {
  EXPECT_EQ(error_of(Plan{"s.yaml", {}, "", {}}),
            "dsdpv1-sim sweep: --param is missing, expected something like --param user_cpu.fsmc.datast=0..15");
  EXPECT_EQ(error_of(Plan{"s.yaml", {"a=1"}, "", {{"a", {"2"}}}}), "--param a: is set twice, expected once");
  const std::vector<std::string> many(1000, "1");
  EXPECT_EQ(error_of(Plan{"s.yaml", {}, "", {{"a", many}, {"b", many}}}),
            "dsdpv1-sim sweep: more than 100000 points, expected fewer values or parameters");
}

}  // namespace
}  // namespace dsdpv1
