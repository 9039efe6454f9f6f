// The slot and index table: access rights, lengths, handlers, and the error codes of tables 27 to 29 and 32.
#include "registers/dsdpv1_regs.h"
#include "tests/driver/acyclic_fixture.hpp"

namespace dsdpv1 {
namespace {

using testing::ElementsAre;

TEST(AcyclicConstants, AgreeWithTheRegisterDescription) {
  EXPECT_EQ(DSDPV1_DS_TRANSPORT, static_cast<int>(DSDPV1_REG_FUNCTION_NUM_TRANSPORT));
  EXPECT_EQ(DSDPV1_DS_READ, static_cast<int>(DSDPV1_REG_FUNCTION_NUM_READ));
  EXPECT_EQ(DSDPV1_DS_WRITE, static_cast<int>(DSDPV1_REG_FUNCTION_NUM_WRITE));
  EXPECT_EQ(DSDPV1_DS_TRANSPORT_ERROR, static_cast<int>(DSDPV1_REG_FUNCTION_NUM_TRANSPORT_ERROR));
  EXPECT_EQ(DSDPV1_DS_READ_ERROR, static_cast<int>(DSDPV1_REG_FUNCTION_NUM_READ_ERROR));
  EXPECT_EQ(DSDPV1_DS_WRITE_ERROR, static_cast<int>(DSDPV1_REG_FUNCTION_NUM_WRITE_ERROR));
  EXPECT_EQ(DSDPV1_MAX_ACYCLIC, DSDPV1_REG_C1_DATA_SIZE);
  EXPECT_EQ(DSDPV1_CLASS_1, DSDPV1_REG_CHIP_COMMAND_2_C1);
  EXPECT_EQ(DSDPV1_CLASS_2, DSDPV1_REG_USER_COMMAND_2_C2);
}

struct Refusal {
  const char* name;
  int master_class;
  std::vector<std::uint8_t> request;
  std::vector<std::uint8_t> answer;
};

class AcyclicRefusal : public AcyclicTest, public testing::WithParamInterface<Refusal> {};

TEST_P(AcyclicRefusal, HasTheRightCode) {
  open();
  EXPECT_EQ(ask(GetParam().master_class, GetParam().request), GetParam().answer);
  EXPECT_EQ(done.refused, GetParam().master_class);
  EXPECT_THAT(parameter, ElementsAre(0x11, 0x22, 0x33, 0x44)) << "nothing is written";
}

INSTANTIATE_TEST_SUITE_P(
    Table, AcyclicRefusal,
    testing::Values(Refusal{"UnknownSlotRead", 1, {0x5E, 9, 1, 4}, {0xDE, 0x80, 0xB2, 0}},
                    Refusal{"UnknownSlotWrite", 2, {0x5F, 9, 1, 1, 7}, {0xDF, 0x80, 0xB2, 0}},
                    Refusal{"UnknownSlotTransport", 2, {0x51, 9, 1, 1, 7}, {0xD1, 0x80, 0xB2, 0}},
                    Refusal{"UnknownSlot0WithoutIm0", 1, {0x5E, 0, 255, 68}, {0xDE, 0x80, 0xB2, 0}},
                    Refusal{"UnknownIndex", 1, {0x5E, 1, 9, 4}, {0xDE, 0x80, 0xB0, 0}},
                    Refusal{"ClassNotAdmitted", 1, {0x5E, 1, 4, 4}, {0xDE, 0x80, 0xB6, 0}},
                    Refusal{"ReadOnly", 2, {0x5F, 1, 2, 1, 7}, {0xDF, 0x80, 0xB6, 0}},
                    Refusal{"WriteOnly", 1, {0x5E, 1, 3, 3}, {0xDE, 0x80, 0xB6, 0}},
                    Refusal{"NoTransport", 2, {0x51, 1, 1, 1, 7}, {0xD1, 0x80, 0xA9, 0}},
                    Refusal{"WriteTooShort", 1, {0x5F, 1, 3, 1, 7}, {0xDF, 0x80, 0xB1, 0}},
                    Refusal{"WriteTooLong", 2, {0x5F, 1, 3, 4, 7, 7, 7, 7}, {0xDF, 0x80, 0xB1, 0}},
                    Refusal{"ReadTooShort", 1, {0x5E, 1, 1, 0}, {0xDE, 0x80, 0xB8, 0}},
                    Refusal{"ReadOfMoreThanAnyAnswer", 2, {0x5E, 1, 1, 241}, {0xDE, 0x80, 0xB7, 0}},
                    Refusal{"UnknownFunction", 2, {0x48, 1, 1, 0}, {0xC8, 0x80, 0xA9, 0}}),
    [](const auto& refusal) { return std::string(refusal.param.name); });

class AcyclicObject : public AcyclicTestOfEachClass {};
INSTANTIATE_TEST_SUITE_P(Class, AcyclicObject, testing::Values(1, 2));

TEST_P(AcyclicObject, PlainDataAreReadUpToTheirLength) {
  open();
  EXPECT_THAT(ask(cls(), {0x5E, 1, 1, 240}), ElementsAre(0x5E, 1, 1, 4, 0x11, 0x22, 0x33, 0x44)) << "V15: shorter";
  EXPECT_THAT(ask(cls(), {0x5E, 1, 1, 1}), ElementsAre(0x5E, 1, 1, 1, 0x11)) << "cut";
}

TEST_P(AcyclicObject, PlainDataAreWrittenWithinTheLimits) {
  open();
  EXPECT_THAT(ask(cls(), {0x5F, 1, 3, 2, 0xA1, 0xA2}), ElementsAre(0x5F, 1, 3, 2));
  EXPECT_THAT(parameter, ElementsAre(0xA1, 0xA2, 0x33, 0x44));
  EXPECT_THAT(ask(cls(), {0x5F, 1, 3, 3, 0xB1, 0xB2, 0xB3}), ElementsAre(0x5F, 1, 3, 3));
  EXPECT_THAT(parameter, ElementsAre(0xB1, 0xB2, 0xB3, 0x44));
}

TEST_P(AcyclicObject, HandlerSeesTheWholeRequest) {
  open();
  EXPECT_THAT(ask(cls(), {0x5F, 2, 1, 3, 7, 8, 9}), ElementsAre(0x5F, 2, 1, 3));
  EXPECT_EQ(seen.master_class, cls());
  EXPECT_EQ(seen.function, DSDPV1_DS_WRITE);
  EXPECT_EQ(seen.slot, 2);
  EXPECT_EQ(seen.index, 1);
  EXPECT_THAT(seen_data, ElementsAre(7, 8, 9));
}

TEST_P(AcyclicObject, HandlerAnswersARead) {
  open();
  reply_data = {1, 2, 3, 4, 5};
  EXPECT_THAT(ask(cls(), {0x5E, 2, 1, 7}), ElementsAre(0x5E, 2, 1, 5, 1, 2, 3, 4, 5));
  EXPECT_EQ(seen.length, 7) << "what the master asks for (V5)";
  EXPECT_THAT(ask(cls(), {0x5E, 2, 1, 2}), ElementsAre(0x5E, 2, 1, 2, 1, 2));
}

TEST_P(AcyclicObject, HandlerAnswersATransportWithAnotherLength) {
  open();
  reply_data = {1, 2, 3};
  EXPECT_THAT(ask(cls(), {0x51, 2, 1, 1, 9}), ElementsAre(0x51, 2, 1, 3, 1, 2, 3));
  EXPECT_THAT(seen_data, ElementsAre(9));
}

TEST_P(AcyclicObject, HandlerRefusesWithItsOwnCodes) {
  open();
  outcome = DSDPV1_FAILED;
  codes = {DSDPV1_EC_INVALID_RANGE, 0x42};
  EXPECT_THAT(ask(cls(), {0x5F, 2, 1, 1, 9}), ElementsAre(0xDF, 0x80, 0xB7, 0x42));
}

TEST_P(AcyclicObject, HandlerRefusesWithThePresetCodes) {
  open();
  outcome = DSDPV1_FAILED;
  EXPECT_THAT(ask(cls(), {0x5E, 2, 1, 1}), ElementsAre(0xDE, 0x80, 0xA0, 0));
  EXPECT_THAT(ask(cls(), {0x5F, 2, 1, 0}), ElementsAre(0xDF, 0x80, 0xA1, 0));
  EXPECT_THAT(ask(cls(), {0x51, 2, 1, 0}), ElementsAre(0xD1, 0x80, 0xA2, 0));
}

TEST_P(AcyclicObject, TooLongAnswerOfAHandlerIsAnErrorAndTheMasterIsTold) {
  open();
  reply_length = 241;
  chip.put_request(cls(), {0x51, 2, 1, 0});
  EXPECT_EQ(poll(), DSDPV1_ERR_ANSWER_LENGTH);
  EXPECT_THAT(last_answer(cls()), ElementsAre(0xD1, 0x80, 0xA2, 0));
}

TEST_P(AcyclicObject, ObjectThatTheOtherClassWaitsForIsBusy) {
  open();
  const std::uint16_t ticket = defer(3 - cls(), {0x5E, 2, 1, 1});
  outcome = DSDPV1_DONE;
  EXPECT_THAT(ask(cls(), {0x5E, 2, 1, 1}), ElementsAre(0xDE, 0x80, 0xC2, 0));
  EXPECT_THAT(ask(cls(), {0x5E, 2, 2, 0}), ElementsAre(0x5E, 2, 2, 0)) << "others are not";
  EXPECT_EQ(answer(ticket, {1}), DSDPV1_OK);
  EXPECT_THAT(ask(cls(), {0x5E, 2, 1, 0}), ElementsAre(0x5E, 2, 1, 0));
}

struct BadObject {
  const char* name;
  std::function<void(dsdpv1_object&)> spoil;
};

class AcyclicTable : public AcyclicTest, public testing::WithParamInterface<BadObject> {};

TEST_P(AcyclicTable, IsChecked) {
  GetParam().spoil(objects.back());
  table.objects = objects.data();
  table.count = objects.size();
  EXPECT_EQ(dsdpv1_acyclic_open(&acyclic, &device, &table), DSDPV1_ERR_TABLE);
}

INSTANTIATE_TEST_SUITE_P(
    All, AcyclicTable,
    testing::Values(BadObject{"NoService", [](auto& o) { o.services = 0; }},
                    BadObject{"UnknownService", [](auto& o) { o.services = 0x09; }},
                    BadObject{"NoClass", [](auto& o) { o.classes = 0; }},
                    BadObject{"UnknownClass", [](auto& o) { o.classes = 0x05; }},
                    BadObject{"LengthAbove240", [](auto& o) { o.max_length = 241; }},
                    BadObject{"LeastAboveLargest", [](auto& o) { o.min_length = 5, o.max_length = 4; }},
                    BadObject{"NothingToRead", [](auto& o) { o.read = nullptr; }},
                    BadObject{"NothingToWrite", [](auto& o) { o.write = nullptr; }},
                    BadObject{"NoTransportHandler", [](auto& o) { o.transport = nullptr; }},
                    BadObject{"TransportForClass1Only", [](auto& o) { o.classes = DSDPV1_CLASS_1; }},
                    BadObject{"Twice", [](auto& o) { o.index = 1; }}),
    [](const auto& bad) { return std::string(bad.param.name); });

}  // namespace
}  // namespace dsdpv1
