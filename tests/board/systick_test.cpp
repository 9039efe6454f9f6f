#include "board/cpu/systick.hpp"

#include <gtest/gtest.h>

namespace dsdpv1::arm {
namespace {

constexpr std::uint32_t kCtrl = 0x10, kLoad = 0x14, kVal = 0x18, kCalib = 0x1C;
constexpr std::uint32_t kEnable = 1, kTickInt = 2, kProcessorClock = 4, kCountFlag = 1U << 16;

SysTick started(std::uint32_t reload, std::uint32_t control, std::uint64_t now) {
  SysTick tick;
  tick.store(kLoad, reload, now);
  tick.store(kVal, 0, now);
  tick.store(kCtrl, control, now);
  return tick;
}

TEST(SysTickTimer, ReachesZeroEveryReloadPlusOneCycles) {
  SysTick tick = started(99, kEnable | kTickInt | kProcessorClock, 1000);
  EXPECT_EQ(tick.next(), 1100U);
  EXPECT_FALSE(tick.catch_up(1099));
  EXPECT_EQ(tick.peek(kVal, 1099), 1U);
  EXPECT_TRUE(tick.catch_up(1100));
  EXPECT_EQ(tick.peek(kVal, 1100), 0U);
  EXPECT_EQ(tick.peek(kVal, 1101), 99U);
  EXPECT_EQ(tick.next(), 1200U);
}

TEST(SysTickTimer, OneCatchUpMayPassSeveralPeriods) {
  SysTick tick = started(9, kEnable | kTickInt | kProcessorClock, 0);
  EXPECT_TRUE(tick.catch_up(57));
  EXPECT_EQ(tick.next(), 60U);
  EXPECT_FALSE(tick.catch_up(59));
}

TEST(SysTickTimer, WithoutTickIntOnlyTheFlagIsSetAndReadingClearsIt) {
  SysTick tick = started(9, kEnable | kProcessorClock, 0);
  EXPECT_EQ(tick.next(), kNever);
  EXPECT_FALSE(tick.catch_up(10));
  EXPECT_EQ(tick.peek(kCtrl, 10), kCountFlag | kEnable | kProcessorClock);
  EXPECT_EQ(tick.load(kCtrl, 10), kCountFlag | kEnable | kProcessorClock);
  EXPECT_EQ(tick.load(kCtrl, 10), kEnable | kProcessorClock);
}

TEST(SysTickTimer, TheExternalClockIsAnEighth) {
  SysTick tick = started(9, kEnable | kTickInt, 0);
  EXPECT_EQ(tick.next(), 80U);
  EXPECT_EQ(tick.peek(kVal, 8), 9U);
  EXPECT_EQ(tick.peek(kVal, 9), 9U);
  EXPECT_EQ(tick.peek(kVal, 16), 8U);
}

TEST(SysTickTimer, ANewReloadCountsFromTheNextPeriodOn) {
  SysTick tick = started(99, kEnable | kTickInt | kProcessorClock, 0);
  tick.store(kLoad, 9, 50);
  EXPECT_EQ(tick.next(), 100U);
  EXPECT_TRUE(tick.catch_up(100));
  EXPECT_EQ(tick.next(), 110U);
}

TEST(SysTickTimer, IsZeroForOneCountWhateverTheReloadBecomes) {
  SysTick tick = started(99, kEnable | kProcessorClock, 0);
  tick.catch_up(100);
  tick.store(kLoad, 49, 100);
  EXPECT_EQ(tick.peek(kVal, 100), 0U);
  EXPECT_EQ(tick.peek(kVal, 101), 99U);
  EXPECT_EQ(tick.peek(kVal, 150), 50U);
}

TEST(SysTickTimer, AWriteToTheCounterClearsItAndTheFlagWithoutAnException) {
  SysTick tick = started(99, kEnable | kTickInt | kProcessorClock, 0);
  EXPECT_TRUE(tick.catch_up(100));
  tick.store(kVal, 55, 130);
  EXPECT_EQ(tick.peek(kVal, 130), 0U);
  EXPECT_EQ(tick.peek(kCtrl, 130) & kCountFlag, 0U);
  EXPECT_EQ(tick.next(), 230U);
}

TEST(SysTickTimer, StandsWhileNotEnabledAndGoesOnFromThere) {
  SysTick tick = started(99, kEnable | kTickInt | kProcessorClock, 0);
  tick.store(kCtrl, kTickInt | kProcessorClock, 40);
  EXPECT_EQ(tick.next(), kNever);
  EXPECT_EQ(tick.peek(kVal, 500), 60U);
  tick.store(kCtrl, kEnable | kTickInt | kProcessorClock, 1000);
  EXPECT_EQ(tick.next(), 1060U);
}

TEST(SysTickTimer, WithoutReloadItStopsAtZero) {
  SysTick tick = started(99, kEnable | kTickInt | kProcessorClock, 0);
  tick.store(kLoad, 0, 10);
  EXPECT_TRUE(tick.catch_up(100));
  EXPECT_EQ(tick.next(), kNever);
  EXPECT_EQ(tick.peek(kVal, 5000), 0U);
  SysTick never = started(0, kEnable | kTickInt | kProcessorClock, 0);
  EXPECT_EQ(never.next(), kNever);
}

TEST(SysTickTimer, CalibrationIsAMillisecondOfTheExternalClock) { EXPECT_EQ(SysTick().peek(kCalib, 0), 9000U); }

}  // namespace
}  // namespace dsdpv1::arm
