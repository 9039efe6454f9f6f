// RESET and start-up: rulings P1, P9, P10, D1, H6.
#include <string>

#include "tests/conformance/user_helpers.hpp"

namespace dsdpv1::conformance {
namespace {

constexpr Cycle kStartUpMoves = 2048 + 4 + 1;      // H6: clear, B000..B003, B006
constexpr Cycle kStartUpHigh = kStartUpMoves + 1;  // one byte a cycle from R + 1 on
constexpr Cycle kReadyCycles = 4096;

void expect_reset_levels(const SlaveBench& bench) {
  EXPECT_EQ(bench.chip.level(Pin::kPbtxd), 1);
  EXPECT_EQ(bench.chip.level(Pin::kPbrts), 0);
  EXPECT_EQ(bench.chip.level(Pin::kLReq), 0);
  EXPECT_EQ(bench.chip.level(Pin::kLSta), 0);
  EXPECT_EQ(bench.chip.level(Pin::kIntr0), 1);
  EXPECT_EQ(bench.chip.level(Pin::kPbf), 1);
  EXPECT_EQ(bench.chip.level(Pin::kBr), 0);
  EXPECT_EQ(bench.chip.level(Pin::kReady), 0);
  EXPECT_EQ(bench.chip.level(Pin::kDOut), dsdpv1::kLevelZ);
}

/// Releases RESET at `tick`; cycle R.
Cycle release_reset(SlaveBench& bench, Tick tick) {
  bench.run_until(tick);
  bench.chip.set(tick, Pin::kReset, 1);
  return seen_at(tick);
}

/// RESET low now and for a while; the user and the master forget what they were doing.
void reset_now(SlaveBench& bench) {
  bench.chip.set(bench.now(), Pin::kReset, 0);
  expect_reset_levels(bench);
  bench.release();
  bench.fcb = true;
  bench.fcb_valid = false;
  bench.run_cycles(100);
  expect_reset_levels(bench);
}

void expect_full_function(SlaveBench& bench) {
  bench.to_data_exch();
  bench.give_inputs({0x12, 0x34});
  const bus::Exchange exchange = bench.data_exchange({0xAB, 0xCD});
  ASSERT_TRUE(exchange.answered());
  EXPECT_EQ(exchange.answer().data, (Bytes{0x12, 0x34}));
  bench.chip_accesses();
  EXPECT_EQ(bench.fetch_outputs(), (Bytes{0xAB, 0xCD}));
}

void fill_dpram(SlaveBench& bench, std::uint8_t value) {
  bench.acquire();
  for (int cell = 0; cell < regs::kDpramSize; ++cell) bench.write(static_cast<std::uint16_t>(cell), value);
  bench.run_cycles(4);
}

TEST(UserReset, EveryOutputHasItsResetLevelBeforeTheFirstRelease) {
  SlaveBench bench;
  expect_reset_levels(bench);
  bench.run_ms(1);
  expect_reset_levels(bench);
  EXPECT_TRUE(bench.chip.trace().empty());
  EXPECT_TRUE(bench.chip.events().empty());
}

TEST(UserReset, HostPortIsDeadInReset) {
  SlaveBench bench;
  bench.run_cycles(10);
  for (const Pin pin : {Pin::kCsr, Pin::kRd}) bench.chip.set(bench.now(), pin, 0);
  bench.run_cycles(5);
  EXPECT_EQ(bench.chip.level(Pin::kDOut), dsdpv1::kLevelZ);
  bench.chip.set(bench.now(), Pin::kRd, 1);
  bench.write(0x130, 0x55);
  bench.run_cycles(5);
  EXPECT_EQ(bench.peek(0x130), 0);
}

TEST(UserReset, ARdThatIsLowSinceBeforeTheReleaseIsNoAccess) {
  SlaveBench bench;
  bench.run_cycles(10);
  for (const Pin pin : {Pin::kCsr, Pin::kRd}) bench.chip.set(bench.now(), pin, 0);
  bench.run_cycles(5);
  release_reset(bench, bench.now());
  bench.run_cycles(10);
  EXPECT_TRUE(bench.changes(Pin::kDOut).empty());
}

// P12: they are carried out, and the start-up access clears what it has not yet cleared.
TEST(UserReset, WritesInTheStartUpStayWhereItHasClearedAlready) {
  SlaveBench bench;
  bench.run_cycles(10);
  const Cycle r = release_reset(bench, bench.now());
  run_to_cycle(bench, r + 1500);
  for (std::uint8_t i = 0; i < 16; ++i) {
    bench.write(static_cast<std::uint16_t>(0x100 + i), i + 1);
    bench.write(static_cast<std::uint16_t>(0x7C0 + i), 0xFF);
  }
  bench.run_cycles(4);
  EXPECT_LT(bench.now() / kCycleTicks, r + 0x7C0);
  run_to_l_sta(bench, 0);
  bench.acquire();
  for (std::uint8_t i = 0; i < 16; ++i) {
    EXPECT_EQ(bench.read(static_cast<std::uint16_t>(0x100 + i)), i + 1);
    EXPECT_EQ(bench.read(static_cast<std::uint16_t>(0x7C0 + i)), 0);
  }
}

TEST(UserReset, ResetReleasesDWhileReading) {
  SlaveBench bench;
  bench.power_on();
  bench.acquire();
  bench.chip.set(bench.now(), Pin::kA, 0);
  bench.chip.set(bench.now(), Pin::kCsr, 0);
  bench.chip.set(bench.now(), Pin::kRd, 0);
  bench.run_cycles(4);
  ASSERT_EQ(bench.chip.level(Pin::kDOut), 0x01);
  bench.run_for(37);
  bench.chip.set(bench.now(), Pin::kReset, 0);
  EXPECT_EQ(bench.chip.level(Pin::kDOut), dsdpv1::kLevelZ);
  EXPECT_EQ(bench.changes(Pin::kDOut).back().at, bench.now());
}

class AtPhase : public testing::TestWithParam<Tick> {};

TEST_P(AtPhase, AssertionIsAsynchronous) {
  SlaveBench bench;
  bench.power_on();
  ASSERT_TRUE(bench.initialise());
  const Cycle start = run_to_l_sta(bench, 1);
  const Tick when = (start + 3) * kCycleTicks + GetParam();
  bench.run_until(when);
  ASSERT_EQ(bench.chip.level(Pin::kLSta), 1);
  ASSERT_EQ(bench.chip.level(Pin::kReady), 1);
  bench.chip.set(when, Pin::kReset, 0);
  expect_reset_levels(bench);
  EXPECT_EQ(bench.changes(Pin::kLSta).back().at, when);
  EXPECT_EQ(bench.changes(Pin::kLReq).back().at, when);
  EXPECT_EQ(bench.changes(Pin::kReady).back().at, when);
  EXPECT_EQ(bench.dp_state(), DpState::kOffline);
  bench.run_ms(1);
  EXPECT_EQ(bench.chip.trace().back().at, when) << "something happens in reset";
}

TEST_P(AtPhase, ReleaseIsSynchronousAndStartUpIsCycleExact) {
  SlaveBench bench;
  const Cycle r = release_reset(bench, 20 * kCycleTicks + GetParam());
  EXPECT_EQ(r, 23);
  run_to_cycle(bench, r + 3000);
  const std::vector<Access> found = accesses(bench);
  ASSERT_GE(found.size(), 3U);
  EXPECT_EQ(found[0].rise, r);
  EXPECT_EQ(found[0].length(), kStartUpHigh);
  EXPECT_EQ(found[1].rise, found[0].fall + 1) << "H8: one cycle low, also when overdue";
  EXPECT_EQ(found[2].rise, found[1].rise + 48);
}

TEST_P(AtPhase, PulseShorterThanACycleResets) {
  SlaveBench bench;
  bench.power_on();
  ASSERT_TRUE(bench.initialise());
  const Tick fall = bench.now() + 10 * kCycleTicks + GetParam();
  bench.run_until(fall);
  bench.chip.set(fall, Pin::kReset, 0);
  expect_reset_levels(bench);
  bench.run_until(fall + 1);
  bench.chip.set(fall + 1, Pin::kReset, 1);
  run_to_cycle(bench, seen_at(fall + 1) - 1);
  expect_reset_levels(bench);
  bench.run_cycles(1);
  EXPECT_EQ(last_rise(bench), seen_at(fall + 1));
  bench.run_cycles(kStartUpHigh);
  EXPECT_EQ(accesses(bench).back().length(), kStartUpHigh);
}

INSTANTIATE_TEST_SUITE_P(UserReset, AtPhase, testing::Values(0, 1, 60, 124, 125, 126, 187, 248, 249),
                         [](const auto& at) { return "Tick" + std::to_string(at.param); });

TEST(UserReset, ReleaseTooShortForTheSynchroniserStartsNothing) {
  for (const Tick high : {1L, 100L, 249L, 250L, 400L, 500L, 639L}) {
    SlaveBench bench;
    const Tick rise = 20 * kCycleTicks + 110;
    const Cycle r = release_reset(bench, rise);
    bench.run_until(rise + high);
    ASSERT_LT(rise + high, r * kCycleTicks);
    bench.chip.set(rise + high, Pin::kReset, 0);
    bench.run_ms(1);
    EXPECT_TRUE(bench.chip.trace().empty()) << "RESET was high for " << high << " ticks";
  }
}

TEST(UserReset, ReleasedAgainAfterAShortReleaseStartsWithTheSecond) {
  SlaveBench bench;
  const Tick first = 20 * kCycleTicks + 110;
  release_reset(bench, first);
  bench.run_until(first + 300);
  bench.chip.set(first + 300, Pin::kReset, 0);
  const Cycle r = release_reset(bench, first + 310);
  bench.run_cycles(20);
  EXPECT_EQ(last_rise(bench), r);
  EXPECT_EQ(bench.changes(Pin::kLSta).size(), 1U);
}

TEST(UserReset, StartUpClearsOneCellACycleAndThenWritesTheVersion) {
  SlaveBench bench;
  bench.power_on();
  fill_dpram(bench, 0xA5);
  reset_now(bench);
  EXPECT_EQ(bench.peek(0x7FF), 0xA5) << "RESET itself does not touch the RAM";
  const Cycle r = release_reset(bench, bench.now() + 33);
  run_to_cycle(bench, r);
  EXPECT_EQ(bench.peek(0x000), 0xA5);
  for (int cell = 0; cell < regs::kDpramSize; ++cell) {
    run_to_cycle(bench, r + 1 + cell);
    ASSERT_EQ(bench.peek(static_cast<std::uint16_t>(cell)), 0) << "B" << std::hex << cell;
    const int next = std::min(cell + 1, regs::kDpramSize - 1);
    ASSERT_EQ(bench.peek(static_cast<std::uint16_t>(next)), next == cell ? 0 : 0xA5);
  }
  constexpr std::uint8_t kVersion[] = {0x01, 0x0D, 0x07, 0x01};
  for (int cell = 0; cell < 4; ++cell) {
    ASSERT_EQ(bench.peek(static_cast<std::uint16_t>(cell)), 0);
    run_to_cycle(bench, r + 2049 + cell);
    ASSERT_EQ(bench.peek(static_cast<std::uint16_t>(cell)), kVersion[cell]);
  }
  EXPECT_EQ(bench.peek(regs::kAccessCount), 0);
  run_to_cycle(bench, r + 2053);
  EXPECT_EQ(bench.peek(regs::kAccessCount), 1);
}

TEST(UserReset, StartUpLeavesEverythingElseZero) {
  SlaveBench bench;
  bench.power_on();
  fill_dpram(bench, 0xFF);
  reset_now(bench);
  const Cycle r = release_reset(bench, bench.now());
  run_to_cycle(bench, r + kStartUpHigh);
  EXPECT_EQ(bench.peek(0x000, 8), (Bytes{1, 0x0D, 7, 1, 0, 0, 1, 0}));
  EXPECT_EQ(bench.peek(0x008, 0x7F8), Bytes(0x7F8, 0));
}

TEST(UserReset, ValidFlagComesInTheFirstAccessFrom4096CyclesOn) {
  SlaveBench bench;
  const Cycle r = release_reset(bench, 77);
  const Cycle second = r + kStartUpHigh + 1;
  const Cycle expected = second + (r + kReadyCycles - second + 47) / 48 * 48;
  run_to_cycle(bench, expected + 6);
  EXPECT_EQ(bench.peek(regs::kValidFlag), 0) << "the header of that access has six moves";
  ASSERT_EQ(last_rise(bench), expected);
  run_to_l_sta(bench, 0);
  EXPECT_EQ(bench.peek(regs::kValidFlag), 0xC5);
  EXPECT_EQ(bench.chip.status().accesses, accesses(bench).size());
}

TEST(UserReset, ValidFlagComesInAnAccessThatBegins4096CyclesAfterTheReleaseAndInNoneBefore) {
  for (const Cycle start : {4095, 4096}) {
    SlaveBench bench;
    const Cycle r = release_reset(bench, 77);
    run_to_cycle(bench, r + 3000);
    bench.acquire();
    run_to_cycle(bench, r + start - 3);
    bench.release();
    ASSERT_EQ(run_to_l_sta(bench, 1), r + start);
    run_to_l_sta(bench, 0);
    EXPECT_EQ(bench.peek(regs::kValidFlag), start < 4096 ? 0 : 0xC5);
  }
}

TEST(UserReset, ValidFlagWaitsForAUserWhoHolds) {
  SlaveBench bench;
  const Cycle r = release_reset(bench, 77);
  run_to_cycle(bench, r + 3000);
  bench.acquire();
  run_to_cycle(bench, r + 6000);
  EXPECT_EQ(bench.peek(regs::kValidFlag), 0);
  bench.release();
  const Cycle start = run_to_l_sta(bench, 1);
  EXPECT_EQ(start, seen_at((r + 6000) * kCycleTicks));
  run_to_l_sta(bench, 0);
  EXPECT_EQ(bench.peek(regs::kValidFlag), 0xC5);
}

TEST(UserReset, ReadyCyclesAreAParameter) {
  dsdpv1::Config config;
  config.ready_cycles = 10'000;
  SlaveBench bench(config);
  const Cycle r = release_reset(bench, 77);
  run_to_cycle(bench, r + 10'000);
  EXPECT_EQ(bench.peek(regs::kValidFlag), 0);
  run_to_cycle(bench, r + 10'000 + 48 + 16);
  EXPECT_EQ(bench.peek(regs::kValidFlag), 0xC5);
}

// --- a user who was not reset (H6) -----------------------------------------------------------------------------------

struct Held {
  Level r_req, r_sta;
};

class HeldThroughReset : public testing::TestWithParam<Held> {
 protected:
  /// Both pins as the parameter says, or both low.
  void hold(bool held) {
    bench.chip.set(bench.now(), Pin::kRReq, held ? GetParam().r_req : Level{0});
    bench.chip.set(bench.now(), Pin::kRSta, held ? GetParam().r_sta : Level{0});
  }
  int reports() const { return bench.count(dsdpv1::Reason::kHeldThroughReset); }

  SlaveBench bench;
};

TEST_P(HeldThroughReset, StartUpWaitsIsReportedOnceAndComesAtOnceWithTheRelease) {
  bench.run_cycles(10);
  hold(true);
  const Cycle r = release_reset(bench, bench.now() + 500);
  run_to_cycle(bench, r + 10'000);
  EXPECT_TRUE(accesses(bench).empty());
  EXPECT_EQ(bench.chip.status().accesses, 0U);
  expect_reset_levels(bench);
  ASSERT_EQ(reports(), 1);
  EXPECT_EQ(bench.last(dsdpv1::Reason::kHeldThroughReset).at, r * kCycleTicks);
  EXPECT_EQ(bench.last(dsdpv1::Reason::kHeldThroughReset).a, GetParam().r_req);
  EXPECT_EQ(bench.last(dsdpv1::Reason::kHeldThroughReset).b, GetParam().r_sta);
  hold(false);
  const Cycle start = seen_at((r + 10'000) * kCycleTicks);
  run_to_cycle(bench, start + kStartUpHigh + 48);
  const std::vector<Access> found = accesses(bench);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].rise, start);
  EXPECT_EQ(found[0].length(), kStartUpHigh);
  EXPECT_EQ(found[1].rise, found[0].fall + 1);
  EXPECT_EQ(bench.peek(regs::kValidFlag), 0xC5) << "overdue: in the first access after the start-up";
  EXPECT_EQ(bench.chip.status().longest_wait, static_cast<std::uint64_t>(start - r));
  EXPECT_EQ(reports(), 1);
}

TEST_P(HeldThroughReset, ReleaseSeenAtTheFirstActiveEdgeIsInTimeAndOneTickLaterIsNot) {
  for (const Tick late : {-1, 0, 1, 249, 250, 251, 2000}) {
    SlaveBench held;
    held.run_cycles(10);
    held.chip.set(held.now(), Pin::kRReq, GetParam().r_req);
    held.chip.set(held.now(), Pin::kRSta, GetParam().r_sta);
    const Cycle r = release_reset(held, 20 * kCycleTicks + 249);
    const Tick last = (r - 2) * kCycleTicks - 1;  // the last tick that edge R - 2 samples
    held.run_until(last + late);
    held.chip.set(held.now(), Pin::kRReq, 0);
    held.chip.set(held.now(), Pin::kRSta, 0);
    const Cycle start = std::max(r, seen_at(last + late));
    run_to_cycle(held, start + 10);
    EXPECT_EQ(last_rise(held), start) << "late " << late;
    EXPECT_EQ(held.count(dsdpv1::Reason::kHeldThroughReset), start == r ? 0 : 1) << "late " << late;
  }
}

TEST_P(HeldThroughReset, EveryResetIsReportedAndNothingIsClearedUntilTheUserReleases) {
  bench.to_data_exch();
  bench.acquire();
  bench.write(0x131, 0x77);
  bench.run_cycles(4);
  for (int round = 1; round <= 3; ++round) {
    hold(true);
    bench.chip.set(bench.now(), Pin::kReset, 0);
    bench.run_for(777);
    const Cycle r = release_reset(bench, bench.now());
    run_to_cycle(bench, r + 500);
    EXPECT_EQ(reports(), round);
    EXPECT_EQ(bench.peek(0x131), 0x77);
    expect_reset_levels(bench);
  }
  bench.release();
  bench.fcb_valid = false, bench.fcb = true;
  run_to_l_sta(bench, 0);
  EXPECT_EQ(bench.peek(0x131), 0);
  bench.run_cycles(5000);
  ASSERT_TRUE(bench.initialise());
  bench.find_baud();
  EXPECT_TRUE(bench.set_prm({}).short_acknowledge());
}

INSTANTIATE_TEST_SUITE_P(UserReset, HeldThroughReset, testing::Values(Held{1, 0}, Held{0, 1}, Held{1, 1}),
                         [](const auto& at) {
                           return std::string(at.param.r_req != 0 ? "Request" : "") +
                                  (at.param.r_sta != 0 ? "State" : "");
                         });

TEST(UserReset, ReadsBeforeTheStartUpYieldXAndWritesAreClearedWithTheRest) {
  SlaveBench bench;
  bench.power_on();
  bench.acquire();
  bench.write(0x130, 0x5A);
  bench.run_cycles(4);  // settled (P8)
  bench.chip.set(bench.now(), Pin::kReset, 0);
  bench.run_cycles(10);
  const Cycle r = release_reset(bench, bench.now());
  run_to_cycle(bench, r + 100);
  bench.write(0x131, 0x77);
  bench.run_cycles(4);
  EXPECT_EQ(bench.peek(0x130, 2), (Bytes{0x5A, 0x77})) << "carried out";
  for (const Level cell : {Level{0x130}, Level{0x131}}) {
    bench.chip.set(bench.now(), Pin::kA, cell);
    bench.chip.set(bench.now(), Pin::kCsr, 0);
    bench.chip.set(bench.now(), Pin::kRd, 0);
    bench.run_cycles(4);
    EXPECT_EQ(bench.chip.level(Pin::kDOut), dsdpv1::kLevelX) << "nobody knows what the RAM holds";
    bench.chip.set(bench.now(), Pin::kRd, 1);
    bench.chip.set(bench.now(), Pin::kCsr, 1);
  }
  EXPECT_EQ(bench.count(dsdpv1::Reason::kAccessNotOwned), 0);
  bench.release();
  run_to_l_sta(bench, 0);
  EXPECT_EQ(bench.peek(0x130, 2), (Bytes{0, 0}));
  bench.acquire();
  EXPECT_EQ(bench.read(0x131), 0);
  EXPECT_EQ(bench.read(0x001), 0x0D);
}

TEST(UserReset, AResetInAStartUpLeavesTheRestOfTheRamAsItWas) {
  SlaveBench bench;
  bench.power_on();
  fill_dpram(bench, 0xA5);
  reset_now(bench);
  const Cycle r = release_reset(bench, bench.now());
  run_to_cycle(bench, r + 1000);
  bench.chip.set(bench.now(), Pin::kRSta, 1);
  bench.chip.set(bench.now(), Pin::kReset, 0);
  bench.run_cycles(10);
  release_reset(bench, bench.now());
  bench.run_cycles(100);
  for (std::uint16_t cell = 0; cell < regs::kDpramSize; ++cell) {
    ASSERT_EQ(bench.peek(cell), cell < 1000 ? 0 : 0xA5) << "B" << std::hex << cell;
    ASSERT_EQ(bench.chip.peek_step(cell), bench.peek(cell)) << "B" << std::hex << cell;
  }
}

// The sampling edge of a read decides: the edge at which the start-up begins is still too early, then the chip owns the
// DPRAM.
TEST(UserReset, NoReadRoundTheBeginOfALateStartUpGivesAValue) {
  for (Cycle offset = -2; offset <= 2; ++offset) {
    SlaveBench bench;
    bench.run_cycles(10);
    bench.chip.set(bench.now(), Pin::kRSta, 1);
    const Cycle r = release_reset(bench, bench.now());
    run_to_cycle(bench, r + 20);
    Script script(bench);
    const Cycle start = r + 60;
    const std::vector<Tick> ticks = {(start - 3) * kCycleTicks + 10, (start + offset) * kCycleTicks - 50};
    script.set(std::min(ticks[0], ticks[1]), ticks[0] < ticks[1] ? Pin::kRSta : Pin::kRd, 0);
    script.set(std::max(ticks[0], ticks[1]), ticks[0] < ticks[1] ? Pin::kRd : Pin::kRSta, 0);
    bench.chip.set(bench.now(), Pin::kCsr, 0);
    run_to_cycle(bench, start + offset + 1);
    EXPECT_EQ(bench.chip.level(Pin::kDOut), dsdpv1::kLevelX) << offset;
    run_to_cycle(bench, start + 5);
    EXPECT_EQ(last_rise(bench), start);
  }
}

TEST(UserReset, UserWhoAsksInStartUpIsServedAfterIt) {
  SlaveBench bench;
  const Cycle r = release_reset(bench, 2600);
  run_to_cycle(bench, r + 500);
  bench.acquire();
  EXPECT_GE(bench.now() / kCycleTicks, r + kStartUpHigh);
  EXPECT_LE(bench.now() / kCycleTicks, r + kStartUpHigh + 8);
  EXPECT_EQ(bench.read(0x000), 0x01);
  EXPECT_EQ(bench.read(0x001), 0x0D);
  EXPECT_EQ(bench.read(0x002), 0x07);
  EXPECT_EQ(bench.read(0x003), 0x01);
  EXPECT_EQ(bench.read(0x004), 0x00);
  EXPECT_EQ(bench.read(0x006), 0x01);
  bench.release();
  expect_no_violation(bench);
}

TEST(UserReset, ACellWithAViolatedWriteIsKnownAgainAfterReset) {
  SlaveBench bench;
  bench.power_on();
  bench.acquire();
  bench.chip.set(bench.now(), Pin::kA, 0x130);
  bench.chip.set(bench.now(), Pin::kCsr, 0);
  bench.chip.set(bench.now(), Pin::kWr, 0);
  bench.run_for(600);
  bench.chip.set(bench.now(), Pin::kWr, 1);  // D is not driven
  bench.run_for(600);
  bench.chip.set(bench.now(), Pin::kCsr, 1);
  ASSERT_EQ(bench.count(dsdpv1::Reason::kWriteFloating), 1);
  reset_now(bench);
  bench.power_on();
  bench.acquire();
  EXPECT_EQ(bench.read(0x130), 0);
}

// --- reset in every state --------------------------------------------------------------------------------------------

struct State {
  const char* name;
  void (*reach)(SlaveBench& bench);
};

void searching(SlaveBench& bench) {
  bench.power_on();
  ASSERT_TRUE(bench.initialise());
  bench.run_ms(7);
}

void in_long_transfer(SlaveBench& bench) {
  bench.power_on();
  bench.acquire();
  bench.write_block(regs::kInit, Init{}.block(), regs::kInitCrc);
  bench.write(regs::kUserCommand1, regs::kUserCommand1Init);
  bench.release();
  run_to_l_sta(bench, 1);
  bench.run_cycles(12);
  ASSERT_EQ(bench.chip.level(Pin::kLSta), 1);
}

const State kStates[] = {
    {"StartUp", [](SlaveBench& bench) { release_reset(bench, 3000), bench.run_cycles(1000); }},
    {"HeldOff",
     [](SlaveBench& bench) {
       bench.chip.set(bench.now(), Pin::kRSta, 1);
       release_reset(bench, 3000), bench.run_cycles(1000);
     }},
    {"BeforeValid", [](SlaveBench& bench) { release_reset(bench, 3000), bench.run_cycles(3000); }},
    {"Idle", [](SlaveBench& bench) { bench.power_on(), run_to_l_sta(bench, 0); }},
    {"Header", [](SlaveBench& bench) { bench.power_on(), run_to_l_sta(bench, 1), bench.run_cycles(3); }},
    {"Transfer", in_long_transfer},
    {"UserOwns", [](SlaveBench& bench) { bench.power_on(), bench.acquire(), bench.write(0x131, 0x77); }},
    {"WriteInFlight", [](SlaveBench& bench) { bench.power_on(), bench.acquire(), bench.write(0x006, 0x77); }},
    {"Searching", searching},
    {"WaitPrm", [](SlaveBench& bench) { bench.to_wait_prm(); }},
    {"WaitCfg", [](SlaveBench& bench) { bench.to_wait_cfg(); }},
    {"DataExch", [](SlaveBench& bench) { bench.to_data_exch(); }},
    {"Interrupt",
     [](SlaveBench& bench) {
       bench.to_wait_prm();
       bench.set_prm({});
       bench.run_cycles(60);
       for (int i = 0; i < 200 && bench.chip.level(Pin::kIntr0) != 0; ++i) bench.run_cycles(1);
     }},
    {"UserJudges",
     [](SlaveBench& bench) {
       Init init;
       init.prm_mode = 2;
       bench.to_wait_prm(init);
       bench.set_prm({});
       bench.run_ms(1);
     }},
    {"Watchdog",
     [](SlaveBench& bench) {
       Prm prm;
       prm.status = 0x88;
       prm.wd1 = prm.wd2 = 1;
       bench.to_data_exch({}, prm);
     }},
};

class InState : public testing::TestWithParam<State> {};

TEST_P(InState, ResetLevelsAtOnceAndFullFunctionAfterwards) {
  SlaveBench bench;
  GetParam().reach(bench);
  bench.run_for(93);
  reset_now(bench);
  EXPECT_EQ(bench.dp_state(), DpState::kOffline);
  EXPECT_EQ(bench.chip.status().baud_index.code(), 15);
  EXPECT_EQ(bench.chip.status().master, 255);
  EXPECT_EQ(bench.chip.status().address, 0);
  expect_full_function(bench);
  EXPECT_EQ(bench.peek(regs::kOfflineCount, 2), (Bytes{0, 0})) << "D1: all zero at reset";
}

INSTANTIATE_TEST_SUITE_P(UserReset, InState, testing::ValuesIn(kStates), [](const auto& at) { return at.param.name; });

TEST(UserReset, AnytimeInAnExchangeAt12M) {
  // The request has 11 characters, the answer follows 11 bit times later: all of it in steps of less than a bit.
  for (Tick offset = 0; offset < 1300 * kCycleTicks; offset += 4'321) {
    SlaveBench bench;
    bench.to_data_exch();
    Script script(bench);
    const Tick when = bench.now() + offset;
    script.at(when, [&bench](Tick now) {
      bench.chip.set(now, Pin::kReset, 0);
      expect_reset_levels(bench);
    });
    bench.data_exchange({1, 2});
    bench.run_until(when + 10 * kCycleTicks);
    EXPECT_LE(bench.chip.trace().back().at, when);
    reset_now(bench);
    expect_full_function(bench);
    if (HasFailure()) FAIL() << "reset " << offset << " ticks after the call";
  }
}

TEST(UserReset, WhileSendingPbtxdAndPbrtsGoAtOnce) {
  SlaveBench bench;
  bench.to_data_exch();
  Script script(bench);
  const bus::Exchange whole = bench.data_exchange({1, 2});
  ASSERT_TRUE(whole.answered());
  const Tick again = whole.answer_end() + 40 * bench.requester.bit();
  const Tick low_in_start_bit = again + (whole.answer_start() - whole.request_start) + kCycleTicks + 13;
  script.set(low_in_start_bit, Pin::kReset, 0);
  const auto telegram = bus::make_telegram(5, 2, bench.fcb ? 0x7D : 0x5D, {3, 4});
  bench.requester.send(bench.timeline, telegram, {.at = again});
  EXPECT_EQ(bench.changes(Pin::kPbrts).back().at, low_in_start_bit);
  EXPECT_EQ(bench.changes(Pin::kPbtxd).back().at, low_in_start_bit);
  expect_reset_levels(bench);
}

}  // namespace
}  // namespace dsdpv1::conformance
