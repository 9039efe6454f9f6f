#include "bus/master/slave.hpp"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <vector>

namespace dsdpv1::bus {
namespace {

SlaveParameters parameters() {
  SlaveParameters slave;
  slave.address = 3;
  slave.ident = 0x0B9A;
  slave.cfg = {0x11, 0x21};
  slave.input_length = slave.output_length = 2;
  slave.wd_fact_1 = 2;
  slave.wd_fact_2 = 50;
  return slave;
}

FdlResult answered(const Telegram& answer) {
  FdlResult result;
  result.outcome = FdlOutcome::kAnswered;
  result.answer = answer;
  return result;
}

FdlResult diagnosis(std::uint8_t status_1, std::uint8_t status_2, std::uint8_t master = 255,
                    std::uint8_t ident_low = 0x9A) {
  return answered(make_telegram(
      1, 3, 0x08, {status_1, static_cast<std::uint8_t>(status_2 | 0x04), 0, master, 0x0B, ident_low}, 62, 60));
}

FdlResult inputs(const Bytes& data, std::uint8_t function = fc::kDl) {
  return answered(make_telegram(1, 3, function, data));
}
FdlResult refusal(std::uint8_t function) { return answered(make_telegram(1, 3, function)); }
FdlResult acknowledged() { return answered(make_sc()); }

struct SlaveTest : testing::Test {
  explicit SlaveTest(const SlaveParameters& p = parameters(), Personality personality = Personality::kHighAlways)
      : slave(p, 1, personality) {}
  /// One request and the answer to it.
  Telegram step(const FdlResult& result) {
    Telegram request = slave.next_request();
    slave.done(result);
    return request;
  }
  void bring_up() {
    step(diagnosis(0x02, 0x01));
    step(acknowledged());
    step(acknowledged());
    step(diagnosis(0, 0, 1));
    ASSERT_EQ(state(), SlaveState::kDataExchange);
  }
  SlaveState state() const { return slave.view().state; }
  SlaveHandler slave;
};

TEST_F(SlaveTest, BringUpByDiagnosisParametersConfigurationDiagnosis) {
  EXPECT_EQ(step(diagnosis(0x02, 0x01)).dsap, sap::kSlaveDiag);
  EXPECT_EQ(step(acknowledged()).dsap, sap::kSetPrm);
  EXPECT_EQ(step(acknowledged()).dsap, sap::kChkCfg);
  EXPECT_EQ(step(diagnosis(0, 0, 1)).dsap, sap::kSlaveDiag);
  const Telegram exchange = step(inputs({1, 2}));
  EXPECT_FALSE(exchange.dsap.has_value());
  EXPECT_EQ(exchange.fc, 0x4D);
  EXPECT_EQ(slave.view().inputs, (Bytes{1, 2}));
  EXPECT_EQ(slave.view().counters.data_exchanges, 1U);
}

TEST_F(SlaveTest, CountedOutputsChangeInEachExchangeUntilTheyAreSet) {
  slave.vary_outputs(OutputPattern::kCount, 1);
  bring_up();
  EXPECT_EQ(step(inputs({0, 0})).data, (Bytes{1, 1}));
  EXPECT_EQ(step(inputs({0, 0}, fc::kDh)).data, (Bytes{2, 2}));
  EXPECT_EQ(step(diagnosis(0, 0, 1)).dsap, sap::kSlaveDiag);
  EXPECT_EQ(step(inputs({0, 0})).data, (Bytes{3, 3}));
  EXPECT_EQ(slave.view().outputs, (Bytes{3, 3}));
  slave.set_outputs({7, 8});
  EXPECT_EQ(step(inputs({0, 0})).data, (Bytes{7, 8}));
  EXPECT_EQ(step(inputs({0, 0})).data, (Bytes{7, 8}));
}

TEST_F(SlaveTest, RandomOutputsFollowFromTheSeed) {
  bring_up();
  const auto three_of = [this](std::uint32_t seed) {
    slave.vary_outputs(OutputPattern::kRandom, seed);
    std::vector<Bytes> seen;
    for (int i = 0; i < 3; ++i) seen.push_back(step(inputs({0, 0})).data);
    return seen;
  };
  const std::vector<Bytes> once = three_of(5);
  EXPECT_NE(once[0], once[1]);
  EXPECT_NE(once[1], once[2]);
  EXPECT_EQ(three_of(5), once);
  EXPECT_NE(three_of(6), once);
}

/// The user still judges Set_Prm when Chk_Cfg comes. Cfg_Fault of an earlier configuration stands until then.
TEST_F(SlaveTest, AnOldCfgFaultDoesNotStopAChkCfgThatWasRefused) {
  constexpr std::uint8_t kCfgFault = 0x04;
  step(diagnosis(0x02 | kCfgFault, 0x01));
  step(acknowledged());
  step(refusal(fc::kRs));
  step(diagnosis(0x02 | kCfgFault, 0, 1));
  EXPECT_EQ(state(), SlaveState::kChkCfg);
  EXPECT_EQ(step(acknowledged()).dsap, sap::kChkCfg);
  step(diagnosis(0x02 | kCfgFault, 0, 1));
  EXPECT_EQ(slave.view().reason, "Cfg_Fault");
  EXPECT_EQ(state(), SlaveState::kDiagnose);
}

TEST_F(SlaveTest, AWrongIdentIsNotParameterised) {
  step(diagnosis(0x02, 0x01, 255, 0x9B));
  EXPECT_EQ(state(), SlaveState::kDiagnose);
  EXPECT_EQ(slave.view().reason, "ident is 0x0B9B, expected 0x0B9A");
}

TEST_F(SlaveTest, ASlaveOfAnotherMasterIsLeftToIt) {
  step(diagnosis(0x00, 0x00, 2));
  EXPECT_EQ(state(), SlaveState::kDiagnose);
  EXPECT_EQ(slave.view().reason, "held by master 2");
}

TEST_F(SlaveTest, NotReadyIsPolledUntilReady) {
  step(diagnosis(0x02, 0x01));
  step(acknowledged());
  step(acknowledged());
  for (int i = 0; i < 3; ++i) step(diagnosis(0x02, 0, 1));
  EXPECT_EQ(state(), SlaveState::kAwaitReady);
  step(diagnosis(0, 0, 1));
  EXPECT_EQ(state(), SlaveState::kDataExchange);
}

TEST_F(SlaveTest, ChkCfgRefusedWhileTheUserJudgesIsRepeated) {
  step(diagnosis(0x02, 0x01));
  step(acknowledged());
  step(refusal(fc::kRs));
  step(diagnosis(0x02, 0, 1));
  EXPECT_EQ(step(acknowledged()).dsap, sap::kChkCfg);
  EXPECT_EQ(slave.view().counters.parameterisations, 1U);
  EXPECT_EQ(slave.view().counters.refusals, 1U);
}

TEST_F(SlaveTest, ChkCfgRefusedWithPrmReqBeginsAnew) {
  step(diagnosis(0x02, 0x01));
  step(acknowledged());
  step(refusal(fc::kRs));
  step(diagnosis(0x02, 0x01));
  EXPECT_EQ(state(), SlaveState::kDiagnose);
}

TEST_F(SlaveTest, AStepTellsItsOwnReasonAndNoneOfBefore) {
  std::vector<std::string> steps;
  slave.on_state = [this, &steps](SlaveState, SlaveState to) {
    const std::string& why = slave.view().step_reason;
    steps.push_back(name(to) + (why.empty() ? "" : ", " + why));
  };
  FdlResult silence;
  silence.outcome = FdlOutcome::kNoAnswer;
  step(diagnosis(0x02, 0x01));
  step(silence);
  step(silence);
  step(diagnosis(0x02, 0x01));  // from OFFLINE on, all is well
  step(acknowledged());
  step(refusal(fc::kRs));
  step(diagnosis(0x02, 0, 1));
  EXPECT_EQ(slave.view().reason, "Chk_Cfg not acknowledged") << "the last failure is kept until all is well";
  step(acknowledged());
  step(diagnosis(0, 0, 1));
  step(inputs({1, 2}, fc::kDh));
  step(diagnosis(0x42, 0x01));
  EXPECT_EQ(steps, (std::vector<std::string>{"DIAGNOSE", "SET_PRM", "OFFLINE, no answer", "DIAGNOSE", "SET_PRM",
                                             "CHK_CFG", "AWAIT_READY, Chk_Cfg not acknowledged", "CHK_CFG",
                                             "AWAIT_READY", "DATA_EXCH", "DIAGNOSE, Prm_Fault"}));
}

struct Fault {
  std::uint8_t status_1, status_2;
  const char* reason;
};

class SlaveFaults : public SlaveTest, public testing::WithParamInterface<Fault> {};
INSTANTIATE_TEST_SUITE_P(Bits, SlaveFaults,
                         testing::Values(Fault{0x42, 0x01, "Prm_Fault"}, Fault{0x52, 0x01, "Prm_Fault, Not_Supported"},
                                         Fault{0x06, 0x01, "Cfg_Fault"}, Fault{0x12, 0, "Not_Supported"},
                                         Fault{0x02, 0x01, "Prm_Req"}));

TEST_P(SlaveFaults, InTheBringUpBeginAnew) {
  step(diagnosis(0x02, 0x01));
  step(acknowledged());
  step(acknowledged());
  step(diagnosis(GetParam().status_1, GetParam().status_2));
  EXPECT_EQ(state(), SlaveState::kDiagnose);
  EXPECT_EQ(slave.view().reason, GetParam().reason);
}

TEST_P(SlaveFaults, InOperationBeginAnew) {
  bring_up();
  step(inputs({1, 2}, fc::kDh));
  step(diagnosis(GetParam().status_1, GetParam().status_2));
  EXPECT_EQ(state(), SlaveState::kDiagnose);
  EXPECT_EQ(slave.view().reason, GetParam().reason);
}

TEST_F(SlaveTest, AHighPriorityAnswerIsFollowedByOneDiagnosis) {
  bring_up();
  step(inputs({1, 2}, fc::kDh));
  EXPECT_EQ(slave.view().inputs, (Bytes{1, 2}));
  EXPECT_EQ(step(diagnosis(0x08, 0, 1)).dsap, sap::kSlaveDiag);
  EXPECT_FALSE(step(inputs({1, 2})).dsap.has_value());
}

TEST_F(SlaveTest, StaticDiagnosisIsFetchedUntilItIsGone) {
  bring_up();
  step(inputs({1, 2}, fc::kDh));
  EXPECT_EQ(step(diagnosis(0, 0x02, 1)).dsap, sap::kSlaveDiag);
  EXPECT_EQ(step(diagnosis(0, 0x02, 1)).dsap, sap::kSlaveDiag);
  EXPECT_EQ(step(diagnosis(0, 0, 1)).dsap, sap::kSlaveDiag);
  EXPECT_FALSE(step(inputs({1, 2})).dsap.has_value());
}

TEST_F(SlaveTest, RefusedDataExchange) {
  bring_up();
  step(refusal(fc::kRs));
  EXPECT_EQ(state(), SlaveState::kDiagnose);
  bring_up();
  step(refusal(fc::kRr));
  EXPECT_EQ(slave.next_request().dsap, sap::kSlaveDiag);
  EXPECT_EQ(state(), SlaveState::kDataExchange);
}

TEST_F(SlaveTest, InputsOfAWrongLengthAreNotTaken) {
  bring_up();
  step(inputs({1, 2}));
  step(inputs({3}));
  EXPECT_EQ(slave.view().inputs, (Bytes{1, 2}));
  EXPECT_EQ(slave.view().counters.errors, 1U);
  EXPECT_EQ(slave.next_request().dsap, sap::kSlaveDiag);
}

TEST_F(SlaveTest, WithoutAnAnswerItIsOffline) {
  bring_up();
  FdlResult nothing;
  nothing.timeouts = 3;
  nothing.retries = 2;
  step(nothing);
  EXPECT_EQ(state(), SlaveState::kOffline);
  EXPECT_EQ(slave.view().counters.timeouts, 3U);
  EXPECT_EQ(slave.view().counters.retries, 2U);
  EXPECT_EQ(slave.view().reason, "no answer");
}

TEST_F(SlaveTest, ClearSendsZerosOrNothingToFailSafeSlaves) {
  bring_up();
  slave.set_outputs({5, 6});
  EXPECT_EQ(slave.next_request().data, (Bytes{5, 6}));
  slave.set_clear(true);
  EXPECT_EQ(slave.next_request().data, (Bytes{0, 0}));
}

SlaveParameters fail_safe() {
  SlaveParameters slave = parameters();
  slave.fail_safe = true;
  return slave;
}

struct FailSafeSlaveTest : SlaveTest {
  FailSafeSlaveTest() : SlaveTest(fail_safe()) {}
};

TEST_F(FailSafeSlaveTest, GetsNoOutputsInClear) {
  bring_up();
  slave.set_clear(true);
  EXPECT_TRUE(slave.next_request().data.empty());
  EXPECT_EQ(slave.next_request().kind, TelegramKind::kSd1);
}

TEST_F(SlaveTest, ReleaseSendsUnlockAndLeavesTheSlaveAlone) {
  bring_up();
  slave.release();
  const Telegram unlock = step(acknowledged());
  EXPECT_EQ(unlock.dsap, sap::kSetPrm);
  EXPECT_EQ(unlock.data[0], 0x40);
  EXPECT_EQ(state(), SlaveState::kReleased);
}

TEST_F(SlaveTest, AnAnswerToAnEarlierStateIsNotTakenForAnother) {
  bring_up();
  slave.next_request();  // a data exchange is on its way when the release comes
  slave.release();
  slave.done(inputs({1, 2}));
  EXPECT_EQ(state(), SlaveState::kReleasing);
}

struct ClassicSlaveTest : SlaveTest {
  ClassicSlaveTest() : SlaveTest(parameters(), Personality::kClassic) {}
};

TEST_F(ClassicSlaveTest, FindsByFdlStatusClearsAndUsesLowPriority) {
  EXPECT_EQ(step(answered(make_telegram(1, 3, 0))).fc, 0x49);
  const Telegram diag = step(diagnosis(0x02, 0x01));
  EXPECT_EQ(diag.dsap, sap::kSlaveDiag);
  EXPECT_EQ(diag.fc, 0x4C);
  FdlResult sent;
  sent.outcome = FdlOutcome::kSent;
  const Telegram clear = step(sent);
  EXPECT_EQ(clear.dsap, sap::kGlobalControl);
  EXPECT_EQ(clear.data, (Bytes{0x02, 0x00}));
  const Telegram prm = step(acknowledged());
  EXPECT_EQ(prm.fc, 0x4C);
  EXPECT_EQ(prm.data[3], kMinTsdrBits);
  EXPECT_EQ(step(acknowledged()).fc, 0x4C);
  step(diagnosis(0, 0, 1));
  EXPECT_EQ(slave.next_request().fc, 0x4D);
}

TEST_F(SlaveTest, HighAlwaysLeavesMinTsdrAndUsesSd3WhenEightBytesFit) {
  SlaveParameters p = parameters();
  p.cfg = {1, 2, 3, 4, 5, 6};
  SlaveHandler high(p, 1, Personality::kHighAlways), classic(p, 1, Personality::kClassic);
  for (SlaveHandler* handler : {&high, &classic}) {
    handler->restart("");
    handler->next_request();
    handler->done(diagnosis(0x02, 0x01));
  }
  EXPECT_EQ(high.next_request().data[3], 0);
  high.done(acknowledged());
  EXPECT_EQ(high.next_request().kind, TelegramKind::kSd3);
  FdlResult sent;
  sent.outcome = FdlOutcome::kSent;
  classic.next_request();
  classic.done(sent);
  classic.next_request();
  classic.done(acknowledged());
  EXPECT_EQ(classic.next_request().kind, TelegramKind::kSd2);
}

TEST(SetPrmData, AllFields) {
  SlaveParameters slave = parameters();
  slave.sync = slave.freeze = true;
  slave.group_ident = 0x05;
  slave.user_prm = {0x00, 0xAA, 0xBB, 0xCC};
  EXPECT_EQ(set_prm_data(slave, 11), (Bytes{0xB8, 2, 50, 11, 0x0B, 0x9A, 0x05, 0x00, 0xAA, 0xBB, 0xCC}));
}

TEST(SetPrmData, WithoutFactorsTheWatchdogIsOff) {
  SlaveParameters slave = parameters();
  slave.wd_fact_2 = 0;
  slave.lock = false;
  EXPECT_EQ(set_prm_data(slave, 0)[0], 0x00);
}

TEST(SetPrmData, FlagsOfTheUserBytesAreAdded) {
  SlaveParameters slave = parameters();
  slave.fail_safe = slave.wd_base_1ms = true;
  EXPECT_EQ(set_prm_data(slave, 0).size(), 8U);
  EXPECT_EQ(set_prm_data(slave, 0)[7], 0x44);
  slave.dpv1 = true;
  EXPECT_EQ(set_prm_data(slave, 0).size(), 10U);
  EXPECT_EQ(set_prm_data(slave, 0)[7], 0xC4);
}

TEST(SlaveHandler, RefusesValuesOutOfRange) {
  const auto refuses = [](auto change) {
    SlaveParameters slave = parameters();
    change(slave);
    EXPECT_THROW(SlaveHandler(slave, 1, Personality::kClassic), std::invalid_argument);
  };
  refuses([](SlaveParameters& s) { s.address = 127; });
  refuses([](SlaveParameters& s) { s.user_prm.resize(238); });
  refuses([](SlaveParameters& s) { s.cfg.clear(); });
  refuses([](SlaveParameters& s) { s.cfg.resize(245); });
  refuses([](SlaveParameters& s) { s.input_length = 245; });
  refuses([](SlaveParameters& s) { s.output_length = -1; });
}

TEST_F(SlaveTest, OutputsMustHaveTheConfiguredLength) { EXPECT_THROW(slave.set_outputs({1}), std::invalid_argument); }

}  // namespace
}  // namespace dsdpv1::bus
