// S3, S11, S30: when answers begin, in captures made for it.
#include <gtest/gtest.h>

#include <functional>

#include "tests/kinds/dsdpv1/claims/made_capture.hpp"

namespace dsdpv1::calibrate_test {
namespace {

namespace sap = bus::sap;

constexpr double kMaxTsdr = 150;  ///< at 1.5M

/// A station whose start is in the capture, with BR.
class TsdrStation : public MadeCapture {
 public:
  TsdrStation() : MadeCapture(k1M5, {wire::kReset, wire::kBr}) {
    set(wire::kReset, true);
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

TEST(CalibrateTsdr, AVerdictCountsAlsoAfterAMinTsdrWithoutLockAndUnlock) {
  const auto start = [](TsdrStation& station, double verdict, double data) {
    station.prm(kLock, 40, 11);  // the user judges
    station.prm(0, 20, 20);
    station.exchange(srd(sap::kSlaveDiag), diagnosis(0x02, 0), 20);
    station.cfg(verdict), station.data(data);
  };
  TsdrStation judged, accepted_before, wrong;
  start(judged, 40, 40), start(accepted_before, 20, 20), start(wrong, 20, 40);
  EXPECT_EQ(contradicted(judged.judge()), "");
  EXPECT_EQ(contradicted(accepted_before.judge()), "");
  EXPECT_EQ(wrong.s3(), Verdict::kContradicted);
}

TEST(CalibrateTsdr, ANewInitialisationMakesItEleven) {
  TsdrStation station;
  station.prm(kLock, 15, 15), station.cfg(15), station.data(15);
  station.set(wire::kBr, false);
  station.wait_ms(1);
  station.find_rate();
  station.exchange(srd(sap::kSlaveDiag), diagnosis(0x02, 0x01), 11);
  EXPECT_EQ(contradicted(station.judge()), "");
}

TEST(CalibrateTsdr, TheEndOfBaudControlLeavesIt) {
  TsdrStation station;
  station.prm(kLock, 15, 15), station.cfg(15), station.data(15);
  station.set(wire::kBr, false);
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

// --- requests that a coarse capture does not show --------------------------------------------------------------------

constexpr double kCoarse = 24e6;

Telegram with_fcv(Telegram telegram) {
  telegram.fc |= bus::fc::kFcv;
  return telegram;
}

/// A start-up with min_TSDR 60, of which two samples make a bit.
calibrate::Result coarse_start(const std::function<void(MadeCapture&)>& before_cfg, const std::vector<double>& data) {
  MadeCapture capture(k12M);
  capture.exchange(fdl_status(), status(0));
  before_cfg(capture);
  capture.exchange(srd(sap::kChkCfg, {0x11, 0x21}), bus::make_sc(), 60);
  for (const double tsdr : data) capture.exchange(data_exchange({1}), data_answer({2}), tsdr);
  return capture.judge_sampled(kCoarse);
}

void prm_after_unread_diagnosis(MadeCapture& capture) {
  capture.request_unread(srd(sap::kSlaveDiag));
  capture.answer(diagnosis(0x02, 0x01));
  capture.exchange(with_fcv(set_prm(kLock, 0, 60)), bus::make_sc(), 60);
}

void unread_prm(MadeCapture& capture) {
  capture.request_unread(set_prm(kLock, 0, 60));
  capture.answer(bus::make_sc(), 60);
}

TEST(CalibrateTsdr, ASetPrmAfterARequestThatWasNotReadCounts) {
  const calibrate::Result right = coarse_start(prm_after_unread_diagnosis, {60, 60});
  EXPECT_EQ(contradicted(right), "");
  EXPECT_EQ(claim(right, "S11", "min_TSDR").verdict, Verdict::kConfirmed);
  const calibrate::Result wrong = coarse_start(prm_after_unread_diagnosis, {60, 11});
  EXPECT_EQ(claim(wrong, "S11", "min_TSDR").verdict, Verdict::kContradicted);
}

TEST(CalibrateTsdr, AfterASetPrmThatWasNotReadItIsThatOfTheNextAnswer) {
  const calibrate::Result right = coarse_start(unread_prm, {60, 60});
  EXPECT_EQ(contradicted(right), "");
  EXPECT_GE(claim(right, "S3", "min_TSDR").tally.holds, 4U);
  const calibrate::Result wrong = coarse_start(unread_prm, {60, 70});
  EXPECT_EQ(claim(wrong, "S3", "min_TSDR").verdict, Verdict::kContradicted);
}

TEST(CalibrateTsdr, AfterASetPrmThatWasNotReadOneWrongAnswerIsToldAtTheNextOne) {
  MadeCapture capture(k12M);
  for (int i = 0; i < 3; ++i) capture.exchange(data_exchange({1}), data_answer({2}), 60);
  unread_prm(capture);
  capture.exchange(data_exchange({1}), data_answer({2}), 70);
  EXPECT_EQ(contradicted(capture.judge_sampled(kCoarse)), "") << "70 may be the new one";
  capture.exchange(data_exchange({1}), data_answer({2}), 60);
  EXPECT_EQ(claim(capture.judge_sampled(kCoarse), "S3", "min_TSDR").tally.fails, 1U);
}

TEST(CalibrateTsdr, WithoutBrAnInitialisationShowsInWhatIsNoDataExchange) {
  MadeCapture capture(k1M5);
  for (int i = 0; i < 3; ++i) capture.exchange(data_exchange({1}), data_answer({2}), 15);
  capture.exchange(srd(sap::kSlaveDiag), diagnosis(0x02, 0x01), 11);
  EXPECT_EQ(contradicted(capture.judge()), "");
}

}  // namespace
}  // namespace dsdpv1::calibrate_test
