// Every check that measures a time: kept at its limit, violated one tick beyond, without other findings. The pins are
// driven directly, because the native user CPU cannot violate most of these rules by a tick, and some of them not at
// all.
#include <gtest/gtest.h>

#include <algorithm>
#include <ostream>

#include "tests/kinds/dsdpv1/checks/board.hpp"
#include "tests/kinds/dsdpv1/checks/telegrams.hpp"

namespace dsdpv1 {
namespace {

using checks::Check;
using checks_test::Board;
using checks_test::Tick;
using checks_test::Timing;

/// Performs the case of the check with a margin of `margin` ticks to the default limit, or to that in `limits`.
struct Case {
  const char* name;
  Check check;
  void (*act)(Board& board, Tick margin);
  Tick limit = checks::kNoLimit;  ///< other than the default
};

void both_own(Board& board, Tick margin) {
  board.set(Pin::kRReq, 1);
  board.wait(250);
  board.chip_owns(true);
  board.wait(2000);
  if (margin >= 0) board.chip_owns(false);
  board.set(Pin::kRSta, 1);
  board.wait(-std::min<Tick>(margin, 0));
  board.chip_owns(false);
  board.wait(500);
  board.release();
}

void no_request(Board& board, Tick margin) {
  board.set(margin < 0 ? Pin::kRSta : Pin::kRReq, 1);
  board.wait(margin < 0 ? -margin : margin);
  board.set(margin < 0 ? Pin::kRReq : Pin::kRSta, 1);
  board.wait(500);
  board.release();
}

void sync_window(Board& board, Tick margin) {
  board.ask(750 + margin);
  board.release();
}

/// Both were low for a tick: the chip may have seen it.
void sync_window_of_a_new_request(Board& board, Tick margin) {
  board.set(Pin::kRReq, 1);
  board.wait(2040);
  board.set(Pin::kRReq, 0);
  board.wait(1);
  sync_window(board, margin);
}

/// Both were never low: changes of R_REQ while R_STA was high do not count.
void sync_window_of_a_renewed_request(Board& board, Tick margin) {
  board.ask(751);
  board.set(Pin::kRReq, 0);
  board.wait(10);
  board.set(Pin::kRReq, 1);
  board.wait(10);
  board.set(Pin::kRSta, 0);
  board.wait(10);
  board.set(Pin::kRSta, 1);
  board.release();
  sync_window(board, margin);
}

/// The other pin is looked at in time.
void look_in_window(Board& board, Tick margin, Pin first, Pin second) {
  board.checks().hears_looks();
  board.set(Pin::kRReq, 1);
  board.wait(100);
  board.look(first);
  board.wait(650 + margin);
  board.look(first);
  board.wait(200);
  board.look(second);
  board.set(Pin::kRSta, 1);
  board.wait(500);
  board.release();
}

void look_at_l_req(Board& board, Tick margin) { look_in_window(board, margin, Pin::kLReq, Pin::kLSta); }
void look_at_l_sta(Board& board, Tick margin) { look_in_window(board, margin, Pin::kLSta, Pin::kLReq); }

void not_owner(Board& board, Tick margin) {
  board.set(Pin::kRReq, 1);
  board.wait(2040);
  if (margin >= 0) board.set(Pin::kRSta, 1);
  board.wait(std::max<Tick>(margin, 0));
  board.set(Pin::kA, 0x014);
  board.wait(1);
  board.set(Pin::kCsr, 0);
  board.set(Pin::kRd, 0);
  board.wait(-std::min<Tick>(margin, 0));
  board.set(Pin::kRSta, 1);
  board.wait(500);
  board.set(Pin::kRd, 1);
  board.set(Pin::kCsr, 1);
}

/// As `not_owner`; the address takes a tick, so that is the minimum margin of a kept one.
void not_owner_kept_by_a_tick(Board& board, Tick margin) { not_owner(board, margin < 0 ? margin : margin - 1); }

/// The first of the two to fall ends the right to access.
void released_in_access(Board& board, Tick margin, Pin first, Pin second) {
  board.ask();
  board.count();
  board.set(Pin::kA, 0x014);
  board.set(Pin::kCsr, 0);
  board.set(Pin::kRd, 0);
  board.wait(1000);
  if (margin >= 0) board.set(Pin::kRd, 1);
  board.wait(std::max<Tick>(margin, 0));
  board.set(first, 0);
  board.wait(-std::min<Tick>(margin, 0));
  board.set(Pin::kRd, 1);
  board.set(Pin::kCsr, 1);
  board.set(second, 0);
}

void r_sta_released_in_access(Board& board, Tick margin) { released_in_access(board, margin, Pin::kRSta, Pin::kRReq); }
void r_req_released_in_access(Board& board, Tick margin) { released_in_access(board, margin, Pin::kRReq, Pin::kRSta); }

/// The later of the two to fall lets the chip in.
void never_released(Board& board, Tick margin, Pin first, Pin second) {
  board.ask();
  board.set(first, 0);
  board.wait(10 * bus::kTicksPerMs - 2540 - margin);
  board.set(second, 0);
}

void r_req_never_released(Board& board, Tick margin) { never_released(board, margin, Pin::kRSta, Pin::kRReq); }
void r_sta_never_released(Board& board, Tick margin) { never_released(board, margin, Pin::kRReq, Pin::kRSta); }

/// A whole hold with one access of a timing.
void one_write(Board& board, const Timing& timing) {
  board.ask();
  board.count();
  board.write(0x014, 0x55, timing);
  board.release();
}

void one_read(Board& board, const Timing& timing) {
  board.ask();
  board.count();
  board.read(0x014, 0x55, timing);
  board.release();
}

void ts(Board& board, Tick margin) {
  Timing timing;
  timing.low = 150 + margin;
  one_write(board, timing);
}

void td_data(Board& board, Tick margin) {
  Timing timing;
  timing.data_setup = 150 + margin;
  one_write(board, timing);
}

void td_address(Board& board, Tick margin) {
  Timing timing;
  timing.address_setup = -450 + margin;
  one_write(board, timing);
}

void address_hold(Board& board, Tick margin) {
  Timing timing;
  timing.address_hold = 150 + margin;
  one_write(board, timing);
}

void data_hold(Board& board, Tick margin) {
  Timing timing;
  timing.data_hold = 150 + margin;
  one_write(board, timing);
}

void csr(Board& board, Tick margin) {
  Timing timing;
  timing.cs_trail = margin;
  one_write(board, timing);
}

void tc(Board& board, Tick margin) {
  Timing timing;
  timing.address_setup = margin;
  one_read(board, timing);
}

void tw(Board& board, Tick margin) {
  Timing timing;
  timing.low = 375 + margin;
  one_read(board, timing);
}

void tw_of_the_sample(Board& board, Tick margin) {
  Timing timing;
  timing.sample = 375 + margin;
  one_read(board, timing);
}

/// WR rises so that RD's sampling edge is a cycle after the edge at which the write settles, or at it.
void read_back(Board& board, Tick margin) {
  board.ask();
  board.count();
  const Tick edge = (board.now() / 250 + 8) * 250;  // the one that follows WR's rise
  board.wait(edge - 1 - 900 - board.now());
  board.write(0x014, 0x55);  // WR rises at edge - 1, the write settles at edge + 500
  board.wait(edge + 500 - 300 - board.now() + (margin < 0 ? -1 : 0));
  board.read(0x014, 0x55);
  board.release();
}

void intr0_service(Board& board, Tick margin) {
  board.set(Pin::kIntr0, 0);
  board.wait(100'000 - 300 - margin);
  board.read(0x410, 0);
}

void intr0_found_in_b00e(Board& board, Tick margin) {
  board.set(Pin::kIntr0, 0);
  board.wait(100'000 - 300 - margin);
  board.read(0x00E, 0x02);
}

constexpr Tick kBit = 1000;         // at 12 Mbit/s: so long after its end a telegram is executed
constexpr Tick kNeeded = 10 * 250;  // the chip's way from the release to its choice of the outputs

/// The chip is held off for 300 us of the interval from `start`, and before it.
void hold_interval(Board& board, Tick margin) {
  const checks_test::Exchanges exchanges(board, 5);
  exchanges.answered(board);
  board.set(Pin::kRReq, 1);
  board.wait(500'000);
  const Tick start = exchanges.request(board);
  board.wait(kBit + 300'000);
  board.set(Pin::kRReq, 0);
  exchanges.request_ending_at(board, start + 300'000 + kNeeded + margin);
  board.wait(kBit);
  board.checks().finish(board.now());
}

/// The hold begins in the interval, and R_STA ends it between the end of the second telegram and its execution.
void hold_interval_to_its_end(Board& board, Tick margin) {
  const checks_test::Exchanges exchanges(board, 5);
  exchanges.answered(board);
  const Tick start = exchanges.request(board);
  board.wait(kBit + 2000);
  board.ask();
  board.set(Pin::kRReq, 0);
  exchanges.request_ending_at(board, start + 300'000);
  board.wait(kBit + 2000 - kNeeded - margin);
  board.set(Pin::kRSta, 0);
  board.wait(5000);
  board.checks().finish(board.now());
}

constexpr Tick kIntr0Limit = 100'000;

const Case kCases[] = {
    {"BothOwn", Check::kBothOwn, both_own},
    {"NoRequest", Check::kNoRequest, no_request},
    {"SyncWindow", Check::kSyncWindow, sync_window},
    {"SyncWindowOfANewRequest", Check::kSyncWindow, sync_window_of_a_new_request},
    {"SyncWindowOfARenewedRequest", Check::kSyncWindow, sync_window_of_a_renewed_request},
    {"LookAtLReq", Check::kLookInWindow, look_at_l_req},
    {"LookAtLSta", Check::kLookInWindow, look_at_l_sta},
    {"RStaReleasedInAccess", Check::kReleasedInAccess, r_sta_released_in_access},
    {"RReqReleasedInAccess", Check::kReleasedInAccess, r_req_released_in_access},
    {"RReqNeverReleased", Check::kNeverReleased, r_req_never_released},
    {"RStaNeverReleased", Check::kNeverReleased, r_sta_never_released},
    {"Ts", Check::kTs, ts},
    {"TdOfD", Check::kTd, td_data},
    {"TdOfA", Check::kTd, td_address},
    {"AddressHold", Check::kAddressHold, address_hold},
    {"DataHold", Check::kDataHold, data_hold},
    {"Csr", Check::kCsr, csr},
    {"Tc", Check::kTc, tc},
    {"Tw", Check::kTw, tw},
    {"TwOfTheSample", Check::kTw, tw_of_the_sample},
    {"Intr0Service", Check::kIntr0Service, intr0_service, kIntr0Limit},
    {"Intr0FoundInB00E", Check::kIntr0Service, intr0_found_in_b00e, kIntr0Limit},
    {"HoldInterval", Check::kHoldInterval, hold_interval},
    {"HoldIntervalToItsEnd", Check::kHoldInterval, hold_interval_to_its_end},
};

void PrintTo(const Case& each, std::ostream* out) { *out << each.name; }

class EachValue : public testing::TestWithParam<Case> {
 protected:
  checks::Limits limits() const {
    checks::Limits limits(checks::rules());
    if (GetParam().limit != checks::kNoLimit) limits[GetParam().check].value = GetParam().limit;
    return limits;
  }
};

TEST_P(EachValue, IsKeptAtTheLimitWithMarginZero) {
  Board board(limits());
  GetParam().act(board, 0);
  const checks::Record& record = board.checks().record(GetParam().check);
  EXPECT_GE(record.count, 1U);
  EXPECT_EQ(record.worst_margin, 0) << *record.worst_value;
  for (const checks::Violation& each : board.violations)
    EXPECT_NE(each.check, GetParam().check) << checks::rule(each.check).id << ": " << each.text;
}

TEST_P(EachValue, IsViolatedOneTickBeyond) {
  Board board(limits());
  GetParam().act(board, -1);
  const checks::Record& record = board.checks().record(GetParam().check);
  EXPECT_EQ(record.violations, 1U);
  EXPECT_EQ(record.worst_margin, -1);
  EXPECT_EQ(record.histogram.count(0), 1U);
  ASSERT_FALSE(board.violations.empty());
  const auto own = std::find_if(board.violations.begin(), board.violations.end(),
                                [](const checks::Violation& each) { return each.check == GetParam().check; });
  ASSERT_NE(own, board.violations.end());
  EXPECT_EQ(own->at, record.at);
  EXPECT_EQ(own->margin, -1);
  EXPECT_FALSE(own->history.empty());
}

TEST_P(EachValue, CostsNothingWhenSwitchedOff) {
  checks::Limits off = limits();
  off[GetParam().check].on = false;
  Board board(off);
  GetParam().act(board, -1);
  EXPECT_EQ(board.checks().record(GetParam().check).count, 0U);
}

INSTANTIATE_TEST_SUITE_P(Checks, EachValue, testing::ValuesIn(kCases),
                         [](const auto& each) { return each.param.name; });

TEST(NotOwner, OwnershipBeginsNoLaterThanTheAccess) {
  Board kept;
  not_owner_kept_by_a_tick(kept, 1);
  EXPECT_EQ(kept.checks().record(Check::kNotOwner).worst_margin, 1);
  Board broken;
  not_owner(broken, -1);
  EXPECT_EQ(broken.checks().record(Check::kNotOwner).worst_margin, -1);
  EXPECT_EQ(broken.checks().record(Check::kNotOwner).violations, 1U);
}

TEST(NotOwner, AnAccessWithoutAnyRequestIsFound) {
  Board board;
  board.write(0x014, 0x55);
  EXPECT_EQ(board.checks().record(Check::kNotOwner).violations, 1U);
}

TEST(ReadBack, IsKeptACycleBehindTheSettlingEdgeAndViolatedAtIt) {
  Board kept;
  read_back(kept, 0);
  EXPECT_EQ(kept.checks().record(Check::kReadBack).worst_margin, 0);
  Board broken;
  read_back(broken, -1);
  EXPECT_EQ(broken.checks().record(Check::kReadBack).worst_margin, -250);
  EXPECT_EQ(broken.checks().record(Check::kReadBack).violations, 1U);
}

TEST(Tw, ASampleThatNobodyHasToldIsTheEndOfTheRead) {
  Board board;
  board.ask();
  board.read(0x014, 0);
  Timing late;
  late.sample = late.low + 100;  // D is released by then
  board.read(0x014, 0, late);
  EXPECT_EQ(board.checks().record(Check::kTw).worst_value, Timing{}.low);
  late.sample = 380;
  board.read(0x014, 0, late);
  board.read(0x014, 0);  // reported for one read, not for the next
  const checks::Record& record = board.checks().record(Check::kTw);
  EXPECT_EQ(record.worst_value, 380);
  EXPECT_EQ(record.count, 4U);
}

TEST(Ts, CountsFromTheFallOfWrThoughCsrFallsLater) {
  Board board;
  board.ask();
  board.set(Pin::kA, 0x014);
  board.set(Pin::kDIn, 0x55);
  board.wait(300);
  board.set(Pin::kWr, 0);
  board.wait(500);
  board.set(Pin::kCsr, 0);
  board.wait(100);
  board.set(Pin::kWr, 1);
  EXPECT_EQ(board.checks().record(Check::kTs).worst_value, 600);
  EXPECT_EQ(board.checks().record(Check::kTs).violations, 0U);
}

TEST(Td, NobodyDrivingDIsAViolation) {
  Board board;
  board.ask();
  board.count();
  board.set(Pin::kCsr, 0);
  board.set(Pin::kWr, 0);
  board.wait(600);
  board.set(Pin::kWr, 1);
  EXPECT_EQ(board.checks().record(Check::kTd).violations, 1U);
  EXPECT_EQ(board.violations.back().text, "0.000 ns of at least 12.500 ns, writing B7FF, nobody drives D");
}

TEST(Intr0Service, WithoutALimitItIsOnlyMeasured) {
  Board board;
  intr0_service(board, 0);
  const checks::Record& record = board.checks().record(Check::kIntr0Service);
  EXPECT_EQ(record.worst_value, 100'000);
  EXPECT_EQ(record.worst_margin, std::nullopt);
  EXPECT_EQ(record.violations, 0U);
}

TEST(Intr0Service, OneThatNobodyServesIsJudgedAtTheEnd) {
  checks::Limits limits(checks::rules());
  limits[Check::kIntr0Service].value = kIntr0Limit;
  Board board(limits);
  board.set(Pin::kIntr0, 0);
  board.wait(kIntr0Limit + 7);
  board.checks().finish(board.now());
  EXPECT_EQ(board.checks().record(Check::kIntr0Service).worst_margin, -7);
}

TEST(Intr0Service, SecondPulseForWhatTheFirstServiceTookAlongIsNotCounted) {
  Board board;
  board.set(Pin::kIntr0, 0);
  board.read(0x00E, 0x06);
  board.set(Pin::kIntr0, 1);
  board.set(Pin::kIntr0, 0);
  board.read(0x00E, 0x00);
  EXPECT_EQ(board.checks().record(Check::kIntr0Service).count, 1U);
}

TEST(NeverReleased, HoldThatLastsToTheEndIsJudgedThere) {
  Board board;
  board.ask();
  board.wait(11 * bus::kTicksPerMs);
  board.checks().finish(board.now());
  EXPECT_EQ(board.checks().record(Check::kNeverReleased).violations, 1U);
}

TEST(Reset, WhatItBreaksOffIsNotJudged) {
  Board board;
  board.ask();
  board.read(0x006, 1);  // not incremented
  board.set(Pin::kRReq, 0);
  board.set(Pin::kRSta, 0);
  board.set(Pin::kReset, 0);
  board.wait(1000);
  board.write(0x000, 0);  // the port is off
  board.set(Pin::kReset, 1);
  board.checks().finish(board.now());
  EXPECT_TRUE(board.violations.empty()) << board.violations.front().text;
}

/// The user CPU's pins go to rest at the tick at which RESET falls.
TEST(Reset, AWriteThatItCutsOffIsNotJudged) {
  Board board;
  board.ask();
  board.set(Pin::kA, 0x132);
  board.set(Pin::kCsr, 0);
  board.wait(300);
  board.set(Pin::kWr, 0);
  board.set(Pin::kDIn, 0x1C);
  board.wait(158);
  board.set(Pin::kReset, 0);
  for (const Pin pin : {Pin::kCsr, Pin::kWr}) board.set(pin, 1);
  board.set(Pin::kA, 0x7FF);
  board.set(Pin::kDIn, dsdpv1::kLevelZ);
  for (const Pin pin : {Pin::kRReq, Pin::kRSta}) board.set(pin, 0);
  board.wait(1000);
  board.set(Pin::kReset, 1);
  board.checks().finish(board.now());
  EXPECT_TRUE(board.violations.empty()) << board.violations.front().text;
}

TEST(History, NamesTheLastChangesOfThePinsInvolvedInOrder) {
  Board board;
  sync_window(board, -1);
  ASSERT_EQ(board.violations.size(), 1U);
  EXPECT_EQ(checks::history_text(board.violations[0]), "R_REQ=1 -62.417 ns, R_STA=1 0.000 ns");
}

TEST(Recorder, ValueAsBeforeIsJudgedByTheLimitNow) {
  const checks::PinHistory history(tb::pins_of({}));
  checks::Recorder recorder(checks::rules(), checks::Limits(checks::rules()), history);
  const auto measure = [&recorder](Tick value) {
    recorder.value(Check::kInputsRenewed, 0, value, [] { return std::string(); });
  };
  measure(1000);
  recorder.set_limit(Check::kInputsRenewed, 1500);
  measure(1000);
  EXPECT_EQ(recorder.record(Check::kInputsRenewed).worst_margin, 500);
  recorder.set_limit(Check::kInputsRenewed, 999);
  measure(1000);
  EXPECT_EQ(recorder.record(Check::kInputsRenewed).violations, 1U);
}

TEST(Histogram, BinsAre1And2And5OfEachDecadeFromOneNanosecond) {
  checks::Histogram histogram;
  for (const Tick ns : {-1, 0, 1, 2, 4, 5, 1'000'000'000}) histogram.add(ns * bus::kTicksPerNs);
  EXPECT_EQ(histogram.count(0), 1U);
  EXPECT_EQ(histogram.count(1), 1U);
  EXPECT_EQ(histogram.count(2), 1U);
  EXPECT_EQ(histogram.count(3), 2U);
  EXPECT_EQ(histogram.count(4), 1U);
  EXPECT_EQ(histogram.count(checks::Histogram::kBins - 1), 1U);
  EXPECT_EQ(checks::Histogram::from(4), 5 * bus::kTicksPerNs);
  EXPECT_EQ(checks::Histogram::from(checks::Histogram::kBins - 1), bus::kTicksPerSecond);
}

}  // namespace
}  // namespace dsdpv1
