#include "bus/master/fdl.hpp"

#include <gtest/gtest.h>

#include "tests/bus/fake_slave.hpp"

namespace dsdpv1::bus {
namespace {

using test::FakeStation;
using test::Reply;

struct FdlAgent : Agent {
  explicit FdlAgent(MasterFdl& layer) : fdl(layer) {
    fdl.on_plan = [this] { announce(); };
  }
  Tick next() const override { return fdl.next(); }
  void run(Tick now) override { fdl.run(now); }
  MasterFdl& fdl;
};

struct FdlTest : testing::Test {
  FdlTest() : slave(segment, timeline), fdl(segment, "master", 1, parameters()), agent(fdl) {
    timeline.add(agent);
    fdl.on_done = [this](const FdlResult& result) { results.push_back(result); };
    slave.script = [this](const Telegram& telegram) { return script(telegram); };
  }
  static BusParameters parameters() {
    BusParameters bus;
    bus.max_retries = 2;
    return bus;
  }
  std::optional<Reply> script(const Telegram& telegram) {
    if (!telegram.wants_answer() || telegram.da != 3) return std::nullopt;
    if (silent > 0 && silent-- > 0) return std::nullopt;
    Reply reply{encode(make_telegram(1, 3, 0x08, {1})), 11'000, {}};
    if (wrong_fcs > 0 && wrong_fcs-- > 0) ++reply.bytes[reply.bytes.size() - 2];
    if (wrong_parity > 0 && wrong_parity-- > 0) reply.faults.wrong_parity_at = 4;
    if (broken_off > 0 && broken_off-- > 0) reply.faults.truncate_after = 5;
    if (wrong_station > 0 && wrong_station-- > 0) reply.bytes = encode(make_telegram(1, 4, 0x08, {1}));
    return reply;
  }
  void set_baud(int index) {
    slave.set_baud(index);
    fdl.set_baud(timeline.now(), index);
    bit = baud(index).bit;
  }
  const FdlResult& ask(const Telegram& telegram) {
    FdlRequest request;
    request.telegram = telegram;
    return ask(request);
  }
  const FdlResult& ask(const FdlRequest& request) {
    const std::size_t before = results.size();
    fdl.start(timeline.now(), request);
    while (results.size() == before && timeline.step(kNever - 1)) {
    }
    return results.back();
  }
  std::vector<int> fcs() const {
    std::vector<int> codes;
    for (const Telegram& telegram : slave.heard) codes.push_back(telegram.fc);
    return codes;
  }

  Segment segment;
  Timeline timeline;
  FakeStation slave;
  MasterFdl fdl;
  FdlAgent agent;
  Tick bit = baud(0).bit;
  int silent = 0, wrong_fcs = 0, wrong_parity = 0, broken_off = 0, wrong_station = 0;
  std::vector<FdlResult> results;
};

const Telegram kSrd = make_telegram(3, 1, fc::kRequest | fc::kSrdHigh, {7});
const Telegram kStatus = make_telegram(9, 1, fc::kRequest | fc::kFdlStatus);
const Telegram kSdn = make_telegram(kBroadcast, 1, fc::kRequest | fc::kSdnHigh, {0, 0}, 58, 62);

class FdlAtEveryBaud : public FdlTest, public testing::WithParamInterface<int> {};
INSTANTIATE_TEST_SUITE_P(Bauds, FdlAtEveryBaud, testing::Range(0, kBaudCount));

TEST_P(FdlAtEveryBaud, AfterAnAnswerTheNextRequestWaitsForId1) {
  set_baud(GetParam());
  const FdlResult first = ask(kSrd);
  EXPECT_TRUE(first.answered());
  const FdlResult second = ask(kSrd);
  const Tick idle = second.request_start - first.answer_end;
  EXPECT_EQ(idle, parameters().id1(GetParam()) * bit);
  EXPECT_GE(idle, kSynBits * bit);
}

TEST_P(FdlAtEveryBaud, AfterSdnTheNextRequestWaitsForId2) {
  set_baud(GetParam());
  const FdlResult first = ask(kSdn);
  EXPECT_EQ(first.outcome, FdlOutcome::kSent);
  const FdlResult second = ask(kSrd);
  EXPECT_EQ(second.request_start - first.request_end, parameters().id2(GetParam()) * bit);
  EXPECT_GE(parameters().id2(GetParam()), baud(GetParam()).max_tsdr_bits);
}

TEST_P(FdlAtEveryBaud, AMissingAnswerEndsWithTheSlotTime) {
  set_baud(GetParam());
  const FdlResult result = ask(kStatus);
  EXPECT_EQ(result.outcome, FdlOutcome::kNoAnswer);
  EXPECT_EQ(timeline.now() - result.request_end, baud(GetParam()).slot_bits * bit);
}

TEST(BusParameters, IdleTimesOfTheStandard) {
  EXPECT_EQ(BusParameters{}.id1(9), 37);
  EXPECT_EQ(BusParameters{}.id1(3), 37);
  EXPECT_EQ(BusParameters{}.id1(0), 76);
  EXPECT_EQ(BusParameters{}.id2(0), 800);
  BusParameters set;
  set.set_bits = 2;
  set.quiet_bits = 3;
  EXPECT_EQ(set.id1(0), 33 + 2 + 4 + 3);
  EXPECT_EQ(BusParameters{}.retries(0), 4);
  EXPECT_EQ(BusParameters{}.retries(3), 1);
  EXPECT_EQ(BusParameters{}.retries(9), 1);
}

TEST_F(FdlTest, FcbTogglesFromAStartedSeries) {
  for (int i = 0; i < 4; ++i) ask(kSrd);
  EXPECT_EQ(fcs(), (std::vector<int>{0x6D, 0x5D, 0x7D, 0x5D}));
}

TEST_F(FdlTest, ARepetitionCarriesTheSameFcb) {
  ask(kSrd);
  silent = 2;
  const FdlResult result = ask(kSrd);
  EXPECT_TRUE(result.answered());
  EXPECT_EQ(result.retries, 2);
  EXPECT_EQ(result.timeouts, 2);
  ask(kSrd);
  EXPECT_EQ(fcs(), (std::vector<int>{0x6D, 0x5D, 0x5D, 0x5D, 0x7D}));
}

TEST_F(FdlTest, AfterTheLastRepetitionTheSeriesStartsAnew) {
  ask(kSrd);
  silent = 3;
  const FdlResult result = ask(kSrd);
  EXPECT_EQ(result.outcome, FdlOutcome::kNoAnswer);
  EXPECT_EQ(result.timeouts, 3);
  ask(kSrd);
  EXPECT_EQ(slave.heard.back().fc, 0x6D);
}

TEST_F(FdlTest, EveryWrongAnswerIsRepeated) {
  for (int* fault : {&wrong_fcs, &wrong_parity, &broken_off, &wrong_station}) {
    *fault = 1;
    const FdlResult result = ask(kSrd);
    EXPECT_TRUE(result.answered());
    EXPECT_EQ(result.errors, 1);
    EXPECT_EQ(result.retries, 1);
    EXPECT_EQ(result.timeouts, 0);
  }
}

TEST_F(FdlTest, OnlyWrongAnswersAreABadAnswer) {
  wrong_fcs = 3;
  const FdlResult result = ask(kSrd);
  EXPECT_EQ(result.outcome, FdlOutcome::kBadAnswer);
  EXPECT_EQ(result.errors, 3);
  EXPECT_EQ(result.raw.size(), 10U);
}

TEST_F(FdlTest, ARepetitionKeepsSyn) {
  broken_off = 1;
  ask(kSrd);
  ASSERT_EQ(slave.starts.size(), 2U);
  const Tick answer_end = slave.ends[0] + (11 + 5 * 11) * bit;
  EXPECT_GE(slave.starts[1] - answer_end, kSynBits * bit);
}

TEST_F(FdlTest, FdlStatusHasNoFcbAndIsNotRepeated) {
  const FdlResult result = ask(kStatus);
  EXPECT_EQ(result.retries, 0);
  EXPECT_EQ(fcs(), std::vector<int>{0x49});
}

TEST_F(FdlTest, WaitsForTheBusOfOthers) {
  FakeStation other(segment, timeline, "other");
  UartSender sender(segment, other.station);
  sender.set_timing(bit);
  sender.send(timeline.now() + 500, characters(Bytes(5, 0xAA)));
  struct SenderAgent : Agent {
    explicit SenderAgent(UartSender& s) : uart(s) {}
    Tick next() const override { return uart.next(); }
    void run(Tick now) override { uart.run(now); }
    UartSender& uart;
  } busy(sender);
  timeline.add(busy);
  timeline.run_until(20'000);
  const FdlResult result = ask(kSrd);
  EXPECT_EQ(result.request_start, sender.end() + kSynBits * bit);
}

TEST_F(FdlTest, RawBytesAreSentOnceAsTheyAre) {
  FdlRequest request;
  WireFaults faults;
  faults.wrong_parity_at = 2;
  request.raw = characters(encode(kSrd), faults);
  const FdlResult result = ask(request);
  EXPECT_EQ(result.outcome, FdlOutcome::kNoAnswer);
  EXPECT_EQ(result.retries, 0);
  EXPECT_TRUE(slave.heard.empty());
}

TEST_F(FdlTest, AbortFallsSilentInsideATelegram) {
  FdlRequest request;
  request.telegram = make_telegram(3, 1, fc::kRequest | fc::kSrdHigh, Bytes(100, 0));
  fdl.start(0, request);
  timeline.run_until(200 * bit);
  fdl.abort(timeline.now());
  EXPECT_TRUE(segment.level());
  EXPECT_TRUE(fdl.idle());
  ASSERT_EQ(results.size(), 1U);
  EXPECT_EQ(results[0].outcome, FdlOutcome::kAborted);
  timeline.run_until(20'000 * bit);
  EXPECT_TRUE(slave.heard.empty());
}

}  // namespace
}  // namespace dsdpv1::bus
