// P2, S2, S3, S10: answers and the idle time before requests, in captures made for it.
#include <gtest/gtest.h>

#include <functional>

#include "tests/kinds/dsdpv1/claims/made_capture.hpp"

namespace dsdpv1::calibrate_test {
namespace {

void exchange_data(MadeCapture& capture, int times) {
  for (int i = 0; i < times; ++i) capture.exchange(data_exchange({1}), data_answer({2}));
}

// --- S3: answered ----------------------------------------------------------------------------------------------------

/// One request of many is not answered, so long after the answer before.
Verdict unanswered_after(double ms, const std::vector<Wire>& pins) {
  MadeCapture capture(k1M5, pins);
  for (const Wire pin : pins) capture.begins_high(pin);
  exchange_data(capture, 3);
  capture.wait_ms(ms);
  capture.request(data_exchange({1}));
  capture.wait_ms(1);
  exchange_data(capture, 3);
  return claim(capture.judge(), "S3", "is answered").verdict;
}

TEST(CalibrateAnswers, WithoutBrTheFirstRequestAfterASilenceMayHaveEndedTheSearch) {
  EXPECT_EQ(unanswered_after(601, {}), Verdict::kConfirmed);
  EXPECT_EQ(unanswered_after(1, {}), Verdict::kContradicted);
  EXPECT_EQ(unanswered_after(100, {wire::kBr}), Verdict::kContradicted);
}

TEST(CalibrateAnswers, WithoutBrAnUnansweredRequestMayHaveFollowedAnInitialisation) {
  MadeCapture capture(k1M5);
  exchange_data(capture, 3);
  capture.request(data_exchange({1}));
  capture.wait_ms(1);
  capture.exchange(data_exchange({1}), status(bus::fc::kRs));
  EXPECT_EQ(contradicted(capture.judge()), "");
}

TEST(CalibrateAnswers, AreReadAtEachRateWithAnotherClock) {
  for (int baud = 0; baud < bus::kBaudCount; ++baud)
    for (const double ppm : {-900.0, 100.0, 900.0}) {
      MadeCapture capture(baud);
      exchange_data(capture, 3);
      capture.stretch(ppm);
      const calibrate::Result result = capture.judge();
      EXPECT_EQ(contradicted(result), "") << baud << ", " << ppm;
      EXPECT_EQ(claim(result, "S3", "without a request").tally.holds, 3U) << baud << ", " << ppm;
    }
}

/// Two samples a bit, which fall on the edges of the answers, or of the requests.
TEST(CalibrateAnswers, AreReadWhereTheEdgesAreOnTheSamples) {
  for (const double late : {1.5, 2.0}) {
    MadeCapture capture(k12M);
    capture.wait_cycles(late);
    for (unsigned i = 0; i < 3000; ++i) {
      capture.exchange(data_exchange({1, 2, 3, 4, 5, 6, 7, 8}), data_answer({1, 2, 3, 4, 5, 6, 7, 8}));
      capture.wait_cycles(1.5 + (i % 2 == 0 ? 0 : 2));  // on the grid of the samples again
    }
    capture.jitter(bus::kTicksPerNs);
    EXPECT_EQ(contradicted(capture.judge_sampled(24e6)), "") << late;
  }
}

// --- the capture begins in a bus cycle ------------------------------------------------------------------------------

/// Captures of a bus that begin one bit after the other in a cycle of it.
void expect_right_from_anywhere(int baud, double tsdr, const std::function<calibrate::Result(MadeCapture&)>& judge) {
  MadeCapture whole(baud);
  const Tick begin = whole.now();
  Tick end = begin;
  for (int i = 0; i < 4; ++i) {
    whole.exchange(data_exchange({0xE5, 1}), data_answer({2, 0xE5, 3}), tsdr);
    if (i == 0) end = whole.now();
  }
  const auto bit = static_cast<Tick>(whole.bit());
  for (Tick at = begin; at < end; at += bit) {
    MadeCapture capture = whole;
    capture.begin_at(at);
    const calibrate::Result result = judge(capture);
    EXPECT_EQ(contradicted(result), "") << at / bit;
    EXPECT_GE(claim(result, "S3", "without a request").tally.holds, 2U) << at / bit;
  }
}

TEST(CalibrateAnswers, ACaptureMayBeginAnywhere) {
  for (const double tsdr : {11.0, 60.0}) {
    expect_right_from_anywhere(
        k12M, tsdr, [](MadeCapture& capture) { return capture.judge(); });
    expect_right_from_anywhere(k1M5, tsdr, [](MadeCapture& capture) { return capture.judge(); });
  }
}

TEST(CalibrateAnswers, ACoarseCaptureMayBeginAnywhere) {
  expect_right_from_anywhere(
      k12M, 11, [](MadeCapture& capture) { return capture.judge_sampled(24e6); });
}

TEST(CalibrateAnswers, AnAnswerThatNobodyAskedForIsContradicted) {
  MadeCapture capture(k1M5);
  exchange_data(capture, 2);
  capture.wait_ms(1);
  capture.answer(data_answer({2}));
  exchange_data(capture, 2);
  EXPECT_EQ(claim(capture.judge(), "S3", "without a request").verdict, Verdict::kContradicted);
}

// --- S3, S10: idle ---------------------------------------------------------------------------------------------------

TEST(CalibrateAnswers, AGlitchDoesNotEndIdleTime) {
  for (const double before : {20.0, 3.0, 0.7}) {  // bit times before the request
    MadeCapture capture(k1M5);
    exchange_data(capture, 2);
    capture.wait_bits(40);
    capture.pulse(wire::kPbrxd, 10 * bus::kTicksPerCycle);
    capture.request(data_exchange({1}), before);
    capture.answer(data_answer({2}));
    const calibrate::Result result = capture.judge();
    EXPECT_EQ(contradicted(result), "") << before;
    EXPECT_EQ(claim(result, "S3", "is answered").tally.holds, 2U) << "the first has no idle time";
  }
}

TEST(CalibrateAnswers, InACoarseCaptureAShortLowLevelMayBeAGlitch) {
  const auto judged = [](double cycles) {
    MadeCapture capture(k12M);
    exchange_data(capture, 2);
    capture.wait_bits(40);
    capture.pulse(wire::kPbrxd, static_cast<Tick>(cycles * bus::kTicksPerCycle));
    capture.request(data_exchange({1}), 20);
    capture.answer(data_answer({2}));
    return claim(capture.judge_sampled(24e6), "S3", "33 bit times").verdict;
  };
  EXPECT_NE(judged(1.8), Verdict::kContradicted);
  EXPECT_EQ(judged(12), Verdict::kContradicted);
}

TEST(CalibrateAnswers, AGlitchOfTheChipIsToldAsWhatItSends) {
  MadeCapture capture(k1M5);
  exchange_data(capture, 2);
  capture.wait_bits(40);
  capture.pulse(wire::kPbtxd, 10 * bus::kTicksPerCycle);
  exchange_data(capture, 1);
  EXPECT_EQ(claim(capture.judge(), "S2", "every edge").verdict, Verdict::kContradicted);
}

TEST(CalibrateAnswers, AfterWhatIsNoTelegramIdleTimeBeginsWithItsEnd) {
  const Bytes wrong(8, 0x55);
  MadeCapture capture(k1M5);
  exchange_data(capture, 2);
  capture.request(wrong);
  capture.request(data_exchange({1}), 20);  // not answered
  capture.wait_ms(1);
  exchange_data(capture, 2);
  EXPECT_EQ(contradicted(capture.judge()), "");
  capture.request(wrong);
  capture.exchange(data_exchange({1}), data_answer({2}));
  EXPECT_EQ(contradicted(capture.judge()), "");
  capture.request(wrong);
  capture.request(data_exchange({1}), 15);
  capture.answer(data_answer({2}));
  EXPECT_EQ(claim(capture.judge(), "S3", "33 bit times").verdict, Verdict::kContradicted);
}

/// The second half of one request comes so many cycles later than 1 bit time after the first, and is not answered.
Verdict unanswered_with_gap(double cycles) {
  MadeCapture capture(k1M5);
  exchange_data(capture, 2);
  const Bytes bytes = bus::encode(data_exchange({1}));
  capture.request(Bytes(bytes.begin(), bytes.begin() + 5));
  capture.wait_cycles(cycles);
  capture.request(Bytes(bytes.begin() + 5, bytes.end()), 1);
  capture.wait_ms(1);
  exchange_data(capture, 2);
  return claim(capture.judge(), "S3", "is answered").verdict;
}

TEST(CalibrateAnswers, ARequestThatMayHaveAGapNeedNotBeAnswered) {
  EXPECT_EQ(unanswered_with_gap(0.5), Verdict::kConfirmed);
  EXPECT_EQ(unanswered_with_gap(5), Verdict::kConfirmed);
  EXPECT_EQ(unanswered_with_gap(-5), Verdict::kContradicted);
}

/// A low level begins so many bit times after a request's end, and the request is answered.
calibrate::Result disturbed(double after, double cycles) {
  MadeCapture capture(k1M5);
  exchange_data(capture, 2);
  capture.request(data_exchange({1}));
  const auto at = capture.now() + static_cast<Tick>(after * capture.bit());
  capture.set_at(wire::kPbrxd, at, false);
  capture.set_at(wire::kPbrxd, at + static_cast<Tick>(cycles * bus::kTicksPerCycle), true);
  capture.answer(data_answer({2}));
  exchange_data(capture, 2);
  return capture.judge();
}

TEST(CalibrateAnswers, ADisturbanceAfterTheDecisionDoesNotEndTheWait) {
  EXPECT_EQ(contradicted(disturbed(5, 20)), "");
  EXPECT_EQ(contradicted(disturbed(1.2, 100)), "");
}

TEST(CalibrateAnswers, ALowLevelBeforeTheDecisionMakesTheRequestVoid) {
  EXPECT_EQ(claim(disturbed(0.5, 20), "S3", "without a request").verdict, Verdict::kContradicted);
}

/// min_TSDR is 140 bit times. Characters that are not a telegram, so many, begin 40 bit times after a request, whose
/// answer begins `tsdr` after it.
MadeCapture disturbed_for_long(int baud, std::size_t characters, double tsdr) {
  constexpr double kMinTsdr = 140, kBegins = 40;
  MadeCapture capture(baud);
  for (int i = 0; i < 3; ++i) capture.exchange(data_exchange({1}), data_answer({2}), kMinTsdr);
  capture.request(data_exchange({1}));
  capture.request(Bytes(characters, 0x55), kBegins);
  capture.answer(data_answer({2}), tsdr - kBegins - static_cast<double>(characters * bus::kCharacterBits));
  for (int i = 0; i < 3; ++i) capture.exchange(data_exchange({1}), data_answer({2}), kMinTsdr);
  return capture;
}

TEST(CalibrateAnswers, ADisturbanceOfAnyLengthDoesNotEndTheWait) {
  for (const std::size_t characters : {2U, 8U}) {
    const calibrate::Result result = disturbed_for_long(k1M5, characters, 140).judge();
    EXPECT_EQ(contradicted(result), "") << characters;
    EXPECT_EQ(claim(result, "S3", "without a request").tally.holds, 7U) << characters;
  }
  EXPECT_EQ(contradicted(disturbed_for_long(k12M, 8, 140).judge_sampled(24e6)), "") << "it may be a request";
}

TEST(CalibrateAnswers, AfterMaxTsdrAnAnswerIsToWhatIsNoTelegram) {
  const calibrate::Result result = disturbed_for_long(k1M5, 8, 160).judge();
  EXPECT_EQ(claim(result, "S3", "without a request").tally.fails, 1U);
}

// --- S2 --------------------------------------------------------------------------------------------------------------

/// An answer of which 4 characters and 3 bits are sent, in which this pin falls.
Verdict cut_by(const std::vector<Wire>& pins) {
  MadeCapture capture(k1M5, pins);
  for (const Wire pin : pins) capture.begins_high(pin);
  exchange_data(capture, 2);
  capture.request(data_exchange({1}));
  capture.cut_answer(data_answer({2}), 4, 3);
  for (const Wire pin : pins) capture.set(pin, false);
  return claim(capture.judge(), "S2", "every edge").verdict;
}

TEST(CalibrateAnswers, AnAnswerThatAResetOrAnInitialisationCutsIsNoContradiction) {
  EXPECT_EQ(cut_by({wire::kBr}), Verdict::kConfirmed);
  EXPECT_EQ(cut_by({wire::kReset}), Verdict::kConfirmed);
  EXPECT_EQ(cut_by({}), Verdict::kConfirmed) << "without BR an initialisation may have cut it";
}

TEST(CalibrateAnswers, AnAnswerThatNothingCutsIsContradicted) {
  MadeCapture capture(k1M5, {wire::kBr});
  capture.begins_high(wire::kBr);
  exchange_data(capture, 2);
  capture.request(data_exchange({1}));
  capture.cut_answer(data_answer({2}), 4, 3);
  EXPECT_EQ(claim(capture.judge(), "S2", "every edge").verdict, Verdict::kContradicted);
}

// --- P2 --------------------------------------------------------------------------------------------------------------

calibrate::Result driven(double lead, double trail) {
  MadeCapture capture(k1M5);
  capture.set_driver(lead, trail);
  exchange_data(capture, 3);
  return capture.judge();
}

TEST(CalibrateAnswers, ADriverThatIsEnabledForLongIsMeasured) {
  const calibrate::Result result = driven(90, 200);
  for (const auto& [key, value] : {std::pair("rts_lead", 90), std::pair("rts_trail", 200)}) {
    EXPECT_EQ(parameter(result, key).verdict, Verdict::kContradicted) << key;
    EXPECT_EQ(parameter(result, key).value, value) << key;
    EXPECT_LE(parameter(result, key).chosen, 32) << "what a scenario takes";
  }
}

TEST(CalibrateAnswers, ADriverThatEndsBeforeTheAnswerHasNoTrail) {
  const calibrate::Result result = driven(4, -8);
  EXPECT_EQ(parameter(result, "rts_trail").verdict, Verdict::kContradicted);
  EXPECT_EQ(parameter(result, "rts_trail").words, "-8");
}

TEST(CalibrateAnswers, ADriverThatStaysEnabledIsContradicted) {
  MadeCapture capture(k1M5);
  capture.begins_high(wire::kPbrts);
  exchange_data(capture, 1);  // its PBRTS falls
  capture.set_at(wire::kPbrts, capture.now() + 100 * bus::kTicksPerCycle, true);
  for (int i = 0; i < 2; ++i) {
    capture.request(data_exchange({1}));
    capture.answer_undriven(data_answer({2}));
  }
  EXPECT_EQ(claim(capture.judge(), "P2", "falls the same time").verdict, Verdict::kContradicted);
}

}  // namespace
}  // namespace dsdpv1::calibrate_test
