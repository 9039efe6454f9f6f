// DPV1 between DPRAM and application: flags, CRCs, holds, both classes at once.
#include "tests/driver/acyclic_fixture.hpp"

namespace dsdpv1 {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

class AcyclicPoll : public AcyclicTestOfEachClass {};
INSTANTIATE_TEST_SUITE_P(Class, AcyclicPoll, testing::Values(1, 2));

TEST_P(AcyclicPoll, NothingToDoCostsOneShortHold) {
  open();
  chip.accesses = 0;
  EXPECT_EQ(poll(), DSDPV1_OK);
  EXPECT_EQ(chip.holds, 1);
  EXPECT_EQ(chip.accesses, 3);
  EXPECT_EQ(done.received | done.answered | done.open, 0);
}

TEST_P(AcyclicPoll, RequestIsTakenAndAnsweredInTwoHolds) {
  open();
  EXPECT_THAT(ask(cls(), {0x5E, 1, 1, 4}), ElementsAre(0x5E, 1, 1, 4, 0x11, 0x22, 0x33, 0x44));
  EXPECT_EQ(chip.holds, 2);
  EXPECT_EQ(chip.at(0x00F), 0);
  EXPECT_EQ(done.received, cls());
  EXPECT_EQ(done.answered, cls());
  EXPECT_EQ(done.refused, 0);
}

TEST_P(AcyclicPoll, FlagIsClearedInTheHoldThatReadTheRequest) {
  open();
  std::vector<int> flags;
  chip.before_access = [&] { flags.push_back(chip.at(0x00F)); };
  static_cast<void>(ask(cls(), {0x5E, 1, 1, 4}));
  EXPECT_THAT(flags, ElementsAre(0, 0));
}

TEST_P(AcyclicPoll, ReservedBitsOfTheChipsCommandByteAreLeftAlone) {
  open();
  chip.at(0x00F) = 0x80;
  static_cast<void>(ask(cls(), {0x5E, 1, 1, 4}));
  EXPECT_EQ(chip.at(0x00F), 0x80);
}

TEST_P(AcyclicPoll, AnswerHasItsCrcAndFlag) {
  open();
  std::uint8_t flags = 0;
  chip.before_access = [&] { flags = static_cast<std::uint8_t>(flags | chip.at(0x011)); };
  static_cast<void>(ask(cls(), {0x5E, 1, 2, 2}));
  const Bytes expected = {0x5E, 1, 2, 2, 0x11, 0x22};
  EXPECT_EQ(chip.bytes(area(0), 6), expected);
  const std::uint16_t crc = dsdpv1_crc(DSDPV1_CRC_START, expected.data(), expected.size());
  EXPECT_THAT(chip.bytes(area(0xF4), 2), ElementsAre(crc >> 8, crc & 0xFF));
  EXPECT_EQ(flags, cls()) << "B011 of its own class only";
}

TEST_P(AcyclicPoll, LargestRequestAndAnswer) {
  open();
  const Bytes data(240, 0xC3);
  EXPECT_THAT(ask(cls(), with_data({0x5F, 1, 5, 240}, data)), ElementsAre(0x5F, 1, 5, 240));
  EXPECT_EQ(largest, data);
  EXPECT_EQ(ask(cls(), {0x5E, 1, 5, 240}), with_data({0x5E, 1, 5, 240}, data));
}

TEST_P(AcyclicPoll, EveryLengthGoesThroughUnchanged) {
  open();
  for (int length = 0; length <= 240; ++length) {
    Bytes data(static_cast<std::size_t>(length));
    for (std::size_t i = 0; i < data.size(); ++i)
      data[i] = static_cast<std::uint8_t>(i * 7 + static_cast<std::size_t>(length));
    const auto byte = static_cast<std::uint8_t>(length);
    ASSERT_THAT(ask(cls(), with_data({0x5F, 1, 5, byte}, data)), ElementsAre(0x5F, 1, 5, byte));
    ASSERT_EQ(ask(cls(), {0x5E, 1, 5, byte}), with_data({0x5E, 1, 5, byte}, data));
  }
}

TEST_P(AcyclicPoll, RequestReadWronglyIsReadAgain) {
  open();
  chip.bad_reads[area(5)] = 2;
  std::vector<int> told;
  chip.before_access = [&] { told.push_back(chip.at(0x00D)); };
  EXPECT_THAT(ask(cls(), {0x5F, 1, 1, 2, 0xAA, 0xBB}), ElementsAre(0x5F, 1, 1, 2));
  EXPECT_THAT(parameter, ElementsAre(0xAA, 0xBB, 0x33, 0x44));
  const int bit = cls() == 1 ? 0x10 : 0x08;
  EXPECT_THAT(told, ElementsAre(0, bit, bit, 0, 0)) << "B00D tells while it is wrong";
}

TEST_P(AcyclicPoll, RequestThatStaysWrongIsNotCarriedOutAndReadAgainAtTheNextPoll) {
  open();
  chip.put_request(cls(), {0x5F, 1, 1, 1, 0xAA});
  spoil_crc();
  EXPECT_EQ(poll(), cls() == 1 ? DSDPV1_ERR_C1_CRC : DSDPV1_ERR_C2_CRC);
  EXPECT_EQ(parameter[0], 0x11);
  EXPECT_EQ(chip.at(0x00D), cls() == 1 ? 0x10 : 0x08);
  EXPECT_EQ(done.received, 0);
  spoil_crc();
  EXPECT_EQ(poll(), DSDPV1_OK);
  EXPECT_EQ(parameter[0], 0xAA);
  EXPECT_EQ(chip.at(0x00D), 0);
  EXPECT_EQ(poll(), DSDPV1_OK);
  EXPECT_EQ(chip.answers_taken, 1) << "carried out once";
}

TEST_P(AcyclicPoll, ImpossibleLengthIsNeverRead) {
  open();
  chip.put_request(cls(), {0x5F, 1, 1, 241});
  EXPECT_EQ(poll(), cls() == 1 ? DSDPV1_ERR_C1_LENGTH : DSDPV1_ERR_C2_LENGTH);
  EXPECT_EQ(chip.answers_taken, 0);
}

TEST_P(AcyclicPoll, RequestReplacedWhileItIsReadAgainIsServedOnce) {
  open();
  int served = 0;
  while_handling = [&] { ++served; };
  chip.put_request(cls(), {0x5F, 2, 1, 1, 0xAA});
  spoil_crc();
  chip.before_access = [&, once = true]() mutable {
    if (std::exchange(once, false)) chip.put_request(cls(), {0x5F, 2, 1, 1, 0xBB});
  };
  EXPECT_EQ(poll(), DSDPV1_OK);
  EXPECT_THAT(seen_data, ElementsAre(0xBB));
  EXPECT_EQ(poll(), DSDPV1_OK);
  EXPECT_EQ(served, 1);
  EXPECT_EQ(chip.answers_taken, 1);
}

TEST_P(AcyclicPoll, RequestThatStaysWrongIsForgottenByAnInitialisation) {
  open();
  chip.put_request(cls(), {0x5F, 1, 1, 1, 0xAA});
  spoil_crc();
  EXPECT_NE(poll(), DSDPV1_OK);
  initialise();
  spoil_crc();
  EXPECT_EQ(poll(), DSDPV1_OK);
  EXPECT_EQ(done.received, 0);
  EXPECT_EQ(parameter[0], 0x11);
}

TEST_P(AcyclicPoll, HoldThatFailsWhileReadingAgainLosesNothing) {
  open();
  chip.put_request(cls(), {0x5F, 1, 1, 1, 0xAA});
  chip.bad_reads[area(4)] = 1;
  device.tuning.acquire_polls = 10;
  bool once = true;
  chip.before_access = [&] { chip.busy_samples = std::exchange(once, false) ? 20 : 0; };
  EXPECT_EQ(poll(), DSDPV1_ERR_DPRAM_BUSY);
  EXPECT_EQ(poll(), DSDPV1_OK);
  EXPECT_EQ(parameter[0], 0xAA);
}

TEST_P(AcyclicPoll, AnswerThatFoundNoHoldGoesWithTheNextPoll) {
  open();
  chip.put_request(cls(), {0x5E, 1, 1, 1});
  device.tuning.acquire_polls = 10;
  bool once = true;
  chip.before_access = [&] { chip.busy_samples = std::exchange(once, false) ? 20 : 0; };
  EXPECT_EQ(poll(), DSDPV1_ERR_DPRAM_BUSY);
  EXPECT_EQ(poll(), DSDPV1_OK);
  EXPECT_THAT(last_answer(cls()), ElementsAre(0x5E, 1, 1, 1, 0x11));
}

TEST_P(AcyclicPoll, AnswerRefusedForItsCrcIsWrittenAgain) {
  open();
  int errors = 2;
  chip.before_access = [&] {
    if (chip.at(0x011) != 0 && errors-- > 0) spoil_crc();
  };
  EXPECT_THAT(ask(cls(), {0x5E, 1, 1, 4}), IsEmpty());
  EXPECT_EQ(poll(), DSDPV1_OK);
  EXPECT_EQ(done.repeated, cls());
  EXPECT_THAT(last_answer(cls()), IsEmpty());
  EXPECT_EQ(poll(), DSDPV1_OK);
  EXPECT_THAT(last_answer(cls()), ElementsAre(0x5E, 1, 1, 4, 0x11, 0x22, 0x33, 0x44));
  EXPECT_EQ(poll(), DSDPV1_OK);
  EXPECT_EQ(done.repeated, 0);
  EXPECT_EQ(chip.answers_taken, 3);
}

TEST_P(AcyclicPoll, AnswerThatTheChipHasNotTakenIsLeftAlone) {
  open();
  chip.takes_commands = false;
  chip.put_request(cls(), {0x5E, 1, 1, 1});
  EXPECT_EQ(poll(), DSDPV1_OK);
  chip.at(0x00B) = 0x30;
  EXPECT_EQ(poll(), DSDPV1_OK);
  EXPECT_EQ(done.repeated | done.answered, 0);
  EXPECT_EQ(chip.at(0x011), cls());
}

TEST_P(AcyclicPoll, NewerRequestWhileTheHandlerWorksDropsTheOldAnswer) {
  open();
  reply_data = {0x77};
  while_handling = [&] {
    while_handling = nullptr;
    chip.put_request(cls(), {0x5E, 1, 1, 4});
  };
  EXPECT_THAT(ask(cls(), {0x5E, 2, 1, 1}), ElementsAre(0x5E, 1, 1, 4, 0x11, 0x22, 0x33, 0x44));
  EXPECT_EQ(done.dropped, cls());
  EXPECT_EQ(done.answered, cls());
  EXPECT_EQ(chip.answers_taken, 1);
}

TEST_P(AcyclicPoll, MasterThatNeverRestsIsLeftToTheNextCall) {
  open();
  int asked = 0;
  while_handling = [&] {
    ++asked;
    chip.put_request(cls(), {0x5E, 2, 1, 1});
  };
  EXPECT_THAT(ask(cls(), {0x5E, 2, 1, 1}), IsEmpty());
  EXPECT_EQ(asked, 3);
  while_handling = nullptr;
  EXPECT_EQ(poll(), DSDPV1_OK);
  EXPECT_EQ(chip.answers_taken, 1);
}

TEST_P(AcyclicPoll, IsRefusedDuringAHoldAndInsideItself) {
  open();
  dsdpv1_error nested = DSDPV1_OK;
  while_handling = [&] { nested = dsdpv1_acyclic_poll(&acyclic, nullptr); };
  static_cast<void>(ask(cls(), {0x5E, 2, 1, 1}));
  EXPECT_EQ(nested, DSDPV1_ERR_NESTED);
  nested = DSDPV1_OK;
  chip.on_r_req = [&](bool level) { nested = level ? dsdpv1_acyclic_poll(&acyclic, nullptr) : nested; };
  EXPECT_EQ(exchange({1}), DSDPV1_OK);
  EXPECT_EQ(nested, DSDPV1_ERR_NESTED);
}

class AcyclicBoth : public AcyclicTest {};

TEST_F(AcyclicBoth, RequestsOfBothClassesAreServedInTheSameHolds) {
  open();
  chip.put_request(1, {0x5E, 1, 1, 1});
  EXPECT_THAT(ask(2, {0x5E, 1, 2, 2}), ElementsAre(0x5E, 1, 2, 2, 0x11, 0x22));
  EXPECT_THAT(last_answer(1), ElementsAre(0x5E, 1, 1, 1, 0x11));
  EXPECT_EQ(done.received, 3);
  EXPECT_EQ(chip.holds, 2);
}

TEST_F(AcyclicBoth, OpenAtOnceAndAnsweredInEitherOrder) {
  open();
  const std::uint16_t first = defer(1, {0x5E, 2, 1, 1});
  const std::uint16_t second = defer(2, {0x5E, 2, 2, 1});
  EXPECT_EQ(done.open, 3);
  EXPECT_EQ(answer(second, {2}), DSDPV1_OK);
  EXPECT_THAT(last_answer(1), IsEmpty());
  EXPECT_EQ(answer(first, {1}), DSDPV1_OK);
  EXPECT_THAT(last_answer(1), ElementsAre(0x5E, 2, 1, 1, 1));
  EXPECT_THAT(last_answer(2), ElementsAre(0x5E, 2, 2, 1, 2));
}

TEST_F(AcyclicBoth, NewerRequestOfOneClassDoesNotTouchTheOther) {
  open();
  const std::uint16_t first = defer(1, {0x5E, 2, 1, 1});
  chip.put_request(2, {0x5E, 1, 1, 1});
  EXPECT_EQ(answer(first, {1}), DSDPV1_OK);
  EXPECT_THAT(last_answer(1), ElementsAre(0x5E, 2, 1, 1, 1));
  EXPECT_EQ(poll(), DSDPV1_OK);
  EXPECT_THAT(last_answer(2), ElementsAre(0x5E, 1, 1, 1, 0x11));
}

TEST_F(AcyclicBoth, WrongCrcOfOneClassDoesNotStopTheOther) {
  open();
  chip.put_request(1, {0x5E, 1, 1, 1});
  chip.put_request(2, {0x5E, 1, 1, 1});
  chip.at(0x6C4) = static_cast<std::uint8_t>(chip.at(0x6C4) ^ 1);
  EXPECT_EQ(poll(), DSDPV1_ERR_C1_CRC);
  EXPECT_THAT(last_answer(2), ElementsAre(0x5E, 1, 1, 1, 0x11));
  EXPECT_EQ(done.received, DSDPV1_CLASS_2);
}

TEST_F(AcyclicBoth, AnswerThatTheChipHasNotTakenKeepsItsFlagWhenTheOtherFollows) {
  open();
  chip.takes_commands = false;
  static_cast<void>(ask(1, {0x5E, 1, 1, 1}));
  static_cast<void>(ask(2, {0x5E, 1, 1, 1}));
  EXPECT_EQ(chip.at(0x011), 3);
}

TEST_F(AcyclicBoth, OnlyTheAnswerWithTheWrongCrcIsWrittenAgain) {
  open();
  chip.before_access = [&, once = true]() mutable {
    if (chip.at(0x011) != 0 && std::exchange(once, false))
      chip.at(0x6C4) = static_cast<std::uint8_t>(chip.at(0x6C4) ^ 1);
  };
  chip.put_request(1, {0x5E, 1, 1, 1});
  static_cast<void>(ask(2, {0x5E, 1, 1, 1}));
  EXPECT_EQ(poll(), DSDPV1_OK);
  EXPECT_EQ(done.repeated, DSDPV1_CLASS_1);
  EXPECT_EQ(chip.answers_taken, 3);
}

TEST_F(AcyclicBoth, CyclicDataAndDiagnosisGoOnWhileRequestsAreOpen) {
  open();
  const std::uint16_t first = defer(1, {0x5E, 2, 1, 1});
  const std::uint16_t second = defer(2, {0x5F, 2, 2, 1, 5});
  chip.put_outputs({0x0A, 0x0B});
  ASSERT_EQ(exchange({0x01, 0x02}), DSDPV1_OK);
  EXPECT_THAT(received(), ElementsAre(0x0A, 0x0B));
  EXPECT_THAT(chip.inputs, ElementsAre(0x01, 0x02));
  const Bytes diagnosis = {0x03, 0x11, 0x22};
  ASSERT_EQ(dsdpv1_set_diagnosis(&device, DSDPV1_DIAG_EXTERNAL, diagnosis.data(), 3), DSDPV1_OK);
  EXPECT_THAT(chip.diagnosis, ElementsAre(0x81, 0x03, 0x03, 0x11, 0x22));
  chip.put_cfg(4, 8, {0x17, 0x23});
  EXPECT_EQ(dsdpv1_service(&device), DSDPV1_OK);
  EXPECT_EQ(cfg_seen.size(), 1U);
  EXPECT_EQ(answer(first, {9}), DSDPV1_OK);
  EXPECT_EQ(answer(second, {}), DSDPV1_OK);
  EXPECT_THAT(last_answer(1), ElementsAre(0x5E, 2, 1, 1, 9));
  EXPECT_THAT(last_answer(2), ElementsAre(0x5F, 2, 2, 1));
}

TEST_F(AcyclicBoth, InterruptHandlerJudgesWhileARequestIsHandled) {
  open();
  while_handling = [&] {
    chip.put_prm({1});
    EXPECT_EQ(dsdpv1_service(&device), DSDPV1_OK);
  };
  EXPECT_THAT(ask(1, {0x5E, 2, 1, 0}), ElementsAre(0x5E, 2, 1, 0));
  EXPECT_EQ(prm_seen.size(), 1U);
}

TEST_F(AcyclicBoth, NothingWorksBeforeOpeningAndInitialisation) {
  EXPECT_EQ(dsdpv1_acyclic_poll(&acyclic, &done), DSDPV1_ERR_ARGUMENT);
  EXPECT_EQ(dsdpv1_acyclic_poll(nullptr, &done), DSDPV1_ERR_ARGUMENT);
  EXPECT_EQ(dsdpv1_acyclic_open(nullptr, &device, &table), DSDPV1_ERR_ARGUMENT);
  EXPECT_EQ(dsdpv1_acyclic_open(&acyclic, nullptr, &table), DSDPV1_ERR_ARGUMENT);
  EXPECT_EQ(dsdpv1_acyclic_open(&acyclic, &device, nullptr), DSDPV1_ERR_ARGUMENT);
  table.count = 1;
  EXPECT_EQ(dsdpv1_acyclic_open(&acyclic, &device, &table), DSDPV1_ERR_ARGUMENT) << "a count without objects";
  table.count = 0;
  EXPECT_EQ(dsdpv1_acyclic_open(&acyclic, &device, &table), DSDPV1_OK);
  EXPECT_EQ(dsdpv1_acyclic_poll(&acyclic, &done), DSDPV1_ERR_NOT_INITIALISED);
  EXPECT_EQ(chip.holds, 0);
}

TEST_F(AcyclicBoth, ResultMayBeNull) {
  open();
  chip.put_request(1, {0x5E, 1, 1, 1});
  EXPECT_EQ(dsdpv1_acyclic_poll(&acyclic, nullptr), DSDPV1_OK);
  EXPECT_THAT(last_answer(1), ElementsAre(0x5E, 1, 1, 1, 0x11));
}

}  // namespace
}  // namespace dsdpv1
