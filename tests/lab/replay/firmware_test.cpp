// The evidence about the slave's user CPU in a capture.
#include "lab/replay/firmware.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <variant>

#include "tests/lab/replay/captures.hpp"

namespace dsdpv1::replay_test {
namespace {

using tb::replay::Firmware;
using tb::replay::firmware_of;
using testing::IsEmpty;
using testing::SizeIs;
using user_cpu::command::SetDiagnosis;
using user_cpu::command::SetInputs;

namespace sap = bus::sap;

const Bytes kPrm = {0x80, 0, 0, 11, 0x12, 0x34, 0};

/// Inputs and diagnoses that the user CPU gets.
Firmware data_of(const tb::replay::Recording& recording) {
  Firmware firmware = firmware_of(recording);
  firmware.supplies = supplies_for(firmware.supplies, {}, {}, true);
  return firmware;
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
  capture.add(to_slave(sap::kGetCfg));
  capture.add(from_slave(sap::kGetCfg, {0x22}));
  EXPECT_EQ(firmware_of(capture.finish()).init.cfg_mode, 1);
}

TEST(Firmware, NewInputsAreGivenWhenTheAnswerBeforeHasEnded) {
  Capture capture;
  start_up(capture);
  exchange(capture, {1});
  const bus::Tick end = exchange(capture, {1});
  exchange(capture, {2});
  exchange(capture, {2});
  const Firmware firmware = data_of(capture.finish());
  ASSERT_THAT(firmware.supplies, SizeIs(1));
  EXPECT_EQ(firmware.supplies[0].at, end);
  EXPECT_EQ(std::get<SetInputs>(firmware.supplies[0].command).bytes, Bytes{2});
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
  const Firmware firmware = data_of(capture.finish());
  ASSERT_THAT(firmware.supplies, SizeIs(1));
  EXPECT_EQ(firmware.supplies[0].at, end);
  const auto& given = std::get<SetDiagnosis>(firmware.supplies[0].command);
  EXPECT_EQ(given.kind, user_cpu::DiagnosisKind::kExternal);
  EXPECT_EQ(given.bytes, (Bytes{3, 0xA5, 0x5A}));
}

TEST(Firmware, DiagnosisThatGoesIsOneToo) {
  Capture capture;
  start_up(capture);
  exchange(capture, {1});
  for (const Bytes& bytes : {diagnosis(0x08, 0x04, {2, 1}), diagnosis(0, 0x04), diagnosis(0, 0x04)}) {
    capture.add(to_slave(sap::kSlaveDiag));
    capture.add(from_slave(sap::kSlaveDiag, bytes));
  }
  const Firmware firmware = data_of(capture.finish());
  ASSERT_THAT(firmware.supplies, SizeIs(2));
  const auto& given = std::get<SetDiagnosis>(firmware.supplies[1].command);
  EXPECT_EQ(given.kind, user_cpu::DiagnosisKind::kExternalGone);
  EXPECT_THAT(given.bytes, IsEmpty());
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

TEST(Firmware, SlaveThatRefusesTheExchangeInTimeHasLeftIt) {
  for (const std::uint8_t watchdog : {std::uint8_t{0}, std::uint8_t{1}}) {
    Capture capture;
    Bytes prm = kPrm;
    if (watchdog != 0) prm[0] |= 0x08;
    prm[1] = prm[2] = watchdog;  // 10 ms
    capture.add(to_slave(sap::kSetPrm, prm));
    capture.add(bus::make_sc());
    const bus::Tick end = exchange(capture, {1});
    capture.add(bus::encode(outputs({1})), 20'000, 0);  // after 13 ms
    capture.add(bus::make_telegram(kMaster, kSlave, bus::fc::kRs));
    capture.add(to_slave(sap::kSlaveDiag));
    capture.add(from_slave(sap::kSlaveDiag, diagnosis(0x02, 0x05)));
    const bus::Tick again = exchange(capture, {1});
    const Firmware firmware = firmware_of(capture.finish());
    ASSERT_THAT(firmware.restarts, SizeIs(watchdog != 0 ? 0 : 1));
    if (watchdog != 0) continue;
    EXPECT_EQ(firmware.restarts[0].from, end);
    EXPECT_EQ(firmware.restarts[0].until, again);
  }
}

TEST(Firmware, NoResourceForASetPrmIsABufferOfItsLength) {
  Capture capture;
  capture.add(to_slave(sap::kSetPrm, Bytes(7 + 40)));
  capture.add(bus::make_telegram(kMaster, kSlave, bus::fc::kRr));
  start_up(capture);
  const Firmware firmware = firmware_of(capture.finish());
  EXPECT_TRUE(firmware.short_prm_buffer);
  EXPECT_EQ(firmware.init.max_prm, 39);
  EXPECT_EQ(firmware.init.max_inputs, 2);  // of configuration 11
  EXPECT_EQ(firmware.init.max_outputs, 0);
  EXPECT_EQ(firmware.init.max_cfg, 1);
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
