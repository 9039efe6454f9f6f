// P5, P6, D1, D2, H5: captures of the host port.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/kinds/dsdpv1/claims/made_pins.hpp"

namespace dsdpv1::calibrate_test {
namespace {

using testing::IsEmpty;

/// The chip accesses the DPRAM every 48 cycles until 388; the user holds it from 410 to 2000.
class MadeHold : public MadePins {
 public:
  explicit MadeHold(bool request = true) {
    show({wire::kLReq, wire::kLSta, wire::kRReq, wire::kRSta});
    show_host_port();
    accesses(100, 400);
    if (request) high(wire::kRReq, 410, 2'000);
    high(wire::kRSta, 418, 2'000);
  }
};

TEST(CalibrateUserAccess, BeginsWithTheLaterOfTheStrobesAndEndsWithTheEarlier) {
  MadeHold made;
  made.number(500, wire::kA, calibrate::kAddressWires, 0x000);
  made.set(500, wire::kRd, false);
  made.set(600, wire::kCsr, false);
  made.number(601.5, wire::kD, calibrate::kDataWires, 0x01);
  made.set(606, wire::kCsr, true);
  made.number(606, wire::kD, calibrate::kDataWires, 0xFF);  // released: the bus floats up
  made.set(700, wire::kRd, true);
  const calibrate::Result result = made.judged(3'000);
  EXPECT_THAT(contradicted(result), IsEmpty());
  EXPECT_EQ(result.found.user_accesses, 1U);
  EXPECT_EQ(claim(result, "P5", "").tally.holds, 1U);
  EXPECT_EQ(claim(result, "D1", "").tally.holds, 1U);
}

TEST(CalibrateUserAccess, IsOneForEachTimeThatCsrFallsWhileRdIsLow) {
  MadeHold made;
  made.set(500, wire::kRd, false);
  for (unsigned address = 0; address < 4; ++address) {
    constexpr std::array<unsigned, 4> kVersion = {0x01, 0x0D, 0x07, 0x01};
    made.number(599 + 20 * address, wire::kA, calibrate::kAddressWires, address);
    made.number(602 + 20 * address, wire::kD, calibrate::kDataWires, kVersion.at(address));
    made.low(wire::kCsr, 600 + 20 * address, 610 + 20 * address);
  }
  made.set(800, wire::kRd, true);
  EXPECT_EQ(claim(made.judged(3'000), "D1", "").tally.holds, 4U);
}

TEST(CalibrateUserAccess, WritesNothingWhereCsrRisesBeforeWr) {
  MadeHold made;
  made.write(500, 0x130, 0x11);
  made.number(599, wire::kA, calibrate::kAddressWires, 0x130);
  made.number(599, wire::kD, calibrate::kDataWires, 0x22);
  made.set(600, wire::kWr, false);
  made.low(wire::kCsr, 600, 605);
  made.set(606, wire::kWr, true);
  made.read(700, 0x130, 0x11);
  EXPECT_THAT(contradicted(made.judged(3'000)), IsEmpty());
}

TEST(CalibrateRead, ThatBringsSomethingElseIsContradicted) {
  MadeHold made;
  made.write(500, 0x130, 0x11);
  made.read(600, 0x130, 0x12);
  made.read(620, 0x001, 0x55);
  const calibrate::Result result = made.judged(3'000);
  EXPECT_EQ(claim(result, "P6", "").tally.fails, 1U);
  EXPECT_EQ(claim(result, "D1", "").tally.fails, 1U);
}

TEST(CalibrateRead, OfACellThatIsJustWrittenIsNotJudged) {
  MadeHold made;
  made.write(500, 0x130, 0x11);   // WR rises at 506
  made.read(508.9, 0x130, 0x00);  // P8: it may be sampled by the third edge after that
  EXPECT_THAT(contradicted(made.judged(3'000)), IsEmpty());
  MadeHold later;
  later.write(500, 0x130, 0x11);
  later.read(509.1, 0x130, 0x00);
  EXPECT_EQ(claim(later.judged(3'000), "P6", "").tally.fails, 1U);
}

TEST(CalibrateRead, WithoutTheDpramIsNotJudged) {
  MadeHold without(false);
  without.read(500, 0x001, 0x55);
  EXPECT_THAT(contradicted(without.judged(3'000)), IsEmpty()) << "R_REQ is low";
  MadeHold too_long;
  too_long.read(2'010, 0x001, 0x55);
  EXPECT_THAT(contradicted(too_long.judged(3'000)), IsEmpty()) << "both are low";
  MadeHold collision;
  collision.access(500, 7);
  collision.read(501, 0x001, 0x55);
  const calibrate::Result result = collision.judged(3'000);
  EXPECT_EQ(claim(result, "D1", "").tally.fails, 0U) << "P12: X, the chip has it";
}

TEST(CalibrateRead, InResetAndBeforeTheStartUpIsNotJudged) {
  MadeHold made;
  made.show({wire::kReset}, true);
  made.low(wire::kReset, 500, 700);
  made.read(600, 0x001, 0xFF);  // P10: D is released
  made.read(702, 0x001, 0xFF);  // before R
  made.read(800, 0x001, 0x55);  // P12: held off, the start-up has not been
  made.access(2'002.5, 2'054);
  made.high(wire::kRReq, 4'070, 5'000);
  made.high(wire::kRSta, 4'080, 5'000);
  made.read(4'100, 0x001, 0x0D);
  const calibrate::Result result = made.judged(6'000);
  EXPECT_EQ(claim(result, "D1", "").tally.fails, 0U);
  EXPECT_EQ(claim(result, "D1", "").tally.holds, 1U);
}

TEST(CalibrateRead, InAResetThatNoPinShowsIsNotJudged) {
  const auto judged = [](const std::vector<Wire>& pins) {
    MadePins made;
    made.show_host_port();
    made.show(pins, true);
    made.read(500, 0x001, 0xFF);
    return claim(made.judged(3'000), "D1", "").verdict;
  };
  EXPECT_EQ(judged({}), Verdict::kNotShown);
  for (const Wire wire : {wire::kReset, wire::kReady, wire::kBr})
    EXPECT_EQ(judged({wire}), Verdict::kContradicted) << calibrate::name_of(wire);
}

TEST(CalibrateRead, OfACellThatTheUserHasEverWrittenShowsNoVersion) {
  MadeHold made;
  made.write(500, 0x001, 0x00);
  made.accesses(2'003, 2'100);
  made.high(wire::kRReq, 2'110, 3'000);
  made.high(wire::kRSta, 2'120, 3'000);
  made.read(2'200, 0x001, 0x00);
  EXPECT_THAT(contradicted(made.judged(4'000)), IsEmpty());
}

TEST(CalibrateRead, OfABlockThatWasNeverWrittenShowsNoCrc) {
  MadeHold made;
  made.read(500, 0x319, 0x00);
  made.read(520, 0x40E, 0x00);
  made.read(540, 0x40F, 0x00);
  EXPECT_THAT(contradicted(made.judged(3'000)), IsEmpty());
}

TEST(CalibrateRead, OfABlockShowsItsCrc) {
  for (const unsigned low : {0x41U, 0x42U}) {
    MadeHold made;
    made.read(500, 0x319, 0x01);
    made.read(520, 0x31A, 0x07);
    made.read(540, 0x40E, 0xE2);
    made.read(560, 0x40F, low);
    const calibrate::Result result = made.judged(3'000);
    EXPECT_EQ(claim(result, "D2", "").verdict, low == 0x41 ? Verdict::kConfirmed : Verdict::kContradicted);
    EXPECT_EQ(claim(result, "D3", "").tally.holds + claim(result, "D3", "").tally.fails, 0U) << "one claim, under D2";
  }
}

TEST(CalibrateRead, ThatIsTooShortForTheSamplesIsNotJudged) {
  MadeHold made;
  for (int at = 500; at < 1'900; at += 7) made.user(at, false, 0x001, 0x0D, 3);
  const calibrate::Result result = made.sampled(3'000, 24e6);
  EXPECT_THAT(contradicted(result), IsEmpty());
  EXPECT_EQ(claim(result, "D1", "").words, "the samples are too far apart");
  MadeHold longer;
  for (int at = 500; at < 1'900; at += 27) longer.user(at, false, 0x001, 0x0D, 10);
  EXPECT_EQ(claim(longer.sampled(3'000, 24e6), "D1", "").verdict, Verdict::kConfirmed);
}

TEST(CalibrateWrite, ThatMayLieBetweenTwoSamplesLeavesCellsUnknown) {
  MadeHold made;
  made.user(500, true, 0x130, 0x11, 10);
  made.user(602.5, true, 0x130, 0x22, 1);  // 20.8 ns
  made.user(702.2, true, 0x131, 0x33, 3);
  made.user(800, false, 0x130, 0x22, 10);
  EXPECT_THAT(contradicted(made.sampled(3'000, 24e6)), IsEmpty());
}

TEST(CalibrateWrite, WhoseDataChangeWithinASampleOfItsEndIsNotKnown) {
  for (const bool before : {true, false}) {  // 25 ns before WR rises, or 17 ns after it: the same sample
    MadeHold made;
    made.number(599, wire::kA, calibrate::kAddressWires, 0x130);
    made.number(599, wire::kD, calibrate::kDataWires, 0x11);
    made.low(wire::kCsr, 600, 614);
    made.low(wire::kWr, 600.3, before ? 611.7 : 610.2);
    made.number(before ? 610.5 : 611.0, wire::kD, calibrate::kDataWires, 0x22);
    made.user(800, false, 0x130, before ? 0x22 : 0x11, 10);
    EXPECT_THAT(contradicted(made.sampled(3'000, 24e6)), IsEmpty()) << before;
  }
}

/// Outputs of one byte with a wrong CRC.
void read_wrong_outputs(MadeHold& made, int at) {
  made.read(at, 0x319, 0x01);
  made.read(at + 20, 0x31A, 0x07);
  made.read(at + 40, 0x40E, 0xAA);
  made.read(at + 60, 0x40F, 0xAA);
}

/// The chip has the DPRAM, then again the user: from `at` + 120 to `at` + 1'000.
void hold_again(MadeHold& made, int at) {
  made.accesses(at + 3, at + 100);
  made.high(wire::kRReq, at + 110, at + 1'000);
  made.high(wire::kRSta, at + 120, at + 1'000);
}

TEST(CalibrateRead, OfABlockThatTheUserHasWrittenShowsNoCrc) {
  for (const unsigned written : {0x319U, 0x31AU, 0x40FU}) {
    MadeHold made;
    made.write(500, written, 0xAA);
    hold_again(made, 2'000);
    read_wrong_outputs(made, 2'200);
    EXPECT_THAT(contradicted(made.judged(4'000)), IsEmpty()) << written;
  }
}

TEST(CalibrateRead, OfABlockThatTheChipHasWrittenSinceShowsItsCrc) {
  for (const unsigned news : {0x00U, 0x01U, 0x02U}) {
    MadeHold made;  // clears the RAM and with it B00E, or only the block
    made.write(500, 0x00E, 0x00);
    made.write(520, 0x31A, 0x00);
    hold_again(made, 2'000);
    made.read(2'180, 0x00E, news);
    read_wrong_outputs(made, 2'200);
    EXPECT_EQ(claim(made.judged(4'000), "D2", "").tally.fails, news == 0x01 ? 1U : 0U) << news;
  }
  MadeHold unread;  // the bit was already set
  unread.write(500, 0x00E, 0x01);
  unread.write(520, 0x31A, 0x00);
  hold_again(unread, 2'000);
  unread.read(2'180, 0x00E, 0x01);
  read_wrong_outputs(unread, 2'200);
  EXPECT_THAT(contradicted(unread.judged(4'000)), IsEmpty());
}

TEST(CalibrateRead, AfterAStartUpIsOfTheChipAgain) {
  MadeHold made;
  made.show({wire::kReset}, true);
  made.write(500, 0x001, 0x00);
  made.low(wire::kReset, 2'500, 2'600);
  made.access(2'602.5, 2'054);
  hold_again(made, 5'000);
  made.read(5'200, 0x001, 0x00);
  EXPECT_EQ(claim(made.judged(7'000), "D1", "").tally.fails, 1U);
}

TEST(CalibrateRead, OfB004AsNotValidAfterItWasIsAgainstD1) {
  for (const bool reset : {true, false}) {
    MadeHold made;
    made.read(500, 0x004, 0xC5);
    if (reset) made.access(2'602.5, 2'054);
    hold_again(made, 5'000);
    made.read(5'200, 0x004, 0x00);
    EXPECT_EQ(claim(made.judged(7'000), "D1", "").tally.fails, reset ? 0U : 1U) << reset;
  }
}

TEST(CalibrateFlags, ThatAreReservedStayAsTheUserSetThem) {
  for (const unsigned read : {0x38U, 0x39U}) {
    MadeHold made;
    made.write(500, 0x010, 0x3F);
    made.accesses(2'003, 2'100);
    made.high(wire::kRReq, 2'110, 3'000);
    made.high(wire::kRSta, 2'120, 3'000);
    made.read(2'200, 0x010, read);
    EXPECT_EQ(claim(made.judged(4'000), "H5", "").verdict, read == 0x38 ? Verdict::kConfirmed : Verdict::kContradicted);
  }
}

}  // namespace
}  // namespace dsdpv1::calibrate_test
