// The heat maps as text: cells, colours, borders.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lab/sweep/heat_map.hpp"

namespace dsdpv1 {
namespace {

using tb::sweep::heat_maps;
using tb::sweep::Plan;
using tb::sweep::Point;
using testing::HasSubstr;
using testing::Not;

Point with(double tw, double ts) {
  Point point;
  point.checks = {{"TW", 1, tw < 0 ? 1 : 0, tw}, {"TS", 1, 0, ts}};
  return point;
}

Point impossible() {
  Point point;
  point.exit = 2;
  point.error = "a < b & c";
  return point;
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

const Plan kPlan{"folder/s.yaml", {}, "", {{"u.d", {"0", "1", "2"}}, {"u.a", {"5", "6"}}}};

TEST(SweepMap, HasACellAPointWithTheWorstMarginAndABorder) {
  const std::string svg =
      heat_maps(kPlan, {with(-3.5, 9), with(-1, 9), with(4, 9), with(5, 9), with(20, 9), impossible()}).at(0).svg;
  EXPECT_EQ(count(svg, "<title>"), 6U);
  for (const char* number : {">-3.5<", ">-1.0<", ">4.0<", ">5.0<", ">9.0<"}) EXPECT_THAT(svg, HasSubstr(number));
  EXPECT_THAT(svg, HasSubstr("stroke-width=\"3\" fill=\"none\""));
  EXPECT_THAT(svg, HasSubstr("fill=\"url(#hatch)\" stroke"));
  EXPECT_THAT(svg, HasSubstr("a &lt; b &amp; c"));
  EXPECT_THAT(svg, HasSubstr(">s.yaml<"));
  EXPECT_THAT(svg, Not(HasSubstr("folder")));
}

TEST(SweepMap, ShowsOneCheckWhenAsked) {
  const std::vector<Point> points(6, with(4, 9));
  EXPECT_THAT(heat_maps(kPlan, points, "TS").at(0).svg, HasSubstr("margin of TS / ns"));
  EXPECT_EQ(count(heat_maps(kPlan, points, "TS").at(0).svg, ">9.0<"), 6U);
  EXPECT_EQ(count(heat_maps(kPlan, points).at(0).svg, ">4.0<"), 6U);
}

TEST(SweepMap, WithoutChecksItSaysWhetherItHolds) {
  Point fails;
  fails.exit = 1;
  const std::string svg = heat_maps(kPlan, {Point(), Point(), Point(), fails, fails, fails}).at(0).svg;
  EXPECT_EQ(count(svg, ">holds<"), 4U);  // three cells and the legend
  EXPECT_EQ(count(svg, ">fails<"), 3U);
}

TEST(SweepMap, OneParameterIsOneRowAndManyValuesHaveNarrowCellsWithoutNumbers) {
  Plan plan{"s.yaml", {}, "", {{"u.d", {}}}};
  for (int i = 0; i < 200; ++i) plan.parameters[0].values.push_back(std::to_string(i));
  const auto pictures = heat_maps(plan, std::vector<Point>(200, with(4, 9)));
  ASSERT_EQ(pictures.size(), 1U);
  EXPECT_EQ(pictures[0].name, "map.svg");
  EXPECT_EQ(count(pictures[0].svg, "<title>"), 200U);
  EXPECT_EQ(count(pictures[0].svg, ">4.0<"), 0U);
}

TEST(SweepMap, ThirdParameterMakesAPictureForEachValue) {
  Plan plan = kPlan;
  plan.parameters.push_back({"u.third", {"x", "y"}});
  const auto pictures = heat_maps(plan, std::vector<Point>(12, with(4, 9)));
  ASSERT_EQ(pictures.size(), 2U);
  EXPECT_EQ(pictures[1].name, "map_2.svg");
  EXPECT_THAT(pictures[1].svg, HasSubstr("u.third=y"));
  EXPECT_EQ(count(pictures[1].svg, "<title>"), 6U);
}

}  // namespace
}  // namespace dsdpv1
