#include "board/cpu/nvic.hpp"

#include <gtest/gtest.h>

namespace dsdpv1::arm {
namespace {

constexpr unsigned kIrq0 = kFirstInterrupt;
constexpr std::uint32_t kAllLanes = ~0U;
constexpr std::uint32_t kIser = 0x100, kIcer = 0x180, kIspr = 0x200, kIcpr = 0x280, kIabr = 0x300, kIpr = 0x400;

TEST(Nvic, AnInterruptIsTakenOnlyWhenEnabledAndPending) {
  Nvic nvic;
  nvic.set_pending(kIrq0 + 3);
  EXPECT_EQ(nvic.foremost(), kNoException);
  nvic.store(kIser, 1U << 3, kAllLanes);
  EXPECT_EQ(nvic.preempting(Nvic::kIdlePriority), kIrq0 + 3);
  nvic.store(kIcer, 1U << 3, kAllLanes);
  EXPECT_EQ(nvic.foremost(), kNoException);
  EXPECT_TRUE(nvic.pending(kIrq0 + 3));
}

TEST(Nvic, SetAndClearRegistersActOnTheOnesThatAreWritten) {
  Nvic nvic;
  nvic.store(kIser, 0xF, kAllLanes);
  nvic.store(kIser, 0, kAllLanes);
  nvic.store(kIcer, 0x2, kAllLanes);
  EXPECT_EQ(nvic.load(kIser), 0xDU);
  EXPECT_EQ(nvic.load(kIcer), 0xDU);
  nvic.store(kIser, 0xFFFFFFFF, 0x0000FF00);
  EXPECT_EQ(nvic.load(kIser), 0xFF0DU) << "bytes that are not written stay";
  nvic.store(kIspr, 0x5, kAllLanes);
  nvic.store(kIcpr, 0x4, kAllLanes);
  EXPECT_EQ(nvic.load(kIspr), 1U);
}

TEST(Nvic, ThirdWordHoldsTheLastFourInterrupts) {
  Nvic nvic;
  nvic.store(kIser + 8, 0xFFFFFFFF, kAllLanes);
  EXPECT_EQ(nvic.load(kIser + 8), 0xFU);
  nvic.store(kIser + 12, 0xFFFFFFFF, kAllLanes);
  EXPECT_EQ(nvic.load(kIser + 12), 0U);
}

TEST(Nvic, PrioritiesHaveFourBits) {
  Nvic nvic;
  nvic.store(kIpr + 4, 0x1F2F3F4F, 0x00FFFFFF);
  EXPECT_EQ(nvic.load(kIpr + 4), 0x00203040U);
  EXPECT_EQ(nvic.priority(kIrq0 + 5), 0x30);
  EXPECT_EQ(nvic.load(kIpr + 0x44), 0U) << "beyond the last interrupt";
}

TEST(Nvic, TheLowerNumberGoesFirstAmongEquals) {
  Nvic nvic;
  nvic.store(kIser, 0xFF, kAllLanes);
  nvic.store(kIspr, 0xFF, kAllLanes);
  EXPECT_EQ(nvic.foremost(), kIrq0);
  nvic.set_priority(kIrq0, 0x10);
  EXPECT_EQ(nvic.foremost(), kIrq0 + 1);
  nvic.set_pending(kPendSv);
  EXPECT_EQ(nvic.foremost(), kPendSv + 0U);
  nvic.set_pending(kHardFault);
  nvic.set_pending(kNmi);
  EXPECT_EQ(nvic.foremost(), kNmi + 0U);
}

TEST(Nvic, OnlyAHigherGroupPriorityPreempts) {
  Nvic nvic;
  nvic.set_grouping(5);  // bits 7 and 6 preempt
  nvic.store(kIser, 7, kAllLanes);
  nvic.set_priority(kIrq0, 0x70);
  nvic.set_priority(kIrq0 + 1, 0x40);
  nvic.set_priority(kIrq0 + 2, 0x30);
  nvic.begin(kIrq0);
  EXPECT_EQ(nvic.active_priority(), 0x40);
  nvic.set_pending(kIrq0 + 1);
  EXPECT_EQ(nvic.preempting(nvic.active_priority()), kNoException);
  nvic.set_pending(kIrq0 + 2);
  EXPECT_EQ(nvic.preempting(nvic.active_priority()), kIrq0 + 2);
}

TEST(Nvic, MasksRaiseTheExecutionPriority) {
  Nvic nvic;
  EXPECT_EQ(nvic.execution_priority({false, false, 0}), Nvic::kIdlePriority + 0);
  EXPECT_EQ(nvic.execution_priority({false, false, 0x50}), 0x50);
  EXPECT_EQ(nvic.execution_priority({true, false, 0x50}), 0);
  EXPECT_EQ(nvic.execution_priority({true, true, 0x50}), -1);
  nvic.begin(kNmi);
  EXPECT_EQ(nvic.execution_priority({true, true, 0x50}), -2);
}

TEST(Nvic, ActiveOnesAreCountedAndShown) {
  Nvic nvic;
  nvic.begin(kIrq0 + 33);
  nvic.begin(kSysTick);
  EXPECT_EQ(nvic.active_count(), 2U);
  EXPECT_EQ(nvic.load(kIabr + 4), 2U);
  nvic.end(kIrq0 + 33);
  EXPECT_EQ(nvic.active_count(), 1U);
  EXPECT_EQ(nvic.load(kIabr + 4), 0U);
}

TEST(Nvic, APulseDuringTheHandlerIsRemembered) {
  Nvic nvic;
  nvic.store(kIser, 1, kAllLanes);
  nvic.set_pending(kIrq0);
  nvic.begin(kIrq0);
  EXPECT_FALSE(nvic.pending(kIrq0));
  nvic.set_pending(kIrq0);
  nvic.end(kIrq0);
  EXPECT_TRUE(nvic.pending(kIrq0));
}

TEST(Nvic, AHighLevelCannotBeClearedAndComesBackAfterReturn) {
  Nvic nvic;
  nvic.set_level(kIrq0, true);
  nvic.clear_pending(kIrq0);
  EXPECT_TRUE(nvic.pending(kIrq0));
  nvic.begin(kIrq0);
  EXPECT_FALSE(nvic.pending(kIrq0));
  nvic.end(kIrq0);
  EXPECT_TRUE(nvic.pending(kIrq0));
  nvic.set_level(kIrq0, false);
  EXPECT_TRUE(nvic.pending(kIrq0)) << "what became pending stays so";
  nvic.clear_pending(kIrq0);
  EXPECT_FALSE(nvic.pending(kIrq0));
}

TEST(Nvic, ResetForgetsEverything) {
  Nvic nvic;
  nvic.set_grouping(3);
  nvic.store(kIser, 1, kAllLanes);
  nvic.set_level(kIrq0, true);
  nvic.begin(kNmi);
  nvic.reset();
  EXPECT_EQ(nvic.load(kIser), 0U);
  EXPECT_EQ(nvic.load(kIspr), 0U);
  EXPECT_EQ(nvic.grouping(), 0U);
  EXPECT_EQ(nvic.active_priority(), Nvic::kIdlePriority + 0);
}

}  // namespace
}  // namespace dsdpv1::arm
