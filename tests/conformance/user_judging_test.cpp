// Judging of parameters and configuration: tables 13 and 14; rulings D4, D8, D15, H7, S7, S15 to S17, P7.
#include <tuple>

#include "tests/conformance/master_side.hpp"
#include "tests/conformance/user_helpers.hpp"

namespace dsdpv1::conformance {
namespace {

Init judged_by(int prm_mode, int cfg_mode) {
  Init init;
  init.prm_mode = static_cast<std::uint8_t>(prm_mode);
  init.cfg_mode = static_cast<std::uint8_t>(cfg_mode);
  init.max_prm = 3;
  init.max_cfg = 4;
  return init;
}

Prm with_user(Bytes user) {
  Prm prm;
  prm.user = std::move(user);
  return prm;
}

/// Slave_Diag's status bytes (APC3 A.4).
struct Diag {
  bool not_ready, cfg_fault, prm_fault, not_supported, prm_req;
  int master;
};

Diag diagnosis(SlaveBench& bench) {
  const Bytes bytes = bench.slave_diag();
  EXPECT_GE(bytes.size(), 6U);
  if (bytes.size() < 6) return {};
  return {(bytes[0] & 0x02) != 0, (bytes[0] & 0x04) != 0, (bytes[0] & 0x40) != 0,
          (bytes[0] & 0x10) != 0, (bytes[1] & 0x01) != 0, bytes[3]};
}

void expect_judging(SlaveBench& bench) {
  const Diag seen = diagnosis(bench);
  EXPECT_TRUE(seen.not_ready);
  EXPECT_FALSE(seen.prm_req) << "S15: not while the user judges";
  EXPECT_FALSE(seen.prm_fault);
  EXPECT_FALSE(seen.cfg_fault);
}

void expect_refused(SlaveBench& bench, bool prm_fault) {
  EXPECT_EQ(bench.dp_state(), DpState::kWaitPrm);
  const Diag seen = diagnosis(bench);
  EXPECT_EQ(seen.prm_fault, prm_fault);
  EXPECT_EQ(seen.cfg_fault, !prm_fault);
  EXPECT_TRUE(seen.not_ready);
  EXPECT_TRUE(seen.prm_req);
  EXPECT_FALSE(seen.not_supported);
  EXPECT_EQ(seen.master, 255) << "S15: the master is released";
}

int pulses(const SlaveBench& bench) {
  int low = 0;
  for (const PinChange& change : bench.changes(Pin::kIntr0)) low += change.level == 0 ? 1 : 0;
  return low;
}

class Modes : public testing::TestWithParam<std::tuple<int, int>> {
 protected:
  int prm_mode() const { return std::get<0>(GetParam()); }
  int cfg_mode() const { return std::get<1>(GetParam()); }
  SlaveBench bench;
};

TEST_P(Modes, RightParametersAndConfigurationReachDataExchange) {
  bench.to_wait_prm(judged_by(prm_mode(), cfg_mode()));
  ASSERT_TRUE(bench.set_prm(with_user({0, 2, 3})).short_acknowledge());
  bench.chip_accesses(2);
  EXPECT_EQ(pulses(bench), 1) << "P7: in every judging mode";
  EXPECT_EQ(bench.peek(regs::kChipCommand1), regs::kChipCommand1Prm);
  if (prm_mode() == 2) {
    EXPECT_EQ(bench.dp_state(), DpState::kWaitPrm);
    expect_judging(bench);
    bench.verdict(true, std::nullopt);
  }
  EXPECT_EQ(bench.dp_state(), DpState::kWaitCfg);
  bench.run_cycles(200);
  ASSERT_TRUE(bench.check_cfg({0x11, 0x21}).short_acknowledge());
  bench.chip_accesses(2);
  EXPECT_EQ(pulses(bench), 2);
  EXPECT_EQ(bench.peek(regs::kChipCommand1) & regs::kChipCommand1Cfg, regs::kChipCommand1Cfg);
  if (cfg_mode() == 2) {
    EXPECT_EQ(bench.dp_state(), DpState::kWaitCfg);
    expect_judging(bench);
    bench.verdict(std::nullopt, true);
  }
  EXPECT_EQ(bench.dp_state(), DpState::kDataExch);
  EXPECT_FALSE(diagnosis(bench).not_ready);
  EXPECT_TRUE(bench.data_exchange({1, 2}).answered());
}

TEST_P(Modes, UserParameterLengths) {
  for (const std::size_t length : {0U, 2U, 3U, 4U}) {
    SlaveBench fresh;
    fresh.to_wait_prm(judged_by(prm_mode(), cfg_mode()));
    Bytes user(length, 0);
    ASSERT_TRUE(fresh.set_prm(with_user(user)).short_acknowledge()) << "S14";
    fresh.chip_accesses(3);
    if (prm_mode() == 2) {
      EXPECT_EQ(fresh.dp_state(), DpState::kWaitPrm);
      EXPECT_EQ(pulses(fresh), 1) << "user bytes " << length;
      EXPECT_EQ(fresh.peek(regs::kPrmLength), length);
      continue;
    }
    const bool right = prm_mode() == 0 ? length <= 3 : length == 3;
    EXPECT_EQ(fresh.dp_state(), right ? DpState::kWaitCfg : DpState::kWaitPrm) << "user bytes " << length;
    EXPECT_EQ(pulses(fresh), right ? 1 : 0) << "D15: refused ones are not written";
    EXPECT_EQ(fresh.peek(regs::kChipCommand1), right ? regs::kChipCommand1Prm : 0);
    EXPECT_EQ(fresh.count(Reason::kPrmUserLength), right ? 0 : 1);
    if (!right) expect_refused(fresh, true);
  }
}

TEST_P(Modes, Configurations) {
  struct Try {
    Bytes cfg;
    bool right[2];  // in modes 0 and 1
  };
  const Try tries[] = {
      {{0x11, 0x21}, {true, true}},
      {{0x21, 0x11}, {true, false}},
      {{0x11}, {true, false}},
      {{0x11, 0x21, 0x00}, {true, false}},
      {{0x11, 0x21, 0x00, 0x00}, {true, false}},
      {{0x11, 0x21, 0x00, 0x00, 0x00}, {false, false}},
      {{0x11, 0x20}, {true, false}},
  };
  for (const Try& one : tries) {
    SlaveBench fresh;
    fresh.to_wait_prm(judged_by(prm_mode(), cfg_mode()));
    fresh.set_prm(with_user({0, 2, 3}));
    fresh.chip_accesses(3);
    if (prm_mode() == 2) fresh.verdict(true, std::nullopt);
    fresh.run_cycles(200);
    const int before = pulses(fresh);
    ASSERT_TRUE(fresh.check_cfg(one.cfg).short_acknowledge());
    fresh.chip_accesses(3);
    const bool user = cfg_mode() == 2;
    const bool right = !user && one.right[cfg_mode()];
    EXPECT_EQ(fresh.dp_state(), right  ? DpState::kDataExch
                                : user ? DpState::kWaitCfg
                                       : DpState::kWaitPrm)
        << one.cfg.size();
    EXPECT_EQ(pulses(fresh) - before, right || user ? 1 : 0);
    if (!right && !user) expect_refused(fresh, false);
  }
}

TEST_P(Modes, VerdictWithoutABlockIsDiscarded) {
  bench.to_wait_prm(judged_by(prm_mode(), cfg_mode()));
  bench.verdict(true, std::nullopt);
  EXPECT_EQ(bench.count(Reason::kVerdictUnexpected), 1);
  bench.verdict(std::nullopt, false);
  EXPECT_EQ(bench.count(Reason::kVerdictUnexpected), 2);
  EXPECT_EQ(bench.peek(regs::kUserCommand1), 0) << "the flag is cleared";
  EXPECT_EQ(bench.dp_state(), DpState::kWaitPrm);
}

TEST_P(Modes, VerdictOnAnythingTheChipJudgesIsDiscarded) {
  if (prm_mode() == 2 || cfg_mode() == 2) return;  // the chip judges both
  const Init init = judged_by(prm_mode(), cfg_mode());
  bench.to_wait_cfg(init, with_user({0, 2, 3}));
  bench.verdict(true, true);
  EXPECT_EQ(bench.count(Reason::kVerdictUnexpected), 2);
  EXPECT_EQ(bench.dp_state(), DpState::kWaitCfg);
  ASSERT_TRUE(bench.check_cfg(init.cfg).short_acknowledge());
  bench.verdict(false, false);
  EXPECT_EQ(bench.count(Reason::kVerdictUnexpected), 4);
  EXPECT_EQ(bench.dp_state(), DpState::kDataExch);
}

INSTANTIATE_TEST_SUITE_P(UserJudging, Modes, testing::Combine(testing::Range(0, 3), testing::Range(0, 3)),
                         [](const auto& at) {
                           return "Prm" + std::to_string(std::get<0>(at.param)) + "Cfg" +
                                  std::to_string(std::get<1>(at.param));
                         });

// --- the user's verdict on parameters --------------------------------------------------------------------------------

class ByUser : public testing::Test {
 protected:
  void wait_for_prm_verdict() {
    bench.to_wait_prm(judged_by(2, 2));
    ASSERT_TRUE(bench.set_prm(with_user({1, 2, 3})).short_acknowledge());
    bench.chip_accesses(3);
  }
  void wait_for_cfg_verdict() {
    wait_for_prm_verdict();
    bench.verdict(true, std::nullopt);
    ASSERT_TRUE(bench.check_cfg({0x11, 0x21}).short_acknowledge());
    bench.chip_accesses(3);
  }
  SlaveBench bench;
};

TEST_F(ByUser, WrongParametersArePrmFault) {
  wait_for_prm_verdict();
  bench.verdict(false, std::nullopt);
  EXPECT_EQ(bench.count(Reason::kPrmUserRefused), 1);
  expect_refused(bench, true);
  EXPECT_EQ(bench.peek(regs::kUserStatus1), 1) << "the chip does not write the user's byte";
}

TEST_F(ByUser, WrongConfigurationIsCfgFault) {
  wait_for_cfg_verdict();
  bench.verdict(std::nullopt, false);
  EXPECT_EQ(bench.count(Reason::kCfgUserRefused), 1);
  expect_refused(bench, false);
}

TEST_F(ByUser, FaultsFallWithTheNextGoodOnes) {
  wait_for_prm_verdict();
  bench.verdict(false, std::nullopt);
  ASSERT_TRUE(diagnosis(bench).prm_fault);
  bench.set_prm(with_user({}));
  bench.chip_accesses(3);
  EXPECT_TRUE(diagnosis(bench).prm_fault) << "S17: not yet good";
  bench.verdict(true, std::nullopt);
  EXPECT_FALSE(diagnosis(bench).prm_fault);
  bench.check_cfg();
  bench.chip_accesses(3);
  bench.verdict(std::nullopt, false);
  ASSERT_TRUE(diagnosis(bench).cfg_fault);
  bench.set_prm(with_user({}));
  bench.chip_accesses(3);
  bench.verdict(true, std::nullopt);
  EXPECT_TRUE(diagnosis(bench).cfg_fault) << "S17: until the next good Check_Cfg";
  bench.check_cfg();
  bench.chip_accesses(3);
  bench.verdict(std::nullopt, true);
  EXPECT_FALSE(diagnosis(bench).cfg_fault);
  EXPECT_EQ(bench.dp_state(), DpState::kDataExch);
}

TEST_F(ByUser, ALateVerdictCounts) {
  wait_for_prm_verdict();
  bench.run_ms(400);
  expect_judging(bench);
  bench.verdict(true, std::nullopt);
  EXPECT_EQ(bench.dp_state(), DpState::kWaitCfg);
  bench.check_cfg();
  bench.run_ms(400);
  bench.verdict(std::nullopt, true);
  EXPECT_EQ(bench.dp_state(), DpState::kDataExch);
}

TEST_F(ByUser, WithoutAVerdictTheStateStays) {
  wait_for_prm_verdict();
  for (int i = 0; i < 5; ++i) {
    bench.run_ms(300);
    expect_judging(bench);
    EXPECT_EQ(bench.dp_state(), DpState::kWaitPrm);
  }
}

TEST_F(ByUser, WithoutAVerdictOnTheConfigurationTheStateStays) {
  wait_for_cfg_verdict();
  for (int i = 0; i < 5; ++i) {
    bench.run_ms(300);
    expect_judging(bench);
    EXPECT_EQ(bench.dp_state(), DpState::kWaitCfg);
  }
  const bus::Exchange exchange = bench.data_exchange({1, 2});
  ASSERT_TRUE(exchange.answered());
  EXPECT_EQ(exchange.answer().fc, bus::fc::kRs) << "S13: no data exchange yet";
}

TEST_F(ByUser, ASecondVerdictIsDiscarded) {
  wait_for_prm_verdict();
  bench.verdict(true, std::nullopt);
  bench.verdict(false, std::nullopt);
  EXPECT_EQ(bench.count(Reason::kVerdictUnexpected), 1);
  EXPECT_EQ(bench.last(Reason::kVerdictUnexpected).a, 0);
  EXPECT_EQ(bench.dp_state(), DpState::kWaitCfg);
}

TEST_F(ByUser, VerdictOnTheOtherKindIsDiscarded) {
  wait_for_prm_verdict();
  bench.verdict(std::nullopt, true);
  EXPECT_EQ(bench.count(Reason::kVerdictUnexpected), 1);
  EXPECT_EQ(bench.last(Reason::kVerdictUnexpected).a, 1);
  expect_judging(bench);
  EXPECT_EQ(bench.dp_state(), DpState::kWaitPrm);
}

TEST_F(ByUser, StatusBitsWithoutTheFlagAreNoVerdict) {
  wait_for_prm_verdict();
  bench.poke(0x00C, 0x01);
  bench.chip_accesses(5);
  expect_judging(bench);
  EXPECT_EQ(bench.dp_state(), DpState::kWaitPrm);
  bench.verdict(true, std::nullopt);
  ASSERT_TRUE(bench.check_cfg().short_acknowledge());
  bench.chip_accesses(3);
  bench.poke(0x00C, 0x02);
  bench.chip_accesses(5);
  expect_judging(bench);
  EXPECT_EQ(bench.dp_state(), DpState::kWaitCfg);
}

TEST_F(ByUser, BothVerdictsInOneHoldAreTakenParametersFirst) {
  // Parameters awaited, configuration not: its verdict comes too early and is discarded, though both stand in one
  // access (H4).
  wait_for_prm_verdict();
  bench.verdict(true, true);
  EXPECT_EQ(bench.dp_state(), DpState::kWaitCfg);
  EXPECT_EQ(bench.count(Reason::kVerdictUnexpected), 1);
  EXPECT_EQ(bench.last(Reason::kVerdictUnexpected).a, 1);
  EXPECT_EQ(bench.peek(regs::kUserCommand1), 0);
}

TEST_F(ByUser, EachVerdictLooksOnlyAtItsOwnBit) {
  wait_for_prm_verdict();
  bench.acquire();
  bench.write(regs::kUserStatus1, regs::kUserStatus1CfgWrong);
  bench.write(regs::kUserCommand1, regs::kUserCommand1PrmVerdict);
  bench.chip_accesses();
  EXPECT_EQ(bench.dp_state(), DpState::kWaitCfg);
  bench.check_cfg();
  bench.chip_accesses(3);
  bench.acquire();
  bench.write(regs::kUserStatus1, regs::kUserStatus1PrmWrong);
  bench.write(regs::kUserCommand1, regs::kUserCommand1CfgVerdict);
  bench.chip_accesses();
  EXPECT_EQ(bench.dp_state(), DpState::kDataExch);
  EXPECT_EQ(bench.count(Reason::kVerdictUnexpected), 0) << "neither flag gives the other verdict";
}

TEST_F(ByUser, CheckCfgWhileTheParametersAreJudgedIsRefused) {
  wait_for_prm_verdict();
  const bus::Exchange exchange = bench.check_cfg();
  ASSERT_TRUE(exchange.answered());
  EXPECT_EQ(exchange.answer().fc, bus::fc::kRs) << "S7, S13: the state is WAIT_PRM";
  bench.verdict(true, std::nullopt);
  EXPECT_TRUE(bench.check_cfg().short_acknowledge());
}

TEST_F(ByUser, AVerdictForASupersededBlockIsDiscarded) {
  wait_for_prm_verdict();
  // The user takes the DPRAM, a newer Set_Prm arrives meanwhile; the verdict is for the older block (H7).
  bench.acquire();
  ASSERT_TRUE(bench.set_prm(with_user({7, 8})).short_acknowledge());
  bench.write(regs::kUserStatus1, 0);
  bench.write(regs::kUserCommand1, regs::kUserCommand1PrmVerdict);
  bench.chip_accesses();
  EXPECT_EQ(bench.count(Reason::kVerdictSuperseded), 1);
  EXPECT_EQ(bench.peek(regs::kUserCommand1), 0);
  EXPECT_EQ(bench.dp_state(), DpState::kWaitPrm);
  EXPECT_EQ(bench.peek(regs::kPrm, 3), (Bytes{2, 7, 8})) << "the newer block is written in the same access";
  expect_judging(bench);
  bench.verdict(true, std::nullopt);
  EXPECT_EQ(bench.dp_state(), DpState::kWaitCfg);
}

TEST_F(ByUser, AVerdictForASupersededConfigurationIsDiscarded) {
  wait_for_cfg_verdict();
  bench.acquire();
  ASSERT_TRUE(bench.check_cfg({0x10, 0x20}).short_acknowledge());
  bench.write(regs::kUserStatus1, 0);
  bench.write(regs::kUserCommand1, regs::kUserCommand1CfgVerdict);
  bench.chip_accesses();
  EXPECT_EQ(bench.count(Reason::kVerdictSuperseded), 1);
  EXPECT_EQ(bench.dp_state(), DpState::kWaitCfg);
  EXPECT_EQ(bench.peek(regs::kCfg, 5), (Bytes{1, 1, 2, 0x10, 0x20}));
  bench.verdict(std::nullopt, true);
  EXPECT_EQ(bench.dp_state(), DpState::kDataExch);
  EXPECT_TRUE(bench.data_exchange({1}).answered());
}

TEST_F(ByUser, ASetPrmWhileTheConfigurationIsJudgedDropsThatVerdict) {
  wait_for_cfg_verdict();
  ASSERT_TRUE(bench.set_prm(with_user({4})).short_acknowledge());
  EXPECT_EQ(bench.dp_state(), DpState::kWaitPrm) << "S15";
  bench.chip_accesses(3);
  bench.verdict(std::nullopt, true);
  EXPECT_EQ(bench.dp_state(), DpState::kWaitPrm);
  EXPECT_EQ(bench.count(Reason::kVerdictUnexpected), 1);
  bench.verdict(true, std::nullopt);
  EXPECT_EQ(bench.dp_state(), DpState::kWaitCfg);
}

TEST_F(ByUser, SetPrmInDataExchangeIsJudgedAgain) {
  wait_for_cfg_verdict();
  bench.verdict(std::nullopt, true);
  ASSERT_EQ(bench.dp_state(), DpState::kDataExch);
  ASSERT_TRUE(bench.set_prm(with_user({5})).short_acknowledge());
  EXPECT_EQ(bench.dp_state(), DpState::kWaitPrm);
  bench.chip_accesses(3);
  EXPECT_EQ(bench.peek(regs::kOfflineCount + 1), 1);
  bench.verdict(true, std::nullopt);
  EXPECT_EQ(bench.dp_state(), DpState::kWaitCfg);
}

TEST_F(ByUser, WhoHoldsTheSlaveGoesOnHoldingItWhileTheUserJudges) {
  wait_for_cfg_verdict();
  bench.verdict(std::nullopt, true);
  ASSERT_TRUE(bench.set_prm(with_user({5})).short_acknowledge());
  EXPECT_EQ(bench.slave_diag().at(3), 2);
  bench.master = 3;
  bench.fcb = true;
  bench.fcb_valid = false;
  EXPECT_FALSE(bench.set_prm(with_user({6})).short_acknowledge()) << "RS for another master (S12)";
}

TEST_F(ByUser, MoreThan237BytesAreAPrmFaultInEveryMode) {
  bench.to_wait_prm(judged_by(2, 2));
  EXPECT_TRUE(bench.srd(61, -1, with_user(Bytes(238, 1)).bytes()).short_acknowledge()) << "fits without SSAP";
  EXPECT_EQ(bench.count(profibus::Reason::kPrmUserLength), 1);
  EXPECT_EQ(bench.slave_diag().at(0) & 0x40, 0x40);
}

// --- a watchdog that waits for the rate (S29)
// --------------------------------------------------------------------------

/// BAUD_CONTROL of 5 ms, so that a master that is silent loses the rate soon.
dsdpv1::Config quick_loss() {
  dsdpv1::Config config;
  config.baud_control_ms = 5;
  return config;
}

Prm watched(int wd1, int wd2, bool wd_on = true) {
  Prm prm = with_user({0x04});  // WD_Base 1 ms
  prm.status = wd_on ? 0x88 : 0x80;
  prm.wd1 = static_cast<std::uint8_t>(wd1);
  prm.wd2 = static_cast<std::uint8_t>(wd2);
  return prm;
}

/// The user has a Set_Prm to judge, and the rate has been lost meanwhile.
void lose_the_rate(SlaveBench& bench, const Prm& prm) {
  bench.to_wait_prm(judged_by(2, 0));
  ASSERT_TRUE(bench.set_prm(prm).short_acknowledge());
  bench.run_ms(10);
  ASSERT_EQ(bench.count(Reason::kBaudLost), 1);
  ASSERT_EQ(bench.peek(0x012) >> 4, 0xF);
}

void accept_in_the_search(SlaveBench& bench, const Prm& prm) {
  lose_the_rate(bench, prm);
  bench.verdict(true, std::nullopt);
  ASSERT_EQ(bench.count(Reason::kPrmAccepted), 1);
  ASSERT_EQ(bench.dp_state(), DpState::kWaitCfg);
  ASSERT_EQ(bench.count(Reason::kWatchdogOn), 0);
}

Tick after_ms(Tick begin, Cycle ms) { return begin + ms * kMs * kCycleTicks; }

void expect_expiry_at(SlaveBench& bench, Tick end, DpState before) {
  bench.run_until(end - 1);
  EXPECT_EQ(bench.dp_state(), before);
  bench.run_until(end);
  EXPECT_EQ(bench.dp_state(), DpState::kWaitPrm);
  EXPECT_EQ(bench.last(Reason::kWatchdogExpired).at, end);
}

TEST_F(ByUser, VerdictWhileTheRateIsSearchedRunsNoWatchdogUntilTheRateIsFound) {
  SlaveBench lost(quick_loss());
  accept_in_the_search(lost, watched(1, 1));
  lost.run_ms(20);
  EXPECT_EQ(lost.count(Reason::kWatchdogOn), 0);
  EXPECT_EQ(lost.count(Reason::kWatchdogExpired), 0);
  EXPECT_EQ(lost.count(Reason::kBaudSearch), 2) << "one search, undisturbed";
  lost.find_baud();
  EXPECT_EQ(lost.count(Reason::kWatchdogOn), 1);
}

TEST_F(ByUser, WatchdogOfAVerdictInTheSearchStartsWithTheRate) {
  SlaveBench lost(quick_loss());
  accept_in_the_search(lost, watched(10, 10));
  lost.find_baud();
  EXPECT_EQ(lost.last(Reason::kWatchdogOn).at, lost.last(Reason::kBaudFound).at);
  EXPECT_EQ(lost.last(Reason::kWatchdogOn).a, 100);
  EXPECT_EQ(lost.last(Reason::kWatchdogOn).b, 1);
  const auto& events = lost.chip.events();
  EXPECT_EQ(events.at(events.size() - 2).reason, Reason::kBaudFound) << "in this order";
  EXPECT_EQ(lost.slave_diag(), (Bytes{0x02, 0x0C, 0, 2, 0x0C, 0xC9}));
  ASSERT_TRUE(lost.check_cfg().short_acknowledge());
  const Cycle decision = lost.now() / kCycleTicks + 2000;
  send_decided_at(lost, decision, 0, bus::make_telegram(5, 2, kSrdFirst, {0x12, 0x34}), true);
  lost.chip_accesses();
  EXPECT_EQ(lost.fetch_outputs(), (Bytes{0x12, 0x34}));
  expect_expiry_at(lost, after_ms(decision * kCycleTicks, 100), DpState::kDataExch);
  EXPECT_EQ(lost.last(Reason::kWatchdogExpired).a, 2);
  EXPECT_EQ(lost.last(Reason::kWatchdogExpired).b, 100);
  EXPECT_EQ(lost.last(Reason::kWatchdogExpired).c, 1);
  EXPECT_EQ(lost.chip.level(Pin::kPbf), 1);
  lost.chip_accesses();
  EXPECT_EQ(lost.fetch_outputs(), (Bytes{0, 0})) << "the outputs do not stand without a master";
  EXPECT_EQ(offline_count(lost), 1);
}

TEST_F(ByUser, WatchdogOfAVerdictInTheSearchReleasesTheSlaveOfADeadMaster) {
  SlaveBench lost(quick_loss());
  accept_in_the_search(lost, watched(5, 4));
  lost.find_baud();
  const Tick end = after_ms(lost.last(Reason::kBaudFound).at, 20);
  for (int i = 0; i < 5; ++i) {
    lost.run_ms(3);
    EXPECT_TRUE(lost.requester.send(lost.timeline, bus::make_telegram(5, 3, kFdlStatus)).answered());
  }
  EXPECT_TRUE(is_rs(ask(lost, bus::sap::kSetPrm, watched(1, 1).bytes(), 3)));
  expect_expiry_at(lost, end, DpState::kWaitCfg);
  EXPECT_EQ(offline_count(lost), 0) << "data exchange was not left (S29)";
  EXPECT_TRUE(is_sc(ask(lost, bus::sap::kSetPrm, watched(1, 1).bytes(), 3)));
}

TEST_F(ByUser, VerdictInTheSearchWithoutWdOnLeavesNoWatchdogWaiting) {
  SlaveBench lost(quick_loss());
  accept_in_the_search(lost, watched(10, 10, false));
  lost.find_baud();
  EXPECT_EQ(lost.count(Reason::kWatchdogOn), 0);
  EXPECT_EQ(lost.slave_diag(), (Bytes{0x02, 0x04, 0, 2, 0x0C, 0xC9}));
}

TEST_F(ByUser, WrongVerdictInTheSearchLeavesNoWatchdogWaiting) {
  SlaveBench lost(quick_loss());
  lose_the_rate(lost, watched(10, 10));
  lost.verdict(false, std::nullopt);
  lost.find_baud();
  EXPECT_EQ(lost.count(Reason::kWatchdogOn), 0);
  EXPECT_EQ(lost.slave_diag(), (Bytes{0x42, 0x05, 0, 255, 0x0C, 0xC9}));
}

TEST_F(ByUser, WaitingWatchdogEndsWithANewInitialisation) {
  SlaveBench lost(quick_loss());
  accept_in_the_search(lost, watched(2, 1));
  ASSERT_TRUE(lost.initialise(judged_by(0, 0)));
  lost.find_baud();
  EXPECT_EQ(lost.count(Reason::kWatchdogOn), 0);
  ASSERT_TRUE(lost.set_prm(with_user({})).short_acknowledge());
  lost.run_ms(4);
  EXPECT_EQ(lost.count(Reason::kWatchdogExpired), 0);
  EXPECT_EQ(lost.dp_state(), DpState::kWaitCfg);
}

/// The user holds the DPRAM with a right verdict in it.
void hold_a_verdict(SlaveBench& bench) {
  bench.acquire();
  bench.write(regs::kUserStatus1, 0);
  bench.write(regs::kUserCommand1, regs::kUserCommand1PrmVerdict);
  bench.run_for(100 * kCycleTicks - bench.now() % kCycleTicks);  // the next access is overdue
}

/// From the release of a hold that is longer than T to the commit of its verdict, in cycles.
Cycle release_to_commit() {
  SlaveBench bench(quick_loss());
  lose_the_rate(bench, watched(3, 1));
  hold_a_verdict(bench);
  const Tick released = bench.now();
  bench.chip_accesses();
  return (bench.last(Reason::kPrmAccepted).at - released) / kCycleTicks;
}

/// The verdict takes effect in this cycle.
void plan_verdict(SlaveBench& bench, Script& script, Cycle commit) {
  const Tick release = (commit - release_to_commit()) * kCycleTicks;
  script.set(release, Pin::kRSta, 0);
  script.set(release, Pin::kRReq, 0);
  ASSERT_GT(release, bench.now());
}

TEST_F(ByUser, WatchdogOfAVerdictAroundTheCycleOfTheRateStartsWithTheLaterOfThem) {
  for (const Cycle later : {-1, 0, 1}) {
    SlaveBench lost(quick_loss());
    lose_the_rate(lost, watched(3, 1));
    hold_a_verdict(lost);
    const Cycle found = lost.now() / kCycleTicks + 3000;
    Script script(lost);
    plan_verdict(lost, script, found + later);
    send_decided_at(lost, found, 0, bus::make_telegram(100, 2, kFdlStatus));
    lost.run_cycles(300);
    ASSERT_EQ(lost.last(Reason::kBaudFound).at, found * kCycleTicks);
    ASSERT_EQ(lost.last(Reason::kPrmAccepted).at, (found + later) * kCycleTicks);
    const Tick begin = std::max(found, found + later) * kCycleTicks;
    EXPECT_EQ(lost.last(Reason::kWatchdogOn).at, begin) << later;
    expect_expiry_at(lost, after_ms(begin, 3), DpState::kWaitCfg);
  }
}

TEST_F(ByUser, VerdictInTheCycleInWhichBaudControlEndsComesFirst) {
  for (const Cycle later : {0, 1}) {
    SlaveBench lost(quick_loss());
    lost.to_wait_prm(judged_by(2, 0));
    ASSERT_TRUE(lost.set_prm(watched(3, 1)).short_acknowledge());
    const Cycle end = lost.last(Reason::kPrmJudged).at / kCycleTicks + 5 * kMs;
    lost.run_ms(4);
    hold_a_verdict(lost);
    Script script(lost);
    plan_verdict(lost, script, end + later);
    run_to_cycle(lost, end + 300);
    ASSERT_EQ(lost.last(Reason::kPrmAccepted).at, (end + later) * kCycleTicks);
    EXPECT_EQ(lost.count(Reason::kBaudLost), later == 0 ? 0 : 1);
    EXPECT_EQ(lost.count(Reason::kWatchdogOn), later == 0 ? 1 : 0);
    if (later == 0) expect_expiry_at(lost, after_ms(end * kCycleTicks, 3), DpState::kWaitCfg);
  }
}

TEST_F(ByUser, RefusedSetPrmLeavesNothingOfItsGroup) {
  Prm first = with_user({}), second = with_user({});
  first.group = 0x01;
  second.group = 0x02;
  const auto take = [this](const Prm& prm, bool right) {
    ASSERT_TRUE(is_sc(ask(bench, bus::sap::kSetPrm, prm.bytes())));
    bench.chip_accesses(3);
    bench.verdict(right, std::nullopt);
  };
  bench.to_wait_prm(judged_by(2, 0));
  take(first, true);
  ASSERT_TRUE(is_sc(ask(bench, bus::sap::kChkCfg, {0x11, 0x21})));
  take(second, false);
  take(first, true);
  ASSERT_TRUE(is_sc(ask(bench, bus::sap::kChkCfg, {0x11, 0x21})));
  bench.global_control(0x02, 0x02);
  EXPECT_EQ(bench.count(Reason::kGlobalControl), 0);
  bench.global_control(0x02, 0x01);
  EXPECT_EQ(bench.count(Reason::kGlobalControl), 1);
}

TEST_F(ByUser, CheckCfgInDataExchangeNeedsNoVerdict) {
  wait_for_cfg_verdict();
  bench.verdict(std::nullopt, true);
  ASSERT_TRUE(bench.check_cfg({0x11, 0x21}).short_acknowledge());
  EXPECT_EQ(bench.dp_state(), DpState::kDataExch) << "S16: the configuration in use";
  ASSERT_TRUE(bench.check_cfg({0x11, 0x20}).short_acknowledge());
  EXPECT_EQ(bench.dp_state(), DpState::kWaitPrm);
  EXPECT_TRUE(diagnosis(bench).cfg_fault);
}

TEST_F(ByUser, WhatTheUserMayNotJudgeIsACfgFault) {
  // incomplete; 256 and 245 bytes
  for (const Bytes& cfg : {Bytes{0x11, 0x40}, Bytes{0x40, 0xFF, 0x40, 0xFF}, Bytes{0x40, 0x7F, 0x40, 0x79, 0x10}}) {
    SlaveBench fresh;
    fresh.to_wait_cfg(judged_by(0, 2));
    fresh.chip_accesses(3);
    fresh.run_cycles(200);
    ASSERT_TRUE(fresh.check_cfg(cfg).short_acknowledge());
    fresh.chip_accesses(3);
    EXPECT_EQ(pulses(fresh), 1) << "only that of Set_Prm";
    expect_refused(fresh, false);
  }
}

TEST_F(ByUser, UserModeDoesNotLookAtB02AOrB02C) {
  Init init = judged_by(2, 2);
  init.max_prm = 0;
  init.max_cfg = 2;
  bench.to_wait_prm(init);
  ASSERT_TRUE(bench.set_prm(with_user(Bytes(20, 0))).short_acknowledge());
  bench.chip_accesses(3);
  EXPECT_EQ(bench.peek(regs::kPrmLength), 20);
  bench.verdict(true, std::nullopt);
  ASSERT_TRUE(bench.check_cfg({0x11, 0x21, 0x00, 0x00}).short_acknowledge());
  bench.chip_accesses(3);
  EXPECT_EQ(bench.peek(regs::kCfgLength), 4);
  bench.verdict(std::nullopt, true);
  EXPECT_EQ(bench.dp_state(), DpState::kDataExch);
}

TEST_F(ByUser, UnlockEndsTheJudging) {
  wait_for_prm_verdict();
  Prm unlock;
  unlock.status = 0x40;
  ASSERT_TRUE(bench.set_prm(unlock).short_acknowledge());
  bench.chip_accesses(3);
  bench.verdict(true, std::nullopt);
  EXPECT_EQ(bench.count(Reason::kVerdictUnexpected), 1);
  EXPECT_EQ(bench.dp_state(), DpState::kWaitPrm);
  EXPECT_TRUE(diagnosis(bench).prm_req);
}

// H7. A check reports it: VERDICT_UNFETCHED.
TEST_F(ByUser, AVerdictOnABlockThatTheUserHasNotFetchedIsTakenLikeAnyOther) {
  wait_for_prm_verdict();
  ASSERT_EQ(bench.peek(regs::kChipCommand1) & 0x02, 0x02);
  bench.verdict(true, std::nullopt);
  EXPECT_EQ(bench.dp_state(), DpState::kWaitCfg);
  EXPECT_EQ(bench.peek(regs::kChipCommand1) & 0x02, 0x02) << "B00E.1 is the user's to clear";
  ASSERT_TRUE(bench.check_cfg().short_acknowledge());
  bench.chip_accesses(3);
  ASSERT_EQ(bench.peek(regs::kChipCommand1) & 0x04, 0x04);
  bench.verdict(std::nullopt, false);
  expect_refused(bench, false);
  EXPECT_EQ(bench.peek(regs::kChipCommand1) & 0x04, 0x04);
}

}  // namespace
}  // namespace dsdpv1::conformance
