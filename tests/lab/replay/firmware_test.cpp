// The evidence about the slave's user CPU in a capture.
#include "lab/replay/firmware.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/lab/replay/captures.hpp"

namespace dsdpv1::replay_test {
namespace {

using tb::replay::Firmware;
using tb::replay::firmware_of;
using testing::IsEmpty;
using testing::SizeIs;

namespace sap = bus::sap;

const Bytes kPrm = {0x80, 0, 0, 11, 0x12, 0x34, 0};

Bytes diagnosis(std::uint8_t first, std::uint8_t second, const Bytes& own = {}) {
  Bytes bytes = {first, second, 0, kMaster, 0x12, 0x34};
  bytes.insert(bytes.end(), own.begin(), own.end());
  return bytes;
}

void start_up(Capture& capture) {
  capture.add(to_slave(sap::kSetPrm, kPrm));
  capture.add(bus::make_sc());
  capture.add(to_slave(sap::kChkCfg, {0x11}));
  capture.add(bus::make_sc());
}

/// The end of the answer.
bus::Tick exchange(Capture& capture, const Bytes& bytes, std::uint8_t fc = bus::fc::kDl) {
  capture.add(outputs({1}));
  capture.add(inputs(bytes, fc));
  return capture.now();
}

TEST(Firmware, IdentAndConfigurationAreThoseOfTheExchange) {
  Capture capture;
  capture.add(to_slave(sap::kSetPrm, {0x80, 0, 0, 11, 0x99, 0x99, 0}));
  capture.add(bus::make_sc());
  start_up(capture);
  exchange(capture, {1, 2});
  capture.add(to_slave(sap::kChkCfg, {0x22}));  // refused later
  capture.add(bus::make_sc());
  const Firmware firmware = firmware_of(capture.finish());
  EXPECT_EQ(firmware.init.ident, 0x1234);
  EXPECT_EQ(firmware.init.cfg, Bytes{0x11});
  EXPECT_EQ(firmware.init.cfg_mode, 0);
  EXPECT_FALSE(firmware.init.dpv1.value_or(false));
  EXPECT_EQ(firmware.inputs, (Bytes{1, 2}));
}

TEST(Firmware, ConfigurationFaultMeansThatItWantsItsOwn) {
  Capture capture;
  start_up(capture);
  capture.add(to_slave(sap::kSlaveDiag));
  capture.add(from_slave(sap::kSlaveDiag, diagnosis(0x04, 0x05)));
  EXPECT_EQ(firmware_of(capture.finish()).init.cfg_mode, 1);
}

TEST(Firmware, NewInputsAreGivenWhenTheAnswerBeforeHasEnded) {
  Capture capture;
  start_up(capture);
  exchange(capture, {1});
  const bus::Tick end = exchange(capture, {1});
  exchange(capture, {2});
  exchange(capture, {2});
  const Firmware firmware = firmware_of(capture.finish());
  ASSERT_THAT(firmware.supplies, SizeIs(1));
  EXPECT_EQ(firmware.supplies[0].at, end);
  EXPECT_EQ(firmware.supplies[0].bytes, Bytes{2});
  EXPECT_FALSE(firmware.supplies[0].diagnosis);
}

TEST(Firmware, DiagnosisIsGivenBeforeTheFirstAnswerOfHighPriority) {
  Capture capture;
  start_up(capture);
  const bus::Tick end = exchange(capture, {1});
  exchange(capture, {1}, bus::fc::kDh);
  exchange(capture, {1}, bus::fc::kDh);
  capture.add(to_slave(sap::kSlaveDiag));
  capture.add(from_slave(sap::kSlaveDiag, diagnosis(0x08, 0x04, {3, 0xA5, 0x5A})));
  exchange(capture, {1});
  const Firmware firmware = firmware_of(capture.finish());
  ASSERT_THAT(firmware.supplies, SizeIs(1));
  EXPECT_EQ(firmware.supplies[0].at, end);
  EXPECT_EQ(firmware.supplies[0].diagnosis, user_cpu::DiagnosisKind::kExternal);
  EXPECT_EQ(firmware.supplies[0].bytes, (Bytes{3, 0xA5, 0x5A}));
}

TEST(Firmware, DiagnosisThatGoesIsOneToo) {
  Capture capture;
  start_up(capture);
  exchange(capture, {1});
  for (const Bytes& bytes : {diagnosis(0x08, 0x04, {2, 1}), diagnosis(0, 0x04), diagnosis(0, 0x04)}) {
    capture.add(to_slave(sap::kSlaveDiag));
    capture.add(from_slave(sap::kSlaveDiag, bytes));
  }
  const Firmware firmware = firmware_of(capture.finish());
  ASSERT_THAT(firmware.supplies, SizeIs(2));
  EXPECT_EQ(firmware.supplies[1].diagnosis, user_cpu::DiagnosisKind::kExternalGone);
  EXPECT_THAT(firmware.supplies[1].bytes, IsEmpty());
}

TEST(Firmware, ObjectsAreWhatWasReadAndWritten) {
  Capture capture;
  start_up(capture);
  exchange(capture, {1});
  const auto talk = [&capture](const Bytes& pdu) {
    capture.add(to_slave(sap::kMs1));
    capture.add(from_slave(sap::kMs1, pdu));
  };
  talk({0x5F, 1, 2, 2});
  talk({0x5E, 1, 2, 3, 7, 8, 9});
  talk({0x5F, 1, 4, 5});
  talk({0xDE, 0x80, 0xB2, 0});  // refused
  const Firmware firmware = firmware_of(capture.finish());
  EXPECT_TRUE(firmware.init.dpv1.value_or(false));
  ASSERT_THAT(firmware.objects, SizeIs(2));
  EXPECT_EQ(firmware.objects[0].data, (Bytes{7, 8, 9}));
  EXPECT_EQ(firmware.objects[1].index, 4);
  EXPECT_EQ(firmware.objects[1].data, Bytes(5));
}

TEST(Beginning, OfAStartIsTheFirstAnswer) {
  Capture capture;
  capture.add(to_slave(sap::kSlaveDiag));
  start_up(capture);
  const auto beginning = tb::replay::beginning_of(capture.finish());
  EXPECT_EQ(beginning.first_answer, 1U);
  EXPECT_EQ(beginning.comparable, 1U);
}

TEST(Beginning, InTheMiddleIsTheNextStart) {
  Capture capture;
  exchange(capture, {1});
  capture.add(to_slave(sap::kSetPrm, kPrm));  // alone it may leave the slave where it is
  capture.add(bus::make_sc());
  exchange(capture, {1});
  start_up(capture);
  EXPECT_EQ(tb::replay::beginning_of(capture.finish()).comparable, 3U);
}

TEST(Beginning, InTheMiddleWithoutAStartThereIsNone) {
  Capture capture;
  exchange(capture, {1});
  exchange(capture, {1});
  EXPECT_EQ(tb::replay::beginning_of(capture.finish()).comparable, 2U);
}

}  // namespace
}  // namespace dsdpv1::replay_test
