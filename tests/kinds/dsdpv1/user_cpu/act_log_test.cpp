// Which instruction an act of the processor belongs to, and where it was while it did nothing.
#include "kinds/user_cpu/act_log.hpp"

#include <gtest/gtest.h>

namespace dsdpv1::user_cpu {
namespace {

using bus::Tick;

constexpr Tick kStart = 1000, kPeriod = ActLog::kSamplePeriod;

std::string page(std::uint32_t pc) { return pc < 0x1000 ? std::to_string(pc >> 8U) : ""; }

TEST(ActLog, ActIsTheLastOneUpToItsTime) {
  ActLog log(kStart);
  EXPECT_FALSE(log.instruction(Act::done(5000)));
  log.pins(2000, 0x100, false);
  log.access(3000, 0x200, 0x006, 1, false);
  EXPECT_FALSE(log.instruction(Act::done(1999)));
  EXPECT_EQ(log.instruction(Act::done(2000)), 0x100U);
  EXPECT_EQ(log.instruction(Act::done(2999)), 0x100U);
  EXPECT_EQ(log.instruction(Act::done(9000)), 0x200U);
}

TEST(ActLog, CellIsWrittenByTheLastStoreThatCoversItElseByTheRelease) {
  ActLog log(kStart);
  log.access(2000, 0x100, 0x00E, 4, true);  // B00E to B011
  log.access(2100, 0x110, 0x010, 1, false);
  log.access(2200, 0x120, 0x012, 1, true);
  log.pins(2300, 0x130, true);
  log.pins(2400, 0x140, false);
  EXPECT_EQ(log.instruction(Act::written(0x010, 3000)), 0x100U);
  EXPECT_EQ(log.instruction(Act::written(0x011, 3000)), 0x100U);
  EXPECT_EQ(log.instruction(Act::written(0x012, 3000)), 0x120U);
  EXPECT_EQ(log.instruction(Act::written(0x00D, 3000)), 0x130U);
  EXPECT_EQ(log.instruction(Act::written(0x00D, 2250)), 0x120U) << "no release either";
}

TEST(ActLog, ActsOlderThanWhatIsKeptAreNotKnown) {
  ActLog log(kStart);
  for (std::uint32_t i = 0; i < 1000; ++i) log.pins(2000 + Tick{i}, i, false);
  EXPECT_EQ(log.instruction(Act::done(2999)), 999U);
  EXPECT_FALSE(log.instruction(Act::done(2100)));
}

TEST(ActLog, OmissionIsWhereTheProgramWasLongest) {
  ActLog log(kStart);
  Tick now = kStart;
  const auto runs = [&](std::uint32_t pc, int periods, std::uint32_t lr = 0xFFFF'FFF9) {
    for (int i = 0; i < periods; ++i) log.sample(now += kPeriod, pc, lr);
  };
  runs(0x100, 50);
  const Tick since = now;
  runs(0x104, 3);
  runs(0x210, 2);
  runs(0x230, 2);
  runs(0x310, 1);
  const Tick until = now;
  runs(0x400, 50);
  const auto stay = log.longest_stay(since, until, page);
  ASSERT_TRUE(stay);
  EXPECT_EQ(stay->pc, 0x230U);
  EXPECT_EQ(stay->time, 4 * kPeriod);
  EXPECT_FALSE(log.longest_stay(since, since + kPeriod / 2, page)) << "no sample in between";
}

TEST(ActLog, OmissionIsInTheFunctionThatWaitsNotInTheOneThatItAsksForTheTime) {
  ActLog log(kStart);
  Tick now = kStart;
  const auto runs = [&](std::uint32_t pc, std::uint32_t lr) { log.sample(now += kPeriod, pc, lr); };
  for (int i = 0; i < 10; ++i) runs(0x100, 0x220), runs(0x104, 0x220), runs(0x210, 0x220);
  const auto stay = log.longest_stay(kStart, now, page);
  ASSERT_TRUE(stay);
  EXPECT_EQ(stay->pc, 0x210U);
  EXPECT_EQ(stay->time, 30 * kPeriod);
  for (int i = 0; i < 40; ++i) runs(0x500, 0x620);  // a leaf is meant rather than its caller
  EXPECT_EQ(log.longest_stay(kStart, now, page)->pc, 0x500U);
}

TEST(ActLog, SleepIsSampledWhenItEndsHoweverLongItWas) {
  ActLog log(kStart);
  log.sample(kStart + 1'000'000 * kPeriod, 0x100, 0);
  EXPECT_GT(log.sample_at(), kStart + 1'000'000 * kPeriod);
  const auto stay = log.longest_stay(kStart + 999'950 * kPeriod, kStart + 1'000'000 * kPeriod, page);
  ASSERT_TRUE(stay);
  EXPECT_EQ(stay->time, 50 * kPeriod);
}

}  // namespace
}  // namespace dsdpv1::user_cpu
