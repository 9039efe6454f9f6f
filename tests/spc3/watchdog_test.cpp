// Watchdogs, the search and min_TSDR (docs/spc3.md, "MAC, DP and watchdog"; A30 to A34).
#include "tests/spc3/bench.hpp"

namespace dsdpv1::spc3_test {
namespace {

constexpr std::uint8_t kWdOn = 0x88;

unsigned wd_state(Bench& bench) { return bench.load(regs::kStatus) >> 6U; }

TEST(Spc3Watchdog, DpControlEndsTheExchangeOfASilentMaster) {
  Bench bench;
  bench.to_data_ex();
  bench.set_prm({0x04}, kWdOn, 2, 3);  // 6 x 1 ms (A32)
  EXPECT_EQ(wd_state(bench), 2U) << "from its receipt (A49)";
  bench.load(regs::kPrmOk);
  bench.check_cfg();
  bench.give_inputs({1, 2, 3});
  bench.load(regs::kCfgOk);
  const Tick request_end = bench.exchange({7, 7}).request_end;
  bench.acknowledge(0xFFFF);
  bench.run_until(request_end + 6 * kMs * profibus::kTicksPerCycle);
  EXPECT_EQ(bench.state(), DpState::kDataExch);
  for (int i = 0; i < 20 && bench.state() == DpState::kDataExch; ++i) bench.run_cycles(1);
  EXPECT_EQ(bench.state(), DpState::kWaitPrm);
  EXPECT_EQ(wd_state(bench), 1U);
  EXPECT_TRUE(bench.raised(regs::kEventWdTimeout | regs::kEventDataEx | regs::kEventDxOut)) << "at the same edge";
  EXPECT_EQ(bench.fetch_outputs(), (Bytes{0, 0}));
}

TEST(Spc3Watchdog, AVerdictThatNeverComesDoesNotStopIt) {
  Bench bench;
  bench.to_wait_prm();
  bench.set_prm({0x04}, kWdOn, 1, 3);
  bench.run_ms(4);
  EXPECT_EQ(bench.state(), DpState::kWaitPrm);
  EXPECT_TRUE(bench.raised(regs::kEventWdTimeout));
  EXPECT_EQ(bench.load(regs::kPrmOk), regs::kVerdictNotAllowed);
}

TEST(Spc3Watchdog, BaudControlSearchesAgainAndLeavesTheState) {
  Bench bench;
  bench.power_on();
  bench.initialise();
  bench.store(regs::kWdBaudControl, 2);  // 2 x 2 x 10 ms (A31)
  bench.start();
  bench.find_baud();
  bench.set_prm();
  bench.check_cfg();
  bench.give_inputs({1, 2, 3});
  bench.load(regs::kCfgOk);
  bench.exchange({1, 2});
  bench.acknowledge(0xFFFF);
  bench.run_ms(39);
  EXPECT_EQ(wd_state(bench), 1U);
  bench.run_ms(2);
  EXPECT_EQ(wd_state(bench), 0U);
  EXPECT_EQ(bench.state(), DpState::kDataExch) << "M 4.4.2";
  EXPECT_EQ(bench.irr(), 0);
  bench.find_baud(1);
  EXPECT_TRUE(bench.raised(regs::kEventBaudDetect));
  EXPECT_EQ(bench.load(regs::kStatus + 1) & 0x0F, 1);
  EXPECT_EQ(kind_of(bench.exchange({1, 2})), "DL");
}

TEST(Spc3Watchdog, BaudControlMayBeLinearOrOff) {
  for (const std::uint8_t value : {std::uint8_t{5}, std::uint8_t{0}}) {
    spc3::Config config;
    config.baud_control = 1;
    Bench bench(Variant::kApc3, config);
    bench.to_wait_prm();
    bench.store(regs::kWdBaudControl, value);
    bench.ask(60);
    bench.run_ms(49);
    EXPECT_EQ(wd_state(bench), 1U);
    bench.run_ms(2);
    EXPECT_EQ(wd_state(bench), value == 0 ? 1U : 0U);
  }
}

TEST(Spc3Watchdog, TheSearchEndsWithEachStartDelimiter) {
  for (const Bytes& data : {Bytes{}, Bytes{1, 2, 3}, Bytes(8, 0)}) {  // SD1, SD2, SD3
    Bench bench;
    bench.power_on();
    bench.initialise();
    bench.start();
    bench.run_cycles(200);  // T_SYN
    const auto telegram = bus::prefer_sd3(bus::make_telegram(100, 2, 0x6D, data));
    bench.requester.send(bench.timeline, telegram, {.wants_answer = false});
    bench.run_cycles(20);
    EXPECT_EQ(wd_state(bench), 1U) << data.size() << " (A30)";
  }
}

// --- min_TSDR --------------------------------------------------------------------------------------------------------

double tsdr(Bench& bench) { return bench.ask(60).tsdr_bits(); }

TEST(MinTsdr, IsTheDefaultTheRegistersOrTheMasters) {
  Bench bench;
  bench.to_wait_prm();
  EXPECT_NEAR(tsdr(bench), 11, 1);
  bench.store(regs::kMinTsdr, 40);
  EXPECT_NEAR(tsdr(bench), 40, 1);
  bench.set_prm({}, 0x80, 0, 0, 70);
  EXPECT_NEAR(tsdr(bench), 70, 1);
  bench.set_prm({}, 0x80, 0, 0, 0);
  EXPECT_NEAR(tsdr(bench), 70, 1) << "0 leaves it";
}

TEST(MinTsdr, IsTheCombiDefault) {
  Bench bench;
  Organisation given;
  given.modes |= regs::kMode0Combi;
  bench.to_wait_prm(given);
  EXPECT_NEAR(tsdr(bench), 60, 1);
}

TEST(MinTsdr, ReturnsToTheDefaultWhenTheRateIsLost) {
  for (const bool keeps : {false, true}) {
    spc3::Config config;
    config.tsdr_at_search = keeps;
    Bench bench(Variant::kApc3, config);
    bench.power_on();
    bench.initialise();
    bench.store(regs::kMinTsdr, 50);
    bench.store(regs::kWdBaudControl, 1);
    bench.start();
    bench.find_baud();
    EXPECT_NEAR(tsdr(bench), keeps ? 50 : 11, 1) << "START begins a search";
    bench.store(regs::kMinTsdr, 40);
    bench.run_ms(11);
    EXPECT_EQ(bench.count(profibus::Reason::kBaudLost), 1);
    bench.find_baud();
    EXPECT_NEAR(tsdr(bench), keeps ? 40 : 11, 1) << "A33";
  }
}

// --- the user's watchdog ---------------------------------------------------------------------------------------------

TEST(UserWatchdog, CountsDataTelegramsWithoutItsBit) {
  Bench bench;
  Organisation given;
  given.user_watchdog = 3;
  bench.to_data_ex(given);  // START with Res_User_Wd
  for (int i = 0; i < 3; ++i) EXPECT_EQ(kind_of(bench.exchange({1, 2})), "DL");
  EXPECT_EQ(bench.state(), DpState::kDataExch) << "the first loaded it, 2 are counted";
  bench.set_mode1(regs::kMode1ResUserWd);
  for (int i = 0; i < 3; ++i) bench.exchange({1, 2});
  EXPECT_EQ(bench.state(), DpState::kDataExch);
  bench.ask(56);
  bench.acknowledge(0xFFFF);
  EXPECT_EQ(kind_of(bench.exchange({8, 8})), "DL") << "still answered";
  EXPECT_EQ(bench.state(), DpState::kWaitPrm);
  EXPECT_EQ(bench.count(spc3::Reason::kUserWatchdog), 1);
  EXPECT_TRUE(bench.raised(regs::kEventDataEx | regs::kEventDxOut));
  EXPECT_EQ(bench.fetch_outputs(), (Bytes{0, 0}));
}

TEST(UserWatchdog, ZeroCounts65536AndTheFirstWithoutTheBitWraps) {
  Bench bench;
  bench.power_on();
  bench.initialise();
  bench.set_mode1(regs::kMode1Start);  // A34: the count is 0
  bench.run_cycles(2);
  bench.find_baud();
  bench.set_prm();
  bench.check_cfg();
  bench.give_inputs({1, 2, 3});
  bench.load(regs::kCfgOk);
  for (int i = 0; i < 10; ++i) bench.exchange({1, 2});
  EXPECT_EQ(bench.state(), DpState::kDataExch);
}

}  // namespace
}  // namespace dsdpv1::spc3_test
