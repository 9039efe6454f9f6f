// The data link layer: FDL status, frame count bit, function codes, SAPs and the addressing of answers (S20, S21,
// S26, chip.md "PROFIBUS facts").
#include <gtest/gtest.h>

#include <functional>
#include <utility>

#include "tests/conformance/master_side.hpp"

namespace dsdpv1::conformance {
namespace {

constexpr std::uint8_t kFirst = 0x6D;    ///< FCB = 1, FCV = 0
constexpr std::uint8_t kFcb0 = 0x5D;     ///< FCB = 0, FCV = 1
constexpr std::uint8_t kFcb1 = 0x7D;     ///< FCB = 1, FCV = 1
constexpr std::uint8_t kNoCount = 0x4D;  ///< FCB = 0, FCV = 0

dsdpv1::Config with_rule(std::uint32_t fcb_rule) {
  dsdpv1::Config config = quick_search();
  if (fcb_rule != 0) config.fcb_rule = fcb_rule;  // 0, the letter, is the default
  return config;
}

class Fdl : public testing::Test {
 protected:
  explicit Fdl(std::uint32_t fcb_rule = 0) : bench(with_rule(fcb_rule)) {}
  Exchange dx(std::uint8_t fc, const Bytes& outputs = {1, 2}, std::uint8_t master = 2) {
    return send_fc(bench, fc, kNoSap, kNoSap, outputs, master);
  }
  std::uint64_t executed() const { return bench.chip.status().data_exchanges; }

  SlaveBench bench;
};

/// Repetitions by content (S26), the ruling until an audit.
class FdlContent : public Fdl {
 protected:
  FdlContent() : Fdl(1) {}
};

// --- FDL status

TEST_F(Fdl, StatusIsAnsweredOkInEveryState) {
  const auto expect_status = [this](std::uint8_t master) {
    const Exchange exchange = bench.requester.send(bench.timeline, bus::make_telegram(5, master, kFdlStatus));
    ASSERT_TRUE(exchange.answered());
    EXPECT_EQ(exchange.raw, (Bytes{0x10, master, 5, 0x00, static_cast<std::uint8_t>(master + 5), 0x16}));
  };
  bench.to_wait_prm();
  expect_status(2);
  ASSERT_TRUE(is_sc(bench.set_prm({})));
  expect_status(2);
  expect_status(3);
  ASSERT_TRUE(is_sc(bench.check_cfg()));
  expect_status(2);
  expect_status(126);
  EXPECT_EQ(bench.dp_state(), DpState::kDataExch);
}

TEST_F(Fdl, NothingIsAnsweredBeforeTheInitialisation) {
  bench.power_on();
  for (int i = 0; i < 3; ++i) {
    EXPECT_TRUE(bench.fdl_status().silent());
    EXPECT_TRUE(ask(bench, 60).silent());
  }
  EXPECT_EQ(bench.dp_state(), DpState::kOffline);
}

// --- frame count bit

TEST_F(Fdl, TogglingSeriesIsExecutedEveryTime) {
  bench.to_data_exch();
  const auto before = executed();
  EXPECT_TRUE(dx(kFirst).answered());
  for (int i = 0; i < 6; ++i) EXPECT_TRUE(dx(i % 2 == 0 ? kFcb0 : kFcb1).answered());
  EXPECT_EQ(executed(), before + 7);
  EXPECT_EQ(bench.count(Reason::kRepetition), 0);
}

TEST_F(Fdl, RepeatedRequestIsAnsweredFromMemoryAndNotExecuted) {
  bench.to_data_exch();
  bench.give_inputs({0x11, 0x22});
  dx(kFirst);
  const Exchange first = dx(kFcb0, {1, 2});
  bench.give_inputs({0x33, 0x44});
  const auto before = executed();
  for (int i = 0; i < 3; ++i) {
    const Exchange again = dx(kFcb0, {1, 2});
    EXPECT_EQ(again.raw, first.raw);
  }
  EXPECT_EQ(executed(), before);
  EXPECT_EQ(bench.count(Reason::kRepetition), 3);
  settle(bench);
  EXPECT_EQ(output_area(bench), (Bytes{1, 2}));
  EXPECT_EQ(dx(kFcb1).answer().data, (Bytes{0x33, 0x44}));
}

TEST_F(Fdl, StartOfASeriesIsAlwaysExecuted) {
  bench.to_data_exch();
  const auto before = executed();
  for (int i = 0; i < 4; ++i) EXPECT_TRUE(dx(kFirst).answered());
  EXPECT_EQ(executed(), before + 4);
}

TEST_F(FdlContent, FirstOfASeriesIsNotRemembered) {
  bench.to_data_exch();
  dx(kFirst);
  const auto before = executed();
  EXPECT_TRUE(dx(kFcb1).answered());  // same SA, same FCB, same data
  EXPECT_EQ(executed(), before + 1);
  EXPECT_TRUE(dx(kFirst).answered());
  EXPECT_TRUE(dx(kFcb1).answered()) << "it has ended the memory of the one before";
  EXPECT_EQ(executed(), before + 3);
  EXPECT_EQ(bench.count(Reason::kRepetition), 0);
}

// S26: a repetition is the same frame again. Each case differs from the request in one thing only.
TEST_F(FdlContent, RequestWithTheSameFrameCountButAnotherContentIsExecuted) {
  constexpr std::uint8_t kLowFcb0 = 0x5C;
  bench.to_data_exch();
  struct Case {
    const char* what;
    std::uint8_t fc;
    int dsap, ssap;
    Bytes data;
    std::uint8_t master;
  };
  const Case request = {"the same", kFcb0, 62, 62, {0x11, 0x21}, 2};
  const Case others[] = {
      {"FCS", kFcb0, 62, 62, {0x11, 0x22}, 2},         {"priority", kLowFcb0, 62, 62, {0x11, 0x21}, 2},
      {"DSAP", kFcb0, 61, 62, {0x11, 0x22}, 2},        {"SSAP", kFcb0, 62, 61, {0x11, 0x22}, 2},
      {"SA", kFcb0, 62, 62, {0x11, 0x20}, 3},          {"length", kFcb0, 62, 62, {0x11, 0x21, 0x00}, 2},
      {"no SSAP", kFcb0, 62, kNoSap, {0x11, 0x21}, 2},
  };
  const auto send = [this](const Case& one) {
    return send_fc(bench, one.fc, one.dsap, one.ssap, one.data, one.master);
  };
  for (const Case& other : others) {
    SCOPED_TRACE(other.what);
    ASSERT_TRUE(send(request).answered());
    const int before = bench.count(Reason::kRepetition);
    ASSERT_TRUE(send(request).answered());
    ASSERT_EQ(bench.count(Reason::kRepetition), before + 1);
    ASSERT_TRUE(send(other).answered());
    EXPECT_EQ(bench.count(Reason::kRepetition), before + 1) << "executed";
    ASSERT_TRUE(send(other).answered());
    EXPECT_EQ(bench.count(Reason::kRepetition), before + 2) << "and remembered in the other's place";
    ASSERT_TRUE(send(request).answered());
    EXPECT_EQ(bench.count(Reason::kRepetition), before + 2);
  }
}

// The sums of these telegrams agree where SAP or SA differ: the FCS alone would take them for the same.
TEST_F(FdlContent, RequestWithTheSameFcsButAnotherSapOrSourceIsExecuted) {
  bench.to_data_exch();
  dx(kFirst);
  const auto fcs = [](const bus::Telegram& telegram) {
    const Bytes bytes = bus::encode(telegram);
    return bytes.at(bytes.size() - 2);
  };
  const bus::Telegram first = bus::make_telegram(5, 2, kFcb0, {0x11, 0x21}, 62, 62);
  const std::pair<const char*, bus::Telegram> others[] = {
      {"DSAP", bus::make_telegram(5, 2, kFcb0, {0x12, 0x21}, 61, 62)},
      {"SSAP", bus::make_telegram(5, 2, kFcb0, {0x11, 0x22}, 62, 61)},
      {"SA", bus::make_telegram(5, 3, kFcb0, {0x10, 0x21}, 62, 62)},
      {"FC", bus::make_telegram(5, 2, 0x5C, {0x12, 0x21}, 62, 62)},
      {"length", bus::make_telegram(5, 2, kFcb0, {0x11, 0x21, 0x00}, 62, 62)},
  };
  for (const auto& [what, other] : others) {
    SCOPED_TRACE(what);
    ASSERT_EQ(fcs(first), fcs(other));
    EXPECT_TRUE(bench.requester.send(bench.timeline, first).answered());
    EXPECT_TRUE(bench.requester.send(bench.timeline, other).answered());
    bench.chip.compare(bench.now());
    EXPECT_EQ(bench.count(Reason::kRepetition), 0);
  }
}

TEST_F(FdlContent, DataExchangeWithTheSameFcsButAnotherFunctionCodeIsExecuted) {
  bench.to_data_exch();
  dx(kFirst);
  EXPECT_TRUE(dx(0x5C, {1, 4}).answered());  // low priority, 0x5D is high
  EXPECT_TRUE(dx(kFcb0, {1, 3}).answered());
  settle(bench);
  EXPECT_EQ(output_area(bench), (Bytes{1, 3}));
}

TEST_F(FdlContent, RequestWithTheSameFcsButAnotherSsapOrLengthHasItsOwnAnswer) {
  bench.to_data_exch();
  dx(kFirst);
  EXPECT_EQ(send_fc(bench, kFcb0, kNoSap, 62, {1, 5}).answer().dsap, 62);
  EXPECT_EQ(send_fc(bench, kFcb0, kNoSap, 61, {1, 6}).answer().dsap, 61);
  EXPECT_TRUE(is_data(send_fc(bench, kFcb1, 60, 62, {})));
  EXPECT_TRUE(is_rr(send_fc(bench, kFcb1, 60, 62, {0})));
}

TEST_F(FdlContent, BytesInAnotherOrderAreTakenForTheSame) {
  bench.to_data_exch();
  const Exchange first = dx(kFcb0, {1, 2});
  const auto before = executed();
  EXPECT_EQ(dx(kFcb0, {2, 1}).raw, first.raw) << "S26 compares the FCS instead of all bytes";
  EXPECT_EQ(executed(), before);
}

TEST_F(FdlContent, MasterThatLostItsPlaceGetsTheServiceThatItAsksFor) {
  bench.to_data_exch();
  dx(kFirst);
  ASSERT_TRUE(dx(kFcb0).answered());
  const Exchange diagnosis = send_fc(bench, kFcb0, 60, 62, {});
  ASSERT_TRUE(is_data(diagnosis)) << kind_of(diagnosis);
  EXPECT_EQ(diagnosis.answer().data.size(), 6U);
  EXPECT_TRUE(is_sc(send_fc(bench, kFcb0, 61, 62, Prm{}.bytes())));
  EXPECT_EQ(bench.dp_state(), DpState::kWaitCfg);
  EXPECT_EQ(bench.count(Reason::kRepetition), 0);
}

TEST_F(FdlContent, EveryOtherAnsweredRequestEndsTheMemory) {
  bench.to_data_exch();
  dx(kFirst);
  const std::pair<const char*, std::function<void()>> others[] = {
      {"FDL status", [this] { bench.fdl_status(); }},
      {"FDL status of another", [this] { bench.requester.send(bench.timeline, bus::make_telegram(5, 3, kFdlStatus)); }},
      {"FCV = 0", [this] { diag(bench); }},
      {"another initiator", [this] { send_fc(bench, kFcb0, 60, 62, {}, 3); }},
      {"refused, FCV = 0", [this] { send_fc(bench, kNoCount, 40, 62, {}); }},
      {"refused, FCV = 1", [this] { send_fc(bench, kFcb1, 40, 62, {}); }},
      {"SDA", [this] { send_fc(bench, 0x53, 62, 62, {}); }},
  };
  for (const auto& [what, other] : others) {
    ASSERT_TRUE(dx(kFcb0).answered());
    const auto before = executed();
    ASSERT_TRUE(dx(kFcb0).answered());
    ASSERT_EQ(executed(), before) << "remembered";
    other();
    EXPECT_TRUE(dx(kFcb0).answered());
    EXPECT_EQ(executed(), before + 1) << what;
    dx(kFcb1);
  }
}

TEST_F(Fdl, IgnoredRequestsLeaveTheMemory) {
  bench.to_data_exch();
  const Exchange first = dx(kFcb0);
  const auto before = executed();
  bench.requester.send(bench.timeline, bus::make_telegram(9, 2, kFcb1, {1}), {.wants_answer = false});
  bench.requester.send(bench.timeline, bus::encode(bus::make_telegram(5, 2, kFcb1, {3, 4})),
                       {.idle_bits = 20, .wants_answer = false});
  ASSERT_EQ(bench.count(Reason::kNoSyn), 0);
  bench.run_for(bench.requester.bit() * 60);
  ASSERT_EQ(bench.count(Reason::kNoSyn), 1);
  bench.requester.send(bench.timeline, bus::make_telegram(5, 9, 0x08, {1}), {.wants_answer = false});
  EXPECT_EQ(dx(kFcb0).raw, first.raw);
  EXPECT_EQ(executed(), before);
}

TEST_F(Fdl, SetPrmRepeatedIsExecutedOnce) {
  bench.to_wait_prm();
  const Bytes prm = Prm{}.bytes();
  EXPECT_TRUE(is_sc(send_fc(bench, kFirst, 61, 62, prm)));
  EXPECT_TRUE(is_sc(send_fc(bench, kFcb0, 61, 62, prm)));
  EXPECT_TRUE(is_sc(send_fc(bench, kFcb0, 61, 62, prm)));
  EXPECT_EQ(bench.count(Reason::kPrmAccepted), 2);
}

TEST_F(Fdl, SameFrameCountOfAnotherMasterIsNoRepetition) {
  bench.to_data_exch();
  dx(kFirst);
  const Exchange of_the_holder = dx(kFcb0);
  EXPECT_TRUE(of_the_holder.answered());
  const Exchange other = send_fc(bench, kFcb0, 60, 62, {}, 3);
  ASSERT_TRUE(is_data(other)) << kind_of(other);
  EXPECT_EQ(other.answer().data.size(), 6U);
  const auto before = executed();
  EXPECT_TRUE(dx(kFcb0, {5, 6}).answered());  // the memory is the other's now: stored again, executed
  EXPECT_EQ(executed(), before + 1);
  EXPECT_EQ(bench.count(Reason::kRepetition), 0);
}

TEST_F(Fdl, BroadcastAndForeignTrafficKeepTheMemory) {
  bench.to_data_exch();
  bench.give_inputs({1, 1});
  dx(kFirst);
  const Exchange first = dx(kFcb0);
  bench.give_inputs({2, 2});
  tell(bench, bus::kBroadcast, 58, {0, 0});
  bench.requester.send(bench.timeline, bus::make_telegram(9, 2, kFcb1, {1, 2}));
  bench.requester.send(bench.timeline, bus::make_token(3, 2), {.wants_answer = false});
  EXPECT_EQ(dx(kFcb0).raw, first.raw);
}

TEST_F(Fdl, RequestWithoutFrameCountIsAlwaysExecuted) {
  bench.to_data_exch();
  const auto before = executed();
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(dx(kNoCount).answered());
  EXPECT_EQ(executed(), before + 3);
}

TEST_F(Fdl, FcvWithoutASeriesIsExecuted) {
  bench.to_wait_prm();
  EXPECT_TRUE(is_sc(send_fc(bench, kFcb0, 61, 62, Prm{}.bytes())));
  EXPECT_EQ(bench.dp_state(), DpState::kWaitCfg);
}

TEST_F(FdlContent, SdnIsNoRepetitionAndLeavesTheMemory) {
  bench.to_data_exch();
  ASSERT_TRUE(dx(kFirst).answered());
  ASSERT_TRUE(dx(kFcb0).answered());
  const auto before = executed();
  EXPECT_TRUE(send_fc(bench, kSdnHigh | 0x10, 58, 62, {0x02, 0x00}).silent())
      << "FCB = 0, FCV = 1, as the request before";
  EXPECT_EQ(bench.count(Reason::kGlobalControl), 1);
  EXPECT_TRUE(dx(kFcb0).answered());
  EXPECT_EQ(executed(), before) << "a repetition still";
}

TEST_F(Fdl, RequestWithSsapAloneIsAnsweredToItWithoutDsap) {
  bench.to_data_exch();
  const Exchange exchange = send_fc(bench, kSrdFirst, kNoSap, 62, {1, 2});
  ASSERT_TRUE(exchange.answered());
  EXPECT_EQ(exchange.answer().dsap, std::optional<std::uint8_t>{62});
  EXPECT_EQ(exchange.answer().ssap, std::nullopt);
}

TEST_F(Fdl, EveryOtherFunctionCodeIsAnsweredRs) {
  bench.to_data_exch();
  for (const int code : {0, 1, 2, 3, 5, 7, 8, 0xA, 0xB, 0xE, 0xF})
    EXPECT_TRUE(is_rs(send_fc(bench, static_cast<std::uint8_t>(0x40 | code), kNoSap, kNoSap, {}))) << code;
  EXPECT_TRUE(is_rs(ask(bench, 58, {0x08, 0x00}))) << "Global_Control is SDN only";
  EXPECT_EQ(bench.dp_state(), DpState::kDataExch);
}

TEST_F(Fdl, NewerRequestReplacesAnAnswerThatHasNotBegun) {
  Prm prm;
  prm.min_tsdr = 255;
  bench.to_data_exch({}, prm);
  bench.give_inputs({1, 2});
  const auto enabled = bench.changes(Pin::kPbrts).size();
  bench.requester.send(bench.timeline, bus::make_telegram(5, 2, kFirst, {}, 60, 62), {.wants_answer = false});
  const Exchange second = bench.requester.send(bench.timeline, bus::make_telegram(5, 3, kFdlStatus));
  ASSERT_TRUE(second.answered());
  EXPECT_EQ(second.answer().da, 3);
  EXPECT_EQ(static_cast<int>(second.tsdr_bits()), 255);
  bench.run_for(second.bit * 600);
  EXPECT_EQ(bench.changes(Pin::kPbrts).size(), enabled + 2) << "only one answer";
  EXPECT_TRUE(dx(kFirst).answered());
}

TEST_F(Fdl, AnswerThatWasReplacedIsNotCountedAsSent) {
  Prm prm;
  prm.min_tsdr = 255;
  bench.to_data_exch({}, prm);
  const auto sent = bench.chip.status().telegrams_answered;
  bench.requester.send(bench.timeline, bus::make_telegram(5, 2, kFdlStatus), {.wants_answer = false});
  EXPECT_TRUE(bench.requester.send(bench.timeline, bus::make_telegram(5, 3, kFdlStatus)).answered());
  bench.run_for(bench.requester.bit() * 600);
  EXPECT_EQ(bench.chip.status().telegrams_answered, sent + 1);  // Status: "answers sent"
}

TEST_F(Fdl, RequestBegunBeforeTheAnswerIsLostToIt) {
  Prm prm;
  prm.min_tsdr = 60;
  bench.to_data_exch({}, prm);
  const auto executed_before = executed();
  bench.requester.send(bench.timeline, bus::make_telegram(5, 2, kFdlStatus), {.wants_answer = false});
  // 66 bits long, begun 33 bits after the first: the answer begins in its middle.
  bench.requester.send(bench.timeline, bus::make_telegram(5, 2, kFirst, {1, 2}), {.wants_answer = false});
  bench.run_for(bench.requester.bit() * 300);
  EXPECT_EQ(executed(), executed_before);
  EXPECT_EQ(bench.count(Reason::kCutByAnswer), 1) << "S8";
  EXPECT_EQ(bench.last(Reason::kCutByAnswer).at,
            bench.changes(Pin::kPbrts).at(bench.changes(Pin::kPbrts).size() - 2).at);
  EXPECT_TRUE(dx(kFirst).answered());
}

TEST_F(Fdl, TelegramWithoutTSynCutByTheAnswerIsCounted) {
  Prm prm;
  prm.min_tsdr = 60;
  bench.to_data_exch({}, prm);
  bench.requester.send(bench.timeline, bus::make_telegram(5, 2, kFdlStatus), {.wants_answer = false});
  bench.requester.send(bench.timeline, bus::encode(bus::make_telegram(5, 2, kFirst, {1, 2})),
                       {.idle_bits = 20, .wants_answer = false});
  bench.run_for(bench.requester.bit() * 300);
  EXPECT_EQ(bench.count(Reason::kCutByAnswer), 0);
  EXPECT_TRUE(dx(kFirst).answered());
  EXPECT_EQ(bench.count(Reason::kFaultyUnsynced), 1);
}

// --- repetitions in both forms of S26

/// `letter()`: SA and FCB decide, else the content does.
class FcbRule : public Fdl, public testing::WithParamInterface<std::uint32_t> {
 protected:
  FcbRule() : Fdl(GetParam()) {}
  bool letter() const { return GetParam() == 0; }

  /// The request is answered by its own service, not from memory.
  void expect_executed(std::uint8_t fc, const char* what = "") {
    const auto before = executed();
    EXPECT_TRUE(dx(fc).answered());
    EXPECT_EQ(executed(), before + 1) << what;
  }
  void expect_repetition(const Exchange& first, std::uint8_t fc, const char* what = "") {
    const auto before = executed();
    EXPECT_EQ(dx(fc).raw, first.raw) << what;
    EXPECT_EQ(executed(), before) << what;
  }
  Exchange diagnosis(std::uint8_t fc, std::uint8_t master = 2) { return send_fc(bench, fc, 60, 62, {}, master); }
  Exchange prm(std::uint8_t fc) { return send_fc(bench, fc, 61, 62, Prm{}.bytes()); }
  void sdn(std::uint8_t da, std::uint8_t fc, int dsap) {
    bench.requester.send(bench.timeline, bus::make_telegram(da, 2, fc, {0, 0}, optional_sap(dsap), 62),
                         {.wants_answer = false});
    bench.run_for(bench.requester.bit() * 20);
  }
};

TEST_P(FcbRule, RepetitionIsTheOldAnswerAndExecutesNothing) {
  bench.to_data_exch();
  bench.give_inputs({0x11, 0x22});
  dx(kFirst);
  const Exchange first = dx(kFcb0);
  bench.give_inputs({0x33, 0x44});
  for (int i = 0; i < 3; ++i) expect_repetition(first, kFcb0);
  EXPECT_EQ(bench.count(Reason::kRepetition), 3);
  EXPECT_EQ(bench.count(Reason::kFcbNotToggled), 0);
  EXPECT_EQ(dx(kFcb1).answer().data, (Bytes{0x33, 0x44}));
}

TEST_P(FcbRule, NewOutputsWithTheOldFcb) {
  bench.to_data_exch();
  bench.give_inputs({0x11, 0x22});
  dx(kFirst);
  const Exchange first = dx(kFcb0, {1, 2});
  bench.give_inputs({0x33, 0x44});
  const Exchange second = dx(kFcb0, {3, 4});
  settle(bench);
  EXPECT_EQ(second.raw == first.raw, letter());
  EXPECT_EQ(output_area(bench), letter() ? (Bytes{1, 2}) : (Bytes{3, 4}));
  EXPECT_EQ(bench.count(Reason::kRepetition), 0);
  ASSERT_EQ(bench.count(Reason::kFcbNotToggled), letter() ? 1 : 0);
  if (!letter()) return;
  const profibus::Event& told = bench.last(Reason::kFcbNotToggled);
  EXPECT_EQ(told.a, 2);
  EXPECT_EQ(told.b, kFcb0);
  EXPECT_EQ(
      dsdpv1::describe(told),
      "request of 2 (FC 5D, SAP none) with the FCB of the one before: not executed, the last answer is sent again");
}

TEST_P(FcbRule, AnotherServiceWithTheOldFcb) {
  bench.to_data_exch();
  dx(kFirst);
  const Exchange first = dx(kFcb0);
  const Exchange second = diagnosis(kFcb0);
  EXPECT_EQ(second.raw == first.raw, letter());
  EXPECT_EQ(second.answer().data.size(), letter() ? 2U : 6U);
  if (letter()) EXPECT_EQ(bench.last(Reason::kFcbNotToggled).c, 60);
}

TEST_P(FcbRule, FirstOfASeriesIsTheOneBefore) {
  bench.to_wait_prm();
  const Exchange first = diagnosis(kFirst);
  const Exchange second = prm(kFcb1);
  EXPECT_EQ(second.raw == first.raw, letter());
  EXPECT_EQ(bench.count(Reason::kPrmAccepted), letter() ? 0 : 1);
  EXPECT_TRUE(is_sc(prm(kFcb0)));
  EXPECT_EQ(bench.count(Reason::kPrmAccepted), letter() ? 1 : 2);
}

TEST_P(FcbRule, FirstOfASeriesAgainWithFcvIsNotTheSameTelegram) {
  bench.to_data_exch();
  dx(kFirst);
  const auto before = executed();
  dx(kFcb1);
  EXPECT_EQ(executed(), before + (letter() ? 0 : 1));
  EXPECT_EQ(bench.count(Reason::kFcbNotToggled), letter() ? 1 : 0);
  dx(kFcb0);
  EXPECT_EQ(executed(), before + (letter() ? 1 : 2)) << "the next of the series is new";
}

TEST_P(FcbRule, FirstOfASeriesIsExecutedEachTime) {
  bench.to_data_exch();
  for (int i = 0; i < 4; ++i) expect_executed(kFirst);
}

TEST_P(FcbRule, RequestWithoutFrameCountEndsTheMemory) {
  bench.to_data_exch();
  dx(kFcb0);
  bench.fdl_status();
  expect_executed(kFcb0, "FDL status");
  dx(kNoCount);
  expect_executed(kFcb0, "SRD");
}

TEST_P(FcbRule, SdnToTheOwnAddress) {
  bench.to_data_exch();
  struct Case {
    const char* what;
    std::uint8_t fc;
    int dsap;
  };
  for (const Case& each : {Case{"Global_Control", 0x46, 58},
                           Case{"Global_Control with the FCB of the request", 0x56, 58}, Case{"ignored", 0x46, 61}}) {
    const Exchange first = dx(kFcb0);
    const int commands = bench.count(Reason::kGlobalControl);
    sdn(5, each.fc, each.dsap);
    EXPECT_EQ(bench.count(Reason::kGlobalControl), commands + (each.dsap == 58 ? 1 : 0)) << each.what;
    letter() ? expect_executed(kFcb0, each.what) : expect_repetition(first, kFcb0, each.what);
    dx(kFcb1);
  }
}

TEST_P(FcbRule, SdnToAllLeavesTheMemory) {
  bench.to_data_exch();
  const Exchange first = dx(kFcb0);
  sdn(bus::kBroadcast, 0x46, 58);
  sdn(bus::kBroadcast, 0x56, 58);
  expect_repetition(first, kFcb0);
  EXPECT_EQ(bench.count(Reason::kGlobalControl), 2);
}

TEST_P(FcbRule, AnotherMasterHasAServiceOfItsOwn) {
  bench.to_data_exch();
  dx(kFirst);
  dx(kFcb0);
  const Exchange other = diagnosis(kFcb0, 3);
  ASSERT_TRUE(is_data(other));
  EXPECT_EQ(other.answer().data.size(), 6U);
  expect_executed(kFcb0, "the memory is the other's");
}

TEST_P(FcbRule, RefusalIsRemembered) {
  bench.to_data_exch();
  ASSERT_TRUE(is_rs(send_fc(bench, kFcb1, 40, 62, {})));
  EXPECT_EQ(kind_of(diagnosis(kFcb1)), letter() ? "RS" : "DL");
}

TEST_P(FcbRule, ChangeOfTheAddressEndsTheMemory) {
  bench.to_wait_prm();
  ASSERT_TRUE(is_sc(send_fc(bench, kFcb0, 55, 62, {42, 0x0C, 0xC9, 0})));
  bench.address = 42;
  const Exchange exchange = diagnosis(kFcb0);
  ASSERT_TRUE(is_data(exchange)) << kind_of(exchange);
  EXPECT_EQ(exchange.answer().sa, 42);
  EXPECT_TRUE(is_sc(prm(kFcb1)));
  EXPECT_EQ(bench.dp_state(), DpState::kWaitCfg);
}

TEST_P(FcbRule, IgnoredOnesLeaveTheMemory) {
  bench.to_data_exch();
  const Exchange first = dx(kFcb0);
  const auto ignored = [this](const Bytes& bytes, int idle_bits, Reason reason) {
    bench.requester.send(bench.timeline, bytes, {.idle_bits = idle_bits, .wants_answer = false});
    bench.run_for(bench.requester.bit() * 60);
    EXPECT_EQ(bench.count(reason), 1) << profibus::code(reason);
  };
  Bytes faulty = bus::encode(bus::make_telegram(5, 2, kFcb1, {3, 4}));
  faulty.at(faulty.size() - 2) ^= 1;
  ignored(faulty, bus::kSynBits, Reason::kFcs);
  bench.requester.send(bench.timeline, bus::make_telegram(9, 2, kFcb1, {1}), {.wants_answer = false});
  ignored(bus::encode(bus::make_telegram(5, 2, kFcb1, {3, 4})), 20, Reason::kNoSyn);
  ignored(bus::encode(bus::make_telegram(5, 9, 0x08, {1})), bus::kSynBits, Reason::kResponse);
  ignored(bus::encode(bus::make_telegram(5, 127, kFcb1, {3, 4})), bus::kSynBits, Reason::kSa127);
  ignored({0x68, 4, 4, 0x68, 0x85, 0x82, kFcb1, 60, static_cast<std::uint8_t>(0x85 + 0x82 + kFcb1 + 60), 0x16},
          bus::kSynBits, Reason::kSapBytes);
  expect_repetition(first, kFcb0);
}

TEST_P(FcbRule, InitialisationAndResetEndTheMemory) {
  bench.to_data_exch();
  for (const bool reset : {false, true}) {
    dx(kFirst);
    ASSERT_TRUE(dx(kFcb0).answered());
    if (reset) {
      bench.chip.set(bench.now(), Pin::kReset, 0);
      bench.power_on();
    }
    ASSERT_TRUE(bench.initialise());
    bench.find_baud(0);
    EXPECT_TRUE(is_rs(dx(kFcb0))) << reset;
  }
  EXPECT_EQ(bench.count(Reason::kRepetition), 0);
}

TEST_P(FcbRule, RetryAfterTheWatchdogGetsTheOldAnswer) {
  Prm watched;
  watched.status = 0x88;  // lock, WD_On
  watched.wd1 = watched.wd2 = 1;
  bench.to_data_exch({}, watched);
  const Exchange first = dx(kFcb0);
  bench.run_ms(12);
  ASSERT_EQ(bench.dp_state(), DpState::kWaitPrm);
  expect_repetition(first, kFcb0);
  EXPECT_EQ(bench.dp_state(), DpState::kWaitPrm);
}

TEST_P(FcbRule, PollOfC2AgainMovesNoChannel) {
  bench.power_on();
  bench.enable_dpv1(true);
  ASSERT_TRUE(bench.initialise());
  bench.find_baud(0);
  const Bytes initiate = {0x57, 0, 0, 0, 0, 100, 1, 0, 0, 0, 0, 0, 0, 0};
  ASSERT_TRUE(is_data(send_fc(bench, kFirst, 0x31, 0x32, initiate)));
  const Exchange connected = send_fc(bench, kFcb0, 0x30, 0x32, {});
  ASSERT_EQ(connected.answer().data.at(0), 0x57);
  EXPECT_EQ(send_fc(bench, kFcb0, 0x30, 0x32, {}).raw, connected.raw);
  EXPECT_EQ(bench.count(Reason::kRepetition), 1);
  EXPECT_TRUE(is_sc(send_fc(bench, kFcb1, 0x30, 0x32, {}))) << "nothing more to fetch";
}

INSTANTIATE_TEST_SUITE_P(S26, FcbRule, testing::Values(0U, 1U),
                         [](const auto& at) { return at.param == 0 ? "Letter" : "Content"; });

// --- source address 127 (S32)

TEST_F(Fdl, SourceAddress127IsIgnoredWhateverItAsks) {
  bench.to_wait_prm();
  const auto ignored = [this](const bus::Telegram& telegram) {
    const auto before = bench.chip.status();
    const int reported = bench.count(Reason::kSa127);
    const std::size_t events = bench.chip.events().size();
    EXPECT_TRUE(bench.requester.send(bench.timeline, telegram).silent());
    settle(bench);
    EXPECT_EQ(bench.count(Reason::kSa127), reported + 1) << int{telegram.fc};
    EXPECT_EQ(bench.chip.events().size(), events + 1) << "nothing else is looked at";
    EXPECT_EQ(bench.chip.status().telegrams_answered, before.telegrams_answered);
    EXPECT_EQ(bench.chip.status().dp_state, before.dp_state);
    EXPECT_EQ(bench.chip.status().master, before.master);
  };
  ignored(bus::make_telegram(5, 127, kFirst, Prm{}.bytes(), 61, 62));
  ASSERT_TRUE(is_sc(bench.set_prm({})));
  ignored(bus::make_telegram(5, 127, kFirst, {0x11, 0x21}, 62, 62));
  ASSERT_TRUE(is_sc(bench.check_cfg()));
  bench.chip_accesses(3);
  for (int code = 0; code <= 0x0F; ++code) {
    const auto fc = static_cast<std::uint8_t>(0x40 | code);
    ignored(bus::make_telegram(5, 127, fc, {1, 2}));
    ignored(bus::make_telegram(5, 127, fc, {0x02, 0}, 58, 62));
    ignored(bus::make_telegram(bus::kBroadcast, 127, fc, {0x02, 0}, 58, 62));
  }
  ignored(bus::make_telegram(5, 127, kFdlStatus));
  ignored(bus::make_telegram(5, 127, kFirst, {}, 60, 62));
  EXPECT_EQ(output_area(bench), Bytes{}) << "no outputs, no clearing";
  EXPECT_TRUE(dx(kFirst).answered());
  EXPECT_EQ(bench.chip.status().master, 2);
}

TEST_F(Fdl, SourceAddress127OrAResponseOrNoTSynGivesTheFirstReasonOnly) {
  bench.to_data_exch();
  const Tick bit = bench.requester.bit();
  bench.requester.send(bench.timeline, bus::make_telegram(5, 127, 0x08, {1, 2}));
  EXPECT_EQ(bench.count(Reason::kResponse), 1);
  bench.requester.send(bench.timeline, bus::make_telegram(9, 2, kFirst, {1}), {.wants_answer = false});
  bench.requester.send(bench.timeline, bus::encode(bus::make_telegram(5, 127, kFirst, {1, 2})),
                       {.idle_bits = 20, .wants_answer = false});
  bench.run_for(bit * 10);
  EXPECT_EQ(bench.count(Reason::kNoSyn), 1);
  EXPECT_EQ(bench.count(Reason::kSa127), 0);
}

TEST_F(Fdl, SourceAddress127LeavesTheMemory) {
  bench.to_data_exch();
  ASSERT_TRUE(dx(kFirst).answered());
  const Exchange first = dx(kFcb0);
  const auto before = executed();
  dx(kFirst, {9, 9}, 127);
  dx(kFcb0, {9, 9}, 127);
  EXPECT_EQ(dx(kFcb0).raw, first.raw);
  EXPECT_EQ(executed(), before) << "a repetition still";
  EXPECT_EQ(bench.count(Reason::kRepetition), 1);
}

TEST_F(Fdl, RefusalIsRepeatedFromMemoryToo) {
  bench.to_wait_prm();
  EXPECT_TRUE(is_rs(dx(kFirst)));
  EXPECT_TRUE(is_rs(dx(kFcb0)));
  EXPECT_TRUE(is_rs(dx(kFcb0)));
  EXPECT_EQ(bench.count(Reason::kRepetition), 1);
}

TEST_F(Fdl, RepetitionBehindAStateChangeIsAnsweredFromMemory) {
  Prm prm;
  prm.status = 0x88;  // lock, WD_On
  prm.wd1 = 1;
  prm.wd2 = 1;  // 10 ms
  bench.to_data_exch({}, prm);
  bench.give_inputs({9, 8});
  dx(kFirst);
  const Exchange first = dx(kFcb0);
  bench.run_ms(12);
  ASSERT_EQ(bench.dp_state(), DpState::kWaitPrm);
  EXPECT_EQ(dx(kFcb0).raw, first.raw);
  EXPECT_TRUE(is_rs(dx(kFcb1)));
}

TEST_F(Fdl, MemoryIsDroppedByANewInitialisation) {
  bench.to_data_exch();
  dx(kFirst);
  EXPECT_TRUE(is_data(dx(kFcb0)));
  ASSERT_TRUE(bench.initialise());
  bench.find_baud(0);
  EXPECT_TRUE(is_rs(dx(kFcb0)));
  EXPECT_EQ(bench.count(Reason::kRepetition), 0);
}

TEST_F(Fdl, MemoryIsDroppedByAReset) {
  bench.to_data_exch();
  dx(kFirst);
  EXPECT_TRUE(is_data(dx(kFcb0)));
  bench.chip.set(bench.now(), Pin::kReset, 0);
  bench.power_on();
  ASSERT_TRUE(bench.initialise());
  bench.find_baud(0);
  EXPECT_TRUE(is_rs(dx(kFcb0)));
}

TEST(FdlMemory, IsDroppedByANewBaudRate) {
  dsdpv1::Config config = quick_search();
  config.baud_control_ms = 5;
  SlaveBench bench(config);
  bench.to_data_exch();
  send_fc(bench, kFirst, kNoSap, kNoSap, {1, 2});
  ASSERT_TRUE(send_fc(bench, kFcb0, kNoSap, kNoSap, {1, 2}).answered());
  bench.run_ms(6);
  bench.find_baud(1);
  const auto before = bench.chip.status().data_exchanges;
  EXPECT_TRUE(send_fc(bench, kFcb0, kNoSap, kNoSap, {1, 2}).answered());
  EXPECT_EQ(bench.chip.status().data_exchanges, before + 1);
}

TEST_F(Fdl, RepetitionKeepsTheTimeToTheAnswer) {
  bench.to_data_exch();
  dx(kFirst);
  const Exchange first = dx(kFcb0);
  const Exchange again = dx(kFcb0);
  EXPECT_EQ(static_cast<int>(again.tsdr_bits()), 11);
  EXPECT_EQ(first.raw, again.raw);
}

// --- function codes

TEST_F(Fdl, IdentAndLsapStatusAreRefused) {
  bench.to_data_exch();
  for (const int fc : {0x4E, 0x4F})
    EXPECT_TRUE(is_rs(send_fc(bench, static_cast<std::uint8_t>(fc), kNoSap, kNoSap, {}))) << fc;
}

TEST_F(Fdl, SdaToADpSapIsRefusedAndNotExecuted) {
  bench.to_wait_prm();
  for (const int fc : {0x43, 0x45, 0x63, 0x65, 0x73}) {
    EXPECT_TRUE(is_rs(send_fc(bench, static_cast<std::uint8_t>(fc), 61, 62, Prm{}.bytes()))) << fc;
    EXPECT_EQ(bench.dp_state(), DpState::kWaitPrm);
  }
  EXPECT_EQ(bench.count(Reason::kPrmAccepted), 0);
}

TEST_F(Fdl, SdnIsNeverAnsweredNorExecutedButForGlobalControl) {
  bench.to_wait_prm();
  for (const int fc : {0x44, 0x46}) {
    EXPECT_TRUE(send_fc(bench, static_cast<std::uint8_t>(fc), 61, 62, Prm{}.bytes()).silent());
    EXPECT_TRUE(send_fc(bench, static_cast<std::uint8_t>(fc), 60, 62, {}).silent());
    EXPECT_TRUE(send_fc(bench, static_cast<std::uint8_t>(fc), 51, 51, {1}).silent());
    EXPECT_TRUE(send_fc(bench, static_cast<std::uint8_t>(fc), kNoSap, kNoSap, {1, 2}).silent());
  }
  EXPECT_EQ(bench.dp_state(), DpState::kWaitPrm);
  EXPECT_EQ(bench.count(Reason::kSdnIgnored), 8);
  EXPECT_EQ(bench.chip.status().data_exchanges, 0U);
}

TEST_F(Fdl, OtherFunctionCodesExecuteNothing) {
  bench.to_data_exch();
  const auto before = executed();
  for (const int fc : {0x40, 0x41, 0x42, 0x47, 0x48, 0x4A, 0x4B}) {
    const Exchange exchange = send_fc(bench, static_cast<std::uint8_t>(fc), kNoSap, kNoSap, {1, 2});
    EXPECT_TRUE(exchange.silent() || is_rs(exchange)) << fc << ": " << kind_of(exchange);
  }
  EXPECT_EQ(executed(), before);
  EXPECT_TRUE(dx(kFirst).answered());
}

TEST_F(Fdl, SrdLowAndHighAreServedAlike) {
  bench.to_wait_prm();
  EXPECT_TRUE(is_sc(send_fc(bench, 0x6C, 61, 62, Prm{}.bytes())));
  EXPECT_TRUE(is_sc(send_fc(bench, 0x6C, 62, 62, {0x11, 0x21})));
  EXPECT_TRUE(is_data(send_fc(bench, 0x6C, kNoSap, kNoSap, {1, 2})));
  EXPECT_TRUE(is_data(send_fc(bench, 0x6D, kNoSap, kNoSap, {1, 2})));
}

// --- SAPs

TEST_F(Fdl, SapsThatDoNotExistAreRefusedWithTheReason) {
  bench.to_data_exch();
  int refused = 0;
  for (int sap = 0; sap < 256; ++sap) {  // bits 7 and 6 of the extension byte are not for SAPs of DP
    if ((sap >= 55 && sap <= 62) || (sap >= 47 && sap <= 49) || sap == 51) continue;
    const Exchange exchange = ask(bench, sap, {0, 0});
    EXPECT_TRUE(is_rs(exchange)) << "SAP " << sap << ": " << kind_of(exchange);
    EXPECT_EQ(bench.count(Reason::kSapUnknown), ++refused) << "SAP " << sap;
    EXPECT_EQ(bench.last(Reason::kSapUnknown).a, sap);
  }
  EXPECT_EQ(bench.dp_state(), DpState::kDataExch);
}

// --- addressing of answers (S21)

TEST_F(Fdl, AnswerGoesToTheSsapFromTheDsap) {
  bench.to_data_exch();
  for (const int ssap : {62, 50, 0, 63}) {
    for (const int dsap : {60, 59, 56, 57}) {
      const Exchange exchange = send_fc(bench, kFirst, dsap, ssap, {}, 7);
      ASSERT_TRUE(is_data(exchange)) << dsap << " from " << ssap << ": " << kind_of(exchange);
      EXPECT_EQ(exchange.answer().da, 7);
      EXPECT_EQ(exchange.answer().sa, 5);
      EXPECT_EQ(exchange.answer().dsap, ssap);
      EXPECT_EQ(exchange.answer().ssap, dsap);
    }
  }
}

TEST_F(Fdl, AnswerToAServiceWithoutSsapHasNoSapBytes) {
  bench.to_data_exch();
  const Exchange exchange = send_fc(bench, kFirst, 60, kNoSap, {}, 7);
  ASSERT_TRUE(is_data(exchange)) << kind_of(exchange);
  EXPECT_EQ(exchange.answer().dsap, std::nullopt);
  EXPECT_EQ(exchange.answer().ssap, std::nullopt);
  EXPECT_EQ(exchange.answer().data.size(), 6U);
}

TEST_F(Fdl, AnswerToADataExchangeHasNoSapBytes) {
  bench.to_data_exch();
  bench.give_inputs({0xA1, 0xB2});
  const Exchange exchange = dx(kFirst);
  EXPECT_EQ(exchange.raw, (Bytes{0x68, 5, 5, 0x68, 2, 5, 0x08, 0xA1, 0xB2,
                                 static_cast<std::uint8_t>(2 + 5 + 8 + 0xA1 + 0xB2), 0x16}));
}

TEST_F(Fdl, RefusalIsAnSd1WithoutSapBytes) {
  bench.to_wait_prm();
  EXPECT_EQ(ask(bench, 62, {0x11, 0x21}).raw, (Bytes{0x10, 2, 5, 0x03, 0x0A, 0x16}));
  ASSERT_TRUE(is_sc(bench.set_prm({})));
  EXPECT_EQ(ask(bench, 62, Bytes(201, 0)).raw, (Bytes{0x10, 2, 5, 0x02, 0x09, 0x16}));
}

TEST_F(Fdl, EveryStationAddressIsServed) {
  for (const int address : {0, 1, 125}) {  // 126: S33
    SlaveBench other(quick_search());
    Init init;
    init.address = static_cast<std::uint8_t>(address);
    other.to_data_exch(init);
    EXPECT_TRUE(other.data_exchange({1, 2}).answered()) << address;
    EXPECT_EQ(other.fdl_status().answer().sa, address);
  }
}

}  // namespace
}  // namespace dsdpv1::conformance
