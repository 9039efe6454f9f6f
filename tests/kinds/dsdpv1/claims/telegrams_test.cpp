// The content of telegrams (S5, S13, S20, S21, S26, facts), in synthetic captures.
#include <gtest/gtest.h>

#include "tests/kinds/dsdpv1/claims/made_capture.hpp"

namespace dsdpv1::calibrate_test {
namespace {

namespace fc = bus::fc;
namespace sap = bus::sap;

/// The verdict on a claim after one exchange.
Verdict verdict(const Telegram& asked, const Telegram& answered, const std::string& ruling, const std::string& words) {
  MadeCapture capture(k1M5);
  capture.exchange(asked, answered);
  return claim(capture.judge(), ruling, words).verdict;
}

// --- S26 -------------------------------------------------------------------------------------------------------------

/// A data exchange, then the end of DATA_EXCH, then one with this FCB.
calibrate::Result after_the_end(unsigned fcb) {
  MadeCapture capture(k1M5, {wire::kBr, wire::kPbf});
  capture.find_rate();
  capture.set(wire::kPbf, false);
  capture.exchange(data_exchange({1}, fc::kFcv | fc::kFcb), data_answer({2}));
  capture.wait_ms(10);
  capture.set(wire::kPbf, true);
  capture.exchange(data_exchange({1}, fcb), data_answer({2}));
  return capture.judge();
}

TEST(CalibrateTelegrams, ARepetitionIsAnsweredFromMemoryAlsoOutsideOfDataExchange) {
  const calibrate::Result result = after_the_end(fc::kFcv | fc::kFcb);
  EXPECT_EQ(contradicted(result), "");
  EXPECT_EQ(claim(result, "S26", "repeated").verdict, Verdict::kConfirmed);
}

TEST(CalibrateTelegrams, WithoutBrARepetitionIsNotShownForWantOfIt) {
  MadeCapture capture(k1M5);
  for (int i = 0; i < 2; ++i) capture.exchange(data_exchange({1}, fc::kFcv), data_answer({2}));
  EXPECT_EQ(claim(capture.judge(), "S26", "repeated").words, "not in the capture: BR");
}

TEST(CalibrateTelegrams, AnotherFcbIsNoRepetition) {
  const calibrate::Result result = after_the_end(fc::kFcv);
  EXPECT_EQ(claim(result, "S13", "outside of data exchange").verdict, Verdict::kContradicted);
  EXPECT_EQ(claim(result, "P3", "outputs are taken").verdict, Verdict::kContradicted);
}

// By the letter of S26 it is one: the chip may send the old answer.
TEST(CalibrateTelegrams, AnotherServiceWithTheSameFcbIsNotJudged) {
  MadeCapture capture(k1M5, {wire::kBr, wire::kPbf});
  capture.find_rate();
  capture.set(wire::kPbf, false);
  capture.exchange(data_exchange({1}, fc::kFcv), data_answer({2}));
  Telegram prm = srd(bus::sap::kSetPrm, {0x80, 0, 0, 11, 0, 0, 0});
  prm.fc = data_exchange({}, fc::kFcv).fc;
  capture.exchange(prm, data_answer({2}));
  EXPECT_EQ(contradicted(capture.judge()), "");
}

TEST(CalibrateTelegrams, ARepetitionCountsThoughWhatIsBetweenWasIllegible) {
  MadeCapture capture(k1M5, {wire::kBr, wire::kPbf});
  capture.find_rate();
  capture.set(wire::kPbf, false);
  capture.exchange(data_exchange({1}, fc::kFcv), data_answer({2}));
  capture.set(wire::kPbf, true);
  capture.request(Bytes{0x68, 0x05, 0x04, 0x68});
  capture.exchange(data_exchange({1}, fc::kFcv), data_answer({2}));
  EXPECT_EQ(contradicted(capture.judge()), "");
}

TEST(CalibrateTelegrams, DataExchangeMayBeginBetweenTheRequestAndItsDecision) {
  MadeCapture capture(k1M5, {wire::kBr, wire::kPbf});
  capture.find_rate();
  capture.request(data_exchange({1}));
  capture.set_at(wire::kPbf, capture.now() + static_cast<Tick>(capture.bit() / 2), false);
  capture.answer(data_answer({2}));
  EXPECT_EQ(contradicted(capture.judge()), "");
}

// --- services --------------------------------------------------------------------------------------------------------

TEST(CalibrateTelegrams, SetSlaveAddressIsRrOnlyBeyondFourBytes) {
  const Bytes right = {9, 0x0C, 0xC9, 0}, longer = {9, 0x0C, 0xC9, 0, 0};
  const auto judged = [](const Bytes& data, const Telegram& answered) {
    return verdict(srd(sap::kSetSlaveAddress, data), answered, "S5", "SAP 55");
  };
  EXPECT_EQ(judged(right, bus::make_sc()), Verdict::kConfirmed);
  EXPECT_EQ(judged(right, status(fc::kRs)), Verdict::kConfirmed);
  EXPECT_EQ(judged(right, status(fc::kRr)), Verdict::kContradicted);
  EXPECT_EQ(judged(longer, status(fc::kRr)), Verdict::kConfirmed);
  EXPECT_EQ(judged(longer, status(fc::kRs)), Verdict::kConfirmed);
  EXPECT_EQ(judged(longer, bus::make_sc()), Verdict::kContradicted);
}

TEST(CalibrateTelegrams, RequestsWithDataToSapsThatAreAlwaysServedAreRr) {
  for (const std::uint8_t each : {sap::kGetCfg, sap::kSlaveDiag}) {
    EXPECT_EQ(verdict(srd(each, {1}), status(fc::kRr), "S13", "SAPs 59 and 60"), Verdict::kConfirmed) << int{each};
    EXPECT_EQ(verdict(srd(each, {1}), status(fc::kRs), "S13", "SAPs 59 and 60"), Verdict::kContradicted) << int{each};
  }
  for (const std::uint8_t each : {sap::kReadInputs, sap::kReadOutputs}) {
    EXPECT_EQ(verdict(srd(each, {1}), status(fc::kRs), "S13", "56 and 57 answer"), Verdict::kConfirmed) << int{each};
    EXPECT_EQ(verdict(srd(each, {1}), bus::make_sc(), "S13", "56 and 57 answer"), Verdict::kContradicted) << int{each};
  }
}

TEST(CalibrateTelegrams, OnlyGetCfgMayHaveNothingToSend) {
  const auto judged = [](std::uint8_t sap, const Telegram& answered) {
    return verdict(srd(sap), answered, "S13", "Slave_Diag is answered");
  };
  EXPECT_EQ(judged(sap::kGetCfg, sap_answer(sap::kGetCfg, {0x11})), Verdict::kConfirmed);
  EXPECT_EQ(judged(sap::kGetCfg, bus::make_sc()), Verdict::kConfirmed);
  EXPECT_EQ(judged(sap::kGetCfg, status(fc::kRs)), Verdict::kContradicted);
  EXPECT_EQ(judged(sap::kSlaveDiag, bus::make_sc()), Verdict::kContradicted);
}

TEST(CalibrateTelegrams, GlobalControlThatWantsAnAnswerIsRefused) {
  const Telegram asked = srd(sap::kGlobalControl, {0, 0});
  EXPECT_EQ(verdict(asked, status(fc::kRs), "S29", "SAP 58"), Verdict::kConfirmed);
  EXPECT_EQ(verdict(asked, bus::make_sc(), "S29", "SAP 58"), Verdict::kContradicted);
}

TEST(CalibrateTelegrams, AnswersWithDataAreSd2) {
  Telegram eight = data_answer({1, 2, 3, 4, 5, 6, 7, 8});
  EXPECT_EQ(verdict(data_exchange({1}), eight, "S20", "SD2"), Verdict::kConfirmed);
  eight.kind = bus::TelegramKind::kSd3;
  EXPECT_EQ(verdict(data_exchange({1}), eight, "S20", "SD2"), Verdict::kContradicted);
}

TEST(CalibrateTelegrams, WithoutSsapTheAnswerHasNoSapBytes) {
  const auto asked = [](std::optional<std::uint8_t> dsap, std::optional<std::uint8_t> ssap) {
    return bus::make_telegram(kStation, kMaster, fc::kRequest | fc::kSrdHigh, {}, dsap, ssap);
  };
  const auto judged = [](const Telegram& request, std::optional<std::uint8_t> dsap, std::optional<std::uint8_t> ssap) {
    return verdict(request, bus::make_telegram(kMaster, kStation, fc::kDl, {1}, dsap, ssap), "S21", "SAP that asked");
  };
  EXPECT_EQ(judged(asked(60, 62), 62, 60), Verdict::kConfirmed);
  EXPECT_EQ(judged(asked(60, 62), 62, {}), Verdict::kContradicted);
  EXPECT_EQ(judged(asked(60, {}), {}, {}), Verdict::kConfirmed);
  EXPECT_EQ(judged(asked(60, {}), {}, 60), Verdict::kContradicted);
  EXPECT_EQ(judged(asked({}, 62), 62, {}), Verdict::kConfirmed);
  EXPECT_EQ(judged(asked({}, 62), 62, 60), Verdict::kContradicted);
}

TEST(CalibrateTelegrams, StatusThreeOfTheDiagnosisIsZero) {
  Telegram answered = diagnosis(0, 0);
  EXPECT_EQ(verdict(srd(sap::kSlaveDiag), answered, "facts", "Slave_Diag"), Verdict::kConfirmed);
  answered.data[2] = 0x80;
  EXPECT_EQ(verdict(srd(sap::kSlaveDiag), answered, "facts", "Slave_Diag"), Verdict::kContradicted);
}

}  // namespace
}  // namespace dsdpv1::calibrate_test
