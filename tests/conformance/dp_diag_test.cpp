// Slave_Diag: the six standard bytes in every situation, the user's diagnosis of three kinds, high priority (D9, D14,
// S7, S23).
#include <gtest/gtest.h>

#include "tests/conformance/master_side.hpp"
#include "tests/conformance/user_helpers.hpp"

namespace dsdpv1::conformance {
namespace {

class Diagnosis : public testing::Test {
 protected:
  void expect(int status1, int status2, int master, const char* what) {
    EXPECT_EQ(diag(bench, 9), (Bytes{static_cast<std::uint8_t>(status1), static_cast<std::uint8_t>(status2), 0,
                                     static_cast<std::uint8_t>(master), 0x0C, 0xC9}))
        << what;
  }
  /// "DL" or "DH".
  std::string priority() { return kind_of(ask(bench, kNoSap, {1, 2})); }

  SlaveBench bench{quick_search()};
};

// --- the standard bytes

TEST_F(Diagnosis, StandardBytesFollowTheStates) {
  bench.to_wait_prm();
  expect(0x02, 0x05, 255, "WAIT_PRM: not ready, Prm_Req");
  ask(bench, 61, Prm{}.bytes());
  expect(0x02, 0x04, 2, "WAIT_CFG: not ready");
  ask(bench, 62, {0x11, 0x21});
  expect(0x00, 0x04, 2, "DATA_EXCH");
  ask(bench, 62, {0x40});
  expect(0x06, 0x05, 255, "Cfg_Fault, WAIT_PRM");
  Prm prm;
  prm.ident = 1;
  ask(bench, 61, prm.bytes());
  expect(0x46, 0x05, 255, "Prm_Fault and Cfg_Fault");
  ask(bench, 61, Prm{}.bytes());
  expect(0x06, 0x04, 2, "Prm_Fault fell, Cfg_Fault stays");
  ask(bench, 62, {0x11, 0x21});
  expect(0x00, 0x04, 2, "DATA_EXCH again");
}

TEST_F(Diagnosis, NotSupportedStandsBesidePrmFault) {
  Init init;
  init.command = 0;
  bench.to_wait_prm(init);
  Prm prm;
  prm.status = 0xA0;
  ask(bench, 61, prm.bytes());
  expect(0x52, 0x05, 255, "Sync_Req");
  ask(bench, 61, Prm{}.bytes());
  expect(0x02, 0x04, 2, "fell");
}

TEST_F(Diagnosis, FaultsStayForAnUnlockAndAMinTsdr) {
  bench.to_wait_prm();
  Prm prm;
  prm.ident = 1;
  ask(bench, 61, prm.bytes());
  prm.status = 0;
  ask(bench, 61, prm.bytes());
  expect(0x42, 0x05, 255, "only min_TSDR: no good parameters");
}

TEST_F(Diagnosis, ShowsWatchdogFreezeAndSync) {
  Prm prm;
  prm.status = 0xB8;
  prm.wd1 = 100;
  prm.wd2 = 100;
  bench.to_data_exch({}, prm);
  expect(0x00, 0x0C, 2, "watchdog");
  tell(bench, 127, 58, {0x20, 0});
  expect(0x00, 0x2C, 2, "sync");
  tell(bench, 127, 58, {0x08, 0});
  expect(0x00, 0x3C, 2, "sync and freeze");
  tell(bench, 127, 58, {0x10, 0});
  expect(0x00, 0x1C, 2, "freeze");
  tell(bench, 127, 58, {0x04, 0});
  expect(0x00, 0x0C, 2, "neither");
}

TEST_F(Diagnosis, ShowsTheIdentAndTheMasterThatHolds) {
  Init init;
  init.ident = 0xBEEF;
  bench.to_wait_prm(init);
  Prm prm;
  prm.ident = 0xBEEF;
  ask(bench, 61, prm.bytes(), 125);
  EXPECT_EQ(diag(bench), (Bytes{0x02, 0x04, 0, 125, 0xBE, 0xEF}));
}

TEST_F(Diagnosis, ShowsNotReadyWhileTheUserJudges) {
  Init init;
  init.prm_mode = 2;
  init.cfg_mode = 2;
  bench.to_wait_prm(init);
  ask(bench, 61, Prm{}.bytes());
  EXPECT_EQ(bench.dp_state(), DpState::kWaitPrm);
  EXPECT_EQ(diag(bench, 9).at(0), 0x02);
  EXPECT_EQ(diag(bench, 9).at(1), 0x04) << "S15: no Prm_Req while the user judges";
  settle(bench);
  bench.verdict(true, std::nullopt);
  EXPECT_EQ(bench.dp_state(), DpState::kWaitCfg);
  ask(bench, 62, {0x11, 0x21});
  EXPECT_EQ(diag(bench, 9).at(0), 0x02);
  settle(bench);
  bench.verdict(std::nullopt, true);
  expect(0x00, 0x04, 2, "DATA_EXCH");
}

// --- the user's diagnosis

TEST_F(Diagnosis, ExtendedIsLowPriorityAndSetsNoBit) {
  bench.to_data_exch();
  bench.give_diag(0x00, {0x03, 0xAA, 0xBB});
  EXPECT_EQ(priority(), "DL");
  EXPECT_EQ(diag(bench), (Bytes{0x00, 0x04, 0, 2, 0x0C, 0xC9, 0x03, 0xAA, 0xBB}));
}

// D9. Until an audit type 00 left Ext_Diag, too.
TEST_F(Diagnosis, ExtendedEndsExternalAndLeavesStatic) {
  bench.to_data_exch();
  bench.give_diag(0x81, {1});
  bench.give_diag(0x82, {2});
  bench.give_diag(0x00, {3});
  EXPECT_EQ(diag(bench), (Bytes{0x00, 0x06, 0, 2, 0x0C, 0xC9, 3}));
  EXPECT_EQ(priority(), "DH") << "static diagnosis stands";
  bench.give_diag(0x02, {4});
  EXPECT_EQ(priority(), "DH");
  diag(bench);
  EXPECT_EQ(priority(), "DL");
}

TEST_F(Diagnosis, ExtendedEndsExternalWithoutAWordToTheMaster) {
  bench.to_data_exch();
  bench.give_diag(0x81, {1});
  diag(bench);
  bench.give_diag(0x00, {});
  EXPECT_EQ(priority(), "DL") << "low priority, also when it clears the bit";
  EXPECT_EQ(diag(bench), (Bytes{0x00, 0x04, 0, 2, 0x0C, 0xC9}));
  bench.give_diag(0x81, {2});
  EXPECT_EQ(priority(), "DH");
  EXPECT_EQ(diag(bench), (Bytes{0x08, 0x04, 0, 2, 0x0C, 0xC9, 2}));
}

TEST_F(Diagnosis, ExtendedLeavesWhatTheHolderHasNotRead) {
  bench.to_data_exch();
  bench.give_diag(0x81, {1});
  bench.give_diag(0x00, {3});
  EXPECT_EQ(priority(), "DH");
  EXPECT_EQ(diag(bench), (Bytes{0x00, 0x04, 0, 2, 0x0C, 0xC9, 3}));
  EXPECT_EQ(priority(), "DL");
}

TEST_F(Diagnosis, RefusedExtendedLeavesExtDiag) {
  bench.to_data_exch();
  bench.give_diag(0x81, {1});
  bench.give_diag(0x00, {2}, 0x0100);
  bench.give_diag(0x00, Bytes(33, 0));
  EXPECT_EQ(bench.count(dpram::Reason::kDiagCrc), 1);
  EXPECT_EQ(bench.count(Reason::kDiagLength), 1);
  EXPECT_EQ(diag(bench), (Bytes{0x08, 0x04, 0, 2, 0x0C, 0xC9, 1}));
}

// The commit comes before the decision of the same cycle.
TEST_F(Diagnosis, ExtendedIsSeenByTheReadThatIsDecidedInItsCycle) {
  const auto held = [](SlaveBench& one) {
    one.to_data_exch();
    one.give_diag(0x81, {1});
    one.run_cycles(200);
    one.acquire();
    one.write_block(dsdpv1::regs::kDiag, {0x00, 1, 3}, dsdpv1::regs::kDiagCrc);
    one.write(dsdpv1::regs::kUserCommand1, dsdpv1::regs::kUserCommand1Diag);
    one.run_for(100 * kCycleTicks - one.now() % kCycleTicks);  // the next access is overdue
  };
  SlaveBench dry(quick_search());
  held(dry);
  const Tick released = dry.now();
  dry.chip_accesses();
  const profibus::Cycle to_commit = (dry.last(Reason::kDiagAccepted).at - released) / kCycleTicks;
  for (const int later : {-1, 0, 1}) {
    SlaveBench one(quick_search());
    held(one);
    const profibus::Cycle decision = one.now() / kCycleTicks + 3000;
    Script script(one);
    const Tick release = (decision + later - to_commit) * kCycleTicks;
    script.set(release, Pin::kRSta, 0);
    script.set(release, Pin::kRReq, 0);
    const Exchange exchange = send_decided_at(one, decision, 0, bus::make_telegram(5, 2, kSrdFirst, {}, 60, 62), true);
    ASSERT_EQ(one.last(Reason::kDiagAccepted).at, (decision + later) * kCycleTicks);
    ASSERT_TRUE(is_data(exchange));
    EXPECT_EQ(exchange.answer().data.at(0), later > 0 ? 0x08 : 0x00) << later;
  }
}

TEST_F(Diagnosis, WaitsVisiblyAlsoWithoutInputs) {
  Init init;
  init.cfg = {0x21};
  bench.to_data_exch(init);
  EXPECT_EQ(kind_of(ask(bench, kNoSap, {1, 2})), "SC");
  bench.give_diag(0x81, {7});
  EXPECT_TRUE(is_refusal(ask(bench, kNoSap, {1, 2}), bus::fc::kDh)) << "SD1 with FC 0A (S19)";
  diag(bench);
  EXPECT_EQ(kind_of(ask(bench, kNoSap, {1, 2})), "SC");
}

TEST_F(Diagnosis, ExternalSetsAndClearsExtDiagWithHighPriorityUntilRead) {
  bench.to_data_exch();
  bench.give_diag(0x81, {0x02, 0x77});
  EXPECT_EQ(priority(), "DH");
  EXPECT_EQ(priority(), "DH");
  EXPECT_EQ(diag(bench), (Bytes{0x08, 0x04, 0, 2, 0x0C, 0xC9, 0x02, 0x77}));
  EXPECT_EQ(priority(), "DL");
  bench.give_diag(0x01, {});
  EXPECT_EQ(priority(), "DH");
  EXPECT_EQ(diag(bench), (Bytes{0x00, 0x04, 0, 2, 0x0C, 0xC9}));
  EXPECT_EQ(priority(), "DL");
}

// D9. Until an audit the first read ended the high priority of static diagnosis, too.
TEST_F(Diagnosis, StaticSetsStatDiagAndIsHighPriorityReadOrNotUntilTheUserTakesItBack) {
  bench.to_data_exch();
  bench.give_diag(0x82, {0x02, 0x77});
  EXPECT_EQ(priority(), "DH");
  EXPECT_EQ(diag(bench), (Bytes{0x00, 0x06, 0, 2, 0x0C, 0xC9, 0x02, 0x77}));
  EXPECT_EQ(priority(), "DH");
  EXPECT_EQ(diag(bench).at(1), 0x06) << "stays until the user takes it back";
  for (const std::uint8_t type : Bytes{0x00, 0x81, 0x01}) {
    bench.give_diag(type, {0x01});
    EXPECT_EQ(diag(bench).at(1), 0x06) << int{type};
    EXPECT_EQ(priority(), "DH") << int{type};
  }
  bench.give_diag(0x02, {0x01});
  EXPECT_EQ(priority(), "DH");
  EXPECT_EQ(diag(bench), (Bytes{0x00, 0x04, 0, 2, 0x0C, 0xC9, 0x01}));
  EXPECT_EQ(priority(), "DL");
}

TEST_F(Diagnosis, HighPriorityEndsWithTheReadAloneNotWithAnExtendedOneOrALostExchange) {
  bench.to_data_exch();
  bench.give_diag(0x81, {1});
  bench.give_diag(0x00, {2});
  EXPECT_EQ(priority(), "DH") << "type 00 is no read";
  ASSERT_TRUE(is_sc(ask(bench, 61, Prm{}.bytes())));
  ASSERT_TRUE(is_sc(ask(bench, 62, {0x11, 0x21})));
  EXPECT_EQ(priority(), "DH");
  diag(bench);
  EXPECT_EQ(priority(), "DL");
}

TEST_F(Diagnosis, StaticWithoutInputsStaysHighPriorityToo) {
  Init init;
  init.cfg = {0x21};
  bench.to_data_exch(init);
  bench.give_diag(0x82, {7});
  diag(bench);
  EXPECT_TRUE(is_refusal(ask(bench, kNoSap, {1, 2}), bus::fc::kDh));
  ASSERT_TRUE(bench.initialise(init));
  bench.find_baud(0);
  ASSERT_TRUE(is_sc(ask(bench, 61, Prm{}.bytes())));
  ASSERT_TRUE(is_sc(ask(bench, 62, {0x21})));
  EXPECT_EQ(kind_of(ask(bench, kNoSap, {1, 2})), "SC") << "a new initialisation ends it";
}

TEST_F(Diagnosis, ExternalAndStaticHaveBitsOfTheirOwn) {
  bench.to_data_exch();
  bench.give_diag(0x81, {1});
  bench.give_diag(0x82, {2});
  EXPECT_EQ(diag(bench), (Bytes{0x08, 0x06, 0, 2, 0x0C, 0xC9, 2}));
  bench.give_diag(0x01, {3});
  EXPECT_EQ(diag(bench), (Bytes{0x00, 0x06, 0, 2, 0x0C, 0xC9, 3}));
  bench.give_diag(0x02, {});
  EXPECT_EQ(diag(bench), (Bytes{0x00, 0x04, 0, 2, 0x0C, 0xC9}));
}

TEST_F(Diagnosis, IsReadOnlyByTheHolder) {
  bench.to_data_exch();
  bench.give_diag(0x81, {1});
  EXPECT_EQ(diag(bench, 3).size(), 7U);
  EXPECT_EQ(priority(), "DH");
  EXPECT_EQ(diag(bench, 2).size(), 7U);
  EXPECT_EQ(priority(), "DL");
}

TEST_F(Diagnosis, GivenBeforeDataExchangeWaitsForTheHolder) {
  bench.to_wait_prm();
  bench.give_diag(0x81, {9});
  EXPECT_EQ(diag(bench).size(), 7U);  // the slave has no holder
  ASSERT_TRUE(is_sc(ask(bench, 61, Prm{}.bytes())));
  ASSERT_TRUE(is_sc(ask(bench, 62, {0x11, 0x21})));
  EXPECT_EQ(priority(), "DH");
  diag(bench);
  EXPECT_EQ(priority(), "DL");
}

TEST_F(Diagnosis, ReadInWaitCfgByTheHolderCounts) {
  bench.to_wait_cfg();
  bench.give_diag(0x81, {9});
  diag(bench);
  ASSERT_TRUE(is_sc(ask(bench, 62, {0x11, 0x21})));
  EXPECT_EQ(priority(), "DL");
}

TEST_F(Diagnosis, NewerOneWhileOneWaitsReplacesItAndIsReadOnce) {
  bench.to_data_exch();
  bench.give_diag(0x81, {1});
  bench.give_diag(0x81, {2, 3});
  EXPECT_EQ(priority(), "DH");
  EXPECT_EQ(diag(bench), (Bytes{0x08, 0x04, 0, 2, 0x0C, 0xC9, 2, 3}));
  EXPECT_EQ(priority(), "DL");
}

TEST_F(Diagnosis, RepetitionOfTheReadDoesNotSwallowANewOne) {
  bench.to_data_exch();
  bench.give_diag(0x81, {1});
  const Exchange first = send_fc(bench, 0x5D, 60, 62, {});
  bench.give_diag(0x81, {2});
  const Exchange again = send_fc(bench, 0x5D, 60, 62, {});
  EXPECT_EQ(again.raw, first.raw);
  EXPECT_EQ(priority(), "DH") << "the new one has not been sent yet";
  EXPECT_EQ(diag(bench).back(), 2);
}

TEST_F(Diagnosis, HasEverySizeUpToB029) {
  Init init;
  init.max_diag = 238;
  bench.to_data_exch(init);
  for (const std::size_t size : {0U, 1U, 6U, 100U, 237U, 238U}) {
    Bytes user;
    for (std::size_t i = 0; i < size; ++i) user.push_back(static_cast<std::uint8_t>(i + size));
    bench.give_diag(0x00, user);
    Bytes expected = {0x00, 0x04, 0, 2, 0x0C, 0xC9};
    expected.insert(expected.end(), user.begin(), user.end());
    EXPECT_EQ(diag(bench), expected) << size;
    EXPECT_TRUE(is_data(ask(bench, 60))) << "FC 08, not 0A";
  }
}

TEST_F(Diagnosis, LongerThanB029IsRefusedAndTheEarlierStays) {
  for (const int largest : {0, 1, 10, 237}) {
    SlaveBench one(quick_search());
    Init init;
    init.max_diag = static_cast<std::uint8_t>(largest);
    one.to_data_exch(init);
    const Bytes good(static_cast<std::size_t>(largest), 0x5A);
    one.give_diag(0x81, good);
    const Bytes before = diag(one);
    EXPECT_EQ(before.size(), 6 + good.size());
    one.give_diag(0x82, Bytes(static_cast<std::size_t>(largest) + 1, 0x11));
    EXPECT_EQ(one.count(Reason::kDiagLength), 1);
    EXPECT_EQ(diag(one), before);
    EXPECT_EQ(one.peek(0x010) & 0x02, 0) << "the flag is cleared all the same";
    EXPECT_TRUE(is_data(ask(one, kNoSap, {1, 2}))) << "a refused one has no priority";
  }
}

TEST_F(Diagnosis, OfAnotherTypeIsRefusedAndTheEarlierStays) {
  bench.to_data_exch();
  bench.give_diag(0x81, {7});
  const Bytes before = diag(bench);
  int refused = 0;
  for (int type = 0; type < 256; ++type) {
    if (type == 0x00 || type == 0x01 || type == 0x81 || type == 0x02 || type == 0x82) continue;
    bench.give_diag(static_cast<std::uint8_t>(type), {9, 9});
    ASSERT_EQ(bench.count(Reason::kDiagType), ++refused) << type;
  }
  EXPECT_EQ(diag(bench), before);
  EXPECT_EQ(priority(), "DL");
}

TEST_F(Diagnosis, WithAWrongCrcIsRefusedAndTheEarlierStays) {
  bench.to_data_exch();
  bench.give_diag(0x81, {7});
  const Bytes before = diag(bench);
  bench.give_diag(0x82, {8}, 0x0100);
  EXPECT_EQ(bench.count(dpram::Reason::kDiagCrc), 1);
  EXPECT_EQ(diag(bench), before);
  EXPECT_EQ(bench.peek(0x00B) & 0x08, 0x08);
  bench.give_diag(0x82, {8});
  EXPECT_EQ(bench.peek(0x00B) & 0x08, 0);
}

TEST_F(Diagnosis, IsForgottenByANewInitialisation) {
  bench.to_data_exch();
  bench.give_diag(0x81, {7});
  ASSERT_TRUE(bench.initialise());
  bench.find_baud(0);
  expect(0x02, 0x05, 255, "as after reset");
}

}  // namespace
}  // namespace dsdpv1::conformance
