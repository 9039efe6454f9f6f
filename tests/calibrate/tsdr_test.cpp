// S3, S11, S30: when answers begin, in captures made for it.
#include <gtest/gtest.h>

#include "made_capture.hpp"

namespace {

using namespace calibrate_test;
using calibrate::Verdict;
namespace sap = bus::sap;

constexpr double kMaxTsdr = 150;  ///< at 1.5M

/// A station whose start is in the capture, with BR.
class TsdrStation : public MadeCapture {
 public:
  TsdrStation() : MadeCapture(k1M5, {Wire::kReset, Wire::kBr}) {
    set(Wire::kReset, true);
    find_rate();
  }
  void prm(std::uint8_t status, std::uint8_t min_tsdr, double tsdr) {
    exchange(set_prm(status, 0, min_tsdr), bus::make_sc(), tsdr);
  }
  void cfg(double tsdr) { exchange(srd(sap::kChkCfg, {0x11, 0x21}), bus::make_sc(), tsdr); }
  void data(double tsdr) { exchange(data_exchange({1}), data_answer({2}), tsdr); }
  Verdict s3() { return claim(judge(), "S3", "min_TSDR").verdict; }
  Verdict s11() { return claim(judge(), "S11", "min_TSDR").verdict; }
};

TEST(CalibrateTsdr, CountsFromTheAnswerToSetPrmOn) {
  TsdrStation station;
  station.prm(kLock, 15, 15), station.cfg(15), station.data(15);
  EXPECT_EQ(station.s3(), Verdict::kConfirmed);
  EXPECT_EQ(station.s11(), Verdict::kConfirmed);
}

TEST(CalibrateTsdr, CountsFromTheVerdictWhereTheUserJudges) {
  TsdrStation station;
  station.prm(kLock, 15, 11);
  station.exchange(srd(sap::kSlaveDiag), diagnosis(0x02, 0));
  station.cfg(15), station.data(15);
  EXPECT_EQ(station.s3(), Verdict::kConfirmed);
  EXPECT_EQ(station.s11(), Verdict::kConfirmed);
}

TEST(CalibrateTsdr, AChipThatLeavesItAsItWasIsContradicted) {
  TsdrStation station;
  station.prm(kLock, 15, 11), station.cfg(11), station.data(11);
  EXPECT_EQ(station.s11(), Verdict::kContradicted);
  EXPECT_NE(station.s3(), Verdict::kContradicted);
}

TEST(CalibrateTsdr, AChipThatForgetsItIsContradicted) {
  TsdrStation station;
  station.prm(kLock, 15, 15), station.cfg(15), station.data(15), station.data(11);
  EXPECT_EQ(station.s11(), Verdict::kContradicted);
}

TEST(CalibrateTsdr, LessThanElevenIsEleven) {
  TsdrStation right;
  right.prm(kLock, 5, 11), right.cfg(11), right.data(11);
  EXPECT_EQ(right.s11(), Verdict::kConfirmed);
  TsdrStation wrong;
  wrong.prm(kLock, 5, 5), wrong.cfg(5), wrong.data(5);
  EXPECT_EQ(wrong.s11(), Verdict::kContradicted);
}

TEST(CalibrateTsdr, MoreThanMaxTsdrIsMaxTsdr) {
  TsdrStation right;
  right.prm(kLock, 200, kMaxTsdr), right.cfg(kMaxTsdr), right.data(kMaxTsdr);
  EXPECT_EQ(right.s11(), Verdict::kConfirmed);
  TsdrStation wrong;
  wrong.prm(kLock, 200, 200), wrong.cfg(200), wrong.data(200);
  EXPECT_EQ(wrong.s11(), Verdict::kContradicted);
}

TEST(CalibrateTsdr, AnUnlockOrARefusedSetPrmLeavesIt) {
  TsdrStation station;
  station.prm(kLock, 15, 15), station.cfg(15), station.data(15);
  station.prm(kUnlock, 20, 15);
  station.exchange(srd(sap::kSlaveDiag), diagnosis(0x02, 0x01), 15);
  station.prm(kLock, 20, 15);  // of another ident
  station.exchange(srd(sap::kSlaveDiag), diagnosis(0x42, 0x01), 15);
  EXPECT_EQ(contradicted(station.judge()), "");
  station.exchange(srd(sap::kSlaveDiag), diagnosis(0x42, 0x01), 20);
  EXPECT_EQ(station.s3(), Verdict::kContradicted);
}

TEST(CalibrateTsdr, AnUnlocksMinTsdrIsNotTaken) {
  TsdrStation station;
  station.prm(kLock, 15, 15), station.cfg(15), station.data(15);
  station.prm(kUnlock, 20, 20);
  EXPECT_EQ(station.s3(), Verdict::kContradicted);
}

TEST(CalibrateTsdr, WithoutLockAndUnlockItCountsAtOnce) {
  TsdrStation right;
  right.prm(0, 20, 20);
  EXPECT_EQ(right.s11(), Verdict::kConfirmed);
  TsdrStation wrong;
  wrong.prm(0, 20, 11);
  EXPECT_EQ(wrong.s11(), Verdict::kContradicted);
}

TEST(CalibrateTsdr, ANewInitialisationMakesItEleven) {
  TsdrStation station;
  station.prm(kLock, 15, 15), station.cfg(15), station.data(15);
  station.set(Wire::kBr, false);
  station.wait_ms(1);
  station.find_rate();
  station.exchange(srd(sap::kSlaveDiag), diagnosis(0x02, 0x01), 11);
  EXPECT_EQ(contradicted(station.judge()), "");
}

TEST(CalibrateTsdr, TheEndOfBaudControlLeavesIt) {
  TsdrStation station;
  station.prm(kLock, 15, 15), station.cfg(15), station.data(15);
  station.set(Wire::kBr, false);
  station.wait_ms(1);
  station.find_rate();
  station.data(15);
  EXPECT_EQ(contradicted(station.judge()), "");
}

TEST(CalibrateTsdr, WhereTheCaptureBeginsInTheMiddleItIsThatOfTheFirstAnswer) {
  MadeCapture capture(k1M5);
  for (int i = 0; i < 3; ++i) capture.exchange(data_exchange({1}), data_answer({2}), 15);
  EXPECT_EQ(contradicted(capture.judge()), "");
  capture.exchange(data_exchange({1}), data_answer({2}), 11);
  EXPECT_EQ(claim(capture.judge(), "S3", "min_TSDR").verdict, Verdict::kContradicted);
}

TEST(CalibrateTsdr, WithoutBrAnInitialisationShowsInWhatIsNoDataExchange) {
  MadeCapture capture(k1M5);
  for (int i = 0; i < 3; ++i) capture.exchange(data_exchange({1}), data_answer({2}), 15);
  capture.exchange(srd(sap::kSlaveDiag), diagnosis(0x02, 0x01), 11);
  EXPECT_EQ(contradicted(capture.judge()), "");
}

}  // namespace
