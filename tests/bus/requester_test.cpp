#include "bus/master/requester.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/bus/fake_slave.hpp"

namespace dsdpv1::bus {
namespace {

using test::FakeStation;
using test::Reply;

const Telegram kRequest = make_telegram(3, 1, 0x49);
const Telegram kAnswer = make_telegram(1, 3, 0x00);

struct RequesterTest : testing::Test {
  RequesterTest() : slave(segment, timeline), requester(segment) {
    timeline.add(requester);
    answer_with({encode(kAnswer)});
  }
  void answer_with(const Reply& reply) {
    slave.script = [reply](const Telegram&) { return reply; };
  }
  Segment segment;
  Timeline timeline;
  FakeStation slave;
  Requester requester;
};

class RequesterAtEveryBaud : public RequesterTest, public testing::WithParamInterface<int> {};
INSTANTIATE_TEST_SUITE_P(Bauds, RequesterAtEveryBaud, testing::Range(0, kBaudCount));

TEST_P(RequesterAtEveryBaud, ReturnsTheAnswerWithExactTimes) {
  slave.set_baud(GetParam());
  requester.set_baud(GetParam());
  answer_with({encode(kAnswer), 12'500});
  ExchangeOptions options;
  options.at = 777'777;
  const Exchange exchange = requester.send(timeline, kRequest, options);
  const Tick bit = baud(GetParam()).bit;
  EXPECT_TRUE(exchange.answered());
  EXPECT_EQ(exchange.answer(), kAnswer);
  EXPECT_EQ(exchange.raw, encode(kAnswer));
  EXPECT_EQ(exchange.request_start, 777'777);
  EXPECT_EQ(exchange.request_end, 777'777 + 66 * bit);
  EXPECT_EQ(exchange.tsdr(), bit * 25 / 2);
  EXPECT_DOUBLE_EQ(exchange.tsdr_bits(), 12.5);
  EXPECT_EQ(exchange.answer_end(), exchange.answer_start() + 66 * bit);
  EXPECT_EQ(timeline.now(), exchange.answer_end());
}

TEST_F(RequesterTest, KeepsTheIdleTimeBetweenTwoRequests) {
  const Exchange first = requester.send(timeline, kRequest);
  const Exchange second = requester.send(timeline, kRequest);
  EXPECT_EQ(second.request_start - first.answer_end(), 33 * requester.bit());
  ExchangeOptions options;
  options.idle_bits = 40;
  EXPECT_EQ(requester.send(timeline, kRequest, options).request_start - second.answer_end(), 40 * requester.bit());
}

TEST_F(RequesterTest, SilenceEndsWithTheSlotTime) {
  slave.script = nullptr;
  const Exchange exchange = requester.send(timeline, kRequest);
  EXPECT_TRUE(exchange.silent());
  EXPECT_FALSE(exchange.answered());
  EXPECT_EQ(timeline.now() - exchange.request_end, 1000 * requester.bit());
  ExchangeOptions options;
  options.slot_bits = 50;
  const Exchange shorter = requester.send(timeline, kRequest, options);
  EXPECT_EQ(timeline.now() - shorter.request_end, 50 * requester.bit());
}

TEST_F(RequesterTest, AnAnswerBegunWithinTheSlotTimeIsReceived) {
  answer_with({encode(kAnswer), 49'900});
  ExchangeOptions options;
  options.slot_bits = 50;
  EXPECT_TRUE(requester.send(timeline, kRequest, options).answered());
}

TEST_F(RequesterTest, WithoutAnAnswerWantedItReturnsAtTheEndOfTheRequest) {
  ExchangeOptions options;
  options.wants_answer = false;
  const Exchange exchange = requester.send(timeline, kRequest, options);
  EXPECT_EQ(timeline.now(), exchange.request_end);
}

TEST_F(RequesterTest, ABrokenOffAnswerIsTruncated) {
  WireFaults faults;
  faults.truncate_after = 3;
  answer_with({encode(kAnswer), 11'000, faults});
  const Exchange exchange = requester.send(timeline, kRequest);
  EXPECT_FALSE(exchange.silent());
  EXPECT_FALSE(exchange.answered());
  EXPECT_EQ(exchange.decoded.error, DecodeError::kTruncated);
  EXPECT_EQ(exchange.raw.size(), 3U);
}

TEST_F(RequesterTest, AWrongAnswerIsKeptToItsEnd) {
  Bytes wrong = encode(make_telegram(1, 3, 0x08, {1, 2, 3}));
  wrong[2] = 99;
  answer_with({wrong});
  const Exchange exchange = requester.send(timeline, kRequest);
  EXPECT_EQ(exchange.decoded.error, DecodeError::kLengthMismatch);
  EXPECT_EQ(exchange.raw, wrong);
}

TEST_F(RequesterTest, CharacterErrorsOfTheAnswerAreReported) {
  WireFaults faults;
  faults.wrong_parity_at = 2;
  answer_with({encode(kAnswer), 11'000, faults});
  const Exchange exchange = requester.send(timeline, kRequest);
  EXPECT_FALSE(exchange.answered());
  EXPECT_EQ(exchange.decoded.error, DecodeError::kNone);
  EXPECT_FALSE(exchange.characters[2].parity_ok);
}

TEST_F(RequesterTest, FaultsReachTheWire) {
  ExchangeOptions options;
  options.faults.wrong_parity_at = 1;
  EXPECT_TRUE(requester.send(timeline, kRequest, options).silent());
  EXPECT_TRUE(slave.heard.empty());
}

TEST_F(RequesterTest, AShortAcknowledgeIsAnAnswer) {
  answer_with({{sd::kSc}});
  EXPECT_TRUE(requester.send(timeline, kRequest).short_acknowledge());
}

TEST_F(RequesterTest, RefusesThePast) {
  timeline.run_until(1000);
  ExchangeOptions options;
  options.at = 999;
  EXPECT_THROW(requester.send(timeline, kRequest, options), std::invalid_argument);
}

TEST_F(RequesterTest, SendsWithAClockError) {
  requester.set_baud(0, 20'000);
  const Exchange exchange = requester.send(timeline, kRequest);
  EXPECT_TRUE(exchange.answered());
  EXPECT_EQ(exchange.request_end - exchange.request_start, 66 * 1020);
}

}  // namespace
}  // namespace dsdpv1::bus
