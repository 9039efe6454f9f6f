#include "tests/driver/driver_fixture.hpp"

namespace dsdpv1 {
namespace {

using testing::ElementsAre;

class Exchange : public DriverTest {};
class InputErrors : public DriverTest {};
class DriverDiagnosis : public DriverTest {};

TEST_F(Exchange, BothDirectionsInOneHold) {
  initialise();
  chip.put_outputs({0xA1, 0xA2, 0xA3});
  ASSERT_EQ(exchange({0x11, 0x22}), DSDPV1_OK);
  EXPECT_EQ(chip.holds, 1);
  EXPECT_TRUE(result.inputs_written);
  EXPECT_THAT(chip.inputs, ElementsAre(0x11, 0x22));
  EXPECT_TRUE(result.outputs_new);
  EXPECT_THAT(received(), ElementsAre(0xA1, 0xA2, 0xA3));
  EXPECT_EQ(chip.at(0x00E), 0) << "B00E.0 is cleared";
}

TEST_F(Exchange, InputAreaByteForByte) {
  initialise();
  ASSERT_EQ(exchange({0x07}), DSDPV1_OK);
  EXPECT_THAT(chip.bytes(0x130, 2), ElementsAre(0x01, 0x07));
  const Bytes block = {0x01, 0x07};
  const std::uint16_t crc = dsdpv1_crc(DSDPV1_CRC_START, block.data(), 2);
  EXPECT_THAT(chip.bytes(0x225, 2), ElementsAre(crc >> 8, crc & 0xFF));
}

TEST_F(Exchange, FullLengthBothWays) {
  config.max_input = config.max_output = 244;
  initialise();
  chip.put_outputs(Bytes(244, 0x5A));
  ASSERT_EQ(exchange(Bytes(244, 0xA5)), DSDPV1_OK);
  EXPECT_EQ(chip.inputs, Bytes(244, 0xA5));
  EXPECT_EQ(received(), Bytes(244, 0x5A));
}

TEST_F(Exchange, WithoutInputsOnlyOutputs) {
  initialise();
  chip.put_outputs({1});
  ASSERT_EQ(dsdpv1_exchange(&device, DSDPV1_INPUT_NEWEST, nullptr, 0, &result), DSDPV1_OK);
  EXPECT_FALSE(result.inputs_written);
  EXPECT_TRUE(result.outputs_new);
}

TEST_F(Exchange, WithoutABufferTheOutputsStay) {
  initialise();
  chip.put_outputs({1});
  result.outputs = nullptr;
  ASSERT_EQ(exchange({1}), DSDPV1_OK);
  EXPECT_EQ(chip.at(0x00E), 1);
}

TEST_F(Exchange, NothingNewIsNoError) {
  initialise();
  ASSERT_EQ(exchange({1}), DSDPV1_OK);
  EXPECT_FALSE(result.outputs_new);
}

TEST_F(Exchange, EmptyOutputsAreOutputs) {
  initialise();
  chip.put_outputs({});
  ASSERT_EQ(exchange({1}), DSDPV1_OK);
  EXPECT_TRUE(result.outputs_new);
  EXPECT_EQ(result.length, 0);
}

TEST_F(Exchange, PolicyDecidesAboutInputsThatWait) {
  initialise();
  chip.takes_commands = false;
  ASSERT_EQ(exchange({1}, DSDPV1_INPUT_WHEN_CONSUMED), DSDPV1_OK);
  ASSERT_EQ(exchange({2}, DSDPV1_INPUT_WHEN_CONSUMED), DSDPV1_OK);
  EXPECT_FALSE(result.inputs_written);
  EXPECT_EQ(chip.at(0x131), 1);
  ASSERT_EQ(exchange({3}, DSDPV1_INPUT_NEWEST), DSDPV1_OK);
  EXPECT_TRUE(result.inputs_written);
  EXPECT_EQ(chip.at(0x131), 3);
}

TEST_F(Exchange, TooManyInputsAreRefusedBeforeTheHold) {
  initialise();
  EXPECT_EQ(exchange(Bytes(9)), DSDPV1_ERR_INPUT_LENGTH);
  EXPECT_EQ(chip.holds, 0);
}

TEST_F(Exchange, RefusalOfEarlierInputsIsReportedOnce) {
  initialise();
  bool once = true;
  chip.before_access = [&] {
    chip.at(0x226) = static_cast<std::uint8_t>(chip.at(0x226) ^ (std::exchange(once, false) ? 1 : 0));
  };
  EXPECT_EQ(exchange({1}), DSDPV1_OK);
  chip.put_outputs({7});
  EXPECT_EQ(exchange({2}), DSDPV1_ERR_INPUT_CRC);
  EXPECT_TRUE(result.outputs_new) << "the other direction is served";
  EXPECT_THAT(chip.inputs, ElementsAre(2));
  EXPECT_EQ(exchange({3}), DSDPV1_OK);
}

TEST_F(Exchange, OutputsReadWronglyAreReadAgain) {
  initialise();
  chip.put_outputs({0x10, 0x20});
  chip.bad_reads[0x31A] = 1;
  ASSERT_EQ(exchange({1}), DSDPV1_OK);
  EXPECT_THAT(received(), ElementsAre(0x10, 0x20));
  EXPECT_EQ(chip.holds, 3) << "exchange, repetition with B00D.2 set, B00D.2 cleared";
  EXPECT_EQ(chip.at(0x00D), 0);
}

TEST_F(Exchange, OutputsThatStayWrongAreAnError) {
  initialise();
  chip.put_outputs({0x10, 0x20});
  chip.at(0x40F) = static_cast<std::uint8_t>(chip.at(0x40F) ^ 1);
  EXPECT_EQ(exchange({1}), DSDPV1_ERR_OUTPUT_CRC);
  EXPECT_FALSE(result.outputs_new);
  EXPECT_TRUE(result.inputs_written);
  EXPECT_EQ(chip.at(0x00D), 0x04);
  chip.put_outputs({0x30});
  EXPECT_EQ(exchange({1}), DSDPV1_OK);
  EXPECT_EQ(chip.at(0x00D), 0);
}

TEST_F(Exchange, OutputsLongerThanTheBuffer) {
  initialise();
  chip.put_outputs({1, 2, 3});
  result.capacity = 2;
  EXPECT_EQ(exchange({1}), DSDPV1_ERR_OUTPUT_LENGTH);
  EXPECT_FALSE(result.outputs_new);
}

TEST_F(Exchange, ImpossibleOutputLengthIsNeverRead) {
  initialise();
  chip.put_outputs({1});
  chip.at(0x319) = 245;
  result.capacity = 244;
  EXPECT_EQ(exchange({1}), DSDPV1_ERR_OUTPUT_LENGTH);
}

TEST_F(Exchange, TellsOfBlocksWhoseIntr0WasNotSeen) {
  initialise();
  chip.put_prm({1});
  ASSERT_EQ(exchange({1}), DSDPV1_OK);
  EXPECT_TRUE(result.intr0_missed);
}

TEST_F(InputErrors, OfTheHistoryStayUntilTheyAreCleared) {
  initialise();
  ASSERT_EQ(dsdpv1_keep_input_errors(&device, true), DSDPV1_OK);
  EXPECT_EQ(chip.holds, 1);
  EXPECT_EQ(chip.at(0x011), 0x40);
  bool once = true;
  chip.before_access = [&] {
    chip.at(0x226) = static_cast<std::uint8_t>(chip.at(0x226) ^ (std::exchange(once, false) ? 1 : 0));
  };
  EXPECT_EQ(exchange({1}), DSDPV1_OK);
  for (const std::uint8_t right : Bytes{2, 3, 4}) {
    EXPECT_EQ(exchange({right}), DSDPV1_ERR_INPUT_CRC);
    EXPECT_THAT(chip.inputs, ElementsAre(right)) << "the inputs themselves are taken";
  }
  ASSERT_EQ(dsdpv1_clear_input_error(&device), DSDPV1_OK);
  EXPECT_EQ(exchange({5}), DSDPV1_OK);
  EXPECT_EQ(chip.at(0x011), 0x40) << "history stays chosen";
}

TEST_F(InputErrors, OfThePresentAreChosenAgainAndNotCleared) {
  initialise();
  chip.at(0x00B) = 0x04;
  ASSERT_EQ(dsdpv1_clear_input_error(&device), DSDPV1_OK);
  EXPECT_EQ(chip.at(0x00B), 0x04);
  ASSERT_EQ(dsdpv1_keep_input_errors(&device, true), DSDPV1_OK);
  ASSERT_EQ(dsdpv1_keep_input_errors(&device, false), DSDPV1_OK);
  EXPECT_EQ(chip.at(0x011), 0);
  EXPECT_EQ(exchange({1}), DSDPV1_ERR_INPUT_CRC);
  EXPECT_EQ(exchange({1}), DSDPV1_OK) << "the right block has cleared it";
}

TEST_F(InputErrors, LeaveTheAnswersThatWaitInB011) {
  initialise();
  chip.takes_commands = false;
  chip.at(0x011) = 0x03;
  ASSERT_EQ(dsdpv1_keep_input_errors(&device, true), DSDPV1_OK);
  EXPECT_EQ(chip.at(0x011), 0x43);
  ASSERT_EQ(dsdpv1_clear_input_error(&device), DSDPV1_OK);
  EXPECT_EQ(chip.at(0x011), 0xC3);
  ASSERT_EQ(dsdpv1_keep_input_errors(&device, false), DSDPV1_OK);
  EXPECT_EQ(chip.at(0x011), 0x83);
}

TEST_F(InputErrors, OfANullDeviceAreRefused) {
  EXPECT_EQ(dsdpv1_keep_input_errors(nullptr, true), DSDPV1_ERR_ARGUMENT);
  EXPECT_EQ(dsdpv1_clear_input_error(nullptr), DSDPV1_ERR_ARGUMENT);
  EXPECT_EQ(chip.holds, 0);
}

TEST_F(DriverDiagnosis, AreaByteForByte) {
  initialise();
  const Bytes data = {0x03, 0x11, 0x22};
  ASSERT_EQ(dsdpv1_set_diagnosis(&device, DSDPV1_DIAG_EXTERNAL, data.data(), 3), DSDPV1_OK);
  const Bytes area = {0x81, 0x03, 0x03, 0x11, 0x22};
  EXPECT_EQ(chip.diagnosis, area);
  const std::uint16_t crc = dsdpv1_crc(DSDPV1_CRC_START, area.data(), area.size());
  EXPECT_THAT(chip.bytes(0x317, 2), ElementsAre(crc >> 8, crc & 0xFF));
}

TEST_F(DriverDiagnosis, AllFiveTypes) {
  initialise();
  for (const auto type : {DSDPV1_DIAG_EXTENDED, DSDPV1_DIAG_EXTERNAL_GONE, DSDPV1_DIAG_EXTERNAL,
                          DSDPV1_DIAG_STATIC_GONE, DSDPV1_DIAG_STATIC}) {
    ASSERT_EQ(dsdpv1_set_diagnosis(&device, type, nullptr, 0), DSDPV1_OK);
    EXPECT_THAT(chip.diagnosis, ElementsAre(type, 0));
  }
  EXPECT_EQ(dsdpv1_set_diagnosis(&device, static_cast<dsdpv1_diag_type>(0x80), nullptr, 0), DSDPV1_ERR_DIAG_TYPE);
}

TEST_F(DriverDiagnosis, LongerThanInitialised) {
  initialise();
  const Bytes data(10);
  EXPECT_EQ(dsdpv1_set_diagnosis(&device, DSDPV1_DIAG_STATIC, data.data(), 10), DSDPV1_ERR_DIAG_LENGTH);
  EXPECT_EQ(chip.holds, 0);
}

TEST_F(DriverDiagnosis, NotTaken) {
  initialise();
  chip.takes_commands = false;
  device.tuning.init_polls = 5;
  EXPECT_EQ(dsdpv1_set_diagnosis(&device, DSDPV1_DIAG_STATIC, nullptr, 0), DSDPV1_ERR_DIAG_TIMEOUT);
}

TEST_F(DriverDiagnosis, WrittenAgainAfterACrcError) {
  initialise();
  int errors = 2;
  chip.before_access = [&] {
    if ((chip.at(0x010) & 2) != 0 && errors-- > 0) chip.at(0x318) = static_cast<std::uint8_t>(chip.at(0x318) ^ 1);
  };
  EXPECT_EQ(dsdpv1_set_diagnosis(&device, DSDPV1_DIAG_STATIC, nullptr, 0), DSDPV1_OK);
  errors = 3;
  EXPECT_EQ(dsdpv1_set_diagnosis(&device, DSDPV1_DIAG_STATIC, nullptr, 0), DSDPV1_ERR_DIAG_CRC);
}

}  // namespace
}  // namespace dsdpv1
