// Set_Prm judged by the chip: table 20, every fault of S6 with its reason, what lasts and what falls (S6, S11, S14,
// S15, S17, S28).
#include <gtest/gtest.h>

#include "tests/conformance/master_side.hpp"

namespace dsdpv1::conformance {
namespace {

constexpr std::uint8_t kPrmFault = 0x40, kNotSupported = 0x10;

class SetPrm : public testing::Test {
 protected:
  Exchange prm(const Prm& prm, std::uint8_t master = 2) { return ask(bench, 61, prm.bytes(), master); }
  std::uint8_t faults() { return static_cast<std::uint8_t>(diag(bench, 9).at(0) & (kPrmFault | kNotSupported)); }

  SlaveBench bench{quick_search()};
};

struct Fault {
  const char* name;
  Prm prm;
  Reason reason;
  std::uint8_t bits;
};

Prm with(std::uint8_t status, const Bytes& user = {}, std::uint16_t ident = 0x0CC9, std::uint8_t wd1 = 1,
         std::uint8_t wd2 = 1) {
  Prm prm;
  prm.status = status;
  prm.user = user;
  prm.ident = ident;
  prm.wd1 = wd1;
  prm.wd2 = wd2;
  return prm;
}

std::vector<Fault> faults_of_a_plain_slave() {
  return {
      {"ident high", with(0x80, {}, 0x0DC9), Reason::kPrmIdent, kPrmFault},
      {"ident low", with(0x80, {}, 0x0CC8), Reason::kPrmIdent, kPrmFault},
      {"Sync_Req", with(0xA0), Reason::kPrmSync, kPrmFault | kNotSupported},
      {"Freeze_Req", with(0x90), Reason::kPrmFreeze, kPrmFault | kNotSupported},
      {"Fail_Safe", with(0x80, {0x40}), Reason::kPrmFailSafe, kPrmFault | kNotSupported},
      {"DPV1_Enable", with(0x80, {0x80, 0, 0}), Reason::kPrmDpv1, kPrmFault | kNotSupported},
      {"WD_Fact_1", with(0x88, {}, 0x0CC9, 0, 1), Reason::kPrmWatchdog, kPrmFault},
      {"WD_Fact_2", with(0x88, {}, 0x0CC9, 1, 0), Reason::kPrmWatchdog, kPrmFault},
      {"user length", with(0x80, {0, 0, 0, 0, 0}), Reason::kPrmUserLength, kPrmFault},
  };
}

Init plain() {
  Init init;
  init.command = 0x00;
  init.max_prm = 4;
  return init;
}

TEST_F(SetPrm, FaultIsAnsweredScAndShownInTheDiagnosis) {
  bench.to_wait_prm(plain());
  for (const Fault& fault : faults_of_a_plain_slave()) {
    SCOPED_TRACE(fault.name);
    const int before = bench.count(fault.reason);
    EXPECT_TRUE(is_sc(prm(fault.prm)));
    EXPECT_EQ(bench.count(fault.reason), before + 1);
    EXPECT_EQ(faults(), fault.bits);
    EXPECT_EQ(bench.dp_state(), DpState::kWaitPrm);
    EXPECT_EQ(bench.chip.status().master, 255);
    EXPECT_TRUE(is_sc(prm(with(0x80))));  // the next good one
    EXPECT_EQ(faults(), 0);
    EXPECT_EQ(bench.dp_state(), DpState::kWaitCfg);
  }
}

TEST_F(SetPrm, FirstFaultInTheOrderOfTheBytesCheckedIsTheReason) {
  bench.to_wait_prm(plain());
  Prm every = with(0xB8, {0xC0, 0, 0, 0, 0, 0}, 0xFFFF, 0, 0);
  const auto expect = [&](Reason reason) {
    const std::size_t before = bench.chip.events().size();
    EXPECT_TRUE(is_sc(prm(every)));
    ASSERT_GT(bench.chip.events().size(), before);
    EXPECT_STREQ(profibus::code(bench.chip.events()[before].reason), profibus::code(reason));
    for (std::size_t i = before + 1; i < bench.chip.events().size(); ++i)
      EXPECT_NE(severity(bench.chip.events()[i].reason), profibus::Severity::kRefusal) << "one reason a refusal";
  };
  expect(Reason::kPrmIdent);
  every.ident = 0x0CC9;
  expect(Reason::kPrmSync);
  every.status = 0x98;
  expect(Reason::kPrmFreeze);
  every.status = 0x88;
  expect(Reason::kPrmFailSafe);
  every.user[0] = 0x80;
  expect(Reason::kPrmDpv1);
  every.user[0] = 0x00;
  expect(Reason::kPrmWatchdog);
  every.wd1 = every.wd2 = 1;
  expect(Reason::kPrmUserLength);
}

TEST_F(SetPrm, FaultInDataExchangeLeavesItAndReleasesTheMaster) {
  for (const Fault& fault : faults_of_a_plain_slave()) {
    SCOPED_TRACE(fault.name);
    SlaveBench one(quick_search());
    one.to_data_exch(plain());
    ASSERT_TRUE(is_data(ask(one, kNoSap, {7, 7})));
    EXPECT_TRUE(is_sc(ask(one, 61, fault.prm.bytes())));
    EXPECT_EQ(one.dp_state(), DpState::kWaitPrm);
    EXPECT_EQ(one.chip.status().master, 255);
    settle(one);
    EXPECT_EQ(output_area(one), (Bytes{0, 0}));
    EXPECT_EQ(offline_count(one), 1);
    EXPECT_TRUE(is_sc(ask(one, 61, with(0x80).bytes(), 3)));  // free for another master
    EXPECT_EQ(one.chip.status().master, 3);
  }
}

TEST_F(SetPrm, FaultInWaitCfgGoesBackToWaitPrm) {
  bench.to_wait_cfg(plain());
  EXPECT_TRUE(is_sc(prm(with(0x80, {}, 0x1234))));
  EXPECT_EQ(bench.dp_state(), DpState::kWaitPrm);
  EXPECT_EQ(offline_count(bench), 0);
}

TEST_F(SetPrm, ShorterThanSevenBytesIsAFault) {
  bench.to_wait_prm();
  const Bytes good = Prm{}.bytes();
  for (std::size_t length = 0; length < 7; ++length) {
    const int before = bench.count(Reason::kPrmShort);
    EXPECT_TRUE(is_sc(ask(bench, 61, Bytes(good.begin(), good.begin() + static_cast<std::ptrdiff_t>(length)))))
        << length;
    EXPECT_EQ(bench.count(Reason::kPrmShort), before + 1) << length;
    EXPECT_EQ(faults(), kPrmFault) << length;
    EXPECT_EQ(bench.dp_state(), DpState::kWaitPrm);
  }
}

TEST_F(SetPrm, WhatTheInitialisationSupportsIsAccepted) {
  for (const auto& [command, prm_bytes] : {std::pair<int, Bytes>{0x04, with(0xA0).bytes()},
                                           {0x02, with(0x90).bytes()},
                                           {0x08, with(0x80, {0x40}).bytes()}}) {
    SlaveBench one(quick_search());
    Init init;
    init.command = static_cast<std::uint8_t>(command);
    one.to_wait_prm(init);
    EXPECT_TRUE(is_sc(ask(one, 61, prm_bytes)));
    EXPECT_EQ(one.dp_state(), DpState::kWaitCfg) << command;
  }
}

// S6: "supported" leaves the choice to the master; what it chose decides on its first Clear (S19).
TEST_F(SetPrm, FailSafeIsTheMastersChoiceWhereItIsSupported) {
  struct Case {
    const char* what;
    std::uint8_t command;
    Bytes user;
    bool accepted, clears;
  };
  for (const Case& each :
       {Case{"neither", 0x00, {0x00}, true, false}, Case{"only the master", 0x00, {0x40}, false, false},
        Case{"only the slave", 0x08, {0x00}, true, false}, Case{"only the slave, 7 bytes", 0x08, {}, true, false},
        Case{"both", 0x08, {0x40}, true, true}}) {
    SCOPED_TRACE(each.what);
    SlaveBench one(quick_search());
    Init init;
    init.command = each.command;
    one.to_wait_prm(init);
    EXPECT_TRUE(is_sc(ask(one, 61, with(0x80, each.user).bytes())));
    EXPECT_EQ(diag(one).at(0) & (kPrmFault | kNotSupported), each.accepted ? 0 : kPrmFault | kNotSupported);
    ASSERT_EQ(one.dp_state(), each.accepted ? DpState::kWaitCfg : DpState::kWaitPrm);
    EXPECT_EQ(one.count(Reason::kPrmFailSafe), each.accepted ? 0 : 1);
    if (!each.accepted) continue;
    ASSERT_TRUE(is_sc(ask(one, 62, {0x11, 0x21})));
    EXPECT_EQ(kind_of(ask(one, kNoSap, {})), each.clears ? "DL" : "RR");
    EXPECT_EQ(one.count(Reason::kFailSafeClear), each.clears ? 1 : 0);
    EXPECT_EQ(one.dp_state(), each.clears ? DpState::kDataExch : DpState::kWaitPrm);
    EXPECT_EQ(diag(one).at(0) & 0x04, each.clears ? 0x00 : 0x04) << "Cfg_Fault";
  }
}

TEST_F(SetPrm, FailSafeOfTheMasterIsSeenByAUserThatJudges) {
  Init init;
  init.prm_mode = 2;
  bench.to_wait_prm(init);
  EXPECT_TRUE(is_sc(prm(with(0x80, {0x40}))));
  settle(bench);
  EXPECT_EQ(bench.peek(0x410, 2), (Bytes{1, 0x40}));
}

TEST_F(SetPrm, WithDpv1NeedsB005AndTenBytes) {
  bench.power_on();
  bench.enable_dpv1(true);
  ASSERT_TRUE(bench.initialise());
  bench.find_baud(0);
  EXPECT_TRUE(is_sc(prm(with(0x80, {0x80}))));
  EXPECT_EQ(faults(), kPrmFault);
  EXPECT_EQ(bench.count(Reason::kPrmShort), 1);
  EXPECT_TRUE(is_sc(prm(with(0x80, {0x80, 0}))));
  EXPECT_EQ(bench.count(Reason::kPrmShort), 2);
  for (const Bytes& user : {Bytes{0x80, 0, 0}, Bytes{0x80, 0xFF, 0xFF}}) {  // DPV1_Status_2 and 3 are reserved
    EXPECT_TRUE(is_sc(prm(with(0x80, user))));
    EXPECT_EQ(bench.dp_state(), DpState::kWaitCfg);
    EXPECT_EQ(faults(), 0);
  }
}

TEST_F(SetPrm, WatchdogFactorsDoNotMatterWithoutWdOn) {
  bench.to_wait_prm();
  EXPECT_TRUE(is_sc(prm(with(0x80, {}, 0x0CC9, 0, 0))));
  EXPECT_EQ(bench.dp_state(), DpState::kWaitCfg);
}

TEST_F(SetPrm, UserLengthInModeZeroIsAtMostB02A) {
  Init init;
  init.max_prm = 5;
  bench.to_wait_prm(init);
  for (const std::size_t length : {0U, 1U, 5U}) {
    EXPECT_TRUE(is_sc(prm(with(0x80, Bytes(length, 0)))));
    EXPECT_EQ(bench.dp_state(), DpState::kWaitCfg) << length;
  }
  for (const std::size_t length : {6U, 100U, 237U}) {
    EXPECT_TRUE(is_sc(prm(with(0x80, Bytes(length, 0)))));
    EXPECT_EQ(bench.dp_state(), DpState::kWaitPrm) << length;
    EXPECT_EQ(faults(), kPrmFault);
  }
}

TEST_F(SetPrm, UserLengthInModeOneIsExactlyB02A) {
  Init init;
  init.max_prm = 5;
  init.prm_mode = 1;
  bench.to_wait_prm(init);
  for (const std::size_t length : {0U, 4U, 6U, 237U, 5U}) {
    EXPECT_TRUE(is_sc(prm(with(0x80, Bytes(length, 0)))));
    EXPECT_EQ(bench.dp_state(), length == 5 ? DpState::kWaitCfg : DpState::kWaitPrm) << length;
  }
}

TEST_F(SetPrm, TakesTheLongestUserParametersToTheUser) {
  bench.to_wait_prm();
  Bytes user;
  for (int i = 0; i < 237; ++i) user.push_back(static_cast<std::uint8_t>(i == 0 ? 0 : i * 3));
  EXPECT_TRUE(is_sc(prm(with(0x80, user))));
  settle(bench);
  EXPECT_EQ(bench.peek(0x00E) & 0x02, 0x02);
  EXPECT_EQ(bench.peek(0x410), 237);
  EXPECT_EQ(bench.peek(0x411, 237), user);
}

// --- table 20

TEST_F(SetPrm, WithoutLockAndUnlockChangesOnlyMinTsdr) {
  for (const auto before : {DpState::kWaitPrm, DpState::kWaitCfg, DpState::kDataExch}) {
    SlaveBench one(quick_search());
    if (before == DpState::kWaitPrm) one.to_wait_prm();
    if (before == DpState::kWaitCfg) one.to_wait_cfg();
    if (before == DpState::kDataExch) one.to_data_exch();
    const auto master = one.chip.status().master;
    Prm only = with(0x38, Bytes(200, 0xFF), 0xFFFF, 0, 0);  // S28: ident, flags and length are not checked
    only.min_tsdr = 44;
    EXPECT_TRUE(is_sc(ask(one, 61, only.bytes())));
    EXPECT_EQ(one.dp_state(), before);
    EXPECT_EQ(one.chip.status().master, master);
    EXPECT_EQ(one.count(Reason::kPrmMinTsdr), 1);
    EXPECT_EQ(diag(one).at(0) & (kPrmFault | kNotSupported), 0);
    EXPECT_EQ(static_cast<int>(one.fdl_status().tsdr_bits()), 44);
    settle(one);
    EXPECT_EQ(offline_count(one), 0);
  }
}

TEST_F(SetPrm, WithoutLockFromAnotherThanTheHolderIsRefused) {
  bench.to_data_exch();
  Prm only = with(0x00);
  only.min_tsdr = 44;
  EXPECT_TRUE(is_rs(prm(only, 3)));
  EXPECT_EQ(static_cast<int>(bench.fdl_status().tsdr_bits()), 11);
}

TEST_F(SetPrm, WithUnlockReleasesTheSlaveAndIsNoFault) {
  for (const int status : {0x40, 0xC0}) {
    SlaveBench one(quick_search());
    one.to_data_exch();
    ASSERT_TRUE(is_data(ask(one, kNoSap, {3, 3})));
    EXPECT_TRUE(is_sc(ask(one, 61, with(static_cast<std::uint8_t>(status)).bytes())));
    EXPECT_EQ(one.dp_state(), DpState::kWaitPrm);
    EXPECT_EQ(one.chip.status().master, 255);
    EXPECT_EQ(one.count(Reason::kPrmUnlock), 1);
    settle(one);
    EXPECT_EQ(output_area(one), (Bytes{0, 0}));
    EXPECT_EQ(offline_count(one), 1);
    const Bytes bits = diag(one);
    EXPECT_EQ(bits.at(0), 0x02);
    EXPECT_EQ(bits.at(1), 0x05);
    EXPECT_EQ(bits.at(3), 0xFF);
    EXPECT_TRUE(is_sc(ask(one, 61, with(0x80).bytes(), 3)));
    EXPECT_EQ(one.chip.status().master, 3);
  }
}

TEST_F(SetPrm, WithUnlockFromAnotherThanTheHolderIsRefused) {
  bench.to_data_exch();
  EXPECT_TRUE(is_rs(prm(with(0x40), 3)));
  EXPECT_EQ(bench.dp_state(), DpState::kDataExch);
}

TEST_F(SetPrm, WithLockHoldsTheSlave) {
  bench.to_wait_prm();
  EXPECT_TRUE(is_sc(prm(with(0x80), 3)));
  EXPECT_EQ(bench.chip.status().master, 3);
  EXPECT_TRUE(is_rs(prm(with(0x80), 2)));
  EXPECT_EQ(diag(bench).at(3), 3);
}

// --- good ones in operation

TEST_F(SetPrm, GoodOneInDataExchangeGoesToWaitCfg) {
  bench.to_data_exch();
  ASSERT_TRUE(is_data(ask(bench, kNoSap, {3, 3})));
  EXPECT_TRUE(is_sc(prm(with(0x80))));
  EXPECT_EQ(bench.dp_state(), DpState::kWaitCfg);
  EXPECT_EQ(bench.chip.status().master, 2);
  settle(bench);
  EXPECT_EQ(output_area(bench), (Bytes{0, 0}));
  EXPECT_EQ(bench.peek(0x00E) & 0x01, 0x01);
  EXPECT_EQ(offline_count(bench), 1);
  EXPECT_TRUE(is_sc(bench.check_cfg()));
  EXPECT_EQ(bench.dp_state(), DpState::kDataExch);
}

TEST_F(SetPrm, GoodOneInWaitCfgStaysThere) {
  bench.to_wait_cfg();
  EXPECT_TRUE(is_sc(prm(with(0x80))));
  EXPECT_EQ(bench.dp_state(), DpState::kWaitCfg);
  EXPECT_EQ(offline_count(bench), 0);
}

TEST_F(SetPrm, ReservedBitsAreNotLookedAt) {
  bench.to_wait_prm();
  for (int bit = 0; bit < 3; ++bit) {
    EXPECT_TRUE(is_sc(prm(with(static_cast<std::uint8_t>(0x80 | 1 << bit)))));
    EXPECT_EQ(faults(), 0) << "byte 0 bit " << bit;
  }
  for (const unsigned spec : {0x01U, 0x02U, 0x08U, 0x10U, 0x20U}) {
    EXPECT_TRUE(is_sc(prm(with(0x80, {static_cast<std::uint8_t>(spec), 0xFF, 0xFF}))));
    EXPECT_EQ(faults(), 0) << "byte 7 = " << spec;
  }
  EXPECT_EQ(bench.dp_state(), DpState::kWaitCfg);
}

TEST_F(SetPrm, CountsEveryLeavingOfDataExchange) {
  bench.to_data_exch();
  for (int i = 1; i <= 260; ++i) {
    ASSERT_TRUE(is_sc(prm(with(0x80))));
    ASSERT_TRUE(is_sc(bench.check_cfg()));
    settle(bench);
    ASSERT_EQ(offline_count(bench), i);
  }
}

// S28: an Unlock, with or without Lock, is for this slave only when the ident number is its own.
TEST_F(SetPrm, UnlockWithAWrongIdentIsPrmFault) {
  for (const int status : {0x40, 0xC0}) {
    for (const int ident : {0x0DC9, 0x0CC8, 0x0CC9}) {
      SlaveBench one(quick_search());
      one.to_data_exch();
      Prm unlock;
      unlock.status = static_cast<std::uint8_t>(status);
      unlock.ident = static_cast<std::uint16_t>(ident);
      EXPECT_TRUE(is_sc(ask(one, 61, unlock.bytes())));
      const bool right = ident == 0x0CC9;
      EXPECT_EQ(one.count(Reason::kPrmUnlock), right ? 1 : 0) << status << " " << ident;
      EXPECT_EQ(one.count(Reason::kPrmIdent), right ? 0 : 1) << status << " " << ident;
      EXPECT_EQ(one.dp_state(), DpState::kWaitPrm);
      EXPECT_EQ(diag(one).at(0), right ? 0x02 : 0x42) << "Prm_Fault";
      EXPECT_EQ(diag(one).at(3), 255);
    }
  }
}

TEST_F(SetPrm, UnlockLeavesTheFaultsAndMinTsdr) {
  bench.to_wait_prm();
  Prm wrong, unlock;
  wrong.ident = 1;
  unlock.status = 0x40;
  unlock.min_tsdr = 60;
  EXPECT_TRUE(is_sc(ask(bench, 61, wrong.bytes())));
  EXPECT_TRUE(is_sc(ask(bench, 61, unlock.bytes())));
  EXPECT_EQ(diag(bench).at(0), 0x42) << "S17: no good Set_Prm";
  const Exchange exchange = ask(bench, 60);
  EXPECT_LT(exchange.tsdr(), 12 * exchange.bit) << "11 bit times still";
}

}  // namespace
}  // namespace dsdpv1::conformance
