// TIM2 to TIM5 and IWDG by their registers (RM0008, chapters 15 and 19).
#include "board/stm32/timer.hpp"

#include <gtest/gtest.h>

#include "board/stm32/watchdog.hpp"

namespace dsdpv1::arm {
namespace {

enum : std::uint32_t { kCen = 1, kUdis = 2, kUrs = 4, kOpm = 8, kArpe = 0x80 };

Timer counting(std::uint32_t psc, std::uint32_t arr, std::uint32_t control = kCen) {
  Timer timer;
  timer.write(Timer::kPsc, psc, 0);
  timer.write(Timer::kArr, arr, 0);
  timer.write(Timer::kEgr, 1, 0);
  timer.write(Timer::kSr, 0, 0);
  timer.write(Timer::kDier, 1, 0);
  timer.write(Timer::kCr1, control, 99);  // counts from 100 on
  return timer;
}

TEST(TimerBlock, CountsFromZeroToArrAndSetsUif) {
  Timer timer = counting(9, 4);
  EXPECT_EQ(timer.next(), 150U);
  EXPECT_EQ(timer.read(Timer::kCnt, 109), 0U);
  EXPECT_EQ(timer.read(Timer::kCnt, 110), 1U);
  EXPECT_EQ(timer.read(Timer::kCnt, 149), 4U);
  EXPECT_FALSE(timer.asks());
  EXPECT_EQ(timer.read(Timer::kSr, 150), 1U);
  EXPECT_TRUE(timer.asks());
  EXPECT_EQ(timer.read(Timer::kCnt, 150), 0U);
  EXPECT_EQ(timer.next(), Timer::kNever);
  timer.write(Timer::kSr, ~1U, 160);
  EXPECT_FALSE(timer.asks());
  EXPECT_EQ(timer.next(), 200U);
  EXPECT_EQ(timer.read(Timer::kCnt, 1'000'000'127), 2U);
}

TEST(TimerBlock, PscIsTakenWithTheNextUpdateAndArrAtOnceWithoutArpe) {
  Timer timer = counting(0, 9);
  timer.write(Timer::kPsc, 1, 102);
  EXPECT_EQ(timer.next(), 110U);
  timer.write(Timer::kArr, 19, 103);
  EXPECT_EQ(timer.next(), 120U);
  EXPECT_EQ(timer.read(Timer::kCnt, 125), 2U);
  Timer buffered = counting(0, 9, kCen | kArpe);
  buffered.write(Timer::kArr, 19, 103);
  EXPECT_EQ(buffered.next(), 110U);
  buffered.write(Timer::kSr, 0, 111);
  EXPECT_EQ(buffered.next(), 130U);
}

TEST(TimerBlock, UgBeginsAgainAndSetsUifUnlessUrsOrUdis) {
  Timer timer = counting(0, 99);
  timer.write(Timer::kEgr, 1, 149);
  EXPECT_TRUE(timer.asks());
  timer.write(Timer::kSr, 0, 149);
  EXPECT_EQ(timer.next(), 250U);
  timer.write(Timer::kCr1, kCen | kUrs, 160);
  timer.write(Timer::kEgr, 1, 169);
  EXPECT_FALSE(timer.asks());
  EXPECT_EQ(timer.next(), 270U);
  timer.write(Timer::kCr1, kCen | kUdis, 180);
  timer.write(Timer::kEgr, 1, 189);
  EXPECT_EQ(timer.read(Timer::kSr, 500), 0U);
  EXPECT_EQ(timer.next(), Timer::kNever);
}

TEST(TimerBlock, OpmStopsItAndCntIsWritten) {
  Timer timer = counting(0, 9, kCen | kOpm);
  timer.write(Timer::kCnt, 8, 101);
  EXPECT_EQ(timer.read(Timer::kSr, 104), 1U);
  EXPECT_EQ(timer.read(Timer::kCr1, 104), kOpm);
  EXPECT_EQ(timer.read(Timer::kCnt, 200), 0U);
}

TEST(TimerBlock, StandsStillWithoutItsClockAndFollowsItsDivider) {
  Timer timer = counting(0, 99);
  timer.follow(4, true, 120);
  EXPECT_EQ(timer.read(Timer::kCnt, 160), 20U + 9);  // from 124 on
  timer.follow(4, false, 160);
  EXPECT_EQ(timer.read(Timer::kCnt, 1000), 29U);
  EXPECT_EQ(timer.next(), Timer::kNever);
  timer.reset();
  EXPECT_EQ(timer.read(Timer::kArr, 1000), 0xFFFFU);
}

TEST(WatchdogBlock, TakesItsLengthFromPrAndRlr) {
  Watchdog dog(10);
  EXPECT_EQ(dog.next(), Watchdog::kNever);
  dog.write(0, 0xCCCC, 100);
  EXPECT_EQ(dog.next(), 100 + 4096 * 40);
  dog.write(4, 3, 200);  // closed
  EXPECT_EQ(dog.read(4, 200), 0U);
  dog.write(0, 0x5555, 200);
  dog.write(4, 3, 200);
  dog.write(8, 99, 200);
  EXPECT_EQ(dog.read(0xC, 249), 3U);
  EXPECT_EQ(dog.read(0xC, 250), 0U);
  dog.write(0, 0xAAAA, 300);
  EXPECT_EQ(dog.next(), 300 + 100 * 320);
  dog.write(8, 1, 300);  // the key was another
  EXPECT_EQ(dog.read(8, 300), 99U);
}

}  // namespace
}  // namespace dsdpv1::arm
