// Faults on SPI and UART, and the driver's reaction.
#include "tests/driver/acyclic_fixture.hpp"

namespace dsdpv1 {
namespace {

using testing::ElementsAre;
using testing::SizeIs;

class Spi : public AcyclicTest {
 protected:
  FakePort port_kind() const override { return FakePort::kSpi; }
};

class DriverUart : public AcyclicTest {
 protected:
  FakePort port_kind() const override { return FakePort::kUart; }
  /// The chip does `what` right before the next exchange telegram: after the host has read its flags.
  void before_exchange(std::function<void()> what) {
    rsu.before_telegram = [what = std::move(what), once = true](const Bytes& request) mutable {
      if (request[0] == 0x41 && std::exchange(once, false)) what();
    };
  }
};

class Serial : public DriverTest, public testing::WithParamInterface<FakePort> {
 protected:
  FakePort port_kind() const override { return GetParam(); }
  dsdpv1_serial& serial() { return GetParam() == FakePort::kSpi ? rsu.spi.serial : rsu.uart.serial; }
};

INSTANTIATE_TEST_SUITE_P(Both, Serial, testing::Values(FakePort::kSpi, FakePort::kUart),
                         [](const auto& port) { return port.param == FakePort::kSpi ? "Spi" : "Uart"; });

TEST_P(Serial, TelegramsAreRepeatedUntilTheReplyIsRight) {
  initialise();
  chip.put_outputs({7});
  rsu.spoilt_requests = 1;
  EXPECT_EQ(exchange({1}), DSDPV1_OK);
  EXPECT_EQ(serial().error_code, 1) << "7.1.6: bit 0 is the CRC";
  chip.put_outputs({8});
  rsu.spoilt_replies = 1;
  EXPECT_EQ(exchange({2}), DSDPV1_OK);
  rsu.deaf = 1;
  EXPECT_EQ(exchange({3}), DSDPV1_OK);
  rsu.failing_calls = 1;
  EXPECT_EQ(exchange({4}), DSDPV1_OK);
  EXPECT_EQ(serial().repetitions, 4U);
  EXPECT_THAT(received(), ElementsAre(8));
  EXPECT_THAT(chip.inputs, ElementsAre(4));
}

TEST_P(Serial, EachPlaceOfADisturbanceIsHealed) {
  config.dpv1 = true;
  for (int place = 0; place < 12; ++place) {
    initialise(2, 2);
    chip.put_prm({static_cast<std::uint8_t>(place)});
    chip.put_outputs({static_cast<std::uint8_t>(place)});
    int telegrams = 0;
    rsu.before_telegram = [&](const Bytes&) { rsu.spoilt_replies = telegrams++ == place ? 1 : 0; };
    EXPECT_EQ(exchange({1}), DSDPV1_OK) << place;
    EXPECT_EQ(dsdpv1_service(&device), DSDPV1_OK) << place;
    rsu.before_telegram = nullptr;
    EXPECT_THAT(received(), ElementsAre(place)) << place;
    ASSERT_FALSE(prm_seen.empty()) << place;
    EXPECT_THAT(prm_seen.back(), ElementsAre(place)) << place;
    // A verdict whose reply is destroyed is written twice; over the UART the chip may have taken it meanwhile: H7
    // discards it.
    EXPECT_THAT(chip.verdicts, testing::Each("prm ok")) << place;
    EXPECT_THAT(chip.verdicts, SizeIs(testing::AllOf(testing::Ge(1U), testing::Le(2U)))) << place;
    chip.verdicts.clear();
    EXPECT_EQ(chip.at(0x00E), 0) << place;
  }
}

TEST_P(Serial, ADeadLineIsAnErrorAndWhatWaitedIsThereAfterwards) {
  initialise(2, 0);
  chip.put_prm({5});
  chip.put_outputs({6});
  const int last = GetParam() == FakePort::kUart ? 1 : 3;  // read, exchange; claim, read, read and write, release
  for (int telegrams = 0; telegrams <= last; ++telegrams) {
    int seen = 0;
    rsu.before_telegram = [&](const Bytes&) { rsu.deaf = seen++ >= telegrams ? 1 : 0; };
    EXPECT_EQ(exchange({1}), DSDPV1_ERR_NO_REPLY) << telegrams;
    EXPECT_FALSE(result.outputs_new);
  }
  rsu.before_telegram = nullptr;
  rsu.deaf = 0;
  EXPECT_EQ(dsdpv1_service(&device), DSDPV1_OK);
  EXPECT_THAT(prm_seen, ElementsAre(Bytes{5}));
}

TEST_P(Serial, RepliesThatStayWrongAreAnErrorOfTheirOwn) {
  initialise();
  device.tuning.telegram_retries = 1;
  rsu.spoilt_requests = 2;
  EXPECT_EQ(exchange({1}), DSDPV1_ERR_TELEGRAM);
  rsu.spoilt_requests = 0;
  rsu.spoilt_replies = 2;
  EXPECT_EQ(exchange({1}), DSDPV1_ERR_REPLY);
}

TEST_P(Serial, ABlockCrcIsWrittenForAChipThatJudgesIt) {
  rsu.spi.block_crc = rsu.uart.block_crc = true;
  ASSERT_EQ(rsu.open(GetParam(), device, judge), DSDPV1_OK);
  chip.looks_at_crcs = true;
  initialise();
  for (const std::uint8_t input : Bytes{1, 2}) {  // with new outputs, and without
    if (input == 2) chip.put_outputs({7});
    EXPECT_EQ(exchange({input}), DSDPV1_OK);
    EXPECT_THAT(chip.inputs, ElementsAre(input));
  }
  EXPECT_EQ(dsdpv1_set_diagnosis(&device, DSDPV1_DIAG_STATIC, nullptr, 0), DSDPV1_OK);
  EXPECT_THAT(chip.diagnosis, ElementsAre(0x82, 0));
}

TEST_P(Serial, AChipInItsResetIsWaitedFor) {
  rsu.deaf = 30;
  EXPECT_EQ(dsdpv1_wait_ready(&device), DSDPV1_OK);
  device.tuning.ready_polls = 3;
  rsu.deaf = 1000;
  EXPECT_EQ(dsdpv1_wait_ready(&device), DSDPV1_ERR_NO_REPLY);
}

TEST_P(Serial, PortsThatCannotWorkAreNotOpened) {
  rsu.spi.address = rsu.uart.address = 3;
  EXPECT_EQ(dsdpv1_open_spi(&device, &rsu.spi, nullptr), DSDPV1_ERR_ARGUMENT);
  EXPECT_EQ(dsdpv1_open_uart(&device, &rsu.uart, nullptr), DSDPV1_ERR_ARGUMENT);
  rsu.spi.address = rsu.uart.address = 1;
  rsu.spi.spare = DSDPV1_SPI_SPARE + 1;
  rsu.uart.baud = 0;
  EXPECT_EQ(dsdpv1_open_spi(&device, &rsu.spi, nullptr), DSDPV1_ERR_ARGUMENT);
  EXPECT_EQ(dsdpv1_open_uart(&device, &rsu.uart, nullptr), DSDPV1_ERR_ARGUMENT);
}

// ----------------------------------------------------------------------------------------------------------------- SPI

TEST_F(Spi, ExchangeIsAClaimALookAReadAndWriteAndARelease) {
  initialise();
  chip.put_outputs({0xAA});
  rsu.requests.clear();
  ASSERT_EQ(exchange({0x55}), DSDPV1_OK);
  ASSERT_THAT(rsu.requests, SizeIs(4));
  EXPECT_THAT(Bytes(rsu.requests[0].begin(), rsu.requests[0].end() - 2), ElementsAre(0x21, 0x00, 0x14, 1, 2));
  EXPECT_THAT(Bytes(rsu.requests[1].begin(), rsu.requests[1].end() - 2), ElementsAre(0x01, 0x00, 0x0A, 10));
  EXPECT_THAT(Bytes(rsu.requests[2].begin(), rsu.requests[2].end() - 2), ElementsAre(0x41, 1, 0x55));
  EXPECT_THAT(Bytes(rsu.requests[3].begin(), rsu.requests[3].end() - 2), ElementsAre(0x21, 0x00, 0x14, 1, 0));
}

TEST_F(Spi, ClaimIsTriedAgainWhileTheChipIsInAnAccess) {
  rsu.busy_claims = 5;
  EXPECT_EQ(dsdpv1_wait_ready(&device), DSDPV1_OK);
  EXPECT_EQ(chip.holds, 1);
  EXPECT_EQ(rsu.spi.serial.repetitions, 0U) << "a refusal is no disturbance";
  device.tuning.acquire_polls = 3;
  rsu.busy_claims = 100;
  EXPECT_EQ(dsdpv1_wait_ready(&device), DSDPV1_ERR_DPRAM_BUSY);
}

TEST_F(Spi, ClaimWhoseRepliesWereAllDestroyedIsGivenBack) {
  initialise();
  rsu.requests.clear();
  rsu.spoilt_replies = 1 + device.tuning.telegram_retries;
  EXPECT_EQ(exchange({0x55}), DSDPV1_ERR_REPLY);
  ASSERT_THAT(rsu.requests, SizeIs(2U + device.tuning.telegram_retries));
  EXPECT_THAT(Bytes(rsu.requests.back().begin(), rsu.requests.back().end() - 2), ElementsAre(0x21, 0x00, 0x14, 1, 0));
}

TEST_F(Spi, ReplyIsFoundWhereItBegins) {
  rsu.spi.spare = 3;
  ASSERT_EQ(rsu.open(FakePort::kSpi, device, judge), DSDPV1_OK);
  for (const int gap : {0, 1, 3}) {
    rsu.reply_gap = gap;
    initialise();
    chip.put_outputs({4, 5});
    EXPECT_EQ(exchange({1}), DSDPV1_OK) << gap;
    EXPECT_THAT(received(), ElementsAre(4, 5)) << gap;
  }
  rsu.reply_gap = 4;
  EXPECT_NE(exchange({1}), DSDPV1_OK);
}

TEST_F(Spi, CallFromAnInterruptDuringAHoldIsRefused) {
  initialise();
  dsdpv1_error nested = DSDPV1_OK;
  rsu.before_telegram = [&](const Bytes&) { nested = dsdpv1_service(&device); };
  EXPECT_EQ(exchange({1}), DSDPV1_OK);
  EXPECT_EQ(nested, DSDPV1_ERR_NESTED);
}

// ---------------------------------------------------------------------------------------------------------------- UART

TEST_F(DriverUart, ExchangeIsALookAndAnExchangeTelegram) {
  initialise();
  chip.put_outputs({0xAA});
  rsu.requests.clear();
  ASSERT_EQ(exchange({0x55}), DSDPV1_OK);
  ASSERT_THAT(rsu.requests, SizeIs(2));
  EXPECT_THAT(rsu.requests[1], ElementsAre(0x41, 0x00, 0x01, 0x30, 0x02, 0x01, 0x55, 0xAB, 0x18)) << "section 10";
}

TEST_F(DriverUart, DiagnosisAndAnswersAreExchangesWithTheirFunctionAndAddress) {
  config.dpv1 = true;
  open();
  rsu.requests.clear();
  ASSERT_EQ(dsdpv1_set_diagnosis(&device, DSDPV1_DIAG_STATIC, nullptr, 0), DSDPV1_OK);
  EXPECT_THAT(Bytes(rsu.requests[0].begin(), rsu.requests[0].begin() + 7), ElementsAre(0x41, 2, 2, 0x27, 2, 0x82, 0));
  chip.put_request(2, {0x5E, 1, 1, 4});
  ASSERT_EQ(poll(), DSDPV1_OK);
  EXPECT_THAT(Bytes(rsu.requests.back().begin(), rsu.requests.back().begin() + 6),
              ElementsAre(0x41, 0, 6, 0xD0, 8, 0x5E));
}

TEST_F(DriverUart, ABlockThatComesAfterTheLookIsNotWipedOut) {
  initialise(2, 2);
  ASSERT_EQ(exchange({1}), DSDPV1_OK);
  before_exchange([&] { chip.put_prm({4}); });
  ASSERT_EQ(exchange({1}), DSDPV1_OK);
  EXPECT_TRUE(result.intr0_missed);
  EXPECT_EQ(dsdpv1_service(&device), DSDPV1_OK);
  EXPECT_THAT(prm_seen, ElementsAre(Bytes{4}));
}

TEST_F(DriverUart, ANewerBlockThatComesWhileItsFlagIsTakenIsJudged) {
  initialise(2, 2);
  chip.put_prm({1});
  before_exchange([&] { chip.put_prm({2}); });
  EXPECT_EQ(dsdpv1_service(&device), DSDPV1_OK);
  EXPECT_THAT(prm_seen.back(), ElementsAre(2));
}

TEST_F(DriverUart, OutputsThatComeAfterTheLookAreGivenToTheApplication) {
  initialise();
  chip.put_outputs({1});
  ASSERT_EQ(exchange({1}), DSDPV1_OK);
  ASSERT_EQ(exchange({1}), DSDPV1_OK);
  EXPECT_FALSE(result.outputs_new);
  before_exchange([&] { chip.put_outputs({2}); });
  ASSERT_EQ(exchange({1}), DSDPV1_OK);
  EXPECT_TRUE(result.outputs_new);
  EXPECT_THAT(received(), ElementsAre(2));
  EXPECT_EQ(chip.at(0x00E), 0);
}

TEST_F(DriverUart, OutputsBeforeDataExchangeAreNotNew) {
  initialise();
  rsu.data_exchange = false;
  ASSERT_EQ(exchange({1}), DSDPV1_OK);
  EXPECT_FALSE(result.outputs_new);
}

TEST_F(DriverUart, ABlockWhoseReplyWasDestroyedIsReadAgain) {
  config.dpv1 = true;
  open();
  chip.put_request(1, {0x5E, 1, 1, 4});
  before_exchange([&] { rsu.spoilt_replies = 1; });
  ASSERT_EQ(exchange({1}), DSDPV1_OK);
  EXPECT_EQ(chip.at(0x00F), 0) << "UA11: cleared with the reply";
  ASSERT_EQ(poll(), DSDPV1_OK);
  EXPECT_THAT(last_answer(1), ElementsAre(0x5E, 1, 1, 4, 0x11, 0x22, 0x33, 0x44));
}

TEST_F(DriverUart, ARequestThatCameSinceTheLastLookIsNotLostWithTheReply) {
  config.dpv1 = true;
  open();
  ASSERT_EQ(exchange({1}), DSDPV1_OK);
  before_exchange([&] {
    chip.put_request(1, {0x5E, 1, 1, 4});
    rsu.spoilt_replies = 1;
  });
  ASSERT_EQ(exchange({1}), DSDPV1_OK);
  EXPECT_EQ(chip.at(0x00F), 0);
  ASSERT_EQ(poll(), DSDPV1_OK);
  EXPECT_THAT(last_answer(1), ElementsAre(0x5E, 1, 1, 4, 0x11, 0x22, 0x33, 0x44));
}

TEST_F(DriverUart, ParametersThatCameSinceTheLastLookAreNotLostWithTheReply) {
  initialise(2, 2);
  chip.put_prm({3});
  chip.put_cfg(4, 8, {0x17, 0x23});
  ASSERT_EQ(dsdpv1_service(&device), DSDPV1_OK);
  ASSERT_EQ(exchange({1}), DSDPV1_OK);
  before_exchange([&] {
    chip.put_prm({4});
    dsdpv1_on_intr0(&device);
    rsu.spoilt_replies = 1;
  });
  ASSERT_EQ(exchange({1}), DSDPV1_OK);
  EXPECT_EQ(chip.at(0x00E), 0);
  EXPECT_EQ(dsdpv1_service(&device), DSDPV1_OK);
  EXPECT_THAT(prm_seen, ElementsAre(Bytes{3}, Bytes{4}));
}

TEST_F(DriverUart, AWriteIsNotCarriedOutAgainAfterALostReply) {
  config.dpv1 = true;
  open();
  chip.put_request(1, {0x5F, 1, 1, 1, 0x99});
  ASSERT_EQ(poll(), DSDPV1_OK);
  const int answers = chip.answers_taken;
  before_exchange([&] { rsu.spoilt_replies = 1; });
  ASSERT_EQ(exchange({1}), DSDPV1_OK);
  ASSERT_EQ(poll(), DSDPV1_OK);
  EXPECT_EQ(chip.answers_taken, answers);
}

TEST_F(DriverUart, AnAnswerThatWaitsIsNotAnnouncedTwice) {
  config.dpv1 = true;
  open();
  chip.takes_commands = false;
  chip.put_request(1, {0x5E, 1, 1, 4});
  ASSERT_EQ(poll(), DSDPV1_OK);
  chip.takes_commands = true;
  int looks = 0;
  chip.before_access = [&] { chip.takes_commands = ++looks != 1; };  // the chip takes it after the first read
  ASSERT_EQ(dsdpv1_keep_input_errors(&device, true), DSDPV1_OK);
  EXPECT_EQ(chip.answers_taken, 1);
  EXPECT_EQ(chip.at(0x011), 0x40);
}

TEST_F(DriverUart, HistoryThatStandsIsNotWaitedFor) {
  initialise();
  const auto telegrams = [this] {
    rsu.requests.clear();
    EXPECT_EQ(dsdpv1_clear_input_error(&device), DSDPV1_OK);
    return rsu.requests.size();
  };
  const std::size_t without = telegrams();
  ASSERT_EQ(dsdpv1_keep_input_errors(&device, true), DSDPV1_OK);
  EXPECT_EQ(telegrams(), without);
}

TEST_F(DriverUart, WaitsForAReplyAsLongAsTheRateAsks) {
  rsu.deaf = 1000;
  device.tuning.ready_polls = 1;
  EXPECT_EQ(dsdpv1_wait_ready(&device), DSDPV1_ERR_NO_REPLY);
  EXPECT_GE(rsu.longest_timeout_us, 3U * 11U * 1000000U / 9600U) << "three characters at 9600 bit/s";
  EXPECT_LE(rsu.longest_timeout_us, 8U * 11U * 1000000U / 9600U);
}

}  // namespace
}  // namespace dsdpv1
