// DPV1: answers that the application gives after its handler has returned DSDPV1_DEFERRED.
#include "tests/driver/acyclic_fixture.hpp"

namespace dsdpv1 {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

class LateAnswer : public AcyclicTestOfEachClass {};
INSTANTIATE_TEST_SUITE_P(Class, LateAnswer, testing::Values(1, 2));

TEST_P(LateAnswer, ToARead) {
  open();
  const std::uint16_t ticket = defer(cls(), {0x5E, 2, 1, 3});
  EXPECT_EQ(answer(ticket, {7, 8, 9, 10}), DSDPV1_OK);
  EXPECT_THAT(last_answer(cls()), ElementsAre(0x5E, 2, 1, 3, 7, 8, 9)) << "cut to what was asked for";
  EXPECT_EQ(poll(), DSDPV1_OK);
  EXPECT_EQ(done.open, 0);
}

TEST_P(LateAnswer, ToAWrite) {
  open();
  const std::uint16_t ticket = defer(cls(), {0x5F, 2, 1, 2, 1, 2});
  EXPECT_EQ(dsdpv1_acyclic_answer(&acyclic, ticket, nullptr, 0), DSDPV1_OK);
  EXPECT_THAT(last_answer(cls()), ElementsAre(0x5F, 2, 1, 2));
}

TEST_P(LateAnswer, Negative) {
  open();
  const std::uint16_t ticket = defer(cls(), {0x5F, 2, 1, 2, 1, 2});
  EXPECT_EQ(dsdpv1_acyclic_refuse(&acyclic, ticket, DSDPV1_EC_STATE_CONFLICT, 0x12), DSDPV1_OK);
  EXPECT_THAT(last_answer(cls()), ElementsAre(0xDF, 0x80, 0xB5, 0x12));
}

TEST_P(LateAnswer, RequestDataStayReadableAndMayBeTheAnswer) {
  open();
  const std::uint16_t ticket = defer(cls(), {0x51, 2, 1, 3, 4, 5, 6});
  EXPECT_EQ(poll(), DSDPV1_OK);
  EXPECT_EQ(dsdpv1_acyclic_answer(&acyclic, ticket, seen.data + 1, 2), DSDPV1_OK);
  EXPECT_THAT(last_answer(cls()), ElementsAre(0x51, 2, 1, 2, 5, 6));
}

TEST_P(LateAnswer, IsGivenOnce) {
  open();
  const std::uint16_t ticket = defer(cls(), {0x5E, 2, 1, 1});
  EXPECT_EQ(answer(ticket, {7}), DSDPV1_OK);
  EXPECT_EQ(answer(ticket, {8}), DSDPV1_ERR_NO_REQUEST_OPEN);
  EXPECT_EQ(dsdpv1_acyclic_refuse(&acyclic, ticket, 0xA0, 0), DSDPV1_ERR_NO_REQUEST_OPEN);
  EXPECT_EQ(chip.answers_taken, 1);
}

TEST_P(LateAnswer, ToAWithdrawnRequestIsDroppedForTheNewerOne) {
  open();
  const std::uint16_t ticket = defer(cls(), {0x5E, 2, 1, 1});
  chip.put_request(cls(), {0x5E, 2, 2, 1});
  EXPECT_EQ(answer(ticket, {7}), DSDPV1_ERR_ANSWER_STALE);
  EXPECT_EQ(chip.answers_taken, 0);
  EXPECT_THAT(chip.bytes(area(0), 4), ElementsAre(0x5E, 2, 2, 1)) << "the newer request is not written over";
  outcome = DSDPV1_DONE;
  reply_data = {9};
  EXPECT_EQ(poll(), DSDPV1_OK);
  EXPECT_THAT(last_answer(cls()), ElementsAre(0x5E, 2, 2, 1, 9));
}

TEST_P(LateAnswer, DoesNotAnswerANewerRequestThatIsDeferredToo) {
  open();
  const std::uint16_t old_ticket = defer(cls(), {0x5E, 2, 1, 1});
  const std::uint16_t new_ticket = defer(cls(), {0x5E, 2, 1, 2});
  EXPECT_EQ(done.dropped, cls());
  EXPECT_EQ(answer(old_ticket, {7}), DSDPV1_ERR_ANSWER_STALE);
  EXPECT_EQ(answer(new_ticket, {8, 9}), DSDPV1_OK);
  EXPECT_THAT(last_answer(cls()), ElementsAre(0x5E, 2, 1, 2, 8, 9));
}

TEST_P(LateAnswer, LimitsAreCheckedBeforeAnythingIsWritten) {
  open();
  const std::uint16_t ticket = defer(cls(), {0x5E, 2, 1, 240});
  chip.holds = 0;
  EXPECT_EQ(answer(ticket, Bytes(241)), DSDPV1_ERR_ANSWER_LENGTH);
  EXPECT_EQ(dsdpv1_acyclic_answer(&acyclic, ticket, nullptr, 1), DSDPV1_ERR_ARGUMENT);
  EXPECT_EQ(dsdpv1_acyclic_answer(nullptr, ticket, nullptr, 0), DSDPV1_ERR_ARGUMENT);
  EXPECT_EQ(dsdpv1_acyclic_refuse(nullptr, ticket, 0xA0, 0), DSDPV1_ERR_ARGUMENT);
  EXPECT_EQ(chip.holds, 0);
  EXPECT_EQ(answer(ticket, Bytes(240, 3)), DSDPV1_OK);
  EXPECT_EQ(last_answer(cls()).size(), 244U);
}

TEST_P(LateAnswer, FromTheHandlerOfAnInterruptedHoldIsPutOff) {
  open();
  const std::uint16_t ticket = defer(cls(), {0x5E, 2, 1, 1});
  dsdpv1_error nested = DSDPV1_OK;
  chip.on_r_req = [&](bool level) { nested = level ? answer(ticket, {7}) : nested; };
  EXPECT_EQ(exchange({1}), DSDPV1_OK);
  EXPECT_EQ(nested, DSDPV1_ERR_NESTED);
  chip.on_r_req = nullptr;
  EXPECT_EQ(answer(ticket, {7}), DSDPV1_OK);
}

TEST_P(LateAnswer, RefusedForItsCrcIsWrittenAgainByThePoll) {
  open();
  const std::uint16_t ticket = defer(cls(), {0x5E, 2, 1, 1});
  chip.before_access = [&, once = true]() mutable {
    if (chip.at(0x011) != 0 && std::exchange(once, false)) spoil_crc();
  };
  EXPECT_EQ(answer(ticket, {7}), DSDPV1_OK);
  EXPECT_THAT(last_answer(cls()), IsEmpty());
  EXPECT_EQ(poll(), DSDPV1_OK);
  EXPECT_THAT(last_answer(cls()), ElementsAre(0x5E, 2, 1, 1, 7));
}

TEST_P(LateAnswer, InitialisationDropsTheRequest) {
  open();
  const std::uint16_t ticket = defer(cls(), {0x5E, 2, 1, 1});
  chip.put_request(3 - cls(), {0x5E, 1, 1, 1});
  initialise();
  EXPECT_EQ(answer(ticket, {7}), DSDPV1_ERR_ANSWER_STALE);
  EXPECT_EQ(poll(), DSDPV1_OK);
  EXPECT_EQ(done.received | done.open, 0) << "also the request that waited in the DPRAM";
  EXPECT_EQ(chip.answers_taken, 0);
}

TEST_P(LateAnswer, PollTellsOfRequestsThatAnInitialisationDropped) {
  open();
  static_cast<void>(defer(cls(), {0x5E, 2, 1, 1}));
  initialise();
  EXPECT_EQ(poll(), DSDPV1_OK);
  EXPECT_EQ(done.dropped, cls());
}

TEST_P(LateAnswer, RefusedInitialisationDropsNothing) {
  open();
  const std::uint16_t ticket = defer(cls(), {0x5E, 2, 1, 1});
  chip.put_request(3 - cls(), {0x5E, 1, 1, 1});
  chip.refuses_silently = true;
  EXPECT_EQ(dsdpv1_initialise(&device, &config), DSDPV1_ERR_INIT_REFUSED);
  EXPECT_EQ(answer(ticket, {7}), DSDPV1_OK);
  EXPECT_EQ(poll(), DSDPV1_OK);
  EXPECT_THAT(last_answer(3 - cls()), ElementsAre(0x5E, 1, 1, 1, 0x11));
}

}  // namespace
}  // namespace dsdpv1
