// Alarms of DPV1 as a class-1 master handles them: asked for in Set_Prm, found in Slave_Diag, acknowledged once.
#include "bus/master/alarms.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "bus/gsd/setup.hpp"
#include "bus/master/master1.hpp"
#include "tests/bus/fake_acyclic.hpp"
#include "tests/bus/fake_slave.hpp"

namespace dsdpv1::bus {
namespace {

using test::FakeDpSlave;
using test::FakeMailbox;
using testing::HasSubstr;

constexpr std::uint8_t kSlave = 3;
const Bytes kAck = {0x5C, 7, 2, 0x29};          // slot 7, process alarm, sequence number 5, appears
const Bytes kAlarm = {0x05, 2, 7, 0x29, 0xAB};  // its block

struct MasterAlarms : testing::Test {
  void start(AlarmParameters alarms) {
    slave.acyclic = [this](const Telegram& request) {
      return request.dsap == sap::kMs1Alarm ? alarm_sap.hear(request) : mailbox.hear(request);
    };
    SlaveParameters parameters;
    parameters.address = kSlave;
    parameters.ident = 0x0B9A;
    parameters.cfg = {0x11, 0x21};
    parameters.input_length = parameters.output_length = 2;
    parameters.dpv1 = true;
    parameters.alarms = alarms;
    timeline.add(master);
    master.add_slave(parameters);
    master.on_acyclic = [this](Tick, std::uint8_t, const AcyclicResult& result) { results.push_back(result); };
    master.start();
    run(20 * kTicksPerMs);
    ASSERT_EQ(master.slave(kSlave).state, SlaveState::kDataExchange);
  }
  static AlarmParameters process() {
    AlarmParameters alarms;
    alarms.enabled = 0x40;
    alarms.mode = 1;
    return alarms;
  }
  void run(Tick ticks) { timeline.run_until(timeline.now() + ticks); }
  void announce(const Bytes& blocks) {
    slave.blocks = blocks;
    slave.high_priority = true;
    run(5 * kTicksPerMs);
  }

  Segment segment;
  Timeline timeline;
  FakeDpSlave slave{segment, timeline, kSlave};
  FakeMailbox mailbox, alarm_sap;
  Master1 master{segment, {}};
  std::vector<AcyclicResult> results;
};

TEST_F(MasterAlarms, AreAskedForInSetPrmAndAcknowledgedOnce) {
  start(process());
  EXPECT_EQ(Bytes(slave.prm.begin() + 7, slave.prm.end()), (Bytes{0x80, 0x40, 1}));
  announce(kAlarm);
  EXPECT_EQ(mailbox.requests, std::vector<Bytes>{kAck});
  ASSERT_EQ(results.size(), 1U);
  EXPECT_EQ(describe(results[0]), "Alarm_Ack slot 7 type 2 sequence number 5: acknowledged");
  master.slave_diag(kSlave);
  slave.extra_status_2 = 0x02;  // Stat_Diag: read again and again
  run(5 * kTicksPerMs);
  EXPECT_EQ(mailbox.requests.size(), 1U) << "not announced again";
  slave.extra_status_2 = 0;
  announce(kAlarm);
  EXPECT_EQ(mailbox.requests.size(), 2U) << "the same alarm once more";
  EXPECT_TRUE(alarm_sap.requests.empty());
}

TEST_F(MasterAlarms, GoToSap50WithoutWaitingForAReadAtSap51) {
  AlarmParameters alarms = process();
  alarms.extra_sap = true;
  start(alarms);
  mailbox.busy_polls = -1;
  master.c1_read(kSlave, 1, 2, 3);
  announce(kAlarm);
  EXPECT_EQ(alarm_sap.requests, std::vector<Bytes>{kAck});
  EXPECT_EQ(master.c1_open(kSlave), 1U);
}

TEST_F(MasterAlarms, AreLeftOpenOnRequest) {
  AlarmParameters alarms = process();
  alarms.acknowledged = false;
  start(alarms);
  announce(kAlarm);
  EXPECT_TRUE(mailbox.requests.empty());
}

TEST_F(MasterAlarms, OfASlaveThatIsNotAskedForThemAreLeftAlone) {
  start({});
  EXPECT_EQ(Bytes(slave.prm.begin() + 7, slave.prm.end()), (Bytes{0x80, 0, 0}));
  announce(kAlarm);
  EXPECT_TRUE(mailbox.requests.empty());
}

TEST_F(MasterAlarms, AcknowledgementsEndWithDataExchangeAndOtherRequestsStay) {
  start(process());
  mailbox.busy_polls = -1;
  master.c1_read(kSlave, 1, 2, 3);
  master.c1_read(kSlave, 1, 2, 4);
  announce(kAlarm);
  EXPECT_EQ(master.c1_open(kSlave), 3U);
  slave.silent_for = 100000;
  run(5 * kTicksPerMs);
  EXPECT_EQ(master.c1_open(kSlave), 1U) << "the read in progress and Alarm_Ack are lost";
  ASSERT_EQ(results.size(), 2U);
  EXPECT_THAT(describe(results[1]), HasSubstr("Alarm_Ack slot 7"));
  EXPECT_EQ(results[1].outcome, AcyclicOutcome::kLost);
}

TEST_F(MasterAlarms, ARefusalAndAWrongEchoAreReported) {
  start(process());
  mailbox.user = [](const Bytes&) { return Bytes{0xDC, 0x80, 0xB5, 0}; };
  announce(kAlarm);
  mailbox.user = [](const Bytes&) { return Bytes{0x5C, 7, 2, 0x31}; };
  announce(kAlarm);
  ASSERT_EQ(results.size(), 2U);
  EXPECT_EQ(describe(results[0]), "Alarm_Ack slot 7 type 2 sequence number 5: refused, access: state conflict");
  EXPECT_EQ(results[1].reason, "Alarm_Specifier 0x31, sent was 0x29");
}

TEST(AlarmOfADiagnosis, IsItsFirstDeviceRelatedBlockThatIsNoStatus) {
  const auto with = [](const Bytes& blocks) {
    Bytes diagnosis(6, 0);
    diagnosis.insert(diagnosis.end(), blocks.begin(), blocks.end());
    const auto ack = alarm_ack_for(diagnosis);
    return ack ? pdu_of(*ack) : Bytes();
  };
  EXPECT_EQ(with({}), Bytes());
  EXPECT_EQ(with(kAlarm), kAck);
  EXPECT_EQ(with({0x42, 1, 0x81, 0x41, 0x09, 0xC1, 0x04, 0x82, 7, 0, 0x05, 2, 7, 0x29, 0xAB}), kAck)
      << "after an identifier, a channel, a revision and a status";
  EXPECT_EQ(with({0x04, 0x81, 7, 0x29}), Bytes()) << "a status";
  EXPECT_EQ(with({0x03, 2, 7}), Bytes()) << "too short for an alarm";
  EXPECT_EQ(with({0x06, 2, 7, 0x29}), Bytes()) << "longer than the telegram";
  EXPECT_EQ(with({0x40, 0x05, 2, 7, 0x29, 0xAB}), Bytes()) << "a block of no bytes";
}

TEST(EnableAlarms, FollowsTheGsdFile) {
  Gsd gsd;
  SlaveParameters parameters;
  AlarmParameters alarms;
  alarms.enabled = 0x60;
  alarms.mode = 2;
  alarms.extra_sap = true;
  EXPECT_EQ(enable_alarms(gsd, alarms, parameters), "the GSD file does not say Diagnostic_Alarm_supp = 1");
  gsd.alarms.types = 0x20;
  EXPECT_EQ(enable_alarms(gsd, alarms, parameters), "the GSD file does not say Process_Alarm_supp = 1");
  gsd.alarms.types = 0x60;
  EXPECT_EQ(enable_alarms(gsd, alarms, parameters), "the GSD file does not say Extra_Alarm_SAP_supp = 1");
  gsd.alarms.extra_sap = true;
  gsd.alarms.sequence_count = 3;
  EXPECT_EQ(enable_alarms(gsd, alarms, parameters), "mode 2: 4 alarms, Alarm_Sequence_Mode_Count of the GSD file is 3");
  EXPECT_EQ(parameters.alarms.enabled, 0);
  gsd.alarms.sequence_count = 4;
  EXPECT_EQ(enable_alarms(gsd, alarms, parameters), "");
  EXPECT_EQ(parameters.alarms.enabled, 0x60);
  alarms.mode = 0;
  EXPECT_EQ(enable_alarms(gsd, alarms, parameters), "mode 0: the GSD file does not say Alarm_Type_Mode_supp = 1");
}

}  // namespace
}  // namespace dsdpv1::bus
