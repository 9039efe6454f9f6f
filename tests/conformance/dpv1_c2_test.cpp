// MSAC_C2 (7.3; rulings V2 to V15): resource manager, channels, timers.
#include "tests/conformance/dpv1_side.hpp"

namespace dsdpv1::conformance {
namespace {

class C2 : public Dpv1Test {
 protected:
  /// The cycle at which the chip decided a request: section 7 of the micro-architecture.
  Cycle decided(const Exchange& exchange) const {
    return seen_at(exchange.request_end) + exchange.bit / kCycleTicks + 1;
  }
  Cycle cycle_of(Reason reason) const { return bench.last(reason).at / kCycleTicks; }
  static const Bytes& connected_answer() {
    static const Bytes answer = {0x57, 0xF0, 1, 0, 0, 0, 0, 0, 0, 2, 0, 2, 0x0C, 0x0D, 0x0A, 0x0B};
    return answer;
  }
  static Bytes abort_pdu(int reason) { return {0x58, 0, static_cast<std::uint8_t>(0x10 | reason)}; }
  /// A request on a channel brought to the user.
  void to_user(int sap, const Bytes& request, std::uint8_t master = kClass2) {
    ASSERT_TRUE(is_sc(c2(sap, request, master)));
    bench.chip_accesses(3);
    ASSERT_EQ(fetch(kC2Area), request);
  }
};

// --- Initiate

TEST_F(C2, InitiateIsAnsweredAtOnceAndConnectedByTheFirstPoll) {
  start();
  const Exchange immediate = c2(kManagerSap, initiate_pdu(0x1234));
  ASSERT_TRUE(is_data(immediate)) << kind_of(immediate);
  EXPECT_EQ(immediate.answer().data, (Bytes{0x56, 0x30, 0x12, 0x34}));
  EXPECT_EQ(immediate.answer().ssap, kManagerSap);
  EXPECT_EQ(immediate.answer().dsap, kC2Ssap);
  EXPECT_TRUE(registry(0x30).in_use);
  EXPECT_FALSE(registry(0x30).connected);
  EXPECT_EQ(registry(0x30).master, kClass2);
  const Exchange poll = c2(kFirstChannel);
  ASSERT_TRUE(is_data(poll));
  EXPECT_EQ(poll.answer().data, connected_answer());
  EXPECT_EQ(poll.answer().ssap, kFirstChannel);
  EXPECT_TRUE(registry(0x30).connected);
  EXPECT_FALSE(registry(0x30).exchanging);
  EXPECT_EQ(dsdpv1::describe(bench.last(Reason::kRmEntry)), "RM registry: channel 48, master 1, in use, connected");
  EXPECT_FALSE(registry(0x2F).in_use);
  EXPECT_TRUE(is_sc(c2(kFirstChannel))) << "nothing waits";
}

TEST_F(C2, AddressesAreExchanged) {
  start();
  const std::pair<Bytes, Bytes> cases[] = {
      {{0x11, 0x22}, {0x22, 0x11}},
      {{0, 0, 0, 0}, {0, 0, 0, 0}},
      {{1, 3, 0, 2, 1, 2, 3, 8, 9}, {0, 2, 1, 3, 8, 9, 1, 2, 3}},
      {{7, 0, 9, 1, 5}, {9, 1, 7, 0, 5}},
  };
  for (const auto& [request, answer] : cases) {
    ASSERT_TRUE(is_data(c2(kManagerSap, initiate_pdu(100, request))));
    const Exchange poll = c2(kFirstChannel);
    ASSERT_TRUE(is_data(poll));
    Bytes expected = {0x57, 0xF0, 1, 0, 0, 0, 0, 0};
    expected.insert(expected.end(), answer.begin(), answer.end());
    EXPECT_EQ(poll.answer().data, expected);
    EXPECT_TRUE(is_sc(c2(kFirstChannel, {0x58, 0, 0, 0})));
  }
}

TEST_F(C2, LongestAddressesFitTheLongestTelegram) {
  start();
  Bytes addr = {1, 115, 2, 113};  // 12 + 4 + 228 = 244 bytes
  for (int i = 0; i < 228; ++i) addr.push_back(static_cast<std::uint8_t>(i));
  ASSERT_TRUE(is_data(c2(kManagerSap, initiate_pdu(100, addr))));
  const Exchange poll = c2(kFirstChannel);
  ASSERT_TRUE(is_data(poll));
  const Bytes& data = poll.answer().data;
  ASSERT_EQ(data.size(), 8U + 232U);
  EXPECT_EQ(Bytes(data.begin() + 8, data.begin() + 12), (Bytes{2, 113, 1, 115}));
  EXPECT_EQ(data[12], 115);
  EXPECT_EQ(data[12 + 113], 0);
}

TEST_F(C2, InitiatesThatCannotBeGrantedAreRefusedAtThePoll) {
  start();
  Bytes no_features = initiate_pdu();
  no_features[6] = 0xFE;
  Bytes both = initiate_pdu(100, {1, 2, 3});
  both[6] = 0x00;
  for (const Bytes& request : {no_features, both}) {
    ASSERT_TRUE(is_data(c2(kManagerSap, request)));
    EXPECT_EQ(text(c2(kFirstChannel)), testing::PrintToString(Bytes{0xD7, 0x80, 0xA9, 0}));
    EXPECT_FALSE(registry(0x30).in_use);
    EXPECT_TRUE(is_rs(c2(kFirstChannel)));
  }
  EXPECT_EQ(bench.count(Reason::kC2InitiateRefused), 2);
}

TEST_F(C2, InitiatesWithWrongAddressesAreAbortedAtThePoll) {
  start();
  int refused = 0;
  for (const Bytes& add_addr : {Bytes{0, 2, 0, 2, 1, 2, 3}, Bytes{0, 2, 0, 2, 1, 2, 3, 4, 5}, Bytes{1, 2, 3}}) {
    ASSERT_TRUE(is_data(c2(kManagerSap, initiate_pdu(100, add_addr))));
    EXPECT_EQ(text(c2(kFirstChannel)), testing::PrintToString(abort_pdu(7)));
    EXPECT_FALSE(registry(0x30).in_use);
    EXPECT_TRUE(is_rs(c2(kFirstChannel)));
    EXPECT_EQ(bench.count(Reason::kC2AddAddr), ++refused);
    EXPECT_EQ(bench.last(Reason::kC2AddAddr).b, add_addr.size());
    EXPECT_EQ(bench.last(Reason::kC2Abort).b, 0x17);
  }
}

TEST_F(C2, ManagerRefusesWhatIsNoInitiate) {
  start();
  Bytes shorter = initiate_pdu();
  shorter.resize(13);
  EXPECT_TRUE(is_rs(c2(kManagerSap, shorter)));
  EXPECT_TRUE(is_rs(c2(kManagerSap, {0x5E, 0, 0, 1, 0, 1, 1, 0, 0, 0, 0, 0, 0, 0})));
  EXPECT_TRUE(is_rs(c2(kManagerSap, initiate_pdu(0)))) << "a Send_Timeout of 0 cannot be kept";
  EXPECT_EQ(bench.count(Reason::kC2InitiateWrong), 3);
  EXPECT_TRUE(is_sc(c2(kManagerSap))) << "a poll";
  EXPECT_TRUE(is_rs(send_fc(bench, kSrdFirst, kManagerSap, 51, initiate_pdu())));
  EXPECT_EQ(bench.count(Reason::kAcyclicSsap), 1);
  EXPECT_FALSE(registry(0x30).in_use);
}

TEST_F(C2, TwoChannelsForOneMasterOrForTwoAndAThirdIsRefused) {
  for (const std::uint8_t second : {std::uint8_t{1}, std::uint8_t{9}}) {
    SCOPED_TRACE(int{second});
    start();
    EXPECT_EQ(connect(1), kFirstChannel);
    EXPECT_EQ(connect(second), kSecondChannel);
    EXPECT_EQ(registry(0x2F).master, second);
    EXPECT_TRUE(registry(0x2F).in_use && registry(0x2F).connected);
    EXPECT_FALSE(registry(0x2F).exchanging);
    EXPECT_TRUE(is_rs(c2(kManagerSap, initiate_pdu(), 7)));
    EXPECT_EQ(bench.last(Reason::kC2Full).a, 7);
    EXPECT_TRUE(is_sc(c2(kFirstChannel, {0x58}, 1)));
    EXPECT_EQ(connect(7), kFirstChannel) << "the channel that became free";
    bench.chip.set(bench.now() + 250, Pin::kReset, 0);
    bench.run_cycles(20);
  }
}

// D17, V7. An early version of Initiate used the B005 that the chip had read last.
TEST_F(C2, NeedsB005AtTheInitialisationAndNoParameterising) {
  bench.power_on();
  EXPECT_TRUE(c2(kManagerSap, initiate_pdu()).silent()) << "OFFLINE";
  ASSERT_TRUE(bench.initialise());
  bench.find_baud(0);
  EXPECT_TRUE(is_rs(c2(kManagerSap, initiate_pdu())));
  bench.enable_dpv1(true);
  bench.chip_accesses();
  EXPECT_TRUE(is_rs(c2(kManagerSap, initiate_pdu()))) << "too late";
  EXPECT_EQ(bench.count(Reason::kC2Disabled), 2);
  EXPECT_EQ(bench.last(Reason::kC2Disabled).a, kClass2);
  ASSERT_TRUE(bench.initialise());
  bench.find_baud(0);
  EXPECT_EQ(connect(), kFirstChannel);
  EXPECT_EQ(bench.dp_state(), DpState::kWaitPrm);
  bench.enable_dpv1(false);
  bench.chip_accesses();
  EXPECT_TRUE(is_sc(c2(kFirstChannel, read_request(0, 0, 1))));
  EXPECT_EQ(connect(), kSecondChannel) << "nor does a new connection look again";
}

TEST_F(C2, ChannelIsOnlyForItsMasterAndSsap50) {
  start();
  EXPECT_TRUE(is_rs(c2(kFirstChannel)));
  EXPECT_EQ(bench.count(Reason::kC2NotInUse), 1);
  ASSERT_EQ(connect(), kFirstChannel);
  EXPECT_TRUE(is_rs(c2(kFirstChannel, {}, 9)));
  EXPECT_EQ(bench.last(Reason::kC2Master).c, kClass2);
  EXPECT_TRUE(is_rs(send_fc(bench, kSrdFirst, kFirstChannel, 51, {}, kClass2)));
  EXPECT_TRUE(is_rs(c2(kFirstChannel, {0x58, 0, 0, 0}, 9))) << "nor may another master abort it";
  EXPECT_TRUE(registry(0x30).connected);
  ASSERT_EQ(connect(), kSecondChannel);
  EXPECT_TRUE(is_rs(send_fc(bench, kSrdFirst, kSecondChannel, 51, {}, kClass2)));
  for (const int sap : {0, 1, 46, 0x32}) EXPECT_TRUE(is_rs(c2(sap))) << sap;
}

// --- requests

TEST_F(C2, ReadWriteAndTransportReachTheUserAndTheAnswerTheMaster) {
  start();
  ASSERT_EQ(connect(), kFirstChannel);
  const std::pair<Bytes, Bytes> cases[] = {
      {read_request(1, 2, 20), pdu_of(0x5E, 1, 2, 3, {7, 8, 9})},
      {pdu_of(0x5F, 1, 2, 3, {7, 8, 9}), pdu_of(0x5F, 1, 2, 3)},
      {pdu_of(0x51, 1, 2, 2, {1, 2}), pdu_of(0x51, 1, 2, 4, {3, 4, 5, 6})},
      {pdu_of(0x51, 1, 2, 0), pdu_of(0xD1, 0x80, 0xB0, 0xFF)},
      {read_request(1, 2, 20), pdu_of(0xDE, 0x80, 0xB2, 0)},
      {pdu_of(0x5F, 1, 2, 0), pdu_of(0xDF, 0x80, 0xB6, 241)},
  };
  for (const auto& [request, answer] : cases) {
    SCOPED_TRACE(testing::PrintToString(request));
    to_user(kFirstChannel, request);
    if (request == read_request(1, 2, 20)) EXPECT_EQ(bench.peek(0x7C4, 2), (Bytes{0x63, 0x43})) << "its CRC";
    EXPECT_TRUE(registry(0x30).exchanging);
    EXPECT_TRUE(is_sc(c2(kFirstChannel)));
    EXPECT_TRUE(is_rr(c2(kFirstChannel, read_request(0, 0, 1))));
    EXPECT_TRUE(is_rr(c2(kFirstChannel, {0x48})));
    give(kC2Area, answer);
    EXPECT_TRUE(is_rr(c2(kFirstChannel, read_request(0, 0, 1)))) << "answered, not fetched";
    EXPECT_EQ(text(c2(kFirstChannel)), testing::PrintToString(answer));
    EXPECT_FALSE(registry(0x30).exchanging);
  }
}

TEST_F(C2, EveryLengthFrom0To240IsTransported) {
  start();
  ASSERT_EQ(connect(kClass2, 1000), kFirstChannel);
  for (int length = 0; length <= 240; ++length) {
    const Bytes pdu = pdu_of(0x51, 3, 4, length, counting(length, length));
    ASSERT_TRUE(is_sc(c2(kFirstChannel, pdu)));
    bench.chip_accesses(3);
    ASSERT_EQ(fetch(kC2Area), pdu);
    const Bytes answer = pdu_of(0x51, 3, 4, 240 - length, counting(240 - length, 3 * length));
    give(kC2Area, answer);
    ASSERT_EQ(text(c2(kFirstChannel)), testing::PrintToString(answer));
  }
}

TEST_F(C2, IdleIsAnsweredByTheChip) {
  start();
  ASSERT_EQ(connect(), kFirstChannel);
  EXPECT_TRUE(is_sc(c2(kFirstChannel, {0x48})));
  EXPECT_EQ(text(c2(kFirstChannel)), testing::PrintToString(Bytes{0x48}));
  bench.chip_accesses();
  EXPECT_EQ(bench.peek(0x00F), 0);
}

// V9, V11. Until an audit the chip answered them with error PDUs, and the early request at once.
TEST_F(C2, RequestsThatAreNoneOfItsServicesAbortTheChannelAtTheNextTelegram) {
  start();
  const std::pair<Bytes, int> cases[] = {{{0x5C, 0, 0, 0}, 2},    {{0x5D, 0, 0, 0}, 2}, {{0x5E, 0, 0, 1, 2}, 2},
                                         {{0x5E, 0, 0}, 2},       {{0x51, 0, 0, 1}, 2}, {{0x51}, 2},
                                         {{0x5F, 0, 0, 0, 1}, 2}, {{0x56, 0, 0, 0}, 2}, {{0xDE, 0x80, 0xB2, 0}, 2},
                                         {{0x57, 0, 0, 0}, 1},    {{0x57}, 1},          {initiate_pdu(), 1}};
  bool poll = false;
  for (const auto& [request, reason] : cases) {
    SCOPED_TRACE(testing::PrintToString(request));
    ASSERT_EQ(connect(), kFirstChannel);
    EXPECT_TRUE(is_sc(c2(kFirstChannel, request)));
    EXPECT_EQ(bench.last(Reason::kC2WrongRequest).b, request[0]);
    EXPECT_EQ(bench.last(Reason::kC2WrongRequest).c, reason);
    EXPECT_TRUE(registry(0x30).in_use);
    EXPECT_FALSE(registry(0x30).connected);
    poll = !poll;  // the next telegram, whatever it is
    EXPECT_EQ(text(c2(kFirstChannel, poll ? Bytes{} : read_request(1, 1, 1))),
              testing::PrintToString(abort_pdu(reason)));
    EXPECT_FALSE(registry(0x30).in_use);
    EXPECT_TRUE(is_rs(c2(kFirstChannel)));
  }
  bench.chip_accesses();
  EXPECT_EQ(bench.peek(0x00F), 0) << "the user sees none of them";
}

TEST_F(C2, WhileARequestIsUnderWayAnythingElseIsRr) {
  start();
  ASSERT_EQ(connect(), kFirstChannel);
  to_user(kFirstChannel, read_request(1, 1, 1));
  for (const Bytes& other : {Bytes{0x5C}, initiate_pdu(), Bytes{0x48}, read_request(2, 2, 2)})
    EXPECT_TRUE(is_rr(c2(kFirstChannel, other)));
  EXPECT_EQ(bench.count(Reason::kC2WrongRequest), 0);
  give(kC2Area, pdu_of(0x5E, 1, 1, 1, {9}));
  EXPECT_TRUE(is_rr(c2(kFirstChannel, {0x5C})));
  EXPECT_EQ(text(c2(kFirstChannel)), testing::PrintToString(pdu_of(0x5E, 1, 1, 1, {9})));
}

TEST_F(C2, ReadsOfMoreThan240BytesReachTheUserWhoJudges) {
  start();
  ASSERT_EQ(connect(), kFirstChannel);
  for (const int length : {241, 255}) {
    to_user(kFirstChannel, read_request(1, 2, length));
    give(kC2Area, pdu_of(0xDE, 0x80, 0xB7, 0));
    EXPECT_EQ(text(c2(kFirstChannel)), testing::PrintToString(pdu_of(0xDE, 0x80, 0xB7, 0)));
  }
}

TEST_F(C2, RequestBeforeTheInitiateAnswerIsASequenceError) {
  start();
  for (const Bytes& request : {read_request(0, 0, 1), Bytes{0x48}, initiate_pdu()}) {
    ASSERT_TRUE(is_data(c2(kManagerSap, initiate_pdu())));
    EXPECT_TRUE(is_sc(c2(kFirstChannel, request)));
    EXPECT_TRUE(registry(0x30).in_use);
    EXPECT_EQ(text(c2(kFirstChannel)), testing::PrintToString(abort_pdu(1)));
    EXPECT_FALSE(registry(0x30).in_use);
    EXPECT_TRUE(is_rs(c2(kFirstChannel)));
  }
}

TEST_F(C2, ChannelAbortedByAWrongRequestIsFreedByItsMastersAbortOrAfterAnotherSendTimeout) {
  start();
  ASSERT_EQ(connect(kClass2, 1), kFirstChannel);
  ASSERT_TRUE(is_sc(c2(kFirstChannel, {0x5C})));
  EXPECT_TRUE(is_sc(c2(kFirstChannel, {0x58, 0, 0x20}))) << "no abort PDU for an abort";
  EXPECT_FALSE(registry(0x30).in_use);
  ASSERT_EQ(connect(kClass2, 1), kFirstChannel);
  const Exchange wrong = c2(kFirstChannel, {0x5C});
  const Cycle end = decided(wrong) + kSendTimeoutUnit;
  run_to_cycle(bench, end - 1);
  EXPECT_TRUE(registry(0x30).in_use);
  run_to_cycle(bench, end);
  EXPECT_FALSE(registry(0x30).in_use);
  EXPECT_EQ(bench.count(Reason::kC2Freed), 1);
  EXPECT_EQ(bench.count(Reason::kC2Timeout), 0);
}

TEST_F(C2, MasterAbortsInEveryState) {
  start();
  const auto aborts = [&](const char* state) {
    EXPECT_TRUE(is_sc(c2(kFirstChannel, {0x58, 1, 0x21, 7}))) << state;
    EXPECT_FALSE(registry(0x30).in_use) << state;
    EXPECT_EQ(bench.last(Reason::kC2AbortedByMaster).b, 0x21) << state;
    EXPECT_TRUE(is_rs(c2(kFirstChannel))) << state;
  };
  ASSERT_TRUE(is_data(c2(kManagerSap, initiate_pdu())));
  aborts("initiated");
  ASSERT_EQ(connect(), kFirstChannel);
  aborts("open");
  ASSERT_EQ(connect(), kFirstChannel);
  bench.acquire();
  ASSERT_TRUE(is_sc(c2(kFirstChannel, read_request(1, 1, 1))));
  aborts("waiting to be written");
  bench.release();
  bench.chip_accesses(3);
  EXPECT_EQ(bench.peek(0x00F), 0) << "withdrawn";
  ASSERT_EQ(connect(), kFirstChannel);
  ASSERT_TRUE(is_sc(c2(kFirstChannel, read_request(1, 1, 1))));
  bench.chip_accesses(3);
  aborts("with the user");
  bench.chip_accesses(3);
  EXPECT_EQ(fetch(kC2Area), read_request(1, 1, 1)) << "it stays (V13)";
  give(kC2Area, pdu_of(0x5E, 1, 1, 1, {1}));
  EXPECT_EQ(bench.last(Reason::kAcyclicNoRequest).a, 2);
  ASSERT_EQ(connect(), kFirstChannel);
  to_user(kFirstChannel, read_request(1, 1, 1));
  give(kC2Area, pdu_of(0x5E, 1, 1, 1, {1}));
  aborts("answered");
  ASSERT_EQ(connect(kClass2, 1), kFirstChannel);
  bench.run_cycles(2 * kSendTimeoutUnit + 100);
  ASSERT_EQ(bench.count(Reason::kC2Timeout), 1);
  aborts("aborted");
}

TEST_F(C2, AbortWithoutAnswerFreesTheChannelToo) {
  start();
  const auto sdn = [&](std::uint8_t master, const Bytes& data, std::uint8_t to = 5) {
    bench.requester.send(bench.timeline, bus::make_telegram(to, master, kSdnHigh, data, kFirstChannel, kC2Ssap),
                         {.wants_answer = false});
    bench.run_for(bench.requester.bit() * 20);
  };
  sdn(kClass2, {0x58, 0, 0, 0});
  EXPECT_EQ(bench.count(Reason::kSdnIgnored), 1) << "nothing to abort";
  ASSERT_EQ(connect(), kFirstChannel);
  sdn(9, {0x58, 0, 0, 0});
  sdn(kClass2, {0x48});
  EXPECT_EQ(bench.count(Reason::kSdnIgnored), 3);
  EXPECT_TRUE(registry(0x30).in_use);
  sdn(kClass2, {0x58, 0, 0, 0});
  EXPECT_FALSE(registry(0x30).in_use);
  ASSERT_EQ(connect(), kFirstChannel);
  sdn(kClass2, {0x58}, bus::kBroadcast);
  EXPECT_FALSE(registry(0x30).in_use) << "to all stations, and of one byte";
}

// --- the shared area (V4)

TEST_F(C2, SecondChannelWaitsUntilTheFirstIsAnswered) {
  start();
  ASSERT_EQ(connect(1), kFirstChannel);
  ASSERT_EQ(connect(9), kSecondChannel);
  // 7.3: a buffer of 240 bytes each, as all four PDUs are
  const Bytes first = pdu_of(0x51, 1, 1, 240, counting(240, 1)), second = pdu_of(0x51, 2, 2, 240, counting(240, 2));
  const Bytes answer = pdu_of(0x51, 1, 1, 240, counting(240, 3)), last = pdu_of(0x51, 2, 2, 240, counting(240, 4));
  to_user(kFirstChannel, first, 1);
  ASSERT_TRUE(is_sc(c2(kSecondChannel, second, 9)));
  bench.chip_accesses(3);
  EXPECT_EQ(bench.peek(0x00F), 0);
  EXPECT_TRUE(is_sc(c2(kSecondChannel, {}, 9)));
  give(kC2Area, answer);
  EXPECT_EQ(fetch(kC2Area), second) << "written in the same access that took the first one's answer, or the next";
  give(kC2Area, last);
  EXPECT_EQ(text(c2(kSecondChannel, {}, 9)), testing::PrintToString(last));
  EXPECT_EQ(text(c2(kFirstChannel, {}, 1)), testing::PrintToString(answer));
}

TEST_F(C2, AbortOfTheFirstChannelHandsTheAreaToTheSecond) {
  start();
  ASSERT_EQ(connect(1), kFirstChannel);
  ASSERT_EQ(connect(9), kSecondChannel);
  bench.acquire();
  ASSERT_TRUE(is_sc(c2(kFirstChannel, read_request(1, 1, 1), 1)));
  ASSERT_TRUE(is_sc(c2(kSecondChannel, read_request(2, 2, 2), 9)));
  ASSERT_TRUE(is_sc(c2(kFirstChannel, {0x58}, 1)));
  bench.release();
  bench.chip_accesses(3);
  EXPECT_EQ(fetch(kC2Area), read_request(2, 2, 2));
}

TEST_F(C2, C1AndC2AreOpenAtTheSameTime) {
  start();
  ASSERT_EQ(connect(), kFirstChannel);
  bench.acquire();
  ASSERT_TRUE(is_sc(c1(read_request(1, 1, 1))));
  ASSERT_TRUE(is_sc(c2(kFirstChannel, read_request(2, 2, 2))));
  bench.release();
  bench.chip_accesses(3);
  EXPECT_EQ(bench.peek(0x00F), 3);
  EXPECT_EQ(fetch(kC2Area), read_request(2, 2, 2));
  EXPECT_EQ(fetch(kC1Area), read_request(1, 1, 1));
  give(kC2Area, pdu_of(0x5E, 2, 2, 1, {2}));
  EXPECT_TRUE(is_sc(c1({})));
  EXPECT_EQ(text(c2(kFirstChannel)), testing::PrintToString(pdu_of(0x5E, 2, 2, 1, {2})));
  give(kC1Area, pdu_of(0x5E, 1, 1, 1, {1}));
  EXPECT_EQ(text(c1({})), testing::PrintToString(pdu_of(0x5E, 1, 1, 1, {1})));
}

TEST_F(C2, LeavingDataExchangeTouchesNoChannel) {
  start();
  ASSERT_EQ(connect(), kFirstChannel);
  to_user(kFirstChannel, read_request(1, 1, 1));
  ASSERT_TRUE(is_sc(bench.set_prm({})));
  ASSERT_EQ(bench.dp_state(), DpState::kWaitCfg);
  EXPECT_EQ(connect(9), kSecondChannel) << "an Initiate is served here, too (V7)";
  give(kC2Area, pdu_of(0x5E, 1, 1, 1, {1}));
  EXPECT_TRUE(is_data(c2(kFirstChannel)));
}

TEST_F(C2, NewInitialisationFreesBothChannels) {
  start();
  ASSERT_EQ(connect(1), kFirstChannel);
  ASSERT_EQ(connect(9), kSecondChannel);
  to_user(kFirstChannel, read_request(1, 1, 1), 1);
  ASSERT_TRUE(bench.initialise());
  EXPECT_FALSE(registry(0x30).in_use);
  EXPECT_FALSE(registry(0x2F).in_use);
  give(kC2Area, pdu_of(0x5E, 1, 1, 1, {1}));
  EXPECT_EQ(bench.count(Reason::kAcyclicNoRequest), 1);
}

TEST_F(C2, WrongCrcIsShownInB00BUntilARightAnswerComes) {
  start();
  ASSERT_EQ(connect(), kFirstChannel);
  to_user(kFirstChannel, read_request(1, 2, 3));
  give(kC2Area, pdu_of(0x5E, 1, 2, 1, {5}), 0x0001);
  EXPECT_EQ(bench.peek(0x00B), kC2Area.crc_error);
  EXPECT_EQ(bench.count(dpram::Reason::kC2Crc), 1);
  give(kC2Area, pdu_of(0x5E, 1, 2, 241));
  EXPECT_EQ(bench.last(dpram::Reason::kAcyclicLength).a, 2);
  EXPECT_EQ(bench.peek(0x00B), kC2Area.crc_error) << "D12: no CRC bit changes";
  give(kC2Area, pdu_of(0x5E, 1, 3, 1, {5}));
  EXPECT_EQ(bench.peek(0x00B), 0);
  EXPECT_EQ(bench.count(Reason::kAcyclicAnswerDiffers), 1);
  EXPECT_TRUE(is_sc(c2(kFirstChannel)));
  give(kC2Area, pdu_of(0x5E, 1, 2, 1, {5}));
  EXPECT_TRUE(is_data(c2(kFirstChannel)));
}

// --- timers (V12)

TEST_F(C2, FEndsOneSendTimeoutAfterTheImmediateAnswer) {
  start();
  const Exchange initiate = c2(kManagerSap, initiate_pdu(2));
  const Cycle end = decided(initiate) + 2 * kSendTimeoutUnit;
  run_to_cycle(bench, end - 1);
  EXPECT_EQ(bench.count(Reason::kC2Timeout), 0);
  run_to_cycle(bench, end);
  ASSERT_EQ(bench.count(Reason::kC2Timeout), 1);
  EXPECT_EQ(bench.last(Reason::kC2Timeout).b, 1);
  EXPECT_EQ(text(c2(kFirstChannel)), testing::PrintToString(abort_pdu(3)));
  EXPECT_FALSE(registry(0x30).in_use);
}

TEST_F(C2, IEndsTwoSendTimeoutsAfterTheConnectionAndPollsDoNotHelp) {
  start();
  ASSERT_TRUE(is_data(c2(kManagerSap, initiate_pdu(1))));
  const Exchange connected = c2(kFirstChannel);
  ASSERT_TRUE(is_data(connected));
  const Cycle end = decided(connected) + 2 * kSendTimeoutUnit;
  bench.run_cycles(kSendTimeoutUnit);
  EXPECT_TRUE(is_sc(c2(kFirstChannel)));
  run_to_cycle(bench, end - 1);
  EXPECT_EQ(bench.count(Reason::kC2Timeout), 0);
  run_to_cycle(bench, end);
  EXPECT_EQ(bench.last(Reason::kC2Timeout).b, 2);
  EXPECT_EQ(text(c2(kFirstChannel, {0x48})), testing::PrintToString(abort_pdu(3)));
}

TEST_F(C2, IdleAndItsAnswerKeepTheChannel) {
  start();
  ASSERT_EQ(connect(kClass2, 1), kFirstChannel);
  for (int i = 0; i < 5; ++i) {
    bench.run_cycles(2 * kSendTimeoutUnit - 10'000);
    ASSERT_TRUE(is_sc(c2(kFirstChannel, {0x48}))) << i;
    ASSERT_TRUE(is_data(c2(kFirstChannel))) << i;
  }
  EXPECT_EQ(bench.count(Reason::kC2Timeout), 0);
}

TEST_F(C2, FGoesOnThroughARefusedRequest) {
  start();
  ASSERT_EQ(connect(kClass2, 1), kFirstChannel);
  ASSERT_TRUE(is_sc(c2(kFirstChannel, {0x48})));  // answered by the chip: only F runs
  bench.run_cycles(kSendTimeoutUnit - 5'000);
  EXPECT_TRUE(is_rr(c2(kFirstChannel, {0x48}))) << "no poll: F goes on";
  bench.run_cycles(5'000);
  EXPECT_EQ(bench.last(Reason::kC2Timeout).b, 1);
  EXPECT_EQ(text(c2(kFirstChannel)), testing::PrintToString(abort_pdu(3)));
}

// The second channel's request waits for its turn: of its timers only F runs.
TEST_F(C2, FEndsOneSendTimeoutAfterTheLastPollOfAnOpenRequest) {
  start();
  ASSERT_EQ(connect(1, 1), kFirstChannel);
  ASSERT_EQ(connect(9, 1), kSecondChannel);
  ASSERT_TRUE(is_sc(c2(kFirstChannel, read_request(1, 1, 1), 1)));
  ASSERT_TRUE(is_sc(c2(kSecondChannel, read_request(2, 2, 2), 9)));
  bench.run_cycles(kSendTimeoutUnit / 2);
  const Exchange poll = c2(kSecondChannel, {}, 9);
  ASSERT_TRUE(is_sc(poll));
  const Cycle end = decided(poll) + kSendTimeoutUnit;
  run_to_cycle(bench, end - 1);
  EXPECT_EQ(bench.count(Reason::kC2Timeout), 1) << "that of the first channel";
  EXPECT_EQ(bench.last(Reason::kC2Timeout).a, kFirstChannel);
  run_to_cycle(bench, end);
  EXPECT_EQ(bench.last(Reason::kC2Timeout).a, kSecondChannel);
  EXPECT_EQ(bench.last(Reason::kC2Timeout).b, 1);
}

TEST_F(C2, UEndsOneSendTimeoutAfterTheRequestThoughTheMasterPolls) {
  start();
  ASSERT_EQ(connect(kClass2, 1), kFirstChannel);
  const Exchange request = c2(kFirstChannel, read_request(1, 1, 1));
  ASSERT_TRUE(is_sc(request));
  const Cycle end = decided(request) + kSendTimeoutUnit;
  bench.chip_accesses(3);
  fetch(kC2Area);
  give(kC2Area, pdu_of(0x5E, 1, 9, 1, {1}));
  EXPECT_EQ(bench.count(Reason::kAcyclicAnswerDiffers), 1) << "V6: U goes on";
  Exchange poll;
  while (bench.now() / kCycleTicks < end - 50'000) {
    bench.run_cycles(20'000);
    poll = c2(kFirstChannel);
    ASSERT_TRUE(is_sc(poll));
  }
  run_to_cycle(bench, end - 1);
  EXPECT_EQ(bench.count(Reason::kC2Timeout), 0);
  run_to_cycle(bench, end);
  EXPECT_EQ(bench.last(Reason::kC2Timeout).b, 3);
  EXPECT_TRUE(registry(0x30).in_use);
  give(kC2Area, pdu_of(0x5E, 1, 1, 1, {1}));
  EXPECT_EQ(bench.count(Reason::kAcyclicNoRequest), 1) << "too late";
  EXPECT_EQ(text(c2(kFirstChannel)), testing::PrintToString(abort_pdu(3)));
  EXPECT_FALSE(registry(0x30).in_use);
}

TEST_F(C2, AnswerCommittedInTheCycleInWhichUEndsIsInTimeAndOneCycleLaterIsNot) {
  for (const int late : {0, 1}) {
    SCOPED_TRACE(late);
    start();
    ASSERT_EQ(connect(kClass2, 1), kFirstChannel);
    const Exchange request = c2(kFirstChannel, read_request(1, 1, 1));
    const Cycle end = decided(request) + kSendTimeoutUnit;
    bench.chip_accesses(3);
    fetch(kC2Area);
    run_to_cycle(bench, end - 60'000);
    ASSERT_TRUE(is_sc(c2(kFirstChannel)));  // F anew
    // The commit is at s + 7 + 4 + 1 + 4; the access starts when R_REQ is seen low, 3 cycles after the tick of its
    // fall.
    const Cycle commit = end + late;
    bench.acquire();
    bench.write_block(kC2Area.base, pdu_of(0x5E, 1, 1, 1, {1}), kC2Area.crc);
    bench.write(0x011, kC2Area.flag);
    run_to_cycle(bench, commit - 16 - 3);
    bench.release();
    bench.chip_accesses(3);
    EXPECT_EQ(bench.count(Reason::kC2Timeout), late);
    EXPECT_EQ(bench.count(Reason::kAcyclicNoRequest), late);
    const Bytes answer = late == 0 ? pdu_of(0x5E, 1, 1, 1, {1}) : abort_pdu(3);
    EXPECT_EQ(text(c2(kFirstChannel)), testing::PrintToString(answer));
    bench.chip.set(bench.now() + 250, Pin::kReset, 0);
    bench.run_cycles(20);
  }
}

TEST_F(C2, PollDecidedInTheCycleInWhichFEndsIsTooLate) {
  for (const int late : {0, 1}) {
    SCOPED_TRACE(late);
    start();
    const Exchange initiate = c2(kManagerSap, initiate_pdu(1));
    const Cycle end = decided(initiate) + kSendTimeoutUnit;
    send_decided_at(bench, end - 1 + late, 0, bus::make_telegram(5, kClass2, kSrdFirst, {}, kFirstChannel, kC2Ssap),
                    true);
    EXPECT_EQ(bench.count(Reason::kC2Timeout), late);
    EXPECT_EQ(bench.count(Reason::kC2Connected), 1) << "only the first of the two";
    bench.chip.set(bench.now() + 250, Pin::kReset, 0);
    bench.run_cycles(20);
  }
}

// A master sees the end of a time in the chip's answers to telegrams decided in that cycle and in the one before.
TEST_F(C2, RequestDecidedInTheCycleInWhichIEndsIsTooLate) {
  for (const int late : {0, 1}) {
    SCOPED_TRACE(late);
    start();
    ASSERT_TRUE(is_data(c2(kManagerSap, initiate_pdu(1))));
    const Exchange connected = c2(kFirstChannel);
    ASSERT_TRUE(is_data(connected));
    const Cycle end = decided(connected) + 2 * kSendTimeoutUnit;
    send_decided_at(bench, end - 1 + late, 0, bus::make_telegram(5, kClass2, kSrdFirst, {0x48}, kFirstChannel, kC2Ssap),
                    true);
    EXPECT_EQ(bench.count(Reason::kC2Timeout), late);
    bench.chip.set(bench.now() + 250, Pin::kReset, 0);
    bench.run_cycles(20);
  }
}

TEST_F(C2, PollDecidedInTheCycleInWhichAnAbortedChannelIsFreeIsRefused) {
  int refused = 0;
  for (const bool by_request : {false, true}) {
    for (const int late : {0, 1}) {
      SCOPED_TRACE(late);
      start();
      const Exchange initiate = c2(kManagerSap, initiate_pdu(1));
      Cycle aborted = decided(initiate) + kSendTimeoutUnit;
      if (by_request) {
        ASSERT_TRUE(is_data(c2(kFirstChannel)));
        bench.run_cycles(kSendTimeoutUnit / 2);
        aborted = decided(c2(kFirstChannel, {0x5D}));
      }
      send_decided_at(bench, aborted + kSendTimeoutUnit - 1 + late, 0,
                      bus::make_telegram(5, kClass2, kSrdFirst, {}, kFirstChannel, kC2Ssap), true);
      bench.run_cycles(1'000);
      EXPECT_EQ(bench.count(Reason::kC2NotInUse), refused += late) << "else the answer is the abort";
      bench.chip.set(bench.now() + 250, Pin::kReset, 0);
      bench.run_cycles(20);
    }
  }
}

TEST_F(C2, TwiceALongSendTimeoutIsNoShortI) {
  start();
  ASSERT_EQ(connect(kClass2, 0x8001), kFirstChannel);  // twice that has 17 bits, the rest of them is 2
  bench.run_cycles(2 * kSendTimeoutUnit + 1'000);
  EXPECT_TRUE(is_sc(c2(kFirstChannel)));
  EXPECT_EQ(bench.count(Reason::kC2Timeout), 0);
}

TEST_F(C2, FAndUMayEndInTheSameCycle) {
  start();
  ASSERT_EQ(connect(kClass2, 1), kFirstChannel);
  const Exchange request = c2(kFirstChannel, read_request(1, 1, 1));
  ASSERT_TRUE(is_sc(request));
  run_to_cycle(bench, decided(request) + kSendTimeoutUnit);
  EXPECT_EQ(bench.count(Reason::kC2Timeout), 1);
  EXPECT_EQ(bench.last(Reason::kC2Timeout).b, 1) << "F before U";
  EXPECT_EQ(text(c2(kFirstChannel)), testing::PrintToString(abort_pdu(3)));
}

TEST_F(C2, TimersOfBothChannelsThatEndInOneCycleAbortTheFirstChannelFirst) {
  start();
  ASSERT_TRUE(is_data(c2(kManagerSap, initiate_pdu(2), 1)));
  const Exchange first = c2(kFirstChannel, {}, 1);
  ASSERT_TRUE(is_data(first));
  const Cycle begun = decided(first), middle = begun + 2 * kSendTimeoutUnit, end = begun + 4 * kSendTimeoutUnit;
  run_to_cycle(bench, middle - 100'000);
  ASSERT_TRUE(is_data(c2(kManagerSap, initiate_pdu(1), 9)));
  send_decided_at(bench, middle, 0, bus::make_telegram(5, 9, kSrdFirst, {}, kSecondChannel, kC2Ssap), true);
  ASSERT_TRUE(registry(0x2F).connected);
  run_to_cycle(bench, end - 1);
  EXPECT_EQ(bench.count(Reason::kC2Timeout), 0);
  run_to_cycle(bench, end);
  std::vector<int> channels;
  for (const profibus::Event& event : bench.chip.events())
    if (event.reason == Reason::kC2Timeout) channels.push_back(event.a);
  EXPECT_EQ(channels, (std::vector<int>{kFirstChannel, kSecondChannel}));
}

TEST_F(C2, AbortedChannelIsFreeAfterAnotherSendTimeoutWithoutItsMaster) {
  start();
  ASSERT_EQ(connect(kClass2, 1), kFirstChannel);
  bench.run_cycles(2 * kSendTimeoutUnit + 1'000);
  ASSERT_EQ(bench.count(Reason::kC2Timeout), 1);
  const Cycle aborted = cycle_of(Reason::kC2Timeout);
  EXPECT_TRUE(is_rs(c2(kFirstChannel, {}, 9)));
  run_to_cycle(bench, aborted + kSendTimeoutUnit - 1);
  EXPECT_TRUE(registry(0x30).in_use);
  run_to_cycle(bench, aborted + kSendTimeoutUnit);
  EXPECT_FALSE(registry(0x30).in_use);
  EXPECT_EQ(bench.count(Reason::kC2Freed), 1);
  EXPECT_TRUE(is_rs(c2(kFirstChannel)));
}

TEST_F(C2, UOfTheSecondChannelStartsWithItsTurn) {
  start();
  ASSERT_EQ(connect(1, 1), kFirstChannel);
  ASSERT_EQ(connect(9, 1), kSecondChannel);
  ASSERT_TRUE(is_sc(c2(kFirstChannel, read_request(1, 1, 1), 1)));
  ASSERT_TRUE(is_sc(c2(kSecondChannel, read_request(2, 2, 2), 9)));
  while (bench.count(Reason::kC2Timeout) == 0) {  // the user never answers; both masters poll
    bench.run_cycles(20'000);
    c2(kFirstChannel, {}, 1);
    c2(kSecondChannel, {}, 9);
  }
  const Cycle first = cycle_of(Reason::kC2Timeout);
  EXPECT_EQ(bench.last(Reason::kC2Timeout).a, kFirstChannel);
  EXPECT_EQ(bench.last(Reason::kC2Timeout).b, 3);
  EXPECT_TRUE(registry(0x2F).exchanging);
  while (bench.count(Reason::kC2Timeout) == 1) {
    bench.run_cycles(20'000);
    c2(kSecondChannel, {}, 9);
  }
  EXPECT_EQ(bench.last(Reason::kC2Timeout).a, kSecondChannel);
  EXPECT_EQ(bench.last(Reason::kC2Timeout).b, 3) << "polls keep F away, I stays off";
  EXPECT_EQ(cycle_of(Reason::kC2Timeout) - first, kSendTimeoutUnit);
}

}  // namespace
}  // namespace dsdpv1::conformance
