// The FSMC's edges compared with the figures of the STM32F103xE datasheet and with its own HCLK counts.
#include "kinds/user_cpu/fsmc_access.hpp"

#include "bus/time.hpp"

#include <gtest/gtest.h>

namespace dsdpv1 {
namespace {

using bus::Tick;
using user_cpu::FsmcAccess;
using user_cpu::FsmcBank;
using user_cpu::FsmcMode;
using user_cpu::FsmcTiming;

/// One HCLK is then exactly 1 us: 12000 ticks.
constexpr Tick kHclk = 12000;

FsmcAccess at_1_mhz(FsmcMode mode, const FsmcTiming& timing) {
  return user_cpu::access_timing({mode, timing, timing, 1'000'000});
}

TEST(FsmcTiming, ReadOfTheDatasheetHasCsrAndRdLowForFiveHclk) {
  const AccessTiming read = at_1_mhz(FsmcMode::k1, {0, 1, 0}).read;
  EXPECT_EQ(read.cs_lead, 0);            // tv(NOE_NE)
  EXPECT_EQ(read.address_setup, 0);      // tv(A_NE)
  EXPECT_EQ(read.rd_low, 5 * kHclk);     // tw(NOE), and with the next tw(NE)
  EXPECT_EQ(read.cs_trail, 0);           // th(NE_NOE)
  EXPECT_EQ(read.rd_sample, 3 * kHclk);  // 2 HCLK before CSR rises
  EXPECT_EQ(read.address_hold, 0);
}

TEST(FsmcTiming, WriteOfTheDatasheetHasCsrLowForThreeHclkAndWrForOne) {
  const AccessTiming write = at_1_mhz(FsmcMode::k1, {0, 1, 0}).write;
  EXPECT_EQ(write.cs_lead, kHclk);       // tv(NWE_NE)
  EXPECT_EQ(write.wr_low, kHclk);        // tw(NWE)
  EXPECT_EQ(write.cs_trail, kHclk);      // th(NE_NWE)
  EXPECT_EQ(write.data_setup, kHclk);    // tv(Data_NE)
  EXPECT_EQ(write.data_hold, kHclk);     // th(Data_NWE)
  EXPECT_EQ(write.address_hold, kHclk);  // th(A_NWE)
}

TEST(FsmcTiming, EachFieldMovesItsEdges) {
  const FsmcAccess access = at_1_mhz(FsmcMode::k1, {3, 7, 2});
  EXPECT_EQ(access.read.rd_sample, (4 + 8) * kHclk);
  EXPECT_EQ(access.read.rd_low, (4 + 8 + 2) * kHclk);
  EXPECT_EQ(access.read.recovery, 3 * kHclk);
  EXPECT_EQ(access.write.address_setup, 4 * kHclk);
  EXPECT_EQ(access.write.wr_low, 7 * kHclk);
  EXPECT_EQ(access.write.recovery, 3 * kHclk);
}

TEST(FsmcTiming, ModeAHoldsRdBackForTheAddressPhaseOnly) {
  const FsmcAccess a = at_1_mhz(FsmcMode::kA, {3, 7, 2}), one = at_1_mhz(FsmcMode::k1, {3, 7, 2});
  EXPECT_EQ(a.read.cs_lead, 4 * kHclk);
  EXPECT_EQ(a.read.address_setup, 4 * kHclk);
  EXPECT_EQ(a.read.cs_lead + a.read.rd_sample, one.read.rd_sample);
  EXPECT_EQ(a.read.cs_lead + a.read.rd_low, one.read.rd_low);
  EXPECT_EQ(a.read.recovery, 4 * kHclk);
  EXPECT_EQ(a.write.wr_low, one.write.wr_low);
}

TEST(FsmcTiming, ModeATakesReadsAndWritesFromTheirOwnRegisters) {
  const FsmcAccess access = user_cpu::access_timing({FsmcMode::kA, {0, 9, 0}, {0, 2, 0}, 1'000'000});
  EXPECT_EQ(access.read.rd_sample, 10 * kHclk);
  EXPECT_EQ(access.write.wr_low, 2 * kHclk);
}

TEST(FsmcTiming, EdgesAt72MHzAreRoundedOnceFromTheirHclkCount) {
  for (int datast = 0; datast <= 255; ++datast) {
    const AccessTiming write =
        user_cpu::access_timing({FsmcMode::k1, {1, datast, 0}, {1, datast, 0}, 72'000'000}).write;
    const Tick rise = write.address_setup + write.wr_low;
    EXPECT_LE(std::abs(3 * rise - 500 * (2 + datast)), 1) << datast;                      // HCLK is 500/3 ticks
    EXPECT_LE(std::abs(3 * (rise + write.data_hold) - 500 * (3 + datast)), 1) << datast;  // and nothing adds up
  }
}

TEST(FsmcTiming, ReservedDatast0GivesWritesWithoutLowTime) {
  EXPECT_EQ(at_1_mhz(FsmcMode::k1, {1, 0, 0}).write.wr_low, 0);
}

TEST(FsmcTiming, OverrideReplacesOnlyWhatItNames) {
  FsmcBank bank;
  bank.read = {4, 5, 6};
  bank.write = {7, 8, 9};
  user_cpu::FsmcOverride given;
  given.datast = 1;
  const FsmcBank same = user_cpu::with(bank, given);
  EXPECT_EQ(same.read.addset, 4);
  EXPECT_EQ(same.read.datast, 1);
  EXPECT_EQ(same.write.datast, 1);
  EXPECT_EQ(same.write.busturn, 9);
  EXPECT_EQ(same.mode, FsmcMode::k1);
  EXPECT_EQ(same.hclk_hz, 72'000'000);
  given.mode = FsmcMode::kA;
  given.hclk_mhz = 36;
  EXPECT_EQ(user_cpu::with(bank, given).mode, FsmcMode::kA);
  EXPECT_EQ(user_cpu::with(bank, given).hclk_hz, 36'000'000);
}

}  // namespace
}  // namespace dsdpv1
