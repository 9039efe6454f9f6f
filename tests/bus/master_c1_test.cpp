#include "bus/master/c1.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "bus/gsd/setup.hpp"
#include "bus/master/master1.hpp"
#include "bus/monitor/monitor.hpp"
#include "tests/bus/fake_acyclic.hpp"
#include "tests/bus/fake_slave.hpp"

namespace dsdpv1::bus {
namespace {

using test::FakeDpSlave;
using test::FakeMailbox;
using test::short_answer;
using testing::HasSubstr;

constexpr int kResponseTimeout = 3;  // units of 10 ms

/// A master with two slaves, of which both have a C1 mailbox; nothing may be flagged.
struct C1Test : testing::Test {
  C1Test() : slave(segment, timeline, 3), other(segment, timeline, 4), master(segment, config()), monitor(segment) {
    timeline.add(master);
    timeline.add(monitor);
    equip(slave, mailbox, 3);
    equip(other, other_mailbox, 4);
    monitor.on_flag = [this](const Flag& flag) { flags.push_back(format_line(flag)); };
    monitor.on_telegram = [this](const WireTelegram& wire) { telegrams.push_back(wire.decoded.telegram); };
    master.start();
    run_until([this] { return exchanging(3) && exchanging(4); });
  }
  static MasterConfig config() {
    MasterConfig config;
    config.bus.gap_factor = 0;
    return config;
  }
  void equip(FakeDpSlave& station, FakeMailbox& box, std::uint8_t address) {
    station.acyclic = [&box](const Telegram& request) {
      return request.dsap == sap::kMs1 && request.ssap == sap::kMs1 ? box.hear(request)
                                                                    : short_answer(request, fc::kRs);
    };
    SlaveParameters parameters;
    parameters.address = address;
    parameters.ident = 0x0B9A;
    parameters.cfg = {0x11, 0x21};
    parameters.input_length = parameters.output_length = 2;
    parameters.dpv1 = true;
    parameters.c1_response_timeout = kResponseTimeout;
    master.add_slave(parameters);
  }
  bool exchanging(std::uint8_t address) const { return master.slave(address).state == SlaveState::kDataExchange; }
  void run_until(const std::function<bool()>& condition, Tick limit = 100 * kTicksPerMs) {
    const Tick end = timeline.now() + limit;
    while (!condition() && timeline.step(end)) {
    }
    ASSERT_TRUE(condition());
  }
  void run(Tick ticks) { timeline.run_until(timeline.now() + ticks); }
  AcyclicCallback keep() {
    return [this](const AcyclicResult& result) { results.push_back(result); };
  }
  AcyclicResult read(std::uint8_t length = 4) {
    master.c1_read(3, 1, 2, length, keep());
    return last();
  }
  AcyclicResult write(const Bytes& data) {
    master.c1_write(3, 1, 2, data, keep());
    return last();
  }
  AcyclicResult last() {
    const std::size_t before = results.size();
    run_until([&] { return results.size() > before; });
    return results.empty() ? AcyclicResult{} : results.back();
  }
  static bool is_acyclic_request(const Telegram& telegram, std::uint8_t da) {
    return telegram.is_request() && telegram.da == da && telegram.dsap == sap::kMs1;
  }

  Segment segment;
  Timeline timeline;
  FakeDpSlave slave, other;
  FakeMailbox mailbox, other_mailbox;
  Master1 master;
  Monitor monitor;
  std::vector<std::string> flags;
  std::vector<Telegram> telegrams;
  std::vector<AcyclicResult> results;
};

TEST_F(C1Test, ReadsWhatTheUserGives) {
  const AcyclicResult result = read(5);
  EXPECT_TRUE(result.positive());
  EXPECT_EQ(result.data, (Bytes{0, 1, 2, 3, 4}));
  EXPECT_EQ(mailbox.requests, (std::vector<Bytes>{{0x5E, 1, 2, 5}}));
  EXPECT_EQ(describe(result), "DS_Read slot 1 index 2: 5 bytes 00 01 02 03 04");
  EXPECT_TRUE(flags.empty()) << flags.front();
}

TEST_F(C1Test, Writes) {
  const AcyclicResult result = write({7, 8, 9});
  EXPECT_TRUE(result.positive());
  EXPECT_EQ(mailbox.requests, (std::vector<Bytes>{{0x5F, 1, 2, 3, 7, 8, 9}}));
  EXPECT_EQ(describe(result), "DS_Write slot 1 index 2: 3 bytes written");
}

TEST_F(C1Test, EveryLengthIsReadAndWritten) {
  mailbox.busy_polls = 0;
  for (std::size_t length = 0; length <= kMaxAcyclicData; ++length) {
    EXPECT_EQ(read(static_cast<std::uint8_t>(length)).data.size(), length);
    EXPECT_TRUE(write(Bytes(length, 0x5A)).positive()) << length;
  }
  EXPECT_THROW(master.c1_write(3, 0, 0, Bytes(kMaxAcyclicData + 1, 0)), std::invalid_argument);
  EXPECT_TRUE(flags.empty()) << flags.front();
}

TEST_F(C1Test, TelegramsAreSrdLowFrom51To51) {
  read();
  for (const Telegram& telegram : telegrams) {
    if (!is_acyclic_request(telegram, 3)) continue;
    EXPECT_EQ(telegram.function(), fc::kSrdLow);
    EXPECT_EQ(telegram.ssap, sap::kMs1);
  }
}

TEST_F(C1Test, BetweenTwoAcyclicTelegramsOfASlaveEverySlaveExchangesItsData) {
  mailbox.busy_polls = 6;
  master.c1_read(4, 0, 0, 1);
  const AcyclicResult result = read();
  EXPECT_EQ(result.polls, 6);
  int acyclic = 0, exchanges_3 = 2, exchanges_4 = 2;
  for (const Telegram& telegram : telegrams) {
    const bool exchange = telegram.is_request() && !telegram.dsap;
    exchanges_3 += exchange && telegram.da == 3 ? 1 : 0;
    exchanges_4 += exchange && telegram.da == 4 ? 1 : 0;
    if (!is_acyclic_request(telegram, 3)) continue;
    if (++acyclic > 1) {
      EXPECT_EQ(exchanges_3, 1);
      EXPECT_EQ(exchanges_4, 1);
    }
    exchanges_3 = exchanges_4 = 0;
  }
  EXPECT_EQ(acyclic, 8);  // the request, six polls in vain, the one that fetches
}

TEST_F(C1Test, OperationsOfASlaveAreDoneInTheirOrderThoseOfAnotherDoNotWaitForThem) {
  mailbox.busy_polls = 20;
  std::vector<int> order;
  const auto note = [&order](int number) {
    return [&order, number](const AcyclicResult&) { order.push_back(number); };
  };
  master.c1_read(3, 0, 0, 1, note(1));
  master.c1_read(3, 0, 1, 1, note(2));
  master.c1_read(4, 0, 0, 1, note(3));
  EXPECT_EQ(master.c1_open(3), 2U);
  run_until([&] { return order.size() == 3; });
  EXPECT_EQ(order, (std::vector<int>{3, 1, 2}));
  EXPECT_EQ(master.c1_open(3), 0U);
}

TEST_F(C1Test, ANegativeAnswerGivesItsCodes) {
  mailbox.user = [](const Bytes& request) {
    return Bytes{static_cast<std::uint8_t>(request[0] | 0x80U), 0x80, 0xB2, 0x07};
  };
  const AcyclicResult result = read();
  EXPECT_EQ(result.outcome, AcyclicOutcome::kNegative);
  EXPECT_EQ(result.error_decode, 0x80);
  EXPECT_EQ(result.error_code_1, 0xB2);
  EXPECT_EQ(result.error_code_2, 0x07);
  EXPECT_EQ(describe(result), "DS_Read slot 1 index 2: refused, access: invalid slot, Error_Code_2 0x07");
}

TEST_F(C1Test, AnUnansweredOperationEndsWithTheResponseTimeout) {
  mailbox.busy_polls = -1;
  const AcyclicResult result = read();
  EXPECT_EQ(result.outcome, AcyclicOutcome::kTimeout);
  const Tick timeout = kResponseTimeout * kTimeUnit10ms, waited = result.done_at - result.sent_at;
  EXPECT_GE(waited, timeout);
  EXPECT_LE(waited, timeout + 2 * master.cycle_time());
  EXPECT_GT(result.polls, 100);
  EXPECT_TRUE(exchanging(3));
}

TEST_F(C1Test, ALateAnswerIsFetchedAndDoesNotReachTheNextOperation) {
  mailbox.busy_polls = -1;
  EXPECT_EQ(read(4).outcome, AcyclicOutcome::kTimeout);
  mailbox.answer_now();
  mailbox.busy_polls = 0;
  const AcyclicResult next = read(9);
  EXPECT_TRUE(next.positive());
  EXPECT_EQ(next.data.size(), 9U);
}

TEST_F(C1Test, WhileTheSlaveStillWorksOnAnEarlierOneTheNextIsRefusedWithRr) {
  mailbox.busy_polls = -1;
  read();
  const AcyclicResult next = read();
  EXPECT_EQ(next.outcome, AcyclicOutcome::kRefused);
  EXPECT_EQ(next.refusal, fc::kRr);
  EXPECT_THAT(describe(next), HasSubstr("refused with RR"));
}

TEST_F(C1Test, RsIsARefusal) {
  slave.acyclic = [](const Telegram& request) { return short_answer(request, fc::kRs); };
  const AcyclicResult result = read();
  EXPECT_EQ(result.outcome, AcyclicOutcome::kRefused);
  EXPECT_EQ(result.refusal, fc::kRs);
  EXPECT_TRUE(exchanging(3));
}

TEST_F(C1Test, LeavingDataExchangeLosesTheOneAtWorkAndKeepsThoseThatWait) {
  mailbox.busy_polls = -1;
  master.c1_read(3, 0, 0, 1, keep());
  master.c1_read(3, 0, 1, 2, keep());
  run_until([this] { return mailbox.open(); });
  slave.state = FakeDpSlave::State::kWaitPrm;
  mailbox.drop();
  mailbox.busy_polls = 0;
  run_until([this] { return results.size() == 2; });
  EXPECT_EQ(results[0].outcome, AcyclicOutcome::kLost);
  EXPECT_EQ(results[0].reason, "data exchange was left");
  EXPECT_TRUE(results[1].positive());
  EXPECT_EQ(results[1].data.size(), 2U);
}

TEST_F(C1Test, StoppingTheMasterLosesTheOneAtWork) {
  mailbox.busy_polls = -1;
  master.c1_read(3, 0, 0, 1, keep());
  run_until([this] { return mailbox.open(); });
  master.stop();
  run(kTicksPerMs);
  ASSERT_EQ(results.size(), 1U);
  EXPECT_EQ(results[0].reason, "the master was stopped");
}

TEST_F(C1Test, BeforeDataExchangeAnOperationWaits) {
  master.release(3);
  run_until([this] { return master.slave(3).state == SlaveState::kReleased; });
  master.c1_read(3, 0, 0, 1, keep());
  run(5 * kTicksPerMs);
  EXPECT_TRUE(results.empty());
  master.activate(3);
  EXPECT_TRUE(last().positive());
}

TEST_F(C1Test, AnAnswerThatDoesNotFitIsReportedAsWrong) {
  const std::vector<std::pair<Bytes, std::string>> wrong = {
      {{0x5F, 1, 2, 0}, "Function_Num 0x5F"},     {{0x5E, 9, 2, 1, 0}, "slot 9"}, {{0x5E, 1, 9, 1, 0}, "index 9"},
      {{0x5E, 1, 2, 3, 0}, "length byte says 3"}, {{0x5E, 1, 2}, "3 bytes"},
  };
  for (const auto& [answer, words] : wrong) {
    mailbox.user = [&answer = answer](const Bytes&) { return answer; };
    const AcyclicResult result = read();
    EXPECT_EQ(result.outcome, AcyclicOutcome::kWrongAnswer);
    EXPECT_THAT(result.reason, HasSubstr(words));
  }
  mailbox.user = [](const Bytes&) { return Bytes{0x5F, 1, 2, 2}; };
  EXPECT_THAT(write({1, 2, 3}).reason, HasSubstr("2 bytes acknowledged"));
}

TEST_F(C1Test, ALostAnswerIsRepeatedByTheDataLinkLayerAndNothingIsExecutedTwice) {
  run_until([this] { return !master.slave(3).inputs.empty(); });
  slave.silent_for = 1;
  master.c1_write(3, 1, 2, {1}, keep());
  EXPECT_TRUE(last().positive());
  EXPECT_EQ(mailbox.requests.size(), 1U);
}

TEST_F(C1Test, WithoutAnAnswerOfTheStationAtAllItEnds) {
  slave.acyclic_silent = true;
  EXPECT_EQ(read().outcome, AcyclicOutcome::kNoAnswer);
}

TEST_F(C1Test, EveryResultIsReportedToTheMastersObserver) {
  int told = 0;
  master.on_acyclic = [&](Tick, std::uint8_t address, const AcyclicResult& result) {
    told += address == 3 && result.positive() ? 1 : 0;
  };
  read();
  EXPECT_EQ(told, 1);
  EXPECT_THROW(master.c1_read(9, 0, 0, 1), std::out_of_range);
}

TEST(EnableDpv1, FollowsTheGsdFile) {
  Gsd gsd;
  SlaveParameters parameters;
  EXPECT_THAT(enable_dpv1(gsd, parameters), HasSubstr("DPV1_Slave"));
  gsd.dpv1 = true;
  EXPECT_THAT(enable_dpv1(gsd, parameters), HasSubstr("C1_Read_Write_supp"));
  EXPECT_FALSE(parameters.dpv1);
  gsd.c1_read_write = true;
  gsd.c1_response_timeout = 42;
  EXPECT_EQ(enable_dpv1(gsd, parameters), "");
  EXPECT_EQ(parameters.c1_response_timeout, 42);
  const Bytes prm = set_prm_data(parameters, 0);
  EXPECT_EQ(Bytes(prm.begin() + 7, prm.end()), (Bytes{0x80, 0, 0}));
}

}  // namespace
}  // namespace dsdpv1::bus
