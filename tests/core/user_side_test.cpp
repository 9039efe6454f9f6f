// A station with another user's side than the DSDPV1's: the mail with its cycles, and the effect of other capacities.
#include "model/profibus/user_side.hpp"

#include <gtest/gtest.h>

#include <numeric>
#include <vector>

#include "model/profibus/station.hpp"
#include "tests/core/event_recorder.hpp"

namespace dsdpv1::profibus {
namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr int kBit = 4;  // 12 Mbit/s
constexpr std::uint8_t kSlave = 5, kMaster = 1, kSrd = 0x4D, kSdn = 0x46;
constexpr std::uint16_t kIdent = 0x1234;

class UserSideTest : public testing::Test {
 protected:
  static SlaveConfig initialisation() {
    SlaveConfig config;
    config.address = kSlave;
    config.ident = kIdent;
    config.sync_supported = config.address_change = config.dpv1 = true;
    config.max_input = config.max_output = 8;
    config.max_prm = 6;
    config.max_cfg = 4;
    config.prm_mode = config.cfg_mode = Judging::kUser;
    const Bytes cfg = {0x11, 0x21};  // 2 inputs, 2 outputs
    config.cfg.assign(cfg.data(), static_cast<int>(cfg.size()));
    return config;
  }

  void SetUp() override {
    user.reset();
    user.initialise(1, initialisation());
  }

  void run(Cycle cycles) {
    for (const Cycle end = now + cycles; now < end;) station.eval(++now);
  }
  void level(bool high, int bits = 1) {
    station.set_rxd(now * kTicksPerCycle, high);
    run(Cycle{bits} * kBit);
  }
  void character(unsigned value) {
    level(false);
    bool odd = false;
    for (int bit = 0; bit < 8; ++bit) {
      level((value >> bit & 1) != 0);
      odd ^= (value >> bit & 1) != 0;
    }
    level(odd);
    level(true);
  }
  /// An SD2 telegram after T_SYN, and the time for its answer.
  void send(const Bytes& body) {
    level(true, 40);
    const auto le = static_cast<std::uint8_t>(body.size());
    for (const unsigned head : {0x68U, unsigned{le}, unsigned{le}, 0x68U}) character(head);
    for (const unsigned byte : body) character(byte);
    character(std::accumulate(body.begin(), body.end(), 0U) & 0xFF);
    character(0x16);
    sent = now;
    level(true, 400);
  }
  void service(int dsap, const Bytes& data, std::uint8_t fc = kSrd, int ssap = 62) {
    const bool broadcast = fc == kSdn;
    Bytes body = {static_cast<std::uint8_t>((broadcast ? 127 : kSlave) | 0x80), kMaster | 0x80, fc,
                  static_cast<std::uint8_t>(dsap), static_cast<std::uint8_t>(ssap)};
    body.insert(body.end(), data.begin(), data.end());
    send(body);
  }
  void find_baud() { service(60, {}); }
  void set_prm(const Bytes& user_bytes) {
    Bytes data = {0xA0, 0, 0, 11, kIdent >> 8, kIdent & 0xFF, 0};  // Lock_Req, Sync_Req
    data.insert(data.end(), user_bytes.begin(), user_bytes.end());
    service(61, data);
  }
  void to_exchange() {
    find_baud();
    set_prm({0x80, 0, 0});
    user.mail().prm.due.clear();
    user.prm_verdict(now, true);
    service(62, {0x11, 0x21});
    user.mail().cfg.due.clear();
    user.cfg_verdict(now, true);
    ASSERT_EQ(user.mail().state.state, DpState::kDataExch);
  }
  /// Due since shortly after the end of the last telegram: at its decision.
  void expect_told(const Due& due) const {
    EXPECT_GE(due.since, sent);
    EXPECT_LE(due.since, sent + 4 * kBit);
  }

  core_test::EventRecorder recorder;
  UserSide user{recorder.log, {6, 4, 8, 10}, station};
  Station station{recorder.log, {}, user, &user.msac()};
  Cycle now = 1, sent = 0;
};

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
