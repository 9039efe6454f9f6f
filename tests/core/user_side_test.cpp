// A station with another user's side than the DSDPV1's: the mail with its cycles, and the effect of other capacities.
#include "model/profibus/user_side.hpp"

#include <gtest/gtest.h>

#include "tests/core/user_side_bench.hpp"

namespace dsdpv1::profibus {
namespace {

TEST_F(UserSideTest, HearsThatTheBaudRateIsFoundAndLostWithTheCycle) {
  EXPECT_EQ(user.mail().baud.index, kBaudUnknown);
  EXPECT_EQ(user.mail().baud.due.since, 1);
  find_baud();
  EXPECT_EQ(user.mail().baud.index, BaudIndex::fastest());
  expect_told(user.mail().baud.due);
  const Cycle found = user.mail().baud.due.since;
  while (now < found + 600 * kCyclesPerMs - 1)
    station.eval(now = std::min(station.next(), found + 600 * kCyclesPerMs - 1));
  EXPECT_EQ(user.mail().baud.index, BaudIndex::fastest());
  run(1);
  EXPECT_EQ(user.mail().baud.index, kBaudUnknown);
  EXPECT_EQ(user.mail().baud.due.since, found + 600 * kCyclesPerMs);
}

TEST_F(UserSideTest, HearsParametersConfigurationAndStateWithTheCycle) {
  find_baud();
  set_prm({1, 2, 3});
  expect_told(user.mail().prm.due);
  EXPECT_TRUE(user.mail().prm.block.equals(Bytes{1, 2, 3}.data(), 3));
  user.mail().prm.due.clear();
  user.prm_verdict(now, true);
  EXPECT_EQ(user.mail().state.state, DpState::kWaitCfg);
  EXPECT_EQ(user.mail().state.due.since, now);
  service(62, {0x10, 0x22});
  expect_told(user.mail().cfg.due);
  EXPECT_EQ(user.mail().cfg.input, 1);
  EXPECT_EQ(user.mail().cfg.output, 3);
  EXPECT_EQ(user.input_size(), 2) << "until the verdict that of the initialisation";
  user.mail().cfg.due.clear();
  user.cfg_verdict(now, true);
  EXPECT_EQ(user.input_size(), 1);
  EXPECT_EQ(user.mail().state.state, DpState::kDataExch);
}

TEST_F(UserSideTest, HearsOutputsAndGlobalControlAndLeavingOfDataExchange) {
  to_exchange();
  send({kSlave, kMaster, kSrd, 0xAB, 0xCD});
  expect_told(user.mail().output.due);
  EXPECT_TRUE(user.outputs().equals(Bytes{0xAB, 0xCD}.data(), 2));
  service(58, {0x20, 0}, kSdn);  // Sync
  expect_told(user.mail().control.due);
  EXPECT_EQ(user.mail().control.command, 0x20);
  EXPECT_EQ(user.mail().control.master, kMaster);
  EXPECT_EQ(user.mail().state.exchanges_left, 0);
  send({kSlave, kMaster, kSrd, 1, 2, 3});  // one too many
  expect_told(user.mail().state.due);
  EXPECT_EQ(user.mail().state.state, DpState::kWaitPrm);
  EXPECT_EQ(user.mail().state.exchanges_left, 1);
}

TEST_F(UserSideTest, HearsItsNewAddress) {
  find_baud();
  service(55, {77, kIdent >> 8, kIdent & 0xFF, 1});
  expect_told(user.mail().address.due);
  EXPECT_EQ(user.mail().address.address, 77);
  EXPECT_TRUE(user.mail().address.locked);
}

TEST_F(UserSideTest, HearsAcyclicRequestsAndAnswers) {
  to_exchange();
  service(51, {dpv1::kWrite, 1, 2, 3, 7, 8, 9}, kSrd, 51);
  expect_told(user.mail().c1.due);
  EXPECT_TRUE(user.mail().c1.pdu.equals(Bytes{dpv1::kWrite, 1, 2, 3, 7, 8, 9}.data(), 7));
  user.mail().c1.due.clear();
  const Bytes answer = {dpv1::kWrite, 1, 2, 3};
  user.c1_answer(now, answer.data(), 4);
  service(51, {}, kSrd, 51);
  EXPECT_EQ(recorder.count(Reason::kC1Answer), 1);
}

TEST_F(UserSideTest, ResetEndsTheTimersOfC2) {
  find_baud();
  service(49, {dpv1::kInitiate, 0, 0, 0, 0, 1, 1, 0, 0, 0, 0, 0, 0, 0}, kSrd, 50);
  ASSERT_EQ(recorder.count(Reason::kC2Initiate), 1);
  EXPECT_TRUE(station.may_act(now + 20 * kCyclesPerMs)) << "F ends after 10 ms";
  user.reset();
  EXPECT_FALSE(station.may_act(now + 20 * kCyclesPerMs));
}

TEST_F(UserSideTest, MoreParametersThanItHoldsAreAPrmFault) {
  find_baud();
  set_prm({1, 2, 3, 4, 5, 6});
  EXPECT_EQ(recorder.count(Reason::kPrmUserLength), 0);
  set_prm({1, 2, 3, 4, 5, 6, 7});
  EXPECT_EQ(recorder.count(Reason::kPrmUserLength), 1);
}

TEST_F(UserSideTest, MoreConfigurationThanItHoldsIsRrAndMoreDataACfgFault) {
  find_baud();
  set_prm({});
  user.mail().prm.due.clear();
  user.prm_verdict(now, true);
  service(62, {0x11, 0x11, 0x11, 0x11, 0x11});
  ASSERT_EQ(recorder.events.back().reason, Reason::kCfgTooLong);
  EXPECT_EQ(recorder.events.back().b, 4);
  service(62, {0x18});  // 9 inputs
  EXPECT_EQ(recorder.count(Reason::kCfgIoLength), 1);
}

TEST_F(UserSideTest, AWriteOfMoreThanItHoldsIsAnsweredForIt) {
  to_exchange();
  Bytes write = {dpv1::kWrite, 1, 2, 11};
  write.resize(15);
  service(51, write, kSrd, 51);
  EXPECT_FALSE(user.mail().c1.due.waiting());
  EXPECT_EQ(recorder.count(Reason::kAcyclicRequestRefused), 1);
}

}  // namespace
}  // namespace dsdpv1::profibus
