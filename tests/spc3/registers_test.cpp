// The address map, interrupts, mode registers and the RAM's end (docs/spc3.md, "Address map", "Events"; A3, A5, A8 to
// A15, A36).
#include "tests/spc3/bench.hpp"

namespace dsdpv1::spc3_test {
namespace {

using spc3::Reason;

TEST(Spc3Registers, AfterResetTheyAreAsThePageSays) {
  for (const Variant variant : {Variant::kApc3, Variant::kSpc3, Variant::kVpc3}) {
    Bench bench(variant);
    bench.power_on();
    const std::uint8_t type = variant == Variant::kVpc3 ? 0xC0 : 0x00;
    const Bytes after = {0, 0, 0, 0, 0, static_cast<std::uint8_t>(type | 0x0F), 0, 0, 0xE1};
    for (Address i = 0; i < after.size(); ++i) EXPECT_EQ(bench.load(i), after[i]) << i;
    EXPECT_EQ(bench.load(regs::kDoutSm), 0xE1);
    EXPECT_EQ(bench.load(regs::kDiagSm), 0x09);
    for (const int reserved : {0x12, 0x13, 0x15}) EXPECT_EQ(bench.load(static_cast<Address>(reserved)), 0);
    bench.store(regs::kMode0, 0x40);
    bench.store(regs::kMode0 + 1, 0x01);
    bench.set_mode1(regs::kMode1EnChangeCfg);
    const bool readable = variant == Variant::kVpc3;
    EXPECT_EQ(bench.load(regs::kMode0), readable ? 0x40 : 0);
    EXPECT_EQ(bench.load(regs::kMode0 + 1), readable ? 0x01 : 0);
    EXPECT_EQ(bench.load(regs::kMode1Read), readable ? regs::kMode1EnChangeCfg : 0);
    EXPECT_EQ(bench.twins.chip().level(Pin::kXInt), 1) << "A12";
  }
}

TEST(Spc3Registers, ModeRegister0IsForOfflineOnly) {
  Bench bench(Variant::kVpc3);
  bench.to_wait_prm();
  const std::uint8_t before = bench.load(regs::kMode0);
  bench.store(regs::kMode0, 0xFF);
  EXPECT_EQ(bench.load(regs::kMode0), before);
  EXPECT_EQ(bench.count(Reason::kMode0Online), 1);
}

TEST(Spc3Registers, PeekAndPokeHaveNoEffect) {
  Bench bench;
  bench.to_data_ex();
  bench.exchange({1, 2});
  const std::uint8_t states = bench.load(regs::kDoutSm);
  const spc3::Chip& chip = bench.twins.chip();
  EXPECT_EQ(chip.peek(regs::kNextDout), 0);
  EXPECT_EQ(chip.peek(regs::kDoutSm), states);
  EXPECT_EQ(chip.peek(0x600 + regs::kBuffers), chip.peek(0x200 + regs::kBuffers));
  bench.twins.poke(regs::kMode1S, regs::kMode1GoOffline);
  bench.twins.poke(0x300, 0x77);
  bench.run_cycles(5);
  EXPECT_EQ(bench.state(), DpState::kDataExch);
  EXPECT_EQ(bench.load(0x300), 0x77);
  EXPECT_EQ(bench.load(regs::kStatus) & 8, 0);
}

// --- interrupts ------------------------------------------------------------------------------------------------------

class Interrupts : public testing::Test {
 protected:
  void SetUp() override {
    bench.power_on();
    bench.store(regs::kImr, 0);
    bench.store(regs::kImr + 1, 0);
  }
  int level() const { return bench.twins.chip().level(Pin::kXInt); }

  Bench bench{Variant::kSpc3};
};

TEST_F(Interrupts, TheLatchFollowsIrAndOnlyEoiEndsIt) {
  bench.store(regs::kIrr, 0x02);
  bench.run_cycles(1);
  EXPECT_EQ(level(), 1);
  bench.run_cycles(1);
  EXPECT_EQ(level(), 0) << "int_delay later (A40)";
  bench.store(regs::kIar, 0x02);
  bench.run_cycles(100);
  EXPECT_EQ(level(), 0);
  EXPECT_EQ(bench.irr(), 0);
  bench.set_mode1(regs::kMode1Eoi);
  bench.run_cycles(1);
  EXPECT_EQ(level(), 1);
  bench.run_cycles(200);
  EXPECT_EQ(level(), 1);
}

TEST_F(Interrupts, EoiWithAnEventLeftIsInactiveForItsTime) {
  for (const Cycle gap : {Cycle{48}, Cycle{48'000}}) {
    bench.store(regs::kMode0 + 1, gap == 48 ? 0x00 : 0x02);
    bench.store(regs::kIrr, 0x02);
    bench.run_cycles(2);
    EXPECT_EQ(level(), 0);
    bench.set_mode1(regs::kMode1Eoi);
    bench.run_cycles(1);
    EXPECT_EQ(level(), 1);
    bench.run_cycles(gap - 1);
    EXPECT_EQ(level(), 1);
    bench.run_cycles(1);
    EXPECT_EQ(level(), 0) << gap << " clocks later (A13)";
    bench.store(regs::kIrr, 0);
    bench.set_mode1(regs::kMode1Eoi);
    bench.run_cycles(2 * gap);
  }
}

TEST_F(Interrupts, AnEoiWithoutInterruptDoesNothing) {
  bench.set_mode1(regs::kMode1Eoi);
  bench.store(regs::kIrr, 0x02);
  bench.run_cycles(2);
  EXPECT_EQ(level(), 0) << "no inactive time";
}

TEST_F(Interrupts, TheMaskHidesEventsAndLetsThemThroughLater) {
  bench.store(regs::kImr, 0x02);
  bench.store(regs::kIrr, 0x02);
  bench.run_cycles(10);
  EXPECT_EQ(level(), 1);
  EXPECT_EQ(bench.load(regs::kIr), 0);
  EXPECT_EQ(bench.load(regs::kIrr), 2);
  bench.store(regs::kImr, 0x00);
  EXPECT_EQ(bench.load(regs::kIr), 2);
  bench.run_cycles(2);
  EXPECT_EQ(level(), 0);
}

TEST_F(Interrupts, AnEventThatGoesBeforeTheLatchLeavesNoInterrupt) {
  bench.store(regs::kIrr, 0x02);
  bench.run_cycles(1);
  bench.store(regs::kIar, 0x02);
  bench.run_cycles(10);
  EXPECT_EQ(level(), 1);
}

TEST_F(Interrupts, IntPolTurnsTheLevel) {
  bench.store(regs::kMode0, regs::kMode0IntPol);
  bench.run_cycles(1);
  EXPECT_EQ(level(), 0);
  bench.store(regs::kIrr, 0x02);
  bench.run_cycles(2);
  EXPECT_EQ(level(), 1);
}

TEST_F(Interrupts, IrrIsReplacedByteByByte) {
  bench.store(regs::kIrr, 0x06);
  bench.store(regs::kIrr + 1, 0x30);
  bench.store(regs::kIrr, 0x01);
  EXPECT_EQ(bench.irr(), 0x3001) << "A10, A11";
  bench.acknowledge(regs::kEventDxOut);
  EXPECT_EQ(bench.irr(), 0x1001);
}

TEST_F(Interrupts, AnEventAndItsAcknowledgementInOneClockLeaveTheEvent) {
  bench.initialise();
  const Cycle first = bench.cycle() + 1 + kMs;  // the edge that takes START, and a millisecond
  bench.start();
  bench.run_until(first * profibus::kTicksPerCycle);
  EXPECT_TRUE(bench.raised(regs::kEventUserTimer));
  bench.acknowledge(0xFFFF);
  bench.run_until((first + kMs - 1) * profibus::kTicksPerCycle);
  EXPECT_FALSE(bench.raised(regs::kEventUserTimer));
  bench.acknowledge(regs::kEventUserTimer);  // taken by the edge of the event
  bench.run_cycles(1);
  EXPECT_TRUE(bench.raised(regs::kEventUserTimer)) << "M 4.3";
}

TEST(UserTimer, ComesEachMillisecondOrTenOfSpc3AndVpc3) {
  for (const Variant variant : {Variant::kApc3, Variant::kSpc3, Variant::kVpc3}) {
    for (const Cycle ms : {1, 10}) {
      Bench bench(variant);
      bench.power_on();
      Organisation given;
      if (ms == 10) given.modes |= regs::kMode0UserTimeBase;
      bench.initialise(given);
      bench.start();
      bench.run_cycles(ms * kMs - 2);
      EXPECT_FALSE(bench.raised(regs::kEventUserTimer));
      bench.run_cycles(1);
      EXPECT_EQ(bench.raised(regs::kEventUserTimer), variant != Variant::kApc3) << "A36";
      bench.set_mode1(regs::kMode1GoOffline);
      bench.run_cycles(2);
      bench.acknowledge(regs::kEventUserTimer);
      bench.run_ms(2 * ms);
      EXPECT_FALSE(bench.raised(regs::kEventUserTimer)) << "not OFFLINE";
    }
  }
}

// --- the RAM's end ---------------------------------------------------------------------------------------------------

TEST(Violation, TheUsersAccessGoes400Lower) {
  Bench bench;
  bench.power_on();
  bench.store(0x210, 0x77);
  EXPECT_EQ(bench.load(0x5FF), 0);
  EXPECT_EQ(bench.load(0x610), 0x77);
  bench.run_cycles(1);
  EXPECT_EQ(bench.load(regs::kStatus), 0x08);
  EXPECT_TRUE(bench.raised(regs::kEventMacReset)) << "also when OFFLINE (A3)";
  EXPECT_EQ(bench.count(Reason::kRamViolation), 1);
  bench.store(0x611, 0x66);
  EXPECT_EQ(bench.load(0x211), 0x66);
  bench.initialise();
  bench.start();
  EXPECT_EQ(bench.load(regs::kStatus), 0x01) << "START clears it";
  bench.load(0x7FF);
  bench.run_cycles(1);
  EXPECT_EQ(bench.load(regs::kStatus), 0x08) << "OFFLINE";
}

TEST(Violation, AWrongPointerOfTheChipIsOne) {
  Bench bench;
  bench.to_wait_prm();
  bench.store(regs::kOrgAuxPointer, 0xBF);  // 5F8H
  bench.acknowledge(0xFFFF);
  EXPECT_EQ(kind_of(bench.set_prm({0, 0xEE})), "SC") << "answered first (A55)";
  EXPECT_EQ(bench.load(0x200), 0xEE);
  EXPECT_EQ(bench.load(regs::kStatus), 0x08);
  EXPECT_TRUE(bench.raised(regs::kEventMacReset));
}

TEST(Violation, MayOnlySetItsBit) {
  spc3::Config config;
  config.violation = 1;
  Bench bench(Variant::kSpc3, config);
  bench.to_wait_prm();
  bench.load(0x600);
  bench.run_cycles(5);
  EXPECT_EQ(bench.load(regs::kStatus), 0x49);
}

TEST(Violation, Vpc3Has2KbAndMayHave4) {
  Bench bench(Variant::kVpc3);
  bench.power_on();
  bench.store(0x7F0, 0x55);
  EXPECT_EQ(bench.load(0x7F0), 0x55);
  bench.load(0x7FC);
  EXPECT_EQ(bench.count(Reason::kErrorCounter), 1);
  bench.store(regs::kMode2, regs::kMode2Ram4k);
  bench.store(0xFF0, 0x66);
  EXPECT_EQ(bench.load(0xFF0), 0x66);
  EXPECT_EQ(bench.load(0x7F0), 0x55);
  EXPECT_EQ(bench.count(Reason::kRamViolation), 0);
  bench.store(regs::kMode2, 0);
  EXPECT_EQ(bench.load(0xBF0), 0x55);
  bench.run_cycles(1);
  EXPECT_EQ(bench.count(Reason::kRamViolation), 1);
}

TEST(Ram, AtPowerOnIsZeroOrFromASeed) {
  spc3::Config config;
  config.ram_seed = 7;
  Bench seeded(Variant::kApc3, config), zero;
  int set = 0;
  for (Address address = regs::kBuffers; address < 0x600; ++address) {
    set += seeded.twins.chip().peek(address) != 0;
    EXPECT_EQ(zero.twins.chip().peek(address), 0);
  }
  EXPECT_GT(set, 1400);
}

}  // namespace
}  // namespace dsdpv1::spc3_test
