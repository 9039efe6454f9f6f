// The parts of a report that collect the page's contents.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tb/report/html/diagram_watch.hpp"
#include "tb/report/html/distribution.hpp"
#include "tb/report/html/pin_memory.hpp"
#include "tb/report/html/telegram_list.hpp"

namespace dsdpv1 {
namespace {

using tb::DiagramEdge;
using tb::Moment;
using tb::Turn;
using tb::html::DiagramWatch;
using tb::html::Distribution;
using tb::html::PinMemory;

constexpr tb::PinNumber kStrobe = 0, kData = 1;
constexpr DiagramEdge kFall{kStrobe, Turn::kFall}, kRise{kStrobe, Turn::kRise}, kChange{kData, Turn::kChange};

TEST(ReportDistribution, KeepsExactLimitsAndAllCountsInBoundedMemory) {
  Distribution times;
  for (bus::Tick value = 1; value <= 100'000; ++value) times.add(value);
  EXPECT_EQ(times.count(), 100'000U);
  EXPECT_EQ(times.least(), 1);
  EXPECT_EQ(times.greatest(), 100'000);
  EXPECT_DOUBLE_EQ(times.mean(), 50'000.5);
  EXPECT_LE(times.values().size(), Distribution::kMost);
  std::uint64_t sum = 0;
  for (const auto& [value, count] : times.values()) {
    sum += count;
    EXPECT_EQ(value % times.step(), 0);
  }
  EXPECT_EQ(sum, 100'000U);
}

TEST(ReportDistribution, OfNothingIsNothing) {
  const Distribution times;
  EXPECT_EQ(times.least(), 0);
  EXPECT_EQ(times.greatest(), 0);
  EXPECT_EQ(times.mean(), 0);
}

TEST(ReportPinMemory, KnowsTheLevelBeforeItsOldestChange) {
  PinMemory memory(1);
  memory.begin(0, 1);
  EXPECT_EQ(memory.trace(0, 0, 10).first, 1);
  const auto changes = static_cast<bus::Tick>(PinMemory::kDepth) + 1;
  for (bus::Tick at = 1; at <= changes; ++at) memory.add(at, 0, static_cast<tb::Level>(at));
  EXPECT_EQ(memory.trace(0, 0, 1).first, 1) << "the level of the change that was forgotten";
  EXPECT_EQ(memory.trace(0, 5, 7).first, 5);
  EXPECT_EQ(memory.trace(0, 5, 7).steps.size(), 2U);
}

TEST(ReportTelegrams, ThoseOfAHostPortHaveALaneOfTheirOwn) {
  const tb::scenario::Scenario scenario;
  tb::html::TelegramList list(scenario);
  list.add("card", {100, 200, false, "read B014, length 1", {0x01, 0x00, 0x14, 0x01, 0x18, 0xCF}, ""});
  list.add("card", {300, 400, true, "reply", {0x81}, "cut after 1 bytes"});
  EXPECT_THAT(list.lanes(), testing::ElementsAre("card, host"));
  EXPECT_THAT(list.texts(),
              testing::ElementsAre("01 00 14 01 18 CF  read B014, length 1", "81  reply: cut after 1 bytes"));
  ASSERT_EQ(list.kept().size(), 2U);
  EXPECT_EQ(list.kept()[0].start, 100);
  EXPECT_EQ(list.kept()[0].end, 200);
  EXPECT_EQ(list.kept()[0].group, tb::html::TelegramGroup::kHost);
  EXPECT_EQ(list.kept()[1].group, tb::html::TelegramGroup::kWrong);
}

/// A strobe with setup and hold of its data, at least 10 ticks each.
class ReportDiagram : public testing::Test {
 protected:
  ReportDiagram() { memory_.begin(kStrobe, 1); }
  void set(bus::Tick at, tb::PinNumber pin, tb::Level level) {
    memory_.add(at, pin, level);
    watch_.pin(at, pin, level);
  }
  void strobe(bus::Tick at, bus::Tick setup, bus::Tick hold) {
    set(at - 50, kStrobe, 0);
    set(at - setup, kData, 1);
    set(at, kStrobe, 1);
    set(at + hold, kData, 0);
  }
  tb::TimingDiagram diagram_{"write",
                             "",
                             "",
                             {kRise},
                             {{"setup", {Moment::Of::kBefore, {kChange}}, {}, "SETUP"},
                              {"hold", {}, {Moment::Of::kAfter, {kChange}}, "HOLD"},
                              {"low", {Moment::Of::kBefore, {kFall}}, {}}},
                             100,
                             {kStrobe, kData}};
  PinMemory memory_{2};
  DiagramWatch watch_{diagram_, {{10, {}}, {10, {}}, {}}, memory_};
};

TEST_F(ReportDiagram, ShowsTheInstanceWithTheLeastMargin) {
  strobe(1'000, 30, 30);
  strobe(2'000, 30, 12);
  strobe(3'000, 25, 30);
  watch_.finish();
  EXPECT_EQ(watch_.instances(), 3U);
  ASSERT_TRUE(watch_.worst());
  EXPECT_EQ(watch_.worst()->instance.anchor, 2'000);
  EXPECT_EQ(watch_.worst()->instance.margin(), 2);
  EXPECT_EQ(watch_.worst()->instance.spans[0].measured(), 30);
  EXPECT_EQ(watch_.worst()->instance.spans[2].measured(), 50);
}

TEST_F(ReportDiagram, PictureHasTheChangesOfTheInstanceAndALittleBeside) {
  strobe(1'000, 30, 12);
  set(5'000, kStrobe, 0);
  ASSERT_TRUE(watch_.worst());
  EXPECT_LT(watch_.worst()->from, 950);
  EXPECT_GT(watch_.worst()->to, 1'012);
  EXPECT_LT(watch_.worst()->to, 5'000);
  ASSERT_EQ(watch_.worst()->pins.size(), 2U);
  EXPECT_EQ(watch_.worst()->pins[0].first, 1);
  EXPECT_EQ(watch_.worst()->pins[0].steps.size(), 2U);
  EXPECT_EQ(watch_.worst()->pins[1].steps.size(), 2U);
}

TEST_F(ReportDiagram, MomentThatDoesNotComeIsLeftOut) {
  strobe(1'000, 30, 5'000);
  watch_.finish();
  ASSERT_TRUE(watch_.worst());
  EXPECT_FALSE(watch_.worst()->instance.spans[1].seen());
  EXPECT_EQ(watch_.worst()->instance.margin(), 20);
}

TEST_F(ReportDiagram, NothingSeenIsNoPicture) {
  watch_.finish();
  EXPECT_FALSE(watch_.worst());
}

}  // namespace
}  // namespace dsdpv1
