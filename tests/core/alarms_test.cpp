// Alarms (docs/alarms.md): a station whose user raises them, a master that acknowledges them at SAP 51 and 50.
#include "model/profibus/alarms.hpp"

#include <gtest/gtest.h>

#include "model/profibus/alarm_reasons.hpp"
#include "tests/core/user_side_bench.hpp"

namespace dsdpv1::profibus {
namespace {

constexpr std::uint8_t kProcess = 2, kAllTypes = 0xFC, kScShort = 0xE5;

class AlarmsTest : public UserSideTest {
 protected:
  AlarmsTest() : UserSideTest(32) {}

  void exchange_with(std::uint8_t status_2, std::uint8_t status_3) {
    to_exchange({0x80, status_2, status_3});
    service(60, {});
  }
  bool raise(std::uint8_t type, std::uint8_t slot, std::uint8_t sequence) {
    const Bytes block = {4, type, slot, static_cast<std::uint8_t>(sequence << 3U | 1)};
    const bool raised = user.new_alarm(now, block.data(), static_cast<int>(block.size()));
    service(60, {});  // the master reads it
    return raised;
  }
  void acknowledge(std::uint8_t type, std::uint8_t slot, std::uint8_t sequence, int sap = 51) {
    service(sap, {0x5C, slot, type, static_cast<std::uint8_t>(sequence << 3U | 1)}, kSrd, 51);
  }
  /// The data of the answered, SD2 with two SAPs; empty for SC.
  Bytes poll(int sap = 51) {
    service(sap, {}, kSrd, 51);
    if (answered == Bytes{kScShort}) return {};
    return answered.size() < 11 ? answered : Bytes(answered.begin() + 9, answered.end() - 2);
  }
  Alarms& alarms() { return user.msac().alarms; }
  void expect_refused(Reason reason, bool raised) {
    EXPECT_FALSE(raised);
    ASSERT_FALSE(recorder.events.empty());
    EXPECT_EQ(recorder.count(reason), 1) << code(reason);
    recorder.events.clear();
  }
};

TEST_F(AlarmsTest, AnAlarmIsInTheDiagnosisUntilItsMasterHasAcknowledgedItAndTheUserHasTakenThat) {
  exchange_with(0x40, 0);
  const Bytes block = {6, kProcess, 3, 0x29, 0xAB, 0xCD, 0x82, 0x41, 0x09};  // and a channel
  ASSERT_TRUE(user.new_alarm(now, block.data(), static_cast<int>(block.size())));
  send({kSlave, kMaster, kSrd, 1, 2});
  EXPECT_EQ(answered.at(6), 0x0A) << "DH: a diagnosis waits";
  service(60, {});
  EXPECT_EQ(answered.at(9) & 0x08U, 0x08U) << "Ext_Diag";
  EXPECT_EQ(Bytes(answered.begin() + 15, answered.end() - 2), block);
  EXPECT_EQ(alarms().open(), 1);
  for (const int sap : {51, 50}) {
    if (sap == 50) ASSERT_TRUE(raise(kProcess, 3, 5));
    acknowledge(kProcess, 3, 5, sap);
    EXPECT_EQ(answered, Bytes{kScShort});
    EXPECT_EQ(alarms().open(), 0);
    expect_told(alarms().mail().due);
    EXPECT_TRUE(alarms().mail().alarm.is({3, kProcess, 0x29}));
    EXPECT_TRUE(poll(sap).empty()) << "the user has not taken it";
    alarms().mail().due.clear();
    EXPECT_EQ(poll(sap), (Bytes{0x5C, 3, kProcess, 0x29}));
    EXPECT_TRUE(poll(sap).empty()) << "once";
  }
}

TEST_F(AlarmsTest, EachTypeNeedsItsBitOfSetPrm) {
  struct Case {
    std::uint8_t type, bit;
  };
  for (const Case& c :
       {Case{1, 0x20}, {2, 0x40}, {3, 0x80}, {4, 0x80}, {5, 0x08}, {6, 0x04}, {32, 0x10}, {126, 0x10}}) {
    user.initialise(now, initialisation());
    exchange_with(static_cast<std::uint8_t>(~c.bit), 0);
    recorder.events.clear();
    expect_refused(AlarmReason::kAlarmDisabled, raise(c.type, 1, 0));
    user.initialise(now, initialisation());
    exchange_with(c.bit, 0);
    EXPECT_TRUE(raise(c.type, 1, 0)) << int{c.type};
  }
}

TEST_F(AlarmsTest, AlarmModeLimitsThoseThatAreOpen) {
  constexpr int kAllowed[] = {6, 2, 4, 8, 12, 16, 24, 32};
  for (std::uint8_t mode = 0; mode < 8; ++mode) {
    user.initialise(now, initialisation());
    exchange_with(kAllTypes, mode);
    int open = 0;
    // sequence mode: one type, other numbers; type mode: one number, other types
    for (std::uint8_t i = 0; i < 32; ++i) open += raise(mode == 0 ? 1 + i % 6 : kProcess, 1, mode == 0 ? 0 : i) ? 1 : 0;
    EXPECT_EQ(open, kAllowed[mode]) << int{mode};
    EXPECT_EQ(alarms().open(), kAllowed[mode]);
  }
}

TEST_F(AlarmsTest, SequenceNumbersOfOpenAlarmsOfOneTypeDiffer) {
  exchange_with(kAllTypes, 3);
  ASSERT_TRUE(raise(kProcess, 1, 4));
  recorder.events.clear();
  expect_refused(AlarmReason::kAlarmLimit, raise(kProcess, 2, 4));
  EXPECT_TRUE(raise(kProcess, 2, 5));
  EXPECT_TRUE(raise(1, 2, 4)) << "of another type";
}

TEST_F(AlarmsTest, OneDiagnosisAfterTheOther) {
  exchange_with(kAllTypes, 3);
  const Bytes first = {4, kProcess, 1, 0x08}, second = {4, kProcess, 1, 0x10};
  ASSERT_TRUE(user.new_alarm(now, first.data(), 4));
  recorder.events.clear();
  expect_refused(AlarmReason::kAlarmUnread, user.new_alarm(now, second.data(), 4));
  expect_refused(AlarmReason::kAlarmUnread, user.new_diagnosis(now, 0x81, second.data(), 4));
  service(60, {});
  EXPECT_TRUE(user.new_alarm(now, second.data(), 4));
}

TEST_F(AlarmsTest, WrongBlocksAreRefused) {
  exchange_with(kAllTypes, 0);
  Bytes longest = {4, kProcess, 1, 0};
  longest.resize(21);  // max_diag is 20
  for (const Bytes& wrong : {Bytes{4, kProcess, 1},
                             {3, kProcess, 1, 0},
                             {5, kProcess, 1, 0},
                             {0x44, kProcess, 1, 0},
                             {4, 0x82, 1, 0},
                             {4, 0, 1, 0},
                             {4, 7, 1, 0},
                             {4, 31, 1, 0},
                             {4, 127, 1, 0},
                             {4, kProcess, 255, 0},
                             longest}) {
    recorder.events.clear();
    expect_refused(AlarmReason::kAlarmBlock, user.new_alarm(now, wrong.data(), static_cast<int>(wrong.size())));
  }
  longest.pop_back();
  EXPECT_TRUE(user.new_alarm(now, longest.data(), 20));
}

TEST_F(AlarmsTest, LeavingDataExchangeDropsThem) {
  exchange_with(kAllTypes, 7);
  ASSERT_TRUE(raise(kProcess, 1, 1));
  ASSERT_TRUE(raise(kProcess, 1, 2));
  acknowledge(kProcess, 1, 1);
  send({kSlave, kMaster, kSrd, 1, 2, 3});  // one output too many
  EXPECT_EQ(recorder.count(AlarmReason::kAlarmsDropped), 1);
  EXPECT_EQ(alarms().open(), 0);
  EXPECT_FALSE(alarms().mail().due.waiting());
  recorder.events.clear();
  const Bytes block = {4, kProcess, 1, 0};
  expect_refused(AlarmReason::kAlarmState, user.new_alarm(now, block.data(), 4));
}

TEST_F(AlarmsTest, AWrongAcknowledgementIsAnsweredWithItsErrorAtBothSaps) {
  exchange_with(kAllTypes, 7);
  ASSERT_TRUE(raise(kProcess, 1, 1));
  for (const int sap : {51, 50}) {
    for (const auto& [type, slot, sequence] : {Alarm{kProcess, 2, 1}, {1, 1, 1}, {kProcess, 1, 2}}) {
      acknowledge(type, slot, sequence, sap);
      EXPECT_EQ(poll(sap), (Bytes{0xDC, 0x80, 0xB5, 0})) << sap << int{type} << int{slot};
    }
    service(sap, {0x5C, 1, kProcess}, kSrd, 51);
    EXPECT_EQ(poll(sap), (Bytes{0xDC, 0x80, 0xB8, 0}));
    service(sap, {0x51, 1, 2, 3}, kSrd, 51);
    EXPECT_EQ(poll(sap), (Bytes{0xD1, 0x80, 0xA9, 0}));
  }
  service(50, {dpv1::kRead, 1, 2, 3}, kSrd, 51);
  EXPECT_EQ(poll(50), (Bytes{0xDE, 0x80, 0xA9, 0})) << "SAP 50 is for Alarm_Ack alone";
  EXPECT_EQ(alarms().open(), 1);
  acknowledge(kProcess, 1, 1);
  acknowledge(kProcess, 1, 1, 50);
  EXPECT_EQ(answered.at(3), fc::kRr) << "RR: the user has not taken the one before";
}

TEST_F(AlarmsTest, Sap50AsksForTheSameAsSap51) {
  const auto status = [&](int ssap) {
    service(50, {0x5C, 1, kProcess, 0}, kSrd, ssap);
    return answered.size() == 6 ? answered[3] : 0xFF;
  };
  find_baud();
  EXPECT_EQ(status(51), fc::kRs) << "not in data exchange";
  exchange_with(kAllTypes, 0);
  EXPECT_EQ(status(50), fc::kRs) << "table 24: from SSAP 51";
  EXPECT_EQ(status(51), 0xFF) << "SC";
  user.initialise(now, initialisation());
  to_exchange({0x00, kAllTypes, 0});
  EXPECT_EQ(status(51), fc::kRs) << "DPV1 is off";
  EXPECT_EQ(recorder.count(AlarmReason::kAlarmSapOff), 1);
  expect_refused(AlarmReason::kAlarmDisabled, raise(kProcess, 1, 0));
}

struct WithoutAlarms : UserSideTest {};

TEST_F(WithoutAlarms, Sap50DoesNotExistAndSap51RefusesAlarmAck) {
  to_exchange();
  service(50, {0x5C, 1, kProcess, 0}, kSrd, 51);
  EXPECT_EQ(recorder.count(Reason::kSapUnknown), 1);
  service(51, {0x5C, 1, kProcess, 0}, kSrd, 51);
  EXPECT_EQ(recorder.count(Reason::kAcyclicRequestRefused), 1);
}

}  // namespace
}  // namespace dsdpv1::profibus
