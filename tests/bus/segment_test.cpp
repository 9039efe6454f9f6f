#include "bus/wire/segment.hpp"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

namespace dsdpv1::bus {
namespace {

struct Recorder : Listener {
  void line_changed(Tick at, bool level) override { changes.emplace_back(at, level); }
  std::vector<std::pair<Tick, bool>> changes;
};

using Changes = std::vector<std::pair<Tick, bool>>;

struct SegmentTest : testing::Test {
  SegmentTest() {
    a = segment.attach("A", &ear_a);
    b = segment.attach("B", &ear_b);
    segment.on_collision = [this](const Collision& collision) { collisions.push_back(collision); };
  }
  Segment segment;
  Recorder ear_a, ear_b;
  StationId a = 0, b = 0;
  std::vector<Collision> collisions;
};

TEST_F(SegmentTest, IdleIsHigh) { EXPECT_TRUE(segment.level()); }

TEST_F(SegmentTest, EverybodyHearsTheDriverTheDriverToo) {
  segment.drive(a, 10, true, false);
  segment.drive(a, 20, true, true);
  EXPECT_EQ(ear_a.changes, (Changes{{10, false}, {20, true}}));
  EXPECT_EQ(ear_b.changes, ear_a.changes);
}

TEST_F(SegmentTest, EnablingADriverAtIdleLevelChangesNothing) {
  segment.drive(a, 10, true, true);
  segment.drive(a, 20, false, true);
  EXPECT_TRUE(ear_b.changes.empty());
}

TEST_F(SegmentTest, ReleasingALowDriverReturnsToIdle) {
  segment.drive(a, 10, true, false);
  segment.drive(a, 15, false, false);
  EXPECT_TRUE(segment.level());
}

TEST_F(SegmentTest, TwoDriversCollideAlsoAtTheSameLevel) {
  segment.drive(a, 10, true, true);
  segment.drive(b, 30, true, true);
  ASSERT_EQ(collisions.size(), 1U);
  EXPECT_EQ(collisions[0].at, 30);
  EXPECT_EQ(collisions[0].first, "A");
  EXPECT_EQ(collisions[0].second, "B");
}

TEST_F(SegmentTest, ACollisionIsReportedOnceForEachEnabling) {
  segment.drive(a, 10, true, true);
  segment.drive(b, 30, true, true);
  segment.drive(b, 31, true, false);
  segment.drive(b, 32, false, true);
  EXPECT_EQ(collisions.size(), 1U);
  segment.drive(b, 40, true, true);
  EXPECT_EQ(collisions.size(), 2U);
}

TEST_F(SegmentTest, LowWinsACollision) {
  segment.drive(a, 10, true, true);
  segment.drive(b, 30, true, false);
  EXPECT_FALSE(segment.level());
}

TEST_F(SegmentTest, OneAfterTheOtherIsNoCollision) {
  segment.drive(a, 10, true, true);
  segment.drive(a, 20, false, true);
  segment.drive(b, 20, true, true);
  EXPECT_TRUE(collisions.empty());
}

TEST_F(SegmentTest, AForcedLevelHidesTheDrivers) {
  segment.force(5, false);
  segment.drive(a, 10, true, true);
  EXPECT_FALSE(segment.level());
  segment.force(20, std::nullopt);
  EXPECT_TRUE(segment.level());
  EXPECT_EQ(ear_b.changes, (Changes{{5, false}, {20, true}}));
}

TEST_F(SegmentTest, AnUnpluggedStationHearsIdleAndIsNotHeard) {
  segment.drive(a, 10, true, false);
  segment.plug(b, 12, false);
  EXPECT_EQ(ear_b.changes, (Changes{{10, false}, {12, true}}));
  EXPECT_TRUE(segment.level_at(b));
  segment.drive(b, 14, true, false);
  EXPECT_TRUE(collisions.empty());
  segment.drive(a, 16, false, true);
  EXPECT_TRUE(segment.level());
}

TEST_F(SegmentTest, PluggingInADrivingStationCollides) {
  segment.plug(b, 1, false);
  segment.drive(b, 2, true, true);
  segment.drive(a, 3, true, true);
  segment.plug(b, 4, true);
  EXPECT_EQ(collisions.size(), 1U);
}

TEST(Segment, AListenerThatDrivesAtOnceKeepsTheOrderForTheOthers) {
  struct Echo : Listener {
    void line_changed(Tick at, bool level) override {
      if (!level) segment->drive(own, at, true, true), segment->drive(other, at, false, true);
    }
    Segment* segment = nullptr;
    StationId own = 0, other = 0;
  } echo;
  Segment segment;
  Recorder before, after;
  segment.attach("before", &before);
  echo.segment = &segment;
  echo.own = segment.attach("echo", &echo);
  segment.attach("after", &after);
  echo.other = segment.attach("sender", nullptr);
  segment.drive(echo.other, 7, true, false);
  EXPECT_EQ(before.changes, (Changes{{7, false}, {7, true}}));
  EXPECT_TRUE(after.changes.empty());
}

// --- listeners that receive late ------------------------------------------------------------------------------------

TEST_F(SegmentTest, TheDeafHearAllWhenTheyAskEachChangeWithItsTick) {
  segment.set_deafness(b, {10, 30});
  for (const Tick at : {10, 20, 29}) segment.drive(a, at, true, at == 20);
  EXPECT_TRUE(ear_b.changes.empty());
  segment.hear(b);
  EXPECT_EQ(ear_b.changes, (Changes{{10, false}, {20, true}, {29, false}}));
  EXPECT_EQ(ear_a.changes, ear_b.changes);
  segment.hear(b);
  EXPECT_EQ(ear_b.changes.size(), 3U);
}

TEST_F(SegmentTest, BeforeTheNextChangeTheDeafHearWhatTheyMissed) {
  segment.set_deafness(b, {10, 30});
  segment.drive(a, 9, true, false);
  segment.drive(a, 15, true, true);
  segment.drive(a, 30, true, false);
  EXPECT_EQ(ear_b.changes, (Changes{{9, false}, {15, true}, {30, false}}));
}

TEST_F(SegmentTest, WhoIsPluggedOutHasHeardWhatWasBefore) {
  segment.set_deafness(b, {0, kNever});
  segment.drive(a, 10, true, false);
  segment.plug(b, 20, false);
  EXPECT_EQ(ear_b.changes, (Changes{{10, false}, {20, true}}));
  segment.drive(a, 30, true, true);
  segment.drive(a, 40, true, false);
  segment.hear(b);
  EXPECT_EQ(ear_b.changes.size(), 2U);
  segment.plug(b, 50, true);
  EXPECT_EQ(ear_b.changes, (Changes{{10, false}, {20, true}, {50, false}}));
}

TEST_F(SegmentTest, HoweverLongTheDeafAreTheyMissNothing) {
  segment.set_deafness(b, {0, kNever});
  for (Tick at = 0; at < 20'000; ++at) segment.drive(a, at, true, at % 2 != 0);
  segment.hear(b);
  EXPECT_EQ(ear_b.changes.size(), 20'000U);
  EXPECT_EQ(ear_b.changes, ear_a.changes);
}

/// Answers a low line by driving it, inside the call.
struct Echo : Listener {
  void line_changed(Tick at, bool level) override {
    if (!level) segment->force(at, true);
  }
  Segment* segment = nullptr;
};

TEST(Segment, WhatComesAndGoesAtOneTickIsHeardByNobodyBehind) {
  Segment segment;
  Echo first;
  Recorder second;
  const StationId driver = segment.attach("driver", nullptr);
  segment.attach("first", &first);
  segment.attach("second", &second);
  first.segment = &segment;
  segment.drive(driver, 10, true, false);
  EXPECT_TRUE(second.changes.empty());
}

// --- the level before ------------------------------------------------------------------------------------------------

TEST_F(SegmentTest, LevelBeforeATickIsThatBeforeAllChangesAtIt) {
  segment.drive(a, 10, true, false);
  EXPECT_TRUE(segment.level_before(10));
  EXPECT_FALSE(segment.level_before(11));
  segment.drive(a, 20, true, true);
  segment.drive(a, 20, true, false);
  EXPECT_FALSE(segment.level_before(20));
  segment.drive(a, 20, true, true);
  EXPECT_FALSE(segment.level_before(20));
  EXPECT_TRUE(segment.level_before(21));
}

/// Takes runs as a whole.
struct Taker : Listener {
  void line_changed(Tick, bool) override {}
  bool run_begins(const CharacterRun&) override { return true; }
  void run_cut(Tick, bool) override {}
};

TEST(Segment, LevelBeforeATickInARunIsThatOfItsCharactersAndSoItIsWhenTheRunIsCutThere) {
  constexpr Tick kBit = 1000, kStart = 100'000;
  constexpr std::uint8_t kBytes[] = {0xFE};  // the start bit, then bit 0, are low: up at the end of two bits
  for (const bool cut : {false, true}) {
    for (const Tick at : {kStart, kStart + 1, kStart + 2 * kBit, kStart + 2 * kBit + 1}) {
      Segment segment;
      Taker sender;
      const StationId station = segment.attach("sender", &sender);
      segment.drive(station, 1, true, true);
      ASSERT_TRUE(segment.send_run(station, {kStart, kBit, kBytes, 1}));
      if (cut) segment.cut_run(at);
      EXPECT_EQ(segment.level_before(at), at == kStart || at > kStart + 2 * kBit) << at << (cut ? ", cut" : "");
    }
  }
}

// --- runs that a filter keeps from a listener ------------------------------------------------------------------------

constexpr Tick kFilteredBit = 1000, kFirstRun = 100'000, kNextRun = 500'000;

/// A telegram of these tests: the first byte is the addressee.
int reads(const std::uint8_t* bytes, std::size_t size) { return size == 2 ? bytes[0] : kNoTelegram; }

/// Records its calls as text.
struct FilteredListener : Listener {
  void line_changed(Tick at, bool level) override {
    note("line " + std::to_string(level) + " at " + std::to_string(at));
  }
  bool run_begins(const CharacterRun& run) override {
    note("run for " + std::to_string(run.bytes[0]) + " at " + std::to_string(run.start));
    return true;
  }
  void run_cut(Tick at, bool level) override { note("cut " + std::to_string(level) + " at " + std::to_string(at)); }
  void runs_passed(std::uint64_t for_stations) override { note(std::to_string(for_stations) + " passed"); }
  void note(std::string words) { told.push_back(std::move(words)); }
  std::vector<std::string> told;
};

struct FilterTest : testing::Test {
  FilterTest() {
    sender = segment.attach("sender", &ear_of_sender);
    listener = segment.attach("listener", &ear);
    segment.set_filter(listener, filter);
    segment.drive(sender, 1, true, true);
  }
  CharacterRun run_at(Tick start, std::vector<std::uint8_t> sent) {
    bytes = std::move(sent);  // as a sender does, which drops those of the previous run
    return {start, kFilteredBit, bytes.data(), bytes.size()};
  }
  void send(Tick start, std::vector<std::uint8_t> sent) {
    EXPECT_TRUE(segment.send_run(sender, run_at(start, std::move(sent))));
  }
  Segment segment;
  FilteredListener ear_of_sender, ear;
  StationId sender = 0, listener = 0;
  const RunFilter filter{&reads, 0, kFilteredBit, 5};
  std::vector<std::uint8_t> bytes;
};

using Words = std::vector<std::string>;

TEST_F(FilterTest, WhatIsForTheStationOrForAllOrNoTelegramIsTold) {
  send(kFirstRun, {5, 0});
  send(kNextRun, {127, 0});
  send(2 * kNextRun, {9, 0, 0});
  EXPECT_EQ(ear.told, (Words{"run for 5 at 100000", "run for 127 at 500000", "run for 9 at 1000000"}));
}

TEST_F(FilterTest, OfOthersTheLastIsToldLateAndThoseBeforeAreCounted) {
  send(kFirstRun, {9, 0});
  EXPECT_TRUE(ear.told.empty());
  segment.hear(listener);
  EXPECT_EQ(ear.told, (Words{"run for 9 at 100000"}));
  for (int i = 1; i <= 3; ++i) send(i * kNextRun, {7, 0});
  send(4 * kNextRun, {128, 0});  // for no station
  send(5 * kNextRun, {8, 0});
  ear.told.clear();
  segment.hear(listener);
  segment.hear(listener);
  EXPECT_EQ(ear.told, (Words{"3 passed", "run for 8 at 2500000"}));
}

TEST_F(FilterTest, BeforeARunForTheStationTheLastOfOthersIsTold) {
  send(kFirstRun, {9, 0});
  send(kNextRun, {5, 0});
  EXPECT_EQ(ear.told, (Words{"run for 9 at 100000", "run for 5 at 500000"}));
}

TEST_F(FilterTest, HoldsForItsBitTimeFromItsTimeOnAndAfterAGap) {
  segment.set_filter(listener, {&reads, kFirstRun + 1, kFilteredBit, 5});
  send(kFirstRun, {9, 0});
  segment.set_filter(listener, {&reads, 0, kFilteredBit + 1, 5});
  send(kNextRun, {8, 0});
  segment.set_filter(listener, filter);
  const Tick end = kNextRun + 2 * kCharacterBits * kFilteredBit;
  send(end + 2 * kFilteredBit - 1, {7, 0});
  EXPECT_EQ(ear.told, (Words{"run for 9 at 100000", "run for 8 at 500000", "run for 7 at 523999"}));
  ear.told.clear();
  send(end + 2 * kFilteredBit - 1 + 2 * kCharacterBits * kFilteredBit + 2 * kFilteredBit, {7, 0});
  EXPECT_TRUE(ear.told.empty());
}

TEST_F(FilterTest, ACutOneIsToldBeforeItsCut) {
  send(kFirstRun, {9, 0});
  segment.force(kFirstRun + kFilteredBit / 2, false);
  EXPECT_EQ(ear.told, (Words{"run for 9 at 100000", "cut 0 at 100500"}));
}

TEST_F(FilterTest, AfterItsEndAChangeOfTheLineTellsItFirst) {
  send(kFirstRun, {9, 0});
  segment.force(kNextRun, false);
  EXPECT_EQ(ear.told, (Words{"run for 9 at 100000", "line 0 at 500000"}));
}

TEST_F(FilterTest, AnUnpluggedStationHasNone) {
  send(kFirstRun, {9, 0});
  segment.plug(listener, kNextRun, false);
  EXPECT_EQ(ear.told, (Words{"run for 9 at 100000"}));
  segment.plug(listener, kNextRun + 1, true);
  send(2 * kNextRun, {7, 0});
  EXPECT_EQ(ear.told.back(), "run for 7 at 1000000");
}

}  // namespace
}  // namespace dsdpv1::bus
