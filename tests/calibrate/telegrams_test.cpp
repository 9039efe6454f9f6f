// What telegrams say (S5, S13, S20, S21, S26, facts), in captures made for it.
#include <gtest/gtest.h>

#include "made_capture.hpp"

namespace {

using namespace calibrate_test;
using calibrate::Verdict;
namespace fc = bus::fc;
namespace sap = bus::sap;


// --- S26 -------------------------------------------------------------------------------------------------------------

/// A data exchange, then the end of DATA_EXCH, then one with this FCB.
calibrate::Result after_the_end(unsigned fcb) {
  MadeCapture capture(k1M5, {Wire::kBr, Wire::kPbf});
  capture.find_rate();
  capture.set(Wire::kPbf, false);
  capture.exchange(data_exchange({1}, fc::kFcv | fc::kFcb), data_answer({2}));
  capture.wait_ms(10);
  capture.set(Wire::kPbf, true);
  capture.exchange(data_exchange({1}, fcb), data_answer({2}));
  return capture.judge();
}

TEST(CalibrateTelegrams, ARepetitionIsAnsweredFromMemoryAlsoOutsideOfDataExchange) {
  const calibrate::Result result = after_the_end(fc::kFcv | fc::kFcb);
  EXPECT_EQ(contradicted(result), "");
  EXPECT_EQ(claim(result, "S26", "repeated").verdict, Verdict::kConfirmed);
}

TEST(CalibrateTelegrams, AnotherFcbIsNoRepetition) {
  const calibrate::Result result = after_the_end(fc::kFcv);
  EXPECT_EQ(claim(result, "S13", "outside of data exchange").verdict, Verdict::kContradicted);
  EXPECT_EQ(claim(result, "P3", "outputs are taken").verdict, Verdict::kContradicted);
}

TEST(CalibrateTelegrams, ARepetitionCountsThoughWhatIsBetweenWasIllegible) {
  MadeCapture capture(k1M5, {Wire::kBr, Wire::kPbf});
  capture.find_rate();
  capture.set(Wire::kPbf, false);
  capture.exchange(data_exchange({1}, fc::kFcv), data_answer({2}));
  capture.set(Wire::kPbf, true);
  capture.request(Bytes{0x68, 0x05, 0x04, 0x68});
  capture.exchange(data_exchange({1}, fc::kFcv), data_answer({2}));
  EXPECT_EQ(contradicted(capture.judge()), "");
}

TEST(CalibrateTelegrams, DataExchangeMayBeginBetweenTheRequestAndItsDecision) {
  MadeCapture capture(k1M5, {Wire::kBr, Wire::kPbf});
  capture.find_rate();
  capture.request(data_exchange({1}));
  capture.set_at(Wire::kPbf, capture.now() + static_cast<Tick>(capture.bit() / 2), false);
  capture.answer(data_answer({2}));
  EXPECT_EQ(contradicted(capture.judge()), "");
}

}  // namespace
