// The asynchronous host port: figure 6, table 15; rulings P5, P6, P8, P11, P12. Times in ticks: 12.5 ns are 150, 31.25
// ns are 375.
#include <map>
#include <random>

#include "tests/conformance/user_helpers.hpp"

namespace dsdpv1::conformance {
namespace {

constexpr Tick kTs = 150, kTd = 150, kTw = 375;
constexpr std::uint16_t kCell = 0x150;  // a cell that the user may write

struct WriteShape {
  Tick low = 300;                       ///< WR low
  Tick a_before = 400, d_before = 400;  ///< last change of A and D before WR's rise
  Tick a_after = 400, d_after = 400;    ///< first change of A and D after it
  Tick csr_after = 500;                 ///< CSR's rise after WR's rise; negative: before it
  bool drive = true;
};

class UserPort : public testing::Test {
 protected:
  void SetUp() override {
    bench.power_on();
    bench.acquire();
    bench.run_for(1000 - bench.now() % 1000);
  }
  void set(Tick at, Pin pin, Level level) {
    bench.run_until(at);
    bench.chip.set(at, pin, level);
  }
  /// One write with exactly these times; WR rises at `rise`. Afterwards the bus is quiet and the write settled.
  void write_shaped(Tick rise, std::uint16_t cell, std::uint8_t value, const WriteShape& shape) {
    const auto other_a = static_cast<Level>(0x7FF & ~cell);
    std::multimap<Tick, std::pair<Pin, Level>> plan;
    plan.insert({rise - 900, {Pin::kA, other_a}});
    plan.insert({rise - 900, {Pin::kDIn, static_cast<Level>(value ^ 0xFF)}});
    plan.insert({rise - 800, {Pin::kCsr, 0}});
    plan.insert({rise - shape.low, {Pin::kWr, 0}});
    plan.insert({rise - shape.a_before, {Pin::kA, static_cast<Level>(cell)}});
    plan.insert({rise - shape.d_before, {Pin::kDIn, shape.drive ? static_cast<Level>(value) : dsdpv1::kLevelZ}});
    if (shape.csr_after < 0) plan.insert({rise + shape.csr_after, {Pin::kCsr, 1}});
    plan.insert({rise, {Pin::kWr, 1}});
    plan.insert({rise + shape.a_after, {Pin::kA, other_a}});
    plan.insert({rise + shape.d_after, {Pin::kDIn, static_cast<Level>(value ^ 0xFF)}});
    if (shape.csr_after >= 0) plan.insert({rise + shape.csr_after, {Pin::kCsr, 1}});
    plan.insert({rise + 1500, {Pin::kDIn, dsdpv1::kLevelZ}});
    for (const auto& [at, change] : plan) set(at, change.first, change.second);
    bench.run_cycles(8);
  }
  void write_shaped(std::uint8_t value, const WriteShape& shape) { write_shaped(next_rise(), kCell, value, shape); }
  Tick next_rise() const { return bench.now() + 2000; }

  /// D long after RD fell; the bus is quiet again afterwards.
  Level read_slowly(std::uint16_t cell) {
    set(bench.now() + 500, Pin::kA, static_cast<Level>(cell));
    set(bench.now(), Pin::kCsr, 0);
    set(bench.now() + 200, Pin::kRd, 0);
    bench.run_for(2000);
    const Level data = bench.chip.level(Pin::kDOut);
    set(bench.now(), Pin::kRd, 1);
    set(bench.now() + 100, Pin::kCsr, 1);
    return data;
  }
  void expect_kept(std::uint8_t value, const WriteShape& shape) {
    const std::size_t events = bench.chip.events().size();
    write_shaped(value, shape);
    EXPECT_EQ(read_slowly(kCell), value);
    EXPECT_EQ(bench.chip.events().size(), events);
  }
  /// The violation is reported once, the cell holds what was captured and reads X, with a report, until written
  /// correctly.
  void expect_violated(std::uint8_t value, const WriteShape& shape, Reason reason) {
    const int before = bench.count(reason);
    const std::size_t events = bench.chip.events().size();
    write_shaped(value, shape);
    EXPECT_EQ(bench.count(reason), before + 1);
    EXPECT_EQ(bench.chip.events().size(), events + 1) << "nothing else is reported";
    EXPECT_EQ(bench.last(reason).a, kCell);
    const int unknown = bench.count(dsdpv1::Reason::kReadUnknown);
    EXPECT_EQ(read_slowly(kCell), dsdpv1::kLevelX);
    EXPECT_EQ(read_slowly(kCell), dsdpv1::kLevelX);
    EXPECT_EQ(bench.count(dsdpv1::Reason::kReadUnknown), unknown + 2);
    write_shaped(0x3C, {});
    EXPECT_EQ(read_slowly(kCell), 0x3C);
    EXPECT_EQ(bench.count(dsdpv1::Reason::kReadUnknown), unknown + 2);
  }

  void expect_bits_set(std::uint16_t cell, std::uint8_t written, unsigned bits) const {
    EXPECT_EQ(bench.last(dsdpv1::Reason::kBitSet).a, cell);
    EXPECT_EQ(bench.last(dsdpv1::Reason::kBitSet).b, written);
    EXPECT_EQ(bench.last(dsdpv1::Reason::kBitSet).c, bits);
  }

  SlaveBench bench;
};

TEST_F(UserPort, TsKeptAtTheLimitAndViolatedByOneTick) {
  WriteShape shape;
  shape.low = kTs;
  expect_kept(0x5A, shape);
  shape.low = kTs - 1;
  expect_violated(0xA5, shape, dsdpv1::Reason::kWriteLowTooShort);
  EXPECT_EQ(bench.last(dsdpv1::Reason::kWriteLowTooShort).b, kTs - 1);
  EXPECT_EQ(bench.peek(kCell), 0x3C);
}

TEST_F(UserPort, TdSetupOfAKeptAtTheLimitAndViolatedByOneTick) {
  WriteShape shape;
  shape.a_before = kTd;
  expect_kept(0x5A, shape);
  shape.a_before = kTd - 1;
  expect_violated(0xA5, shape, dsdpv1::Reason::kWriteSetup);
  EXPECT_EQ(bench.last(dsdpv1::Reason::kWriteSetup).b, kTd - 1);
}

TEST_F(UserPort, TdSetupOfDKeptAtTheLimitAndViolatedByOneTick) {
  WriteShape shape;
  shape.d_before = kTd;
  expect_kept(0x5A, shape);
  shape.d_before = kTd - 1;
  expect_violated(0xA5, shape, dsdpv1::Reason::kWriteSetup);
}

TEST_F(UserPort, TdHoldOfAKeptAtTheLimitAndViolatedByOneTick) {
  WriteShape shape;
  shape.a_after = kTd;
  expect_kept(0x5A, shape);
  shape.a_after = kTd - 1;
  expect_violated(0xA5, shape, dsdpv1::Reason::kWriteHold);
  EXPECT_EQ(bench.last(dsdpv1::Reason::kWriteHold).b, kTd - 1);
}

TEST_F(UserPort, TdHoldOfDKeptAtTheLimitAndViolatedByOneTick) {
  WriteShape shape;
  shape.d_after = kTd;
  expect_kept(0x5A, shape);
  shape.d_after = kTd - 1;
  expect_violated(0xA5, shape, dsdpv1::Reason::kWriteHold);
  shape.d_after = 1;
  expect_violated(0xA5, shape, dsdpv1::Reason::kWriteHold);
}

TEST_F(UserPort, TdHoldIsViolatedWhenDIsReleasedEarly) {
  const int before = bench.count(dsdpv1::Reason::kWriteHold);
  const Tick rise = next_rise();
  set(rise - 800, Pin::kA, kCell);
  set(rise - 800, Pin::kDIn, 0x42);
  set(rise - 800, Pin::kCsr, 0);
  set(rise - 300, Pin::kWr, 0);
  set(rise, Pin::kWr, 1);
  set(rise + kTd - 1, Pin::kDIn, dsdpv1::kLevelZ);
  bench.run_cycles(4);
  EXPECT_EQ(bench.count(dsdpv1::Reason::kWriteHold), before + 1);
  EXPECT_EQ(read_slowly(kCell), dsdpv1::kLevelX);
}

TEST_F(UserPort, BothAAndDLateInTheHoldTimeAreOneViolation) {
  WriteShape shape;
  shape.a_after = 100;
  shape.d_after = 120;
  expect_violated(0x11, shape, dsdpv1::Reason::kWriteHold);
}

TEST_F(UserPort, FloatingDIsReported) {
  WriteShape shape;
  shape.drive = false;
  expect_violated(0x00, shape, dsdpv1::Reason::kWriteFloating);
}

TEST_F(UserPort, ASettingOfTheSameLevelIsNoChange) {
  const std::size_t events = bench.chip.events().size();
  const Tick rise = next_rise();
  set(rise - 800, Pin::kA, kCell);
  set(rise - 800, Pin::kDIn, 0x42);
  set(rise - 800, Pin::kCsr, 0);
  set(rise - 300, Pin::kWr, 0);
  set(rise - 10, Pin::kA, kCell);
  set(rise - 10, Pin::kDIn, 0x42);
  set(rise, Pin::kWr, 1);
  set(rise + 10, Pin::kA, kCell);
  bench.run_cycles(4);
  EXPECT_EQ(bench.chip.events().size(), events);
  EXPECT_EQ(bench.peek(kCell), 0x42);
}

TEST_F(UserPort, CsrEarlyWritesNothingAndIsReported) {
  write_shaped(0x77, {});
  WriteShape shape;
  shape.csr_after = -1;
  const std::size_t events = bench.chip.events().size();
  write_shaped(0x99, shape);
  EXPECT_EQ(bench.count(dsdpv1::Reason::kWriteDeselected), 1);
  EXPECT_EQ(bench.chip.events().size(), events + 1);
  EXPECT_EQ(read_slowly(kCell), 0x77);
}

TEST_F(UserPort, CsrRisingWithWrAfterItIsInTime) {
  WriteShape shape;
  shape.csr_after = 0;
  expect_kept(0x66, shape);
}

TEST_F(UserPort, WithoutCsrNothingIsWrittenAndNothingReported) {
  write_shaped(0x77, {});
  const std::size_t events = bench.chip.events().size();
  set(bench.now() + 500, Pin::kA, kCell);
  set(bench.now(), Pin::kDIn, 0x11);
  set(bench.now() + 500, Pin::kWr, 0);
  set(bench.now() + 500, Pin::kWr, 1);
  bench.run_cycles(8);
  EXPECT_EQ(bench.chip.events().size(), events);
  EXPECT_EQ(bench.peek(kCell), 0x77);
}

TEST_F(UserPort, WithoutCsrNothingIsRead) {
  set(bench.now() + 500, Pin::kRd, 0);
  bench.run_cycles(8);
  EXPECT_EQ(bench.chip.level(Pin::kDOut), dsdpv1::kLevelZ);
  set(bench.now(), Pin::kRd, 1);
  EXPECT_TRUE(bench.changes(Pin::kDOut).empty());
  expect_no_violation(bench);
}

TEST_F(UserPort, TheChipReadsWhatAViolatedWriteCaptured) {
  bench.release();
  ASSERT_TRUE(bench.initialise());
  bench.acquire();
  bench.write_block(regs::kInput, {2, 7, 8}, regs::kInputCrc);
  bench.run_cycles(8);
  WriteShape shape;
  shape.low = kTs - 1;
  write_shaped(next_rise(), regs::kUserCommand1, regs::kUserCommand1Input, shape);
  EXPECT_EQ(bench.count(dsdpv1::Reason::kWriteLowTooShort), 1);
  bench.chip_accesses();
  EXPECT_EQ(bench.peek(regs::kUserCommand1), 0) << "the chip has seen the flag";
  bench.acquire();
  EXPECT_EQ(read_slowly(regs::kUserCommand1), 0) << "the chip's write makes the cell known";
}

// --- reading ---------------------------------------------------------------------------------------------------------

TEST_F(UserPort, ReadLatencyIsHalfToOneAndAHalfCyclesAtEveryPhase) {
  set(bench.now() + 10, Pin::kA, 0x003);
  set(bench.now() + 10, Pin::kCsr, 0);
  for (Tick phase = 0; phase < kCycleTicks; ++phase) {
    const Tick fall = (bench.now() / kCycleTicks + 3) * kCycleTicks + phase;
    set(fall, Pin::kRd, 0);
    EXPECT_EQ(bench.chip.level(Pin::kDOut), dsdpv1::kLevelX) << "unknown at once";
    const Tick driven = sampled_at(fall) * kCycleTicks + kCycleTicks / 2;
    bench.run_until(driven - 1);
    EXPECT_EQ(bench.chip.level(Pin::kDOut), dsdpv1::kLevelX);
    bench.run_until(driven);
    EXPECT_EQ(bench.chip.level(Pin::kDOut), 0x01);
    EXPECT_GT(driven - fall, kCycleTicks / 2);
    EXPECT_LE(driven - fall, kTw);
    set(fall + 700, Pin::kRd, 1);
    EXPECT_EQ(bench.chip.level(Pin::kDOut), dsdpv1::kLevelZ);
    EXPECT_EQ(bench.changes(Pin::kDOut).back().at, fall + 700);
  }
  expect_no_violation(bench);
}

TEST_F(UserPort, CsrRisingReleasesD) {
  set(bench.now() + 10, Pin::kA, 0x003);
  set(bench.now(), Pin::kCsr, 0);
  set(bench.now() + 100, Pin::kRd, 0);
  bench.run_for(1000);
  ASSERT_EQ(bench.chip.level(Pin::kDOut), 0x01);
  set(bench.now() + 31, Pin::kCsr, 1);
  EXPECT_EQ(bench.chip.level(Pin::kDOut), dsdpv1::kLevelZ);
  EXPECT_EQ(bench.changes(Pin::kDOut).back().at, bench.now());
  bench.run_cycles(4);
  set(bench.now(), Pin::kRd, 1);
  EXPECT_EQ(bench.chip.level(Pin::kDOut), dsdpv1::kLevelZ);
  expect_no_violation(bench);
}

TEST_F(UserPort, TwKeptAtTheLimitAndViolatedByOneTickAtEveryPhase) {
  set(bench.now() + 10, Pin::kA, 0x003);
  set(bench.now(), Pin::kCsr, 0);
  for (Tick phase = 0; phase < kCycleTicks; phase += 7) {
    for (const Tick low : {kTw, kTw - 1}) {
      const int before = bench.count(dsdpv1::Reason::kReadTooShort);
      const Tick fall = (bench.now() / kCycleTicks + 3) * kCycleTicks + phase;
      set(fall, Pin::kRd, 0);
      bench.run_until(fall + low);
      const Level data = bench.chip.level(Pin::kDOut);
      EXPECT_TRUE(data == 0x01 || low < kTw) << "certain after Tw, phase " << phase;
      set(fall + low, Pin::kRd, 1);
      EXPECT_EQ(bench.count(dsdpv1::Reason::kReadTooShort) - before, low < kTw ? 1 : 0) << "phase " << phase;
    }
  }
  EXPECT_EQ(bench.last(dsdpv1::Reason::kReadTooShort).b, kTw - 1);
}

TEST_F(UserPort, ASampleBeforeTwIsXAndReportedOnceAtEveryPhase) {
  set(bench.now() + 10, Pin::kA, 0x003);
  for (Tick phase = 0; phase < kCycleTicks; ++phase) {
    for (const Tick after : {Tick{0}, kTw - 100, kTw - 1, kTw}) {
      const int before = bench.count(dsdpv1::Reason::kReadTooShort);
      const Tick fall = (bench.now() / kCycleTicks + 3) * kCycleTicks + phase;
      const bool by_csr = phase % 2 == 1;  // the later of RD's and CSR's fall begins the read
      set(fall - 60, by_csr ? Pin::kRd : Pin::kCsr, 0);
      set(fall, by_csr ? Pin::kCsr : Pin::kRd, 0);
      bench.run_until(fall + after);
      const bool early = after < kTw;
      EXPECT_EQ(bench.chip.sample(fall + after), early ? dsdpv1::kLevelX : 0x01) << after << " at phase " << phase;
      EXPECT_EQ(bench.count(dsdpv1::Reason::kReadTooShort) - before, early ? 1 : 0) << after << " at phase " << phase;
      if (early) EXPECT_EQ(bench.last(dsdpv1::Reason::kReadTooShort).b, after);
      set(fall + after, Pin::kRd, 1);  // too short as well: the read has been reported
      EXPECT_EQ(bench.count(dsdpv1::Reason::kReadTooShort) - before, early ? 1 : 0) << after << " at phase " << phase;
      EXPECT_EQ(bench.chip.sample(fall + after), dsdpv1::kLevelZ);
      set(fall + after, Pin::kCsr, 1);
    }
  }
}

TEST_F(UserPort, AReadCutBeforeItsSamplingEdgeDrivesNothing) {
  set(bench.now() + 10, Pin::kA, 0x003);
  set(bench.now(), Pin::kCsr, 0);
  const Tick fall = (bench.now() / kCycleTicks + 3) * kCycleTicks + 10;
  set(fall, Pin::kRd, 0);
  set(fall + 100, Pin::kRd, 1);
  bench.run_cycles(4);
  ASSERT_EQ(bench.changes(Pin::kDOut).size(), 2U);
  EXPECT_EQ(bench.changes(Pin::kDOut)[1].level, dsdpv1::kLevelZ);
  EXPECT_EQ(bench.changes(Pin::kDOut)[1].at, fall + 100);
}

TEST_F(UserPort, TcKeptWhenAIsValidWithRdsFall) {
  set(bench.now() + 10, Pin::kA, 0x7F0);
  set(bench.now(), Pin::kCsr, 0);
  for (const bool rd_first : {false, true}) {  // the order of two calls at one tick does not matter
    bench.run_cycles(3);
    const Tick fall = bench.now() + 77;
    if (rd_first) set(fall, Pin::kRd, 0);
    set(fall, Pin::kA, 0x003);
    set(fall, Pin::kRd, 0);
    bench.run_for(kTw);
    EXPECT_EQ(bench.chip.level(Pin::kDOut), 0x01);
    expect_no_violation(bench);
    set(bench.now(), Pin::kRd, 1);
    set(bench.now(), Pin::kA, 0x7F0);
  }
}

TEST_F(UserPort, TcViolatedByOneTickYieldsX) {
  set(bench.now() + 10, Pin::kA, 0x7F0);
  set(bench.now(), Pin::kCsr, 0);
  bench.run_cycles(3);
  const Tick fall = bench.now() + 77;
  set(fall, Pin::kRd, 0);
  set(fall + 1, Pin::kA, 0x003);
  bench.run_for(1000);
  EXPECT_EQ(bench.chip.level(Pin::kDOut), dsdpv1::kLevelX);
  EXPECT_EQ(bench.count(dsdpv1::Reason::kReadAddressChanged), 1);
}

TEST_F(UserPort, ChangeOfAAtTheLastTickBeforeTheSamplingEdgeYieldsXAndAfterItDoesNot) {
  for (const Tick after : {-1, 0, 1, 100}) {
    const int before = bench.count(dsdpv1::Reason::kReadAddressChanged);
    set(bench.now() + 10, Pin::kA, 0x003);
    set(bench.now(), Pin::kCsr, 0);
    const Tick edge = (bench.now() / kCycleTicks + 4) * kCycleTicks;
    set(edge - 200, Pin::kRd, 0);
    set(edge + after, Pin::kA, 0x123);
    bench.run_until(edge + 500);
    EXPECT_EQ(bench.chip.level(Pin::kDOut), after < 0 ? dsdpv1::kLevelX : Level{0x01}) << after;
    EXPECT_EQ(bench.count(dsdpv1::Reason::kReadAddressChanged) - before, after < 0 ? 1 : 0) << after;
    set(bench.now(), Pin::kRd, 1);
  }
}

TEST_F(UserPort, ReadsOfEveryAddress) {
  std::mt19937 random(7);
  Bytes expected(regs::kDpramSize);
  for (int cell = 0; cell < regs::kDpramSize; ++cell) {
    expected[static_cast<std::size_t>(cell)] = static_cast<std::uint8_t>(random());
    bench.write(static_cast<std::uint16_t>(cell), expected[static_cast<std::size_t>(cell)]);
  }
  bench.run_cycles(4);
  for (int cell = 0; cell < regs::kDpramSize; ++cell) {
    ASSERT_EQ(bench.read(static_cast<std::uint16_t>(cell)), expected[static_cast<std::size_t>(cell)])
        << std::hex << cell;
  }
}

TEST_F(UserPort, FastestReadsWithAnUnlimitedHostAreCertainAfterTw) {
  // RD stays low: only CSR and A would restart a read, so each read needs its own fall; no recovery time is ruled.
  set(bench.now() + 10, Pin::kCsr, 0);
  Tick now = bench.now() + 500;
  for (int i = 0; i < 1000; ++i) {
    set(now, Pin::kA, static_cast<Level>(i % 4));
    set(now, Pin::kRd, 0);
    bench.run_until(now + kTw);
    constexpr Level kVersion[] = {0x01, 0x0D, 0x07, 0x01};
    ASSERT_EQ(bench.chip.level(Pin::kDOut), kVersion[i % 4]) << "read " << i;
    set(now + kTw, Pin::kRd, 1);
    now += kTw + 1;
  }
  expect_no_violation(bench);
}

// --- settling (P8) ---------------------------------------------------------------------------------------------------

TEST_F(UserPort, AWriteTakesEffectAtTheThirdEdgeAtEveryPhase) {
  for (Tick phase = 0; phase < kCycleTicks; ++phase) {
    const Tick rise = (bench.now() / kCycleTicks + 8) * kCycleTicks + phase;
    const auto value = static_cast<std::uint8_t>(phase + 1);
    const std::uint8_t old = bench.peek(kCell);
    set(rise - 400, Pin::kA, kCell);
    set(rise - 400, Pin::kDIn, value);
    set(rise - 400, Pin::kCsr, 0);
    set(rise - 300, Pin::kWr, 0);
    set(rise, Pin::kWr, 1);
    run_to_cycle(bench, seen_at(rise) - 1);
    ASSERT_EQ(bench.peek(kCell), old) << "phase " << phase;
    bench.run_for(kCycleTicks - 1);
    ASSERT_EQ(bench.peek(kCell), old) << "phase " << phase;
    bench.run_for(1);
    ASSERT_EQ(bench.peek(kCell), value) << "phase " << phase;
  }
}

TEST_F(UserPort, AReadSampledNoLaterThanTheSettlingEdgeYieldsXAndOneLaterTheValue) {
  for (const int late : {0, 1, 2, 3, 4}) {  // the sampling edge of the read counted from the first edge after WR's rise
    for (const Tick phase : {0, 1, 100, 249}) {
      const int before = bench.count(dsdpv1::Reason::kReadInFlight);
      const Tick rise = (bench.now() / kCycleTicks + 8) * kCycleTicks + phase;
      const auto value = static_cast<std::uint8_t>(16 * late + phase % 7);
      set(rise - 400, Pin::kA, kCell);
      set(rise - 400, Pin::kDIn, value);
      set(rise - 400, Pin::kCsr, 0);
      set(rise - 300, Pin::kWr, 0);
      set(rise, Pin::kWr, 1);
      const Tick sampling = (sampled_at(rise) + late) * kCycleTicks;
      set(std::max(rise, sampling - 100), Pin::kRd, 0);
      bench.run_until(sampling + 1000);
      const bool in_flight = late <= 2;
      EXPECT_EQ(bench.chip.level(Pin::kDOut), in_flight ? dsdpv1::kLevelX : Level{value}) << late << " phase " << phase;
      EXPECT_EQ(bench.count(dsdpv1::Reason::kReadInFlight) - before, in_flight ? 1 : 0) << late << " phase " << phase;
      set(bench.now(), Pin::kRd, 1);
      set(bench.now(), Pin::kDIn, dsdpv1::kLevelZ);
    }
  }
}

TEST_F(UserPort, AReadOfAnotherCellIsNotDisturbedByAWriteInFlight) {
  const Tick rise = next_rise();
  set(rise - 400, Pin::kA, kCell);
  set(rise - 400, Pin::kDIn, 0x12);
  set(rise - 400, Pin::kCsr, 0);
  set(rise - 300, Pin::kWr, 0);
  set(rise, Pin::kWr, 1);
  set(rise + kTd, Pin::kA, 0x003);
  set(rise + kTd, Pin::kRd, 0);
  bench.run_for(kTw);
  EXPECT_EQ(bench.chip.level(Pin::kDOut), 0x01);
  expect_no_violation(bench);
}

TEST_F(UserPort, FastestLegalWritesReachEveryAddressAtEveryPhase) {
  // Ts and Td allow one write in 300 ticks: A and D change 150 after each rise, 150 before the next. 300 and 250 are
  // out of step, so that 2048 writes meet every fifth phase; the odd start shifts them.
  for (const Tick start : {0, 1, 2, 3, 4}) {
    std::mt19937 random(static_cast<unsigned>(start + 1));
    std::vector<std::uint16_t> order(regs::kDpramSize);
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<std::uint16_t>(i);
    std::shuffle(order.begin(), order.end(), random);
    std::vector<std::uint8_t> values(order.size());
    Tick rise = (bench.now() / kCycleTicks + 10) * kCycleTicks + start;
    set(rise - kTd, Pin::kCsr, 0);
    for (const std::uint16_t cell : order) {
      values[cell] = static_cast<std::uint8_t>(random());
      set(rise - kTd, Pin::kA, static_cast<Level>(cell));
      set(rise - kTd, Pin::kDIn, values[cell]);
      set(rise - kTs, Pin::kWr, 0);
      set(rise, Pin::kWr, 1);
      rise += kTs + kTd;
    }
    set(rise, Pin::kCsr, 1);
    bench.run_cycles(4);
    for (int cell = 0; cell < regs::kDpramSize; ++cell) {
      ASSERT_EQ(bench.peek(static_cast<std::uint16_t>(cell)), values[static_cast<std::size_t>(cell)])
          << std::hex << cell;
    }
    EXPECT_EQ(bench.count(dsdpv1::Reason::kWriteOverrun), 0);
    for (const Reason reason : {dsdpv1::Reason::kWriteSetup, dsdpv1::Reason::kWriteHold,
                                dsdpv1::Reason::kWriteLowTooShort, dsdpv1::Reason::kWriteFloating})
      EXPECT_EQ(bench.count(reason), 0) << profibus::code(reason);
  }
}

TEST_F(UserPort, TheLastOfTwoWritesToTheSameCellWins) {
  Tick rise = next_rise();
  set(rise - 400, Pin::kCsr, 0);
  set(rise - 400, Pin::kA, kCell);
  for (const std::uint8_t value : Bytes{0x11, 0x22, 0x33}) {
    set(rise - kTd, Pin::kDIn, value);
    set(rise - kTs, Pin::kWr, 0);
    set(rise, Pin::kWr, 1);
    rise += kTs + kTd;
  }
  bench.run_cycles(4);
  EXPECT_EQ(bench.peek(kCell), 0x33);
  expect_no_violation(bench);
}

// --- who may write, and when -----------------------------------------------------------------------------------------

// P6: only the chip sets bits of these.
constexpr std::uint16_t kStatusCells[] = {0x00A, 0x00B, 0x00E, 0x00F};
bool is_status(std::uint16_t cell) {
  return std::find(std::begin(kStatusCells), std::end(kStatusCells), cell) != std::end(kStatusCells);
}

TEST_F(UserPort, SettingABitOfTheChipsStatusIsReportedClearingIsNot) {
  const auto write = [this](std::uint16_t cell, std::uint8_t value) {
    const int before = bench.count(dsdpv1::Reason::kBitSet);
    bench.write(cell, value);
    bench.run_cycles(4);
    EXPECT_EQ(bench.peek(cell), value) << "carried out";
    return bench.count(dsdpv1::Reason::kBitSet) - before;
  };
  for (const std::uint16_t cell : kStatusCells) {
    SCOPED_TRACE(cell);
    write(cell, 0x00);
    for (unsigned bit = 0; bit < 8; ++bit) {
      const auto value = static_cast<std::uint8_t>(1U << bit);
      EXPECT_EQ(write(cell, value), 1);
      expect_bits_set(cell, value, value);
      EXPECT_EQ(write(cell, value), 0) << "nothing changes";
      EXPECT_EQ(write(cell, 0x00), 0);
      EXPECT_EQ(write(cell, 0x00), 0);
    }
    EXPECT_EQ(write(cell, 0x25), 1);
    EXPECT_EQ(write(cell, 0x05), 0);
    EXPECT_EQ(write(cell, 0x85), 1);
    expect_bits_set(cell, 0x85, 0x80);
  }
  EXPECT_EQ(bench.count(dsdpv1::Reason::kReadOnlyWritten), 0);
}

// "Before" is when the byte reaches the RAM, not when WR rises.
TEST_F(UserPort, SettingABitIsJudgedAfterTheWritesInFlight) {
  write_shaped(next_rise(), 0x00B, 0x01, {});
  ASSERT_EQ(bench.count(dsdpv1::Reason::kBitSet), 1);
  bench.chip.set(bench.now(), Pin::kA, 0x00B);
  bench.chip.set(bench.now(), Pin::kCsr, 0);
  Tick rise = 0;
  for (const Level value : {Level{0}, Level{1}}) {
    bench.chip.set(bench.now(), Pin::kDIn, value);
    bench.chip.set(bench.now(), Pin::kWr, 0);
    bench.run_for(200);
    rise = bench.now();
    bench.chip.set(rise, Pin::kWr, 1);
    bench.run_for(200);
  }
  bench.chip.set(bench.now(), Pin::kCsr, 1);
  bench.run_cycles(8);
  EXPECT_EQ(bench.count(dsdpv1::Reason::kBitSet), 2);
  expect_bits_set(0x00B, 0x01, 0x01);
  EXPECT_EQ(bench.last(dsdpv1::Reason::kBitSet).at, seen_at(rise) * kCycleTicks) << "when it settles (P8)";
}

TEST_F(UserPort, WritingBackABitThatTheChipHasSetIsNotReported) {
  bench.release();
  ASSERT_TRUE(bench.initialise());
  bench.give_inputs({1, 2}, 1);
  ASSERT_EQ(bench.peek(0x00B), 0x04);
  bench.poke(0x00B, 0x04);
  EXPECT_EQ(bench.count(dsdpv1::Reason::kBitSet), 0);
  bench.give_inputs({1, 2});
  ASSERT_EQ(bench.peek(0x00B), 0x00);
  bench.poke(0x00B, 0x04);
  bench.run_cycles(4);
  EXPECT_EQ(bench.count(dsdpv1::Reason::kBitSet), 1);
}

TEST_F(UserPort, WritesToTheChipsCellsAreReportedAndCarriedOut) {
  for (const regs::Cell& cell : regs::kMap) {
    const int before = bench.count(dsdpv1::Reason::kReadOnlyWritten), set = bench.count(dsdpv1::Reason::kBitSet);
    const auto old = bench.peek(cell.first);
    bench.write(cell.first, 0xE7);
    bench.run_cycles(4);
    EXPECT_EQ(bench.peek(cell.first), 0xE7) << cell.name;
    const bool reported = cell.chip_writes && !cell.user_writes;  // P6; reserved cells belong to neither side (P13)
    EXPECT_EQ(bench.count(dsdpv1::Reason::kReadOnlyWritten) - before, reported ? 1 : 0) << cell.name;
    const bool of_status = is_status(cell.first);
    EXPECT_EQ(bench.count(dsdpv1::Reason::kBitSet) - set, of_status ? 1 : 0) << cell.name;
    if (of_status) expect_bits_set(cell.first, 0xE7, 0xE7U & ~static_cast<unsigned>(old));
  }
  EXPECT_EQ(bench.last(dsdpv1::Reason::kReadOnlyWritten).a, 0x5CB);
  EXPECT_EQ(bench.last(dsdpv1::Reason::kReadOnlyWritten).b, 0xE7);
}

TEST_F(UserPort, AnAccessWithoutOwnershipIsReportedAndCarriedOut) {
  for (const auto& [request, state] : {std::pair<Level, Level>{0, 0}, {0, 1}, {1, 0}}) {
    bench.release();
    run_to_l_sta(bench, 0);
    run_to_l_sta(bench, 0);  // the first may have been running
    bench.chip.set(bench.now(), Pin::kRReq, request);
    bench.chip.set(bench.now(), Pin::kRSta, state);
    const int before = bench.count(dsdpv1::Reason::kAccessNotOwned);
    bench.write(kCell, static_cast<std::uint8_t>(0x40 + 2 * request + state));
    EXPECT_EQ(bench.count(dsdpv1::Reason::kAccessNotOwned), before + 1);
    EXPECT_EQ(bench.last(dsdpv1::Reason::kAccessNotOwned).a, kCell);
    EXPECT_EQ(bench.last(dsdpv1::Reason::kAccessNotOwned).b, request);
    EXPECT_EQ(bench.last(dsdpv1::Reason::kAccessNotOwned).c, state);
    bench.run_cycles(4);
    EXPECT_EQ(bench.peek(kCell), 0x40 + 2 * request + state);
    EXPECT_EQ(bench.read(kCell), 0x40 + 2 * request + state);
    EXPECT_EQ(bench.count(dsdpv1::Reason::kAccessNotOwned), before + 2);
  }
}

TEST_F(UserPort, AReadWhileTheChipOwnsYieldsX) {
  bench.release();
  for (int offset = -3; offset < 12; ++offset) {
    const Cycle start = run_to_l_sta(bench, 1) + 48;
    const int before = bench.count(dsdpv1::Reason::kAccessNotOwned);
    set((start - 6) * kCycleTicks, Pin::kA, 0x003);
    set(bench.now(), Pin::kCsr, 0);
    const Cycle sampling = start + offset;
    set(sampling * kCycleTicks - 50, Pin::kRd, 0);
    bench.run_until(sampling * kCycleTicks + 200);
    const bool owned = offset >= 1 && offset <= 7;  // L_STA was 1 before the sampling edge
    EXPECT_EQ(bench.chip.level(Pin::kDOut), owned ? dsdpv1::kLevelX : Level{0x01}) << offset;
    EXPECT_EQ(bench.count(dsdpv1::Reason::kAccessNotOwned), before + 1) << "never silent";
    set(bench.now() + 100, Pin::kRd, 1);
  }
}

TEST_F(UserPort, AWriteWhileTheChipOwnsIsReportedAndCarriedOut) {
  bench.release();
  run_to_l_sta(bench, 1);
  const int before = bench.count(dsdpv1::Reason::kAccessNotOwned);
  bench.write(kCell, 0x5C);
  EXPECT_EQ(bench.count(dsdpv1::Reason::kAccessNotOwned), before + 1);
  bench.run_cycles(4);
  EXPECT_EQ(bench.peek(kCell), 0x5C);
}

TEST_F(UserPort, RandomTrafficIsNeverSilentlyWrong) {
  // Strobes of any length at any time: what is read without a report is what was written last without a report.
  std::mt19937 random(20);
  const auto draw = [&random](Tick from, Tick to) { return std::uniform_int_distribution<Tick>(from, to)(random); };
  std::map<std::uint16_t, int> known;  // -1: a report left it unknown
  int read = 0, unknown = 0;
  for (int i = 0; i < 4000; ++i) {
    const auto cell = static_cast<std::uint16_t>(0x140 + draw(0, 7));
    const std::size_t reports = bench.chip.events().size();
    Tick now = bench.now() + draw(150, 400);
    if (draw(0, 1) == 0) {
      const auto value = static_cast<std::uint8_t>(draw(0, 255));
      set(now, Pin::kCsr, 0);
      set(now, Pin::kA, static_cast<Level>(cell));
      set(now, Pin::kDIn, value);
      set(now + draw(0, 60), Pin::kWr, 0);
      set(bench.now() + draw(100, 400), Pin::kWr, 1);
      set(bench.now() + draw(120, 400), Pin::kDIn, dsdpv1::kLevelZ);
      bench.run_cycles(4);
      known[cell] = bench.chip.events().size() == reports ? value : -1;
    } else {
      set(now, Pin::kA, static_cast<Level>(cell));
      set(now, Pin::kCsr, 0);
      set(now + draw(0, 200), Pin::kRd, 0);
      bench.run_for(draw(100, 800));
      const Level data = bench.chip.level(Pin::kDOut);
      set(bench.now(), Pin::kRd, 1);
      const bool silent = bench.chip.events().size() == reports;
      if (data == dsdpv1::kLevelX) {
        ++unknown;
        EXPECT_FALSE(silent) << "X without a report, read " << i;
      } else if (known.count(cell) != 0) {
        ++read;
        EXPECT_EQ(data, known[cell]) << "read " << i;
      }
    }
  }
  EXPECT_GT(read, 200);
  EXPECT_GT(unknown, 200);
}

}  // namespace
}  // namespace dsdpv1::conformance
