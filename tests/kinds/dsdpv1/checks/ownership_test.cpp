// The DPRAM's ownership and access rights (5.1, H1, H2), pin by pin: cases not covered by the limits of
// values_test.cpp.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/kinds/dsdpv1/checks/board.hpp"
#include "tests/kinds/dsdpv1/checks/telegrams.hpp"

namespace dsdpv1 {
namespace {

using checks::Check;
using checks_test::Board;
using checks_test::Tick;

std::uint64_t violations(Board& board, Check check) { return board.checks().record(check).violations; }

void hold_released_by(Board& board, Pin first, Tick delay, Pin second) {
  board.ask();
  board.count();
  board.set(first, 0);
  board.wait(delay);
  board.set(second, 0);
  board.wait(5000);
}

TEST(Release, IsFineInEitherOrderWithAnyDelay) {
  for (const Tick delay : {0, 1, 100, 1'000'000}) {
    Board board;
    hold_released_by(board, Pin::kRSta, delay, Pin::kRReq);
    hold_released_by(board, Pin::kRReq, delay, Pin::kRSta);
    board.checks().finish(board.now());
    EXPECT_TRUE(board.violations.empty()) << delay << ": " << board.violations.front().text;
    EXPECT_EQ(board.checks().record(Check::kCountByUser).count, 2U);
    EXPECT_EQ(board.checks().record(Check::kNeverReleased).count, 2U);
  }
}

TEST(Release, FirstOfTheTwoEndsTheRightToAccessAndTheSecondTheHold) {
  for (const bool r_req_first : {false, true}) {
    Board board;
    board.ask();
    board.set(r_req_first ? Pin::kRReq : Pin::kRSta, 0);
    board.wait(100);
    board.count();
    board.set(r_req_first ? Pin::kRSta : Pin::kRReq, 0);
    board.wait(5000);
    board.checks().finish(board.now());
    EXPECT_EQ(violations(board, Check::kNotOwner), 2U);
    EXPECT_EQ(board.violations.size(), 2U) << "B006 was counted before the chip could come";
  }
}

TEST(Release, RStaThatRisesAgainBeforeRReqFallsIsTheSameHold) {
  Board board;
  board.ask();
  board.count();
  board.set(Pin::kRSta, 0);
  board.wait(100);
  board.set(Pin::kRSta, 1);
  board.read(0x014, 0);
  board.release();
  board.checks().finish(board.now());
  EXPECT_TRUE(board.violations.empty()) << board.violations.front().text;
  EXPECT_EQ(board.checks().record(Check::kCountByUser).count, 1U);
}

TEST(NoRequest, RStaThatRisesAsRReqFallsIsAloneWhicheverIsToldFirst) {
  for (const bool r_sta_first : {false, true}) {
    Board board;
    board.set(Pin::kRReq, 1);
    board.wait(2040);
    board.set(r_sta_first ? Pin::kRSta : Pin::kRReq, r_sta_first ? 1 : 0);
    board.set(r_sta_first ? Pin::kRReq : Pin::kRSta, r_sta_first ? 0 : 1);
    board.wait(700);
    board.set(Pin::kRSta, 0);
    EXPECT_EQ(violations(board, Check::kNoRequest), 1U);
    EXPECT_EQ(board.checks().record(Check::kNoRequest).worst_margin, -700);
  }
}

TEST(NoRequest, OneThatLastsToTheEndIsJudgedThere) {
  Board board;
  board.set(Pin::kRSta, 1);
  board.wait(11 * bus::kTicksPerMs);
  board.checks().finish(board.now());
  EXPECT_EQ(violations(board, Check::kNoRequest), 1U);
  EXPECT_EQ(violations(board, Check::kNeverReleased), 1U) << "R_STA alone holds the chip off, too";
}

TEST(NoRequest, RStaBeforeRReqIsOneMistakeAndInTheSameTickTheWindow) {
  for (const Tick earlier : {0, 1}) {
    Board board;
    board.set(Pin::kRSta, 1);
    board.wait(earlier);
    board.set(Pin::kRReq, 1);
    EXPECT_EQ(violations(board, Check::kNoRequest), earlier == 0 ? 0U : 1U);
    EXPECT_EQ(violations(board, Check::kSyncWindow), earlier == 0 ? 1U : 0U);
  }
}

TEST(BothOwn, MarginCountsFromTheRequestWhenTheChipHadGoneBefore) {
  Board board;
  board.chip_owns(true);
  board.wait(300);
  board.chip_owns(false);
  board.wait(50'000);
  board.ask(2040);
  EXPECT_EQ(board.checks().record(Check::kBothOwn).worst_value, 2040);
}

TEST(SyncWindow, BothLowForNoTimeIsNoNewRequest) {
  Board board;
  board.ask();
  board.set(Pin::kRSta, 0);
  board.set(Pin::kRReq, 0);
  board.set(Pin::kRReq, 1);
  board.wait(100);
  board.set(Pin::kRSta, 1);
  EXPECT_EQ(board.checks().record(Check::kSyncWindow).count, 2U);
  EXPECT_EQ(violations(board, Check::kSyncWindow), 0U);
}

void look_at_both(Board& board) {
  board.look(Pin::kLReq);
  board.look(Pin::kLSta);
}

void ask_and_look(Board& board) {
  board.set(Pin::kRReq, 1);
  board.wait(1200);
  look_at_both(board);
}

/// A right hold by a user who tells his looks.
void hold_with_looks(Board& board) {
  board.checks().hears_looks();
  ask_and_look(board);
  board.wait(840);
  board.set(Pin::kRSta, 1);
  board.wait(500);
  board.count();
  board.release();
}

TEST(LookInWindow, RStaWithoutALookSinceTheRequestIsAViolation) {
  Board board;
  hold_with_looks(board);
  board.ask();
  ASSERT_EQ(board.violations.size(), 1U);
  EXPECT_EQ(board.violations[0].text, "0.000 ns of at least 62.500 ns, no look at L_REQ and L_STA");
  EXPECT_FALSE(board.violations[0].act.look) << "the line is that of R_STA";
  EXPECT_EQ(board.violations[0].act.at, board.now() - 500);
  EXPECT_EQ(board.checks().record(Check::kLookInWindow).count, 2U);
}

TEST(LookInWindow, OnePinIsNotEnough) {
  for (const Pin pin : {Pin::kLReq, Pin::kLSta}) {
    Board board;
    hold_with_looks(board);
    board.set(Pin::kRReq, 1);
    board.wait(1200);
    board.look(pin);
    board.set(Pin::kRSta, 1);
    ASSERT_EQ(board.violations.size(), 1U);
    EXPECT_EQ(board.violations[0].text.substr(board.violations[0].text.rfind(' ')),
              pin == Pin::kLReq ? " L_STA" : " L_REQ");
  }
}

TEST(LookInWindow, LookThatFoundTheChipAtWorkIsNone) {
  for (const bool looks_again : {true, false}) {
    Board board;
    hold_with_looks(board);
    board.set(Pin::kRReq, 1);
    board.wait(10);
    board.chip_owns(true);
    board.wait(1200);
    look_at_both(board);
    board.wait(10);
    board.chip_owns(false);
    if (looks_again) look_at_both(board);
    board.set(Pin::kRSta, 1);
    EXPECT_EQ(violations(board, Check::kLookInWindow), looks_again ? 0U : 1U);
    if (!looks_again)
      EXPECT_EQ(board.violations.at(0).text,
                "0.000 ns of at least 62.500 ns, no look at L_REQ and L_STA since they fell");
  }
}

TEST(LookInWindow, LastLookCountsNotTheFirst) {
  Board board;
  hold_with_looks(board);
  board.set(Pin::kRReq, 1);
  board.wait(100);
  look_at_both(board);
  const Tick early = board.now();
  board.wait(2000);
  board.look(Pin::kLReq);
  board.set(Pin::kRSta, 1);
  ASSERT_EQ(board.violations.size(), 1U);
  EXPECT_EQ(board.violations[0].text, "8.333 ns of at least 62.500 ns, the last look at L_STA");
  EXPECT_TRUE(board.violations[0].act.look);
  EXPECT_EQ(board.violations[0].act.at, early);
  board.release();
  board.set(Pin::kRReq, 1);
  look_at_both(board);
  board.wait(2000);
  look_at_both(board);
  board.set(Pin::kRSta, 1);
  EXPECT_EQ(violations(board, Check::kLookInWindow), 1U);
}

TEST(LookInWindow, UserWhoGivesUpLooksAgainInHisNextRequest) {
  for (const bool looks : {true, false}) {
    Board board;
    hold_with_looks(board);
    ask_and_look(board);
    board.set(Pin::kRReq, 0);
    board.wait(100);
    board.set(Pin::kRReq, 1);
    board.wait(1200);
    if (looks) look_at_both(board);
    board.set(Pin::kRSta, 1);
    EXPECT_EQ(violations(board, Check::kLookInWindow), looks ? 0U : 1U);
  }
}

TEST(LookInWindow, RequestThatNeverEndedNeedsNoOtherLook) {
  Board board;
  hold_with_looks(board);
  ask_and_look(board);
  board.set(Pin::kRSta, 1);
  board.wait(500);
  board.set(Pin::kRReq, 0);
  board.wait(100);
  board.set(Pin::kRReq, 1);  // takes the release back
  board.set(Pin::kRSta, 0);
  board.wait(2000);
  board.set(Pin::kRSta, 1);
  board.set(Pin::kRSta, 0);
  board.set(Pin::kRReq, 0);
  board.set(Pin::kRReq, 1);  // both low for no time
  board.wait(100);
  board.set(Pin::kRSta, 1);
  EXPECT_TRUE(board.violations.empty()) << board.violations.front().text;
  EXPECT_EQ(board.checks().record(Check::kLookInWindow).count, 4U);
}

TEST(LookInWindow, RStaInTheWindowIsNotJudgedTwice) {
  for (const bool judged : {true, false}) {
    checks::Limits limits(checks::rules());
    limits[Check::kSyncWindow].on = judged;
    Board board(limits);
    board.checks().hears_looks();
    board.ask(749);
    EXPECT_EQ(violations(board, Check::kSyncWindow), judged ? 1U : 0U);
    EXPECT_EQ(violations(board, Check::kLookInWindow), judged ? 0U : 1U);
  }
}

TEST(LookInWindow, RStaBeforeRReqIsAnotherMistake) {
  Board board;
  board.checks().hears_looks();
  board.set(Pin::kRSta, 1);
  board.wait(2000);
  board.set(Pin::kRReq, 1);
  ASSERT_EQ(board.violations.size(), 1U);
  EXPECT_EQ(board.violations[0].check, Check::kNoRequest);
}

TEST(LookInWindow, OfAUserWhoDoesNotTellNothingIsJudged) {
  Board board;
  EXPECT_FALSE(board.checks().applies(Check::kLookInWindow));
  board.ask();
  EXPECT_EQ(board.checks().record(Check::kLookInWindow).count, 0U);
  board.checks().hears_looks();
  EXPECT_TRUE(board.checks().applies(Check::kLookInWindow));
}

TEST(LookInWindow, SerialPortsHaveNoSuchPins) {
  for (Level mode = 0; mode <= 3; ++mode) {
    checks::SerialSettings settings;
    settings.mode = mode;
    checks::Checks checks(checks::Limits(checks::rules(Part::kRsu)), Part::kRsu, settings);
    checks.hears_looks();
    EXPECT_EQ(checks.applies(Check::kLookInWindow), mode == 0 || mode == 3);
  }
}

TEST(Reset, RequestThroughItHoldsTheChipOffFromItsEndOn) {
  Board board;
  board.ask();
  board.wait(9 * bus::kTicksPerMs);
  board.set(Pin::kReset, 0);
  board.wait(2 * bus::kTicksPerMs);
  board.set(Pin::kReset, 1);
  board.wait(9 * bus::kTicksPerMs);
  board.release();
  EXPECT_EQ(board.checks().record(Check::kNeverReleased).worst_value, 9 * bus::kTicksPerMs + 100);
  EXPECT_TRUE(board.violations.empty()) << board.violations.front().text;
}

TEST(Reset, WhatTheUserDoesMeanwhileIsNotJudged) {
  Board board;
  board.set(Pin::kReset, 0);
  board.set(Pin::kRSta, 1);
  board.wait(100);
  board.set(Pin::kRReq, 1);
  board.wait(100);
  board.set(Pin::kRSta, 0);
  board.wait(10);
  board.set(Pin::kRSta, 1);
  board.set(Pin::kReset, 1);
  board.checks().finish(board.now());
  EXPECT_TRUE(board.violations.empty()) << board.violations.front().text;
}

TEST(HoldInterval, HoldOverThreeTelegramsLosesOutputsTwice) {
  Board board;
  const checks_test::Exchanges exchanges(board, 5);
  exchanges.answered(board);
  const Tick start = exchanges.request(board);
  board.wait(200'000);
  board.set(Pin::kRReq, 1);
  for (const Tick at : {300'000, 600'000, 900'000}) exchanges.request_ending_at(board, start + at);
  board.wait(100'000);
  board.set(Pin::kRReq, 0);
  exchanges.request_ending_at(board, start + 1'200'000);
  board.wait(2000);
  board.checks().finish(board.now());
  const checks::Record& record = board.checks().record(Check::kHoldInterval);
  EXPECT_EQ(record.count, 4U);
  EXPECT_EQ(record.violations, 2U);
  EXPECT_EQ(record.worst_value, 0) << "the chip was held off all the time, not longer";
}

}  // namespace
}  // namespace dsdpv1
