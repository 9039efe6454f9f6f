// DP_CONTROL: the watchdog's time, what triggers it, what its expiry does, to the cycle (S1, S18, S22).
#include <gtest/gtest.h>

#include "tests/conformance/master_side.hpp"

namespace dsdpv1::conformance {
namespace {

using profibus::Cycle;

class Watchdog : public testing::Test {
 protected:
  static Prm prm(int wd1, int wd2, bool one_ms) {
    Prm prm;
    prm.status = 0x88;
    prm.wd1 = static_cast<std::uint8_t>(wd1);
    prm.wd2 = static_cast<std::uint8_t>(wd2);
    if (one_ms) prm.user = {0x04};
    return prm;
  }
  /// In data exchange with a watchdog of 10 x 1 x 10 ms, which the user has accepted.
  void accept_by_user() {
    Init init;
    init.prm_mode = 2;
    bench.to_wait_prm(init);
    judge(prm(10, 1, false));
    bench.verdict(true, std::nullopt);
    ASSERT_TRUE(is_sc(ask(bench, 62, {0x11, 0x21})));
    ASSERT_TRUE(is_data(ask(bench, kNoSap, {1, 2})));
  }
  /// A Set_Prm that the user has then; the cycle of its decision.
  Cycle judge(const Prm& prm) {
    const Cycle decision = soon();
    send_decided_at(bench, decision, 0, bus::make_telegram(5, 2, kSrdFirst, prm.bytes(), 61, 62), true);
    EXPECT_EQ(bench.last(Reason::kPrmJudged).at, decision * kCycleTicks);
    bench.chip_accesses(3);
    return decision;
  }
  void expect_expiry(Cycle end, unsigned factors, unsigned base_ms) {
    bench.run_until(end * kCycleTicks);
    const profibus::Event& expired = bench.last(Reason::kWatchdogExpired);
    EXPECT_EQ(expired.at, end * kCycleTicks);
    EXPECT_EQ(expired.a, 2);
    EXPECT_EQ(expired.b, factors);
    EXPECT_EQ(expired.c, base_ms);
  }
  Cycle soon() const { return bench.now() / kCycleTicks + 2000; }
  void dx_decided_at(Cycle decision, std::uint8_t master = 2) {
    send_decided_at(bench, decision, 0, bus::make_telegram(5, master, kSrdFirst, {1, 2}), true);
  }

  SlaveBench bench{quick_search()};
};

TEST_F(Watchdog, TimeIsTheProductOfTheFactorsInTheBaseThatSetPrmChose) {
  struct Case {
    int wd1, wd2;
    bool one_ms;
    Cycle ms;
  };
  for (const Case& each : {Case{1, 1, true, 1},
                           {7, 1, true, 7},
                           {1, 9, true, 9},
                           {5, 6, true, 30},
                           {1, 1, false, 10},
                           {2, 3, false, 60},
                           {2, 3, true, 6},
                           {255, 1, true, 255}}) {
    SlaveBench one(quick_search());
    one.to_data_exch({}, prm(each.wd1, each.wd2, each.one_ms));
    const Cycle decision = one.now() / kCycleTicks + 2000;
    send_decided_at(one, decision, 0, bus::make_telegram(5, 2, kSrdFirst, {1, 2}), true);
    const Tick end = (decision + each.ms * kMs) * kCycleTicks;
    one.run_until(end - 1);
    EXPECT_EQ(one.dp_state(), DpState::kDataExch) << each.ms;
    one.run_until(end);
    EXPECT_EQ(one.dp_state(), DpState::kWaitPrm) << each.ms;
    const profibus::Event& expired = one.last(Reason::kWatchdogExpired);
    EXPECT_EQ(expired.at, end);
    EXPECT_EQ(expired.a, 2);
    EXPECT_EQ(expired.b, static_cast<unsigned>(each.wd1 * each.wd2));
    EXPECT_EQ(expired.c, each.one_ms ? 1 : 10);
  }
}

// --- while the user judges nothing of a Set_Prm is in force (S15)

TEST_F(Watchdog, ItsEndNamesTheSetPrmThatStartedIt) {
  accept_by_user();
  EXPECT_EQ(bench.last(Reason::kWatchdogOn).a, 10);
  EXPECT_EQ(bench.last(Reason::kWatchdogOn).b, 10);
  const Cycle decision = judge(prm(8, 5, true));
  expect_expiry(decision + 100 * kMs, 10, 10);
  bench.verdict(true, std::nullopt);
  EXPECT_EQ(bench.last(Reason::kVerdictUnexpected).a, 0);
  EXPECT_EQ(bench.dp_state(), DpState::kWaitPrm);
}

TEST_F(Watchdog, ItsEndNamesTheNewOneAfterTheVerdict) {
  accept_by_user();
  judge(prm(8, 5, true));
  bench.verdict(true, std::nullopt);
  const Tick accepted = bench.last(Reason::kPrmAccepted).at;
  EXPECT_EQ(bench.last(Reason::kWatchdogOn).a, 40);
  EXPECT_EQ(bench.last(Reason::kWatchdogOn).b, 1);
  expect_expiry(accepted / kCycleTicks + 40 * kMs, 40, 1);
}

TEST_F(Watchdog, EndsSilentlyWithTheRefusalOfTheNewOne) {
  accept_by_user();
  judge(prm(8, 5, true));
  bench.verdict(false, std::nullopt);
  EXPECT_EQ(bench.dp_state(), DpState::kWaitPrm);
  bench.run_ms(110);
  EXPECT_EQ(bench.count(Reason::kWatchdogExpired), 0);
}

TEST_F(Watchdog, LongestTimeIsSixHundredAndFiftySeconds) {
  bench.to_data_exch({}, prm(255, 255, false));
  EXPECT_EQ(bench.last(Reason::kWatchdogOn).a, 65025U);
  EXPECT_EQ(bench.last(Reason::kWatchdogOn).b, 10);
  bench.run_ms(700);  // BAUD_CONTROL's 600 ms do not run now
  EXPECT_EQ(bench.dp_state(), DpState::kDataExch);
  EXPECT_EQ(bench.count(Reason::kBaudLost), 0);
}

TEST_F(Watchdog, LongestTimeEndsToTheCycle) {
  bench.to_data_exch({}, prm(255, 255, false));
  const Cycle decision = soon();
  dx_decided_at(decision);
  bench.chip.set(bench.now(), Pin::kRReq, 1);  // no accesses: nothing but the time passes
  const Tick end = (decision + 650'250 * kMs) * kCycleTicks;
  // 31 thousand million cycles: only the engine that skips.
  bench.timeline.run_until(end - 1);
  EXPECT_EQ(bench.dp_state(), DpState::kDataExch);
  bench.timeline.run_until(end);
  EXPECT_EQ(bench.dp_state(), DpState::kWaitPrm);
}

TEST_F(Watchdog, RunsFromTheSetPrmOn) {
  bench.to_wait_prm();
  const Cycle decision = soon();
  send_decided_at(bench, decision, 0, bus::make_telegram(5, 2, kSrdFirst, prm(3, 1, true).bytes(), 61, 62), true);
  EXPECT_EQ(bench.last(Reason::kPrmAccepted).at, decision * kCycleTicks);
  bench.run_ms(4);
  EXPECT_EQ(bench.last(Reason::kWatchdogExpired).at, (decision + 3 * kMs) * kCycleTicks);
}

TEST_F(Watchdog, IsTriggeredByARepetitionToo) {
  bench.to_data_exch({}, prm(3, 1, true));
  for (int i = 0; i < 5; ++i) {
    bench.run_ms(2);
    EXPECT_TRUE(send_fc(bench, i == 0 ? 0x6D : 0x7D, kNoSap, kNoSap, {1, 2}).answered());
  }
  EXPECT_EQ(bench.dp_state(), DpState::kDataExch);
}

TEST_F(Watchdog, OfARefusedSetPrmDoesNotRun) {
  bench.to_wait_prm();
  Prm wrong = prm(3, 1, true);
  wrong.ident = 1;
  ASSERT_TRUE(is_sc(ask(bench, 61, wrong.bytes())));
  bench.run_ms(5);
  EXPECT_EQ(bench.count(Reason::kWatchdogExpired), 0);
  EXPECT_EQ(diag(bench).at(1) & 0x08, 0);
}

TEST_F(Watchdog, IsTriggeredInItsLastCycleAndNotInTheNext) {
  for (const bool in_time : {true, false}) {
    SlaveBench one(quick_search());
    one.to_data_exch({}, prm(3, 1, true));
    const Cycle first = one.now() / kCycleTicks + 2000;
    const auto dx = bus::make_telegram(5, 2, kSrdFirst, {1, 2});
    send_decided_at(one, first, 0, dx, true);
    send_decided_at(one, first + 3 * kMs - (in_time ? 1 : 0), 0, dx, true);
    EXPECT_EQ(one.dp_state(), in_time ? DpState::kDataExch : DpState::kWaitPrm);
  }
}

TEST_F(Watchdog, ClearsTheOutputsReleasesTheMasterAndCounts) {
  bench.to_data_exch({}, prm(3, 1, true));
  dx_decided_at(soon());
  bench.chip_accesses();
  ASSERT_EQ(bench.fetch_outputs(), (Bytes{1, 2}));
  bench.run_ms(4);
  EXPECT_EQ(bench.dp_state(), DpState::kWaitPrm);
  EXPECT_EQ(bench.chip.status().master, 255);
  EXPECT_EQ(bench.chip.level(Pin::kPbf), 1);
  EXPECT_EQ(bench.fetch_outputs(), (Bytes{0, 0}));
  EXPECT_EQ(offline_count(bench), 1);
  EXPECT_EQ(bench.peek(0x012), 0x04);
  EXPECT_EQ(output_area(bench), (Bytes{0, 0}));
  EXPECT_TRUE(is_rs(ask(bench, bus::sap::kReadOutputs))) << "S13";
  EXPECT_TRUE(is_rs(ask(bench, kNoSap, {1, 2})));
  EXPECT_EQ(bench.chip.level(Pin::kBr), 1) << "the baud rate stays";
}

TEST_F(Watchdog, IsTriggeredByEveryTelegramOfTheHolderToTheStation) {
  bench.to_data_exch({}, prm(3, 1, true));
  for (int i = 0; i < 4; ++i) {
    bench.run_ms(2);
    EXPECT_TRUE(bench.fdl_status().answered());
    bench.run_ms(2);
    EXPECT_TRUE(is_data(ask(bench, 60)));
    bench.run_ms(2);
    EXPECT_TRUE(is_rs(ask(bench, 40, {1})));
    bench.run_ms(2);
    tell(bench, 5, 58, {0, 0});
  }
  EXPECT_EQ(bench.dp_state(), DpState::kDataExch);
}

TEST_F(Watchdog, IsNotTriggeredByOthersNorByBroadcasts) {
  bench.to_data_exch({}, prm(3, 1, true));
  const Cycle decision = soon();
  dx_decided_at(decision);
  for (int i = 0; i < 2; ++i) {
    bench.run_ms(1);
    EXPECT_TRUE(is_data(ask(bench, 60, {}, 3)));
    EXPECT_TRUE(bench.requester.send(bench.timeline, bus::make_telegram(5, 3, kFdlStatus)).answered());
    tell(bench, bus::kBroadcast, 58, {0, 0});
    bench.requester.send(bench.timeline, bus::make_telegram(9, 2, kSrdFirst, {1, 2}));
  }
  bench.run_ms(1);
  EXPECT_EQ(bench.last(Reason::kWatchdogExpired).at, (decision + 3 * kMs) * kCycleTicks);
}

TEST_F(Watchdog, RunsInWaitCfgToo) {
  bench.to_wait_cfg({}, prm(3, 1, true));
  bench.run_ms(4);
  EXPECT_EQ(bench.dp_state(), DpState::kWaitPrm);
  EXPECT_EQ(bench.count(Reason::kWatchdogExpired), 1);
  EXPECT_EQ(bench.peek(dsdpv1::regs::kOfflineCount, 2), (Bytes{0, 0})) << "data exchange was not left (S29)";
}

TEST_F(Watchdog, NeverExpiresWithoutWdOn) {
  Prm off = prm(1, 1, true);
  off.status = 0x80;
  bench.to_data_exch({}, off);
  bench.run_ms(590);
  EXPECT_EQ(bench.dp_state(), DpState::kDataExch);
  EXPECT_EQ(bench.count(Reason::kWatchdogExpired), 0);
}

TEST_F(Watchdog, IsSwitchedOffByASetPrmWithoutIt) {
  bench.to_data_exch({}, prm(3, 1, true));
  ASSERT_TRUE(is_sc(ask(bench, 61, Prm{}.bytes())));
  ASSERT_TRUE(is_sc(ask(bench, 62, {0x11, 0x21})));
  bench.run_ms(20);
  EXPECT_EQ(bench.dp_state(), DpState::kDataExch);
}

TEST_F(Watchdog, TakesItsTimeFromTheNewestSetPrm) {
  bench.to_data_exch({}, prm(50, 1, true));
  ASSERT_TRUE(is_sc(ask(bench, 61, prm(2, 1, true).bytes())));
  ASSERT_TRUE(is_sc(ask(bench, 62, {0x11, 0x21})));
  bench.run_ms(3);
  EXPECT_EQ(bench.dp_state(), DpState::kWaitPrm);
}

TEST_F(Watchdog, IsNotTouchedByASetPrmThatChangesOnlyMinTsdr) {
  bench.to_data_exch({}, prm(3, 1, true));
  Prm only = prm(200, 200, false);
  only.status = 0x08;
  ASSERT_TRUE(is_sc(ask(bench, 61, only.bytes())));
  bench.run_ms(4);
  EXPECT_EQ(bench.dp_state(), DpState::kWaitPrm);
}

TEST_F(Watchdog, ExpiryLeavesTheRateToBaudControl) {
  dsdpv1::Config config = quick_search();
  config.baud_control_ms = 7;
  SlaveBench one(config);
  one.to_data_exch({}, prm(3, 1, true));
  one.run_ms(11);
  const Tick expired = one.last(Reason::kWatchdogExpired).at;
  EXPECT_EQ(one.last(Reason::kBaudLost).at, expired + 7 * kMs * kCycleTicks);
}

TEST_F(Watchdog, EndsWithTheMasterThatUnlocks) {
  dsdpv1::Config config = quick_search();
  config.baud_control_ms = 7;
  SlaveBench one(config);
  one.to_data_exch({}, prm(3, 1, true));
  Prm unlock;
  unlock.status = 0x40;
  ASSERT_TRUE(is_sc(ask(one, 61, unlock.bytes())));
  one.run_ms(8);
  EXPECT_EQ(one.count(Reason::kWatchdogExpired), 0);
  EXPECT_EQ(one.count(Reason::kBaudLost), 1);
}

TEST_F(Watchdog, ShowsInTheDiagnosisWhileItRuns) {
  bench.to_wait_prm();
  EXPECT_EQ(diag(bench)[1] & 0x08, 0);
  ASSERT_TRUE(is_sc(ask(bench, 61, prm(3, 1, true).bytes())));
  EXPECT_EQ(diag(bench)[1] & 0x08, 0x08);
  bench.run_ms(4);
  EXPECT_EQ(diag(bench)[1] & 0x08, 0);
}

}  // namespace
}  // namespace dsdpv1::conformance
