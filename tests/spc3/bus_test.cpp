// The asynchronous Intel bus at the pins (docs/spc3.md, "Pins"; A16, A42, A44, A58), edge by edge.
#include <string>

#include "tests/spc3/bus_user.hpp"

namespace dsdpv1::spc3_test {
namespace {

using spc3::Level;
using spc3::Reason;

constexpr Address kCell = 0x123;

/// "XREADY=0 at 7.000": pin, level and cycles since `from`.
std::string text(const std::vector<PinChange>& changes, Tick from) {
  std::string all;
  for (const PinChange& each : changes) {
    const Tick since = each.at - from;
    all += std::string(all.empty() ? "" : ", ") + (each.pin == Pin::kXReady ? "ready" : "db") + " " +
           std::to_string(each.level) + " at " + std::to_string(since / profibus::kTicksPerCycle) + "." +
           std::to_string(since % profibus::kTicksPerCycle);
  }
  return all;
}

struct BusTest : testing::Test {
  explicit BusTest(spc3::Config config = {}, Variant variant = Variant::kApc3, Bus bus = Bus::kIntelAsync)
      : bench(variant, config), user(bench, bus) {
    bench.power_on();
  }
  /// The changes of DB and XREADY during `act`, counted from an edge of CLK; `act` begins 100 ticks after it.
  template <class Act>
  std::string changes_during(const Act& act) {
    const Tick edge = (bench.cycle() + 1) * profibus::kTicksPerCycle;
    bench.run_until(edge + 100);
    const std::size_t before = bench.twins.trace.size();
    act();
    bench.run_cycles(20);
    return text({bench.twins.trace.begin() + static_cast<std::ptrdiff_t>(before), bench.twins.trace.end()}, edge);
  }
  int count(profibus::Reason reason) const { return bench.count(reason); }
  std::uint8_t cell(Address address) const { return bench.twins.chip().peek(address); }

  Bench bench;
  BusUser user;
};

TEST_F(BusTest, AReadAnswersAtReadyAndAWriteActsAtItsEnd) {
  bench.twins.poke(kCell, 0xA5);
  // Begins at 0.100 and is seen at 1; ready six clocks later (A42). Ends at 10.100, released one clock after 11.
  EXPECT_EQ(changes_during([&] { EXPECT_EQ(user.read(kCell, 2500), 0xA5); }),
            "db -2 at 0.100, ready 0 at 7.0, db 165 at 7.0, db -1 at 10.100, ready 1 at 12.0");
  EXPECT_EQ(changes_during([&] {
              user.begin_write(kCell, 0x3C);
              user.wait(2499);
              EXPECT_EQ(cell(kCell), 0xA5);
              user.wait(1);
              user.end();
              EXPECT_EQ(cell(kCell), 0x3C);
            }),
            "ready 0 at 7.0, ready 1 at 12.0")
      << "DB is driven in reads only";
  EXPECT_TRUE(bench.twins.events.empty());
}

TEST_F(BusTest, ACommandActsOnceAtReady) {
  const Address command = regs::kNewDin;
  user.begin_read(command);
  user.wait(6 * profibus::kTicksPerCycle);
  EXPECT_EQ(cell(regs::kDinSm), 0xE1);
  user.wait(2 * profibus::kTicksPerCycle);
  const std::uint8_t after = cell(regs::kDinSm);
  EXPECT_NE(after, 0xE1);
  user.wait(100 * profibus::kTicksPerCycle);
  EXPECT_EQ(user.end_read(), 3);
  EXPECT_EQ(cell(regs::kDinSm), after);
}

struct EachBus : testing::TestWithParam<Bus> {};
INSTANTIATE_TEST_SUITE_P(Buses, EachBus,
                         testing::Values(Bus::kIntelAsync, Bus::kIntelSync, Bus::kMotorolaAsync, Bus::kMotorolaSync));

TEST_P(EachBus, AndTheRegisterCallAreOneMap) {
  Bench bench, other;
  bench.power_on();
  other.power_on();
  BusUser user(bench, GetParam());
  const auto swap = [](Address address) { return is_motorola(GetParam()) ? spc3::swapped(address) : address; };
  const std::pair<Address, int> accesses[] = {
      {regs::kIrr, 0x0F},     {regs::kIar, 0x03},  {regs::kImr, 0x00},   {0x16, 5},  {regs::kIrr, -1},
      {regs::kNewDin, -1},    {0x700, 0x55},       {regs::kNewDiag, -1}, {0x18, 7},  {regs::kStatus, -1},
      {regs::kIrr + 1, 0x20}, {regs::kIr + 1, -1}, {0x300, -1},          {0x19, -1}, {regs::kMode0 + 1, 1},
      {regs::kMode0, 0x10},   {regs::kMode1S, 2}};
  for (const auto& [address, value] : accesses) {
    if (value >= 0) {
      user.write(swap(address), static_cast<std::uint8_t>(value));
      other.store(address, static_cast<std::uint8_t>(value));
    } else {
      EXPECT_EQ(user.read(swap(address)), other.load(address)) << address;
    }
    other.run_cycles(16);
  }
  for (Address i = 0; i < 0x600; ++i) ASSERT_EQ(bench.twins.chip().peek(i), other.twins.chip().peek(i)) << i;
  EXPECT_EQ(bench.twins.chip().level(Pin::kXInt), other.twins.chip().level(Pin::kXInt));
  EXPECT_EQ(bench.count(Reason::kBeforeReady), 0);
}

TEST(MotorolaBus, ExchangesTheBytesOfWordsOnly) {
  std::string exchanged;
  for (Address i = 0; i < 0x600; ++i)
    if (spc3::swapped(i) != i) exchanged += std::to_string(i) + "-" + std::to_string(spc3::swapped(i)) + " ";
  EXPECT_EQ(exchanged, "0-1 1-0 2-3 3-2 4-5 5-4 6-7 7-6 24-25 25-24 ");
}

TEST_F(BusTest, EarlyRdyIsOneClockSooner) {
  user.write(regs::kMode0, 0x20);
  EXPECT_EQ(changes_during([&] { user.write(kCell, 1); }), "ready 0 at 6.0, ready 1 at 12.0");
  EXPECT_EQ(changes_during([&] { user.read(kCell); }),
            "db -2 at 0.100, ready 0 at 6.0, db 1 at 7.0, db -1 at 10.100, ready 1 at 12.0");
  // A command acts with the data (A16).
  changes_during([&] {
    user.begin_read(regs::kNewDin);
    user.wait(6 * profibus::kTicksPerCycle - 100);
    EXPECT_EQ(bench.twins.chip().level(Pin::kXReady), 0);
    EXPECT_EQ(cell(regs::kDinSm), 0xE1);
    user.wait(profibus::kTicksPerCycle);
    EXPECT_NE(cell(regs::kDinSm), 0xE1);
    user.end();
  });
  EXPECT_EQ(count(Reason::kBeforeReady), 0);
  changes_during([&] { user.write(kCell, 2, 6 * profibus::kTicksPerCycle); });  // after XREADY, before ready
  EXPECT_EQ(count(Reason::kBeforeReady), 1);
  EXPECT_EQ(cell(kCell), 2);
}

struct BusTimes : BusTest {
  static spc3::Config config() {
    spc3::Config config;
    config.ready = 9;
    config.ready_release = 3;
    config.clock = 24;
    return config;
  }
  BusTimes() : BusTest(config(), Variant::kSpc3) {}
};
TEST_F(BusTimes, AreParametersThatDoubleWith24MHz) {
  EXPECT_EQ(changes_during([&] { user.read(kCell, 6000); }),
            "db -2 at 0.100, ready 0 at 19.0, db 0 at 19.0, db -1 at 24.100, ready 1 at 31.0");
}

TEST_F(BusTest, AnAccessBeforeReadyIsReportedAndServed) {
  bench.twins.poke(kCell, 0x77);
  user.begin_read(kCell);
  user.wait(300);
  EXPECT_EQ(user.end_read(), 0x77) << "sampled at the end";
  user.write(kCell, 0x78, 300);
  EXPECT_EQ(cell(kCell), 0x78);
  EXPECT_EQ(count(Reason::kBeforeReady), 2);
  // Sampled in time or not, a command acts once.
  user.begin_read(regs::kNewDin);
  user.wait(300);
  EXPECT_EQ(bench.twins.sample(bench.now()), 3);
  user.wait(3000);
  EXPECT_EQ(user.end_read(), 3);
  EXPECT_EQ(cell(regs::kDinSm) & 0x30, 0x30);
  EXPECT_EQ(count(Reason::kBeforeReady), 3) << "once in an access";
  // Without a sample the command acts at its end.
  user.begin_read(regs::kNewDin);
  user.wait(300);
  user.end();
  EXPECT_EQ(cell(regs::kDinSm) & 0x30, 0x20);
  const profibus::Event& event = bench.twins.events.front();
  EXPECT_EQ(spc3::describe(event), "the access to 123H ends 6 clocks before it is ready (write 0)");
}

struct StrictBus : BusTest {
  static spc3::Config config() {
    spc3::Config config;
    config.ready_rule = 1;
    return config;
  }
  StrictBus() : BusTest(config()) {}
};
TEST_F(StrictBus, GivesNothingBeforeReady) {
  bench.twins.poke(kCell, 0x77);
  const Tick six_clocks = 6 * profibus::kTicksPerCycle;
  EXPECT_EQ(changes_during([&] {
              user.begin_read(kCell);
              user.wait(six_clocks);
              EXPECT_EQ(bench.twins.sample(bench.now()), spc3::kLevelX);
              user.end();
            }),
            "db -2 at 0.100, db -1 at 6.100");
  user.write(kCell, 0x78, six_clocks);
  EXPECT_EQ(cell(kCell), 0x77);
  user.begin_read(regs::kNewDin);
  user.wait(300);
  user.end();
  EXPECT_EQ(cell(regs::kDinSm), 0xE1);
  EXPECT_EQ(count(Reason::kBeforeReady), 3);
  EXPECT_EQ(user.read(kCell), 0x77);
}

TEST_F(BusTest, XcsAndStrobeMakeTheAccessInAnyOrder) {
  bench.twins.poke(kCell, 0x42);
  user.set(Pin::kAb, kCell);
  user.set(Pin::kXRd, 0);
  user.wait(5000);
  EXPECT_EQ(bench.twins.chip().level(Pin::kXReady), 1) << "not selected";
  EXPECT_EQ(changes_during([&] {
              user.set(Pin::kXCs, 0);
              user.wait(2500);
              user.set(Pin::kXCs, 1);
            }),
            "db -2 at 0.100, ready 0 at 7.0, db 66 at 7.0, db -1 at 10.100, ready 1 at 12.0");
  user.set(Pin::kXRd, 1);
  user.set(Pin::kDbIn, 0x43);
  user.set(Pin::kXWr, 0);
  user.wait(5000);
  user.set(Pin::kXWr, 1);
  EXPECT_EQ(cell(kCell), 0x42);
  EXPECT_TRUE(bench.twins.events.empty());
}

TEST_F(BusTest, WhatTheCpuDoesNotDriveIsReported) {
  user.begin_write(kCell, spc3::kLevelZ);
  user.wait(2500);
  user.end();
  EXPECT_EQ(cell(kCell), 0xFF);
  EXPECT_EQ(count(Reason::kUnknownData), 1);
  user.set(Pin::kAb, spc3::kLevelX);
  user.set(Pin::kXCs, 0);
  user.set(Pin::kXRd, 0);
  user.wait(2500);
  EXPECT_EQ(bench.twins.chip().level(Pin::kDbOut), spc3::kLevelX);
  user.end();
  EXPECT_EQ(count(Reason::kUnknownAddress), 1);
}

TEST_F(BusTest, OfTwoStrobesTheFirstGoesOn) {
  bench.twins.poke(kCell, 0x42);
  user.begin_read(kCell);
  user.wait(1000);
  user.set(Pin::kXWr, 0);
  user.wait(2500);
  EXPECT_EQ(bench.twins.chip().level(Pin::kDbOut), 0x42);
  EXPECT_EQ(count(Reason::kBothStrobes), 1);
  user.set(Pin::kDbIn, 0x11);
  user.set(Pin::kXRd, 1);
  user.wait(2500);
  user.end();
  EXPECT_EQ(cell(kCell), 0x11);
}

TEST_F(BusTest, ResetEndsAnAccess) {
  user.begin_read(kCell);
  user.wait(2500);
  bench.twins.set(bench.now(), Pin::kReset, 1);
  EXPECT_EQ(bench.twins.chip().level(Pin::kDbOut), spc3::kLevelZ);
  EXPECT_EQ(bench.twins.chip().level(Pin::kXReady), 1);
  user.end();
  EXPECT_EQ(count(Reason::kInReset), 0);
  user.begin_write(kCell, 9);
  user.wait(2500);
  user.end();
  EXPECT_EQ(count(Reason::kInReset), 1);
  EXPECT_EQ(cell(kCell), 0);
}

TEST_F(BusTest, XtestAtLowIsReported) {
  user.set(Pin::kXTest1, 0);
  EXPECT_EQ(spc3::describe(bench.twins.events.at(0)), "XTEST1 is low: no effect here");
  EXPECT_EQ(bench.twins.chip().level(Pin::kClkOut), spc3::kLevelX) << "A43";
}

// --- the other buses -------------------------------------------------------------------------------------------------

struct MotorolaAsync : BusTest {
  MotorolaAsync() : BusTest({}, Variant::kApc3, Bus::kMotorolaAsync) {}
};
TEST_F(MotorolaAsync, AsAndXcsAreTheStrobeAndXdtackAnswers) {
  bench.twins.poke(kCell, 0xA5);
  EXPECT_EQ(changes_during([&] { EXPECT_EQ(user.read(kCell, 2500), 0xA5); }),
            "db -2 at 0.100, ready 0 at 7.0, db 165 at 7.0, db -1 at 10.100, ready 1 at 12.0");
  EXPECT_EQ(changes_during([&] { user.write(kCell, 0x3C); }), "ready 0 at 7.0, ready 1 at 12.0");
  EXPECT_EQ(cell(kCell), 0x3C);
  user.write(kCell, 0x3D, 300);
  EXPECT_EQ(count(Reason::kBeforeReady), 1);
}

struct MotorolaSync : BusTest {
  MotorolaSync() : BusTest({}, Variant::kApc3, Bus::kMotorolaSync) {}
};
TEST_F(MotorolaSync, AnswersAClockAfterTheStrobeIsSeen) {
  EXPECT_EQ(changes_during([&] { user.read(kCell); }), "db -2 at 0.100, db 0 at 2.0, db -1 at 10.100");
}

struct Synchronous : BusTest {
  static spc3::Config config() {
    spc3::Config config;
    config.strobe = 3;
    return config;
  }
  explicit Synchronous(Bus bus = Bus::kMotorolaSync) : BusTest(config(), Variant::kApc3, bus) {}
};
TEST_F(Synchronous, HasNoReadyAndAReadActsAfterStrobe) {
  bench.twins.poke(kCell, 0xA5);
  EXPECT_EQ(changes_during([&] { EXPECT_EQ(user.read(kCell, 2500), 0xA5); }),
            "db -2 at 0.100, db 165 at 4.0, db -1 at 10.100");
  EXPECT_EQ(changes_during([&] { user.write(kCell, 0x3C, 300); }), "");
  EXPECT_EQ(cell(kCell), 0x3C);
  user.begin_read(regs::kNewDin);  // shorter than strobe: acts at its end
  user.wait(300);
  EXPECT_EQ(cell(regs::kDinSm), 0xE1);
  user.end();
  EXPECT_NE(cell(regs::kDinSm), 0xE1);
  EXPECT_TRUE(bench.twins.events.empty());
}

struct IntelSync : Synchronous {
  IntelSync() : Synchronous(Bus::kIntelSync) {}
};
TEST_F(IntelSync, LatchesTheAddressAndSelectsItself) {
  bench.twins.poke(kCell, 0xA5);
  user.begin_read(kCell);
  user.set(Pin::kDbIn, 0x44);  // after ALE: no matter
  user.wait(2500);
  EXPECT_EQ(bench.twins.chip().level(Pin::kDbOut), 0xA5);
  user.end();
  for (const unsigned line : {0x0800U, 0x1000U, 0x8000U}) {  // A15 to A11 (A45)
    user.write(static_cast<Address>(kCell | line), 0x11);
    EXPECT_EQ(cell(kCell), 0xA5) << line;
    user.begin_read(static_cast<Address>(kCell | line));
    user.wait(2500);
    EXPECT_EQ(bench.twins.chip().level(Pin::kDbOut), spc3::kLevelZ);
    user.end();
  }
  EXPECT_TRUE(bench.twins.events.empty());
  user.begin_read(kCell);
  user.end();
  user.set(Pin::kAb, spc3::kLevelZ);
  user.set(Pin::kXRd, 0);
  user.wait(2500);
  EXPECT_EQ(bench.twins.chip().level(Pin::kDbOut), spc3::kLevelX) << "A58";
  user.end();
  EXPECT_EQ(count(Reason::kUnknownAddress), 1);
  // Both strobes before AB selects: reported when it does, as BUS_STROBES.
  user.set(Pin::kAb, 0x40);
  user.set(Pin::kXRd, 0);
  user.set(Pin::kXWr, 0);
  EXPECT_EQ(count(Reason::kBothStrobes), 0);
  user.set(Pin::kAb, 0x01);
  EXPECT_EQ(count(Reason::kBothStrobes), 1);
  user.end();
}

}  // namespace
}  // namespace dsdpv1::spc3_test
