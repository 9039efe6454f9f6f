// MSAC_C1 (7.2; rulings V1, V5 to V9, V14, V15).
#include "tests/conformance/dpv1_side.hpp"

namespace dsdpv1::conformance {
namespace {

class C1 : public Dpv1Test {};

TEST_F(C1, ReadIsAcknowledgedPolledAndAnswered) {
  start();
  EXPECT_TRUE(is_sc(c1(read_request(1, 7, 10))));
  EXPECT_EQ(bench.last(Reason::kC1Request).b, 1);
  EXPECT_EQ(bench.last(Reason::kC1Request).c, 7);
  EXPECT_TRUE(is_sc(c1({})));
  bench.chip_accesses();
  EXPECT_EQ(fetch(kC1Area), read_request(1, 7, 10));
  EXPECT_TRUE(is_sc(c1({})));
  const Bytes answer = pdu_of(0x5E, 1, 7, 3, {0xAA, 0xBB, 0xCC});
  give(kC1Area, answer);
  EXPECT_EQ(bench.peek(0x011), 0);
  const Exchange poll = c1({});
  ASSERT_TRUE(is_data(poll)) << kind_of(poll);
  EXPECT_EQ(poll.answer().data, answer);
  EXPECT_EQ(poll.answer().dsap, kC1Sap);
  EXPECT_EQ(poll.answer().ssap, kC1Sap);
  EXPECT_TRUE(is_sc(c1({}))) << "nothing is left";
  ASSERT_TRUE(is_sc(c1(read_request(1, 7, 1))));
  bench.chip_accesses();
  fetch(kC1Area);
  give(kC1Area, answer);
  EXPECT_EQ(text(c1({})), testing::PrintToString(answer)) << "V15: longer than asked for";
}

TEST_F(C1, WriteCarriesItsDataToTheUserAndIsAnsweredWithTheLength) {
  start();
  const Bytes request = pdu_of(0x5F, 2, 9, 5, {1, 2, 3, 4, 5});
  for (const int length : {5, 0}) {  // V5: 0 as 7.2 has it is passed on, too
    EXPECT_TRUE(is_sc(c1(request)));
    bench.chip_accesses();
    EXPECT_EQ(fetch(kC1Area), request);
    give(kC1Area, pdu_of(0x5F, 2, 9, length));
    EXPECT_EQ(text(c1({})), testing::PrintToString(pdu_of(0x5F, 2, 9, length)));
  }
}

TEST_F(C1, EveryLengthFrom0To240IsReadAndWritten) {
  start();
  for (int length = 0; length <= 240; ++length) {
    SCOPED_TRACE(length);
    const Bytes write = pdu_of(0x5F, 0, 1, length, counting(length, length));
    ASSERT_TRUE(is_sc(c1(write)));
    bench.chip_accesses(3);
    ASSERT_EQ(fetch(kC1Area), write);
    give(kC1Area, pdu_of(0x5F, 0, 1, length));
    ASSERT_EQ(text(c1({})), testing::PrintToString(pdu_of(0x5F, 0, 1, length)));
    ASSERT_TRUE(is_sc(c1(read_request(0, 1, length))));
    bench.chip_accesses(3);
    ASSERT_EQ(fetch(kC1Area), read_request(0, 1, length));
    const Bytes answer = pdu_of(0x5E, 0, 1, length, counting(length, 2 * length));
    give(kC1Area, answer);
    ASSERT_EQ(text(c1({})), testing::PrintToString(answer));
  }
  EXPECT_EQ(bench.count(Reason::kC1Answer), 2 * 241);
}

TEST_F(C1, ErrorAnswerIsFourBytesWhateverTheLastOneIs) {
  start();
  for (const int code2 : {0, 1, 240, 241, 255}) {
    ASSERT_TRUE(is_sc(c1(read_request(3, 4, 200))));
    bench.chip_accesses();
    fetch(kC1Area);
    const Bytes error = pdu_of(0xDE, 0x80, 0xB2, code2);
    give(kC1Area, error);
    EXPECT_EQ(text(c1({})), testing::PrintToString(error));
  }
}

TEST_F(C1, SecondRequestWhileOneIsOpenIsRrInEveryPhase) {
  start();
  bench.acquire();  // the first request cannot reach the DPRAM
  ASSERT_TRUE(is_sc(c1(read_request(1, 1, 1))));
  EXPECT_TRUE(is_rr(c1(read_request(2, 2, 2)))) << "waiting to be written";
  bench.release();
  bench.chip_accesses();
  EXPECT_TRUE(is_rr(c1(read_request(2, 2, 2)))) << "with the user";
  EXPECT_EQ(fetch(kC1Area), read_request(1, 1, 1));
  bench.run_ms(50);
  EXPECT_TRUE(is_sc(c1({}))) << "7.2: the chip waits for the user";
  EXPECT_EQ(bench.peek(0x00F), 0) << "the second one does not reach the DPRAM";
  give(kC1Area, pdu_of(0x5E, 1, 1, 1, {0x77}));
  EXPECT_TRUE(is_rr(c1(pdu_of(0x5F, 2, 2, 0)))) << "answered, not fetched";
  EXPECT_EQ(bench.count(Reason::kAcyclicOpen), 3);
  EXPECT_EQ(text(c1({})), testing::PrintToString(pdu_of(0x5E, 1, 1, 1, {0x77})));
  EXPECT_TRUE(is_sc(c1(read_request(2, 2, 2))));
}

struct Wrong {
  Bytes request;
  std::uint8_t code;
};

TEST_F(C1, RequestsThatTheChipFindsWrongAreAnsweredByItself) {
  start();
  const Wrong cases[] = {
      {{0x5C, 0, 0, 0}, 0xA9},  // alarm acknowledge: not supported
      {{0x51, 0, 0, 0}, 0xA9},  // transport is C2's
      {{0x00}, 0xA9},          {{0xDE, 0, 0, 0}, 0xA9},      {{0x5E}, 0xB8},
      {{0x5E, 1, 2}, 0xB8},    {{0x5E, 1, 2, 241, 0}, 0xB8}, {{0x5E, 1, 2, 1, 0}, 0xB8},
      {{0x5F, 1, 2}, 0xB1},    {{0x5F, 1, 2, 1}, 0xB1},      {{0x5F, 1, 2, 1, 0, 0}, 0xB1},
  };
  for (const Wrong& wrong : cases) {
    SCOPED_TRACE(testing::PrintToString(wrong.request));
    EXPECT_TRUE(is_sc(c1(wrong.request)));
    EXPECT_EQ(bench.last(Reason::kAcyclicRequestRefused).c, wrong.code);
    const Bytes expected = {static_cast<std::uint8_t>(wrong.request[0] | 0x80), 0x80, wrong.code, 0};
    EXPECT_EQ(text(c1({})), testing::PrintToString(expected));
  }
  bench.chip_accesses();
  EXPECT_EQ(bench.peek(0x00F), 0) << "the user sees none of them";
  EXPECT_EQ(bench.count(Reason::kC1Request), 0);
}

TEST_F(C1, IsOnlyForTheHolderInDataExchangeWithDpv1OnAndSsap51) {
  start();
  EXPECT_TRUE(is_rs(c1(read_request(0, 0, 1), 3)));
  EXPECT_EQ(bench.last(Reason::kSapMaster).a, kC1Sap);
  EXPECT_TRUE(is_rs(send_fc(bench, kSrdFirst, kC1Sap, 50, read_request(0, 0, 1))));
  EXPECT_TRUE(is_rs(send_fc(bench, kSrdFirst, kC1Sap, kNoSap, read_request(0, 0, 1))));
  EXPECT_EQ(bench.count(Reason::kAcyclicSsap), 2);
  EXPECT_TRUE(is_rs(send_fc(bench, kSrdFirst, 50, kC1Sap, {0x5C, 0, 0, 0}))) << "SAP 50 (alarms) does not exist";
  ASSERT_TRUE(is_sc(bench.set_prm({})));  // to WAIT_CFG
  EXPECT_TRUE(is_rs(c1(read_request(0, 0, 1))));
  EXPECT_EQ(bench.last(Reason::kSapState).a, kC1Sap);
}

TEST_F(C1, NeedsDpv1EnableInSetPrm) {
  start(true, false);
  EXPECT_TRUE(is_rs(c1(read_request(0, 0, 1))));
  EXPECT_EQ(bench.count(Reason::kC1Disabled), 1);
  ASSERT_TRUE(is_sc(bench.set_prm({})));  // without the byte: off is the default
  ASSERT_TRUE(is_sc(bench.check_cfg()));
  EXPECT_TRUE(is_rs(c1(read_request(0, 0, 1))));
  EXPECT_EQ(bench.count(Reason::kC1Disabled), 2);
}

// V9. Until an audit the chip itself refused them (B8).
TEST_F(C1, ReadsOfMoreThan240BytesReachTheUserWhoJudges) {
  start();
  for (const int length : {240, 241, 255}) {
    ASSERT_TRUE(is_sc(c1(read_request(1, 2, length))));
    bench.chip_accesses(3);
    EXPECT_EQ(fetch(kC1Area), read_request(1, 2, length));
    const Bytes error = pdu_of(0xDE, 0x80, 0xB7, 0);
    give(kC1Area, error);
    EXPECT_EQ(text(c1({})), testing::PrintToString(error));
  }
  EXPECT_EQ(bench.count(Reason::kAcyclicRequestRefused), 0);
}

// D17. An early version checked B005 again at each Set_Prm.
TEST_F(C1, B005CountsAtTheInitialisationAndNotLater) {
  start();
  bench.enable_dpv1(false);
  bench.chip_accesses();
  EXPECT_TRUE(is_sc(c1(read_request(0, 0, 1))));
  Prm prm;
  prm.user = {0x80, 0, 0};
  ASSERT_TRUE(is_sc(bench.set_prm(prm)));
  EXPECT_EQ(bench.dp_state(), DpState::kWaitCfg) << "nor at Set_Prm";
  ASSERT_TRUE(bench.initialise());
  bench.find_baud(0);
  ASSERT_TRUE(is_sc(send_fc(bench, kSrdFirst, 61, 62, prm.bytes())));
  EXPECT_EQ(bench.count(Reason::kPrmDpv1), 1) << "B005 is 0 at this initialisation";
  bench.enable_dpv1(true);
  bench.chip_accesses();
  ASSERT_TRUE(is_sc(send_fc(bench, kSrdFirst, 61, 62, prm.bytes())));
  EXPECT_EQ(bench.count(Reason::kPrmDpv1), 2) << "a later 1D is too late";
  ASSERT_FALSE(bench.initialise(Init{.max_input = 255}));
  ASSERT_TRUE(is_sc(send_fc(bench, kSrdFirst, 61, 62, prm.bytes())));
  EXPECT_EQ(bench.count(Reason::kPrmDpv1), 3) << "a refused initialisation does not count";
  EXPECT_EQ(diag(bench).at(0) & 0x40, 0x40);
  EXPECT_EQ(bench.dp_state(), DpState::kWaitPrm);
  ASSERT_TRUE(bench.initialise());
  bench.find_baud(0);
  ASSERT_TRUE(is_sc(send_fc(bench, kSrdFirst, 61, 62, prm.bytes())));
  EXPECT_EQ(bench.dp_state(), DpState::kWaitCfg);
}

TEST_F(C1, B005OfARefusedInitialisationDoesNotCount) {
  start();
  for (const Init& refused :
       {Init{.crc_error = 1}, Init{.address = 127}, Init{.max_input = 255}, Init{.length = 220}}) {
    bench.enable_dpv1(false);
    ASSERT_FALSE(bench.initialise(refused));
    bench.address = 5;
    ASSERT_TRUE(is_sc(c1(read_request(0, 0, 1)))) << "what was stays";
    ASSERT_EQ(fetch(kC1Area), read_request(0, 0, 1));
    give(kC1Area, pdu_of(0x5E, 0, 0, 1, {7}));
    ASSERT_TRUE(is_data(c1({})));
  }
}

TEST_F(C1, B005HasToBeExactly1D) {
  bench.power_on();
  for (int value = 0; value < 256; ++value) {
    SCOPED_TRACE(value);
    const bool on = value == 0x1D;
    bench.poke(regs::kDpv1Enable, static_cast<std::uint8_t>(value));
    ASSERT_TRUE(bench.initialise());
    bench.find_baud(0);
    EXPECT_EQ(kind_of(c2(kManagerSap, initiate_pdu())), on ? "DL" : "RS") << "C2";
    Prm prm;
    prm.user = {0x80, 0, 0};
    EXPECT_TRUE(is_sc(ask(bench, 61, prm.bytes())));
    EXPECT_EQ(bench.dp_state(), on ? DpState::kWaitCfg : DpState::kWaitPrm) << "DPV1_Enable, for C1";
    EXPECT_EQ(diag(bench, 9).at(0) & 0x50, on ? 0x00 : 0x50) << "Prm_Fault and Not_Supported";
  }
}

TEST_F(C1, LeavingDataExchangeWithdrawsARequestThatWaits) {
  start();
  bench.acquire();
  ASSERT_TRUE(is_sc(c1(read_request(1, 1, 1))));
  ASSERT_TRUE(is_sc(bench.set_prm({})));
  bench.release();
  bench.chip_accesses(3);
  EXPECT_EQ(bench.peek(0x00F), 0);
  EXPECT_EQ(bench.count(Reason::kC1Dropped), 1);
}

TEST_F(C1, AnswerAfterLeavingDataExchangeIsRefused) {
  start();
  ASSERT_TRUE(is_sc(c1(read_request(1, 1, 1))));
  bench.chip_accesses();
  EXPECT_EQ(fetch(kC1Area), read_request(1, 1, 1));
  Prm prm;
  prm.user = {0x80, 0, 0};
  ASSERT_TRUE(is_sc(bench.set_prm(prm)));
  ASSERT_TRUE(is_sc(bench.check_cfg()));
  give(kC1Area, pdu_of(0x5E, 1, 1, 1, {9}));
  EXPECT_EQ(bench.last(Reason::kAcyclicNoRequest).a, 1);
  EXPECT_TRUE(is_sc(c1({}))) << "back in data exchange, nothing is open";
  EXPECT_TRUE(is_sc(c1(read_request(1, 1, 1)))) << "and a new request is taken";
}

// H5: whether the user has taken the flag of the withdrawn one or not.
TEST_F(C1, NewRequestOverwritesAWithdrawnOneAndSetsItsFlag) {
  Prm prm;
  prm.user = {0x80, 0, 0};
  start();
  for (const bool cleared : {false, true}) {
    ASSERT_TRUE(is_sc(c1(read_request(1, 1, 1))));
    bench.chip_accesses(3);
    EXPECT_EQ(bench.peek(0x5D0, 4), read_request(1, 1, 1));
    EXPECT_EQ(bench.peek(0x00F), 1);
    if (cleared) bench.poke(0x00F, 0);
    ASSERT_TRUE(is_sc(bench.set_prm(prm)));
    ASSERT_TRUE(is_sc(bench.check_cfg()));
    ASSERT_TRUE(is_sc(c1(read_request(2, 2, 2))));
    bench.chip_accesses(3);
    EXPECT_EQ(fetch(kC1Area), read_request(2, 2, 2));
    give(kC1Area, pdu_of(0x5E, 2, 2, 1, {5}));
    ASSERT_TRUE(is_data(c1({})));
  }
}

TEST_F(C1, AnswerBeforeTheRequestWasWrittenIsRefused) {
  start();
  bench.acquire();
  ASSERT_TRUE(is_sc(c1(read_request(1, 1, 1))));
  bench.write_block(kC1Area.base, pdu_of(0x5E, 1, 1, 1, {9}), kC1Area.crc);
  bench.write(0x011, kC1Area.flag);
  bench.release();
  bench.chip_accesses(3);
  EXPECT_EQ(bench.count(Reason::kAcyclicNoRequest), 1);
  EXPECT_EQ(fetch(kC1Area), read_request(1, 1, 1)) << "written in the access that refused the answer";
}

TEST_F(C1, AnswerThatDoesNotRepeatTheRequestIsRefusedAndTheRequestStaysOpen) {
  start();
  ASSERT_TRUE(is_sc(c1(read_request(1, 2, 3))));
  bench.chip_accesses();
  fetch(kC1Area);
  const Bytes answers[] = {pdu_of(0x5F, 1, 2, 0),       pdu_of(0x5E, 9, 2, 1, {0}), pdu_of(0x5E, 1, 9, 1, {0}),
                           pdu_of(0xDF, 0x80, 0xB2, 0), pdu_of(0x51, 1, 2, 1, {0}), pdu_of(0x00, 1, 2, 0)};
  int refused = 0;
  for (const Bytes& answer : answers) {
    give(kC1Area, answer);
    EXPECT_EQ(bench.count(Reason::kAcyclicAnswerDiffers), ++refused) << testing::PrintToString(answer);
    EXPECT_TRUE(is_sc(c1({})));
  }
  give(kC1Area, pdu_of(0x5E, 1, 2, 1, {5}));
  EXPECT_EQ(text(c1({})), testing::PrintToString(pdu_of(0x5E, 1, 2, 1, {5})));
  give(kC1Area, pdu_of(0x5E, 1, 2, 1, {5}));
  EXPECT_EQ(bench.count(Reason::kAcyclicNoRequest), 1) << "a second answer";
}

TEST_F(C1, WrongCrcIsShownInB00BUntilARightAnswerComes) {
  start();
  ASSERT_TRUE(is_sc(c1(read_request(1, 2, 3))));
  bench.chip_accesses();
  fetch(kC1Area);
  give(kC1Area, pdu_of(0x5E, 1, 2, 1, {5}), 0x0100);
  EXPECT_EQ(bench.peek(0x00B), kC1Area.crc_error);
  EXPECT_EQ(bench.peek(0x011), 0) << "H5";
  EXPECT_EQ(bench.count(dpram::Reason::kC1Crc), 1);
  EXPECT_TRUE(is_sc(c1({})));
  give(kC1Area, pdu_of(0x5E, 1, 2, 1, {5}));
  EXPECT_EQ(bench.peek(0x00B), 0);
  EXPECT_TRUE(is_data(c1({})));
}

TEST_F(C1, EveryCoveredByteIsInTheCrcAndNoOther) {
  start();
  const Bytes answer = pdu_of(0x5E, 1, 2, 3, {5, 6, 7});
  for (int i = 0; i < 10; ++i) {
    ASSERT_TRUE(is_sc(c1(read_request(1, 2, 3))));
    bench.chip_accesses();
    EXPECT_EQ(bench.peek(0x6C4, 2), (Bytes{0x6D, 0x03})) << "of 5E 01 02 03";
    fetch(kC1Area);
    bench.acquire();
    bench.write_block(kC1Area.base, answer, kC1Area.crc);
    const auto cell = static_cast<std::uint16_t>(kC1Area.base + i);
    bench.write(cell, static_cast<std::uint8_t>(bench.read(cell) ^ 0x80));
    bench.write(0x011, kC1Area.flag);
    bench.release();
    bench.chip_accesses(3);
    if (i == 3)  // a length of 131: other bytes are read, the CRC cannot be right
      EXPECT_EQ(bench.peek(0x00B), kC1Area.crc_error);
    else
      EXPECT_EQ(bench.peek(0x00B) != 0, i < 7) << "byte " << i;
    give(kC1Area, answer);
    c1({});
  }
}

TEST_F(C1, LengthAbove240IsRefusedUnread) {
  start();
  ASSERT_TRUE(is_sc(c1(read_request(1, 2, 3))));
  bench.chip_accesses();
  fetch(kC1Area);
  give(kC1Area, pdu_of(0x5E, 1, 2, 241));
  EXPECT_EQ(bench.last(dpram::Reason::kAcyclicLength).b, 241);
  EXPECT_EQ(bench.peek(0x00B), 0);
  EXPECT_TRUE(is_sc(c1({})));
}

TEST_F(C1, BeforeTheInitialisationAnAnswerIsDropped) {
  bench.power_on();
  give(kC1Area, pdu_of(0x5E, 1, 2, 0), 1);
  EXPECT_EQ(bench.count(dpram::Reason::kBeforeInit), 1);
  EXPECT_EQ(bench.last(dpram::Reason::kBeforeInit).b, 0x011);
  EXPECT_EQ(bench.peek(0x00B), 0);
  EXPECT_EQ(bench.peek(0x011), 0);
}

TEST_F(C1, RepeatedPollGetsTheStoredAnswerAgain) {
  start();
  bench.fcb_valid = false;
  ASSERT_TRUE(is_sc(bench.srd(kC1Sap, kC1Sap, read_request(1, 2, 1))));
  bench.chip_accesses();
  fetch(kC1Area);
  give(kC1Area, pdu_of(0x5E, 1, 2, 1, {5}));
  const Exchange first = bench.srd(kC1Sap, kC1Sap, {});
  ASSERT_TRUE(is_data(first));
  bench.fcb = !bench.fcb;  // the same frame count bit again
  EXPECT_EQ(bench.srd(kC1Sap, kC1Sap, {}).raw, first.raw);
  EXPECT_EQ(bench.count(Reason::kRepetition), 1);
  EXPECT_TRUE(is_sc(bench.srd(kC1Sap, kC1Sap, {})));
}

TEST_F(C1, InterruptIsNotGivenForAcyclicRequests) {
  start();
  settle(bench);
  const std::size_t before = bench.changes(Pin::kIntr0).size();
  ASSERT_EQ(connect(), kFirstChannel);
  ASSERT_TRUE(is_sc(c1(read_request(1, 2, 1))));
  ASSERT_TRUE(is_sc(c2(kFirstChannel, read_request(1, 2, 1))));
  settle(bench);
  EXPECT_EQ(bench.peek(0x00F), 0x03);
  EXPECT_EQ(bench.changes(Pin::kIntr0).size(), before);  // P7
}

// Section 9 of the micro-architecture: an access with a request of k bytes is 7 + k + 3 cycles long.
TEST_F(C1, RequestOccupiesTheAccessAsLongAsItsBytes) {
  start();
  settle(bench);
  for (const int length : {0, 1, 17, 240}) {
    const std::size_t before = accesses(bench).size();
    ASSERT_TRUE(is_sc(c1(pdu_of(0x5F, 0, 0, length, counting(length)))));
    settle(bench);
    Cycle longest = 0;
    const std::vector<Access> all = accesses(bench);
    for (std::size_t i = before; i < all.size(); ++i) longest = std::max(longest, all[i].length());
    EXPECT_EQ(longest, 7 + (4 + length) + 3);
    fetch(kC1Area);
    give(kC1Area, pdu_of(0x5F, 0, 0, length));
    c1({});
  }
}

// ... and one with an answer of L data bytes 7 + 4 + L + 5, and two more to clear the bit in B00B.
TEST_F(C1, AnswerOccupiesTheAccessAsLongAsItsBytes) {
  start();
  for (const int length : {0, 1, 17, 240}) {
    ASSERT_TRUE(is_sc(c1(read_request(0, 0, length))));
    bench.chip_accesses(3);
    fetch(kC1Area);
    const std::size_t before = accesses(bench).size();
    give(kC1Area, pdu_of(0x5E, 0, 0, length, counting(length)));
    settle(bench);
    Cycle longest = 0;
    const std::vector<Access> all = accesses(bench);
    for (std::size_t i = before; i < all.size(); ++i) longest = std::max(longest, all[i].length());
    EXPECT_EQ(longest, 7 + 4 + length + 5 + 2);
    c1({});
  }
}

}  // namespace
}  // namespace dsdpv1::conformance
