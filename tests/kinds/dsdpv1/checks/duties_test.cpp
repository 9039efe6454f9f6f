// What the user owes: blocks served, verdicts given, outputs fetched and inputs renewed in time, by accesses at the
// pins, INTR0 and telegrams, to the tick.
#include <gtest/gtest.h>

#include "kinds/dsdpv1/checks/refusals.hpp"
#include "model/dpram/reasons.hpp"
#include "model/dsdpv1/reasons.hpp"
#include "tests/kinds/dsdpv1/checks/board.hpp"
#include "tests/kinds/dsdpv1/checks/telegrams.hpp"

namespace dsdpv1 {
namespace {

using bus::Tick;
using checks::Check;
using checks_test::Board;
using checks_test::Exchanges;

constexpr std::uint8_t kStation = 5;
constexpr Tick kLimit = 100 * bus::kTicksPerMs;

std::uint64_t violations(Board& board, Check check) { return board.checks().record(check).violations; }

/// A hold with the test's accesses, begun with B006 as the chip or the user left it; returns its end.
template <class Act>
Tick hold(Board& board, const Act& act, unsigned count = 1) {
  board.ask();
  board.count(count);
  act();
  board.release();
  return board.now() - 5000;  // as Board::release waits
}

Tick look(Board& board, unsigned flags) {
  return hold(
      board, [&board, flags] { board.read(0x00E, flags); });
}

Tick fetch(Board& board, unsigned flags, unsigned set, const checks_test::Cells& cells) {
  return hold(
      board, [&] { board.fetch(flags, set, cells); });
}
Tick fetch_parameters(Board& board) { return fetch(board, 0x00E, 0x02, checks_test::kEmptyParameters); }
Tick fetch_outputs(Board& board) {
  return fetch(board, 0x00E, 0x01, {{0x319, 0x01}, {0x31A, 0x11}, {0x40E, 0x12}, {0x40F, 0x34}});
}

/// In a hold, after the test's writes.
Tick set_flag(Board& board, unsigned cell, unsigned flag, const checks_test::Cells& before = {}) {
  return hold(
      board,
      [&] {
        for (const auto& [written, value] : before) board.write(written, value);
        board.read(cell, 0x00);
        board.write(cell, flag);
      });
}

/// An empty block with its CRC.
Tick hand_over_inputs(Board& board) {
  return set_flag(board, 0x010, 0x01, {{0x130, 0x00}, {0x225, 0x40}, {0x226, 0xBF}});
}

/// Of the length byte alone, which the chip would refuse (D12): only the modes matter.
/// `mode` is that of the parameters (B02B) or of the configuration (B02D).
void initialise(Board& board, unsigned mode, unsigned accepted, unsigned mode_of = 0x02B) {
  set_flag(board, 0x010, 0x04, {{mode_of, mode}, {0x0F7, 0x40}, {0x0F8, 0xBF}, {0x00A, 0x00}});
  hold(board, [&board, accepted] {
    board.read(0x010, 0x00);
    board.read(0x00A, accepted);
  });
}

Tick news(Board& board) {
  const Tick fell = board.now();
  board.set(Pin::kIntr0, 0);
  board.wait(16'000);
  board.set(Pin::kIntr0, 1);
  board.wait(16'000);
  return fell;
}

/// Ends the run so long after `since`.
void finish(Board& board, Tick since, Tick after) { board.checks().finish(since + after); }

// --- BLOCK_SERVED ----------------------------------------------------------------------------------------------------

TEST(BlockServed, CountsFromIntr0ToTheEndOfTheHoldThatClearsTheFlag) {
  Board board;
  const Tick fell = news(board);
  const Tick served = fetch_parameters(board);
  board.wait(2 * kLimit);
  look(board, 0x00);
  EXPECT_EQ(board.checks().record(Check::kBlockServed).worst_value, served - fell);
  EXPECT_EQ(board.checks().record(Check::kBlockServed).at, fell);
  EXPECT_EQ(violations(board, Check::kBlockServed), 0U);
}

TEST(BlockServed, IsViolatedOnceOnlyWhenTheRunLastsLongerThanTheLimit) {
  for (const Tick beyond : {Tick{0}, Tick{1}}) {
    Board board;
    finish(board, news(board), kLimit + beyond);
    EXPECT_EQ(violations(board, Check::kBlockServed), beyond == 0 ? 0U : 1U);
  }
  Board board;
  const Tick fell = news(board);
  board.wait(2 * kLimit);
  look(board, 0x02);
  look(board, 0x02);
  fetch_parameters(board);
  look(board, 0x00);
  EXPECT_EQ(violations(board, Check::kBlockServed), 2U) << "not looked, and the flag late";
  EXPECT_EQ(board.violations.front().at, fell);
}

TEST(BlockServed, HoldWithoutALookDoesNotEndIt) {
  Board board;
  const Tick fell = news(board);
  hold(board, [&board] { board.read(0x012, 0x0C); });
  finish(board, fell, 2 * kLimit);
  EXPECT_EQ(violations(board, Check::kBlockServed), 1U);
}

TEST(BlockServed, LookThatFindsNothingEndsIt) {
  Board board;
  const Tick fell = news(board);
  look(board, 0x00);
  finish(board, fell, 2 * kLimit);
  EXPECT_EQ(violations(board, Check::kBlockServed), 0U);
}

TEST(BlockServed, FlagThatIsSeenAndLeftIsFoundWithoutIntr0) {
  Board board;
  const Tick seen = hold(board, [&board] { board.read(0x00F, 0x02); });
  finish(board, seen, 2 * kLimit);
  EXPECT_EQ(violations(board, Check::kBlockServed), 1U);
  EXPECT_NE(board.violations.at(0).text.find("B00F.1, C2 request"), std::string::npos) << board.violations[0].text;
}

TEST(BlockServed, ResetAndInitialisationEndIt) {
  Board reset;
  news(reset);
  look(reset, 0x02);
  reset.set(Pin::kReset, 0);
  reset.wait(1000);
  reset.set(Pin::kReset, 1);
  finish(reset, reset.now(), 2 * kLimit);
  EXPECT_EQ(violations(reset, Check::kBlockServed), 0U);

  Board again;
  news(again);
  look(again, 0x02);
  initialise(again, 0, 1);
  finish(again, again.now(), 2 * kLimit);
  EXPECT_EQ(violations(again, Check::kBlockServed), 0U);
}

// --- VERDICT_GIVEN ---------------------------------------------------------------------------------------------------

TEST(VerdictGiven, CountsFromTheFetchToTheVerdict) {
  Board board;
  initialise(board, 2, 1);
  const Tick fetched = fetch_parameters(board);
  board.wait(50'000);
  const Tick given = hold(board, [&board] {
    board.read(0x00E, 0x00);
    board.read(0x010, 0x00);
    board.write(0x010, 0x80);
  });
  look(board, 0x00);
  EXPECT_EQ(board.checks().record(Check::kVerdictGiven).worst_value, given - fetched);
  finish(board, given, 2 * kLimit);
  EXPECT_EQ(violations(board, Check::kVerdictGiven), 0U);
}

TEST(VerdictGiven, IsMissedAfterTheLimitFromTheFirstOfSeveralFetches) {
  for (const Tick beyond : {Tick{0}, Tick{1}}) {
    Board board;
    initialise(board, 2, 1);
    const Tick first = fetch_parameters(board);
    board.wait(kLimit / 2);
    fetch_parameters(board);
    finish(board, first, kLimit + beyond);
    EXPECT_EQ(violations(board, Check::kVerdictGiven), beyond == 0 ? 0U : 1U);
  }
}

/// The user fetches a configuration, waits and gives a verdict; the time from the end of the fetch to that of the
/// verdict's hold.
Tick judge_configuration(Board& board, Tick wait, unsigned verdict) {
  initialise(board, 2, 1, 0x02D);
  const Tick fetched = fetch(board, 0x00E, 0x04, {{0x500, 0}, {0x501, 0}, {0x502, 0}, {0x5CB, 0xC0}, {0x5CC, 0x71}});
  board.wait(wait);
  const Tick given = hold(board, [&board, verdict] {
    board.read(0x010, 0x00);
    board.write(0x010, verdict);
  });
  finish(board, given, 2 * kLimit);
  return given - fetched;
}

TEST(VerdictGiven, OnAConfigurationIsB010Bit6AndMissedATickAfterTheLimit) {
  Board sooner;
  const Tick rest = judge_configuration(sooner, 0, 0x40);
  EXPECT_EQ(sooner.checks().record(Check::kVerdictGiven).worst_value, rest);
  struct Try {
    Tick beyond;
    unsigned verdict;
    std::uint64_t violations;
  };
  for (const Try& one : {Try{0, 0x40, 0}, Try{1, 0x40, 1}, Try{0, 0x80, 1}}) {
    Board board;
    ASSERT_EQ(judge_configuration(board, kLimit - rest + one.beyond, one.verdict), kLimit + one.beyond);
    EXPECT_EQ(violations(board, Check::kVerdictGiven), one.violations) << one.beyond << " " << one.verdict;
  }
}

TEST(VerdictGiven, IsOwedOnlyInTheModeThatTheChipHasAccepted) {
  struct Setup {
    unsigned mode, accepted;
    std::uint64_t violations;
  };
  for (const Setup& each : {Setup{0, 1, 0}, Setup{1, 1, 0}, Setup{2, 1, 1}, Setup{2, 0, 0}}) {
    Board board;
    initialise(board, each.mode, each.accepted);
    finish(board, fetch_parameters(board), 2 * kLimit);
    EXPECT_EQ(violations(board, Check::kVerdictGiven), each.violations) << each.mode << each.accepted;
  }
}

// --- OUTPUTS_FETCHED, INPUTS_RENEWED ---------------------------------------------------------------------------------

/// A board whose station has answered, so that its address is known.
struct Slave {
  Board board;
  Exchanges bus{board, kStation};

  Slave() { bus.answered(board); }
  explicit Slave(Tick most_overwritten) : board(with_most_overwritten(most_overwritten)) { bus.answered(board); }

  static checks::Limits with_most_overwritten(Tick most) {
    checks::Limits limits(checks::rules());
    limits[Check::kOutputsOverwritten].value = most;
    return limits;
  }
  /// So many Data_Exchange, one each millisecond; returns the execution of the first.
  Tick exchanges(int count) {
    Tick first = 0;
    for (int i = 0; i < count; ++i) {
      const Tick begun = board.now(), executed = bus.exchange(board);
      if (i == 0) first = executed;
      board.wait(begun + bus::kTicksPerMs - board.now());
    }
    return first;
  }
  void parameterise(const bus::Bytes& data) {
    bus.request(board, bus::make_telegram(kStation, 2, bus::fc::kRequest | bus::fc::kSrdHigh, data, bus::sap::kSetPrm,
                                          bus::sap::kMaster));
    board.wait(1000);
    bus.answered(board);
  }
};

TEST(OutputsFetched, CountsFromTheFirstUnfetchedDataExchange) {
  Slave slave;
  slave.exchanges(1);
  fetch_outputs(slave.board);
  const Tick first = slave.exchanges(3);
  const Tick fetched = fetch_outputs(slave.board);
  look(slave.board, 0x00);
  EXPECT_EQ(slave.board.checks().record(Check::kOutputsFetched).worst_value, fetched - first);
  EXPECT_EQ(violations(slave.board, Check::kOutputsFetched), 0U);
}

TEST(OutputsFetched, IsMissedATickAfterTheLimit) {
  const auto fetch_after = [](Slave& slave, Tick wait) {
    const Tick first = slave.exchanges(99);
    slave.bus.exchange(slave.board);
    slave.board.wait(wait);
    const Tick fetched = fetch_outputs(slave.board);
    look(slave.board, 0x00);
    return fetched - first;
  };
  Slave sooner;
  const Tick rest = fetch_after(sooner, 0);
  for (const Tick beyond : {Tick{0}, Tick{1}}) {
    Slave slave;
    ASSERT_EQ(fetch_after(slave, kLimit - rest + beyond), kLimit + beyond);
    EXPECT_EQ(violations(slave.board, Check::kOutputsFetched), beyond == 0 ? 0U : 1U);
  }
}

TEST(OutputsFetched, UserThatNeverLooksIsFoundAfterTheLimitWithTheNumberThatIsLost) {
  Slave slave;
  slave.exchanges(101);
  EXPECT_EQ(violations(slave.board, Check::kOutputsFetched), 0U);
  slave.exchanges(40);
  EXPECT_EQ(violations(slave.board, Check::kOutputsFetched), 1U);
  EXPECT_NE(slave.board.violations.at(0).text.find("101 newer"), std::string::npos) << slave.board.violations[0].text;
}

TEST(OutputsFetched, UserThatLooksAndLeavesThemIsFound) {
  Slave slave;
  for (int i = 0; i < 30; ++i) {
    slave.exchanges(5);
    look(slave.board, 0x01);
  }
  EXPECT_EQ(violations(slave.board, Check::kOutputsFetched), 1U);
}

TEST(OutputsFetched, LookThatFindsNothingEndsItAsInSyncMode) {
  Slave slave;
  for (int i = 0; i < 30; ++i) {
    slave.exchanges(5);
    look(slave.board, 0x00);
  }
  EXPECT_EQ(violations(slave.board, Check::kOutputsFetched), 0U);
}

TEST(OutputsFetched, BusThatFallsSilentEndsIt) {
  Slave slave;
  slave.exchanges(50);
  slave.board.wait(2 * kLimit);
  slave.exchanges(50);
  fetch_outputs(slave.board);
  look(slave.board, 0x00);
  finish(slave.board, slave.board.now(), 2 * kLimit);
  EXPECT_EQ(violations(slave.board, Check::kOutputsFetched), 0U);
}

TEST(OutputsFetched, LimitIsTheWatchdogOfTheSetPrmInForce) {
  Slave slave;
  slave.parameterise({0x88, 2, 1, 11, 0x12, 0x34, 0});  // 20 ms
  slave.exchanges(22);
  EXPECT_EQ(slave.board.checks().limit(Check::kOutputsFetched).value, 20 * bus::kTicksPerMs);
  EXPECT_EQ(violations(slave.board, Check::kOutputsFetched), 1U);
  slave.parameterise({0x88, 20, 1, 11, 0x12, 0x34, 0, 0x04});  // WD_Base: 20 ms again
  EXPECT_EQ(slave.board.checks().limit(Check::kInputsRenewed).value, 20 * bus::kTicksPerMs);
  slave.parameterise({0x80, 2, 1, 11, 0x12, 0x34, 0});  // off
  EXPECT_EQ(slave.board.checks().limit(Check::kOutputsFetched).value, kLimit);
}

TEST(OutputsFetched, LimitOfTheScenarioGoesFirst) {
  checks::Limits limits(checks::rules());
  limits[Check::kOutputsFetched].value = bus::kTicksPerMs;
  checks::Checks checks(limits);
  EXPECT_EQ(checks.limit(Check::kOutputsFetched).value, bus::kTicksPerMs);
}

TEST(OutputsOverwritten, GreatestNumberInARowIsShownAndHasNoLimit) {
  Slave slave;
  for (const int count : {1, 50, 7}) {
    slave.exchanges(count);
    fetch_outputs(slave.board);
  }
  look(slave.board, 0x00);
  const checks::Record& record = slave.board.checks().record(Check::kOutputsOverwritten);
  EXPECT_EQ(record.worst_value, 49);
  EXPECT_EQ(record.count, 3U);
  EXPECT_EQ(record.violations, 0U);
}

TEST(OutputsOverwritten, MoreThanTheScenarioAllowsIsFoundAtTheFetchAndAtTheEnd) {
  for (const int count : {4, 5}) {
    Slave slave(3);
    slave.exchanges(count);
    fetch_outputs(slave.board);
    slave.exchanges(count);
    EXPECT_EQ(violations(slave.board, Check::kOutputsOverwritten), count == 4 ? 0U : 1U);
    finish(slave.board, slave.board.now(), 1000);
    EXPECT_EQ(violations(slave.board, Check::kOutputsOverwritten), count == 4 ? 0U : 2U);
    if (count == 4) continue;
    const checks::Violation& first = slave.board.violations.at(0);
    EXPECT_EQ(first.text, "4 of at most 3, outputs in a row");
    EXPECT_EQ(first.margin, std::nullopt);
  }
}

TEST(OutputsOverwritten, OutputsFetchedBeforeTheAnswerIsOverAreNotLost) {
  Slave slave(0);
  for (int i = 0; i < 5; ++i) {
    slave.bus.request(slave.board);
    slave.board.wait(2000);
    fetch_outputs(slave.board);
    slave.bus.answered(slave.board, bus::make_telegram(2, kStation, bus::fc::kDl, {0x22}));
  }
  slave.exchanges(1);
  fetch_outputs(slave.board);
  look(slave.board, 0x00);
  EXPECT_EQ(slave.board.checks().record(Check::kOutputsOverwritten).worst_value, 0);
}

TEST(OutputsOverwritten, NoneHaveComeWhenALookFindsNothing) {
  Slave slave(0);
  for (int i = 0; i < 5; ++i) {
    slave.exchanges(5);
    look(slave.board, 0x00);
  }
  finish(slave.board, slave.board.now(), 1000);
  EXPECT_EQ(violations(slave.board, Check::kOutputsOverwritten), 0U);
}

TEST(InputsRenewed, CountsFromOneAnnouncementToTheNext) {
  Slave slave;
  slave.exchanges(2);
  const Tick one = hand_over_inputs(slave.board);
  slave.exchanges(3);
  const Tick two = hand_over_inputs(slave.board);
  look(slave.board, 0x01);
  EXPECT_EQ(slave.board.checks().record(Check::kInputsRenewed).worst_value, two - one);
}

TEST(InputsRenewed, IsMissedATickAfterTheLimit) {
  const auto renew_after = [](Slave& slave, Tick wait) {
    slave.exchanges(2);
    const Tick one = hand_over_inputs(slave.board);
    slave.exchanges(99);
    slave.board.wait(wait);
    const Tick two = hand_over_inputs(slave.board);
    look(slave.board, 0x01);
    return two - one;
  };
  Slave sooner;
  const Tick rest = renew_after(sooner, 0);
  for (const Tick beyond : {Tick{0}, Tick{1}}) {
    Slave slave;
    ASSERT_EQ(renew_after(slave, kLimit - rest + beyond), kLimit + beyond);
    EXPECT_EQ(violations(slave.board, Check::kInputsRenewed), beyond == 0 ? 0U : 1U);
  }
}

TEST(InputsRenewed, UserThatStopsIsFoundAndOneWithoutDataExchangeIsNot) {
  Slave slave;
  slave.exchanges(2);
  hand_over_inputs(slave.board);
  for (int i = 0; i < 12; ++i) {
    slave.exchanges(10);
    fetch_outputs(slave.board);
  }
  EXPECT_EQ(violations(slave.board, Check::kInputsRenewed), 1U);

  Slave quiet;
  quiet.exchanges(2);
  hand_over_inputs(quiet.board);
  finish(quiet.board, quiet.board.now(), 2 * kLimit);
  EXPECT_EQ(violations(quiet.board, Check::kInputsRenewed), 0U);

  Slave without;  // has no inputs: its answers are SC
  for (int i = 0; i < 120; ++i) {
    without.bus.request(without.board);
    without.board.wait(1000);
    without.bus.answered(without.board);
    without.board.wait(bus::kTicksPerMs);
  }
  EXPECT_EQ(violations(without.board, Check::kInputsRenewed), 0U);
}

// --- USER_REFUSED ----------------------------------------------------------------------------------------------------

void refuse(Board& board, profibus::Reason reason, std::uint16_t a = 0) {
  board.checks().event({board.now(), reason, a, 0, 0});
}

void give_verdict(Board& board) { set_flag(board, 0x010, 0x80); }

TEST(UserRefused, IsWhatTheUserCanAvoidWithTheChipsText) {
  Board board;
  refuse(board, profibus::Reason::kDiagType, 0x55);
  refuse(board, dpram::Reason::kInitAddress, 127);
  refuse(board, profibus::Reason::kAcyclicAnswerDiffers);
  refuse(board, profibus::Reason::kAcyclicNoRequest);  // withdrawn
  refuse(board, profibus::Reason::kVerdictSuperseded);
  refuse(board, dpram::Reason::kInputCrc);  // CRC_WRITTEN
  EXPECT_EQ(violations(board, Check::kUserRefused), 3U);
  EXPECT_NE(board.violations.at(0).text.find("type 55"), std::string::npos) << board.violations[0].text;
}

// U6, over the parallel port, SPI and the UART.
TEST(UserRefused, CountsTheReasonsOfTheRulingOverEachPort) {
  struct Case {
    profibus::Reason reason;
    bool counts[3];
  };
  const Case cases[] = {
      {dpram::Reason::kInitLength, {true, true, true}},
      {dpram::Reason::kInitAddress, {true, true, true}},
      {dpram::Reason::kInitLimit, {true, true, true}},
      {dpram::Reason::kInitCfg, {true, true, true}},
      {dpram::Reason::kBeforeInit, {true, true, true}},
      {profibus::Reason::kDiagLength, {true, true, true}},
      {profibus::Reason::kDiagType, {true, true, true}},
      {dpram::Reason::kAcyclicLength, {true, true, true}},
      {profibus::Reason::kAcyclicAnswerDiffers, {true, true, false}},
      {Reason::kTelegramCrc, {true, true, true}},
      {Reason::kTelegramAddress, {true, true, true}},
      {Reason::kTelegramData, {true, true, true}},
      {Reason::kTelegramLength, {true, true, true}},
      {dpram::Reason::kInitCrc, {false, true, true}},
      {dpram::Reason::kInputCrc, {false, true, true}},
      {dpram::Reason::kDiagCrc, {false, true, true}},
      {dpram::Reason::kC1Crc, {false, true, true}},
      {dpram::Reason::kC2Crc, {false, true, true}},
      {profibus::Reason::kAcyclicNoRequest, {false, false, false}},
      {profibus::Reason::kVerdictSuperseded, {false, false, false}},
  };
  for (const Level mode : {Level{0}, Level{1}, Level{2}}) {
    for (const Case& each : cases) {
      checks::Checks checks(checks::Limits(checks::rules(Part::kRsu)), Part::kRsu, {mode, 1});
      checks.pin(1000, Pin::kReset, 1);
      checks.event({2000, each.reason, 0, 0, 0});
      EXPECT_EQ(checks.record(Check::kUserRefused).violations, each.counts[mode] ? 1U : 0U)
          << profibus::code(each.reason) << " in mode " << mode;
    }
  }
}

TEST(UserRefused, VerdictCountsOnlyWhenNoBlockWasFetchedForIt) {
  Board board;
  fetch_parameters(board);
  give_verdict(board);
  look(board, 0x00);
  refuse(board, profibus::Reason::kVerdictUnexpected);  // the master has started again
  EXPECT_EQ(violations(board, Check::kUserRefused), 0U);
  give_verdict(board);
  look(board, 0x00);
  refuse(board, profibus::Reason::kVerdictUnexpected);
  EXPECT_EQ(violations(board, Check::kUserRefused), 1U);
}

/// Telegrams without ownership, each a hold: a read of the parameters' CRC, or none, then a verdict that the chip
/// refuses (accept, a process over the UART, seed 1: a lost reply had cleared B00E.2).
TEST(UserRefused, VerdictOverTheUartMayBeOnABlockThatWasReadOnceMore) {
  const checks::PinHistory history(tb::pins_of({}));
  for (const bool reads : {true, false}) {
    checks::Recorder recorder(checks::rules(), checks::Limits(checks::rules()), history);
    checks::Refusals refusals(recorder);
    checks::UserHolds holds;
    Tick now = 0;
    const auto telegram = [&](std::initializer_list<checks::Access> accesses) {
      holds.began(now);
      for (const checks::Access& access : accesses) holds.accessed(access);
      refusals.hold(holds.ended(now += 1000, checks::HoldOf::kTelegram), holds);
      holds.forget_reads();
    };
    if (reads) telegram({{false, 0x4FE, 0x40, 0, 0}, {false, 0x4FF, 0xBF, 0, 0}});
    for (int verdict = 1; verdict <= 2; ++verdict) {
      telegram({{true, 0x010, 0x80, 0, 0}});
      refusals.event({now, profibus::Reason::kVerdictUnexpected, 0, 0, 0}, checks::Refusals::Port::kUart);
      EXPECT_EQ(recorder.record(Check::kUserRefused).violations, static_cast<unsigned>(verdict - (reads ? 1 : 0)));
    }
  }
}

void fetch_configuration(Board& board) {
  fetch(board, 0x00E, 0x04, {{0x500, 0}, {0x501, 0}, {0x502, 0}, {0x5CB, 0}, {0x5CC, 0}});
  look(board, 0x00);
}

TEST(UserRefused, InputsOfAnotherLengthCountFromTheThirdSinceAConfigurationWasFetched) {
  Board board;
  for (int i = 0; i < 2; ++i) refuse(board, profibus::Reason::kInputLength, 3);
  fetch_configuration(board);
  for (int i = 0; i < 2; ++i) refuse(board, profibus::Reason::kInputLength, 3);
  EXPECT_EQ(violations(board, Check::kUserRefused), 0U);
  refuse(board, profibus::Reason::kInputLength, 3);
  EXPECT_EQ(violations(board, Check::kUserRefused), 1U);
}

TEST(UserRefused, InputsOfAnotherLengthAreRightUntilTheUserFetchesTheConfigurationThatWaits) {
  Board board;
  fetch_configuration(board);
  news(board);
  for (int i = 0; i < 5; ++i) refuse(board, profibus::Reason::kInputLength, 3);
  look(board, 0x04);  // seen, and left
  for (int i = 0; i < 5; ++i) refuse(board, profibus::Reason::kInputLength, 3);
  EXPECT_EQ(violations(board, Check::kUserRefused), 0U);
  fetch_configuration(board);
  for (int i = 0; i < 3; ++i) refuse(board, profibus::Reason::kInputLength, 3);
  EXPECT_EQ(violations(board, Check::kUserRefused), 1U);
  initialise(board, 0, 1);  // with other lengths
  for (int i = 0; i < 2; ++i) refuse(board, profibus::Reason::kInputLength, 3);
  EXPECT_EQ(violations(board, Check::kUserRefused), 1U);
}

TEST(UserRefused, InputsLongerThanTheirAreaCountAtOnce) {
  for (const std::uint16_t length : {std::uint16_t{244}, std::uint16_t{245}}) {
    Board board;
    refuse(board, profibus::Reason::kInputLength, length);
    EXPECT_EQ(violations(board, Check::kUserRefused), length - 244U);
  }
}

TEST(UserRefused, IsJudgedOnlyOfAChipThatTellsItsEvents) {
  Board board;
  give_verdict(board);
  look(board, 0x00);
  EXPECT_FALSE(board.checks().applies(Check::kUserRefused)) << "foreign RTL";
  EXPECT_EQ(board.checks().record(Check::kUserRefused).count, 0U);
  refuse(board, profibus::Reason::kVerdictSuperseded);
  give_verdict(board);
  look(board, 0x00);
  EXPECT_TRUE(board.checks().applies(Check::kUserRefused));
  EXPECT_EQ(board.checks().record(Check::kUserRefused).count, 1U);
}

// --- READY_UNSEEN ----------------------------------------------------------------------------------------------------

TEST(ReadyUnseen, IsJudgedOnceAfterEachReset) {
  Board board(checks::Limits(checks::rules()), true);
  const auto start = [&board](unsigned b004) {
    hold(board, [&board, b004] { board.read(0x004, b004); });
    hold(board, [&board] { board.write(0x005, 0x1D); });
    hold(board, [&board] { board.write(0x005, 0x1D); });
  };
  start(0xC5);
  EXPECT_EQ(board.checks().record(Check::kReadyUnseen).count, 1U);
  EXPECT_EQ(violations(board, Check::kReadyUnseen), 0U);
  board.set(Pin::kReset, 0);
  board.wait(5000);
  board.set(Pin::kReset, 1);
  start(0x45);
  EXPECT_EQ(violations(board, Check::kReadyUnseen), 1U);
  EXPECT_NE(board.violations.at(0).text.find("B005"), std::string::npos) << board.violations[0].text;
}

TEST(InitRepeated, SameValuesAgainAreMeasuredFromTheEarlierOnes) {
  Board board;
  initialise(board, 0, 1);
  const Tick one = set_flag(board, 0x010, 0x04);
  const Tick two = set_flag(board, 0x010, 0x04);
  look(board, 0x00);
  EXPECT_EQ(board.checks().record(Check::kInitRepeated).count, 2U);
  EXPECT_EQ(violations(board, Check::kInitRepeated), 2U);
  EXPECT_EQ(board.violations.back().margin, two - one - kLimit);
}

TEST(InitRepeated, IsAllowedFromTheLimitOn) {
  const auto repeat_after = [](Board& board, Tick wait) {
    initialise(board, 0, 1);
    const Tick one = set_flag(board, 0x010, 0x04, {{0x02B, 1}});
    board.wait(wait);
    const Tick two = set_flag(board, 0x010, 0x04);
    look(board, 0x00);
    return two - one;
  };
  Board sooner;
  const Tick rest = repeat_after(sooner, 0);
  for (const Tick within : {Tick{0}, Tick{1}}) {
    Board board;
    ASSERT_EQ(repeat_after(board, kLimit - rest - within), kLimit - within);
    EXPECT_EQ(violations(board, Check::kInitRepeated), within == 0 ? 0U : 1U);
  }
}

TEST(InitRepeated, OtherValuesRefusalAndResetAreNone) {
  Board board;
  initialise(board, 0, 1);
  initialise(board, 2, 1);  // B02B
  initialise(board, 2, 0);
  EXPECT_EQ(violations(board, Check::kInitRepeated), 1U);
  initialise(board, 2, 1);  // after a refusal
  board.set(Pin::kReset, 0);
  board.wait(5000);
  board.set(Pin::kReset, 1);
  initialise(board, 2, 1);
  EXPECT_EQ(violations(board, Check::kInitRepeated), 1U);
}

/// As before, in a hold that finds B00A.0 clear.
void initialise_again(Board& board) {
  hold(
      board,
      [&board] {
        board.read(0x00A, 0x00);
        board.read(0x010, 0x00);
        board.write(0x010, 0x04);
      });
}

TEST(InitRepeated, RefusalSeenInTheSameHoldAllowsIt) {
  Board board;
  initialise(board, 0, 1);
  initialise_again(board);
  look(board, 0x00);
  EXPECT_EQ(violations(board, Check::kInitRepeated), 0U);
}

TEST(InitRepeated, UsersOwnClearingIsNoRefusal) {
  Board board;
  initialise(board, 0, 1);
  hold(board, [&board] { board.write(0x00A, 0x00); });  // chapter 8: after success
  look(board, 0x00);
  initialise_again(board);
  look(board, 0x00);
  EXPECT_EQ(violations(board, Check::kInitRepeated), 1U);
}

TEST(InitRepeated, IsAllowedUntilB006SaysThatTheChipHasCome) {
  for (const unsigned count : {1U, 2U}) {
    Board board;
    set_flag(board, 0x010, 0x04, {{0x02B, 0}});
    hold(
        board, [&board] { board.read(0x00E, 0x00); }, count);
    hold(
        board,
        [&board] {
          board.read(0x010, 0x00);
          board.write(0x010, 0x04);
        },
        3);
    look(board, 0x00);
    EXPECT_EQ(violations(board, Check::kInitRepeated), count == 1 ? 1U : 0U);
  }
}

TEST(ResetLow, LeastTimeIsShown) {
  Board board;
  board.set(Pin::kReset, 0);
  board.wait(700);
  board.set(Pin::kReset, 1);
  EXPECT_EQ(board.checks().record(Check::kResetLow).count, 2U);
  EXPECT_EQ(board.checks().record(Check::kResetLow).worst_value, 700);
}

// --- requests --------------------------------------------------------------------------------------------------------

Tick fetch_request(Board& board) {
  return fetch(board, 0x00F, 0x01, {{0x5D0, 0x5E}, {0x5D1, 1}, {0x5D2, 2}, {0x5D3, 4}, {0x6C4, 0}, {0x6C5, 0}});
}

/// Without its data and CRC.
Tick answer(Board& board, unsigned function, unsigned slot, unsigned length, unsigned index = 2) {
  return hold(
      board,
      [&] {
        board.write(0x5D0, function);
        board.write(0x5D1, slot);
        board.write(0x5D2, index);
        board.write(0x5D3, length);
        board.read(0x00F, 0x00);
        board.read(0x011, 0x00);
        board.write(0x011, 0x01);
      });
}

TEST(RequestAnswered, CountsFromTheFetchToTheAnswer) {
  Board board;
  const Tick fetched = fetch_request(board);
  const Tick answered = answer(board, 0x5E, 1, 4);
  look(board, 0x00);
  EXPECT_EQ(board.checks().record(Check::kRequestAnswered).worst_value, answered - fetched);
  EXPECT_EQ(violations(board, Check::kRequestAnswered), 0U);
}

TEST(RequestAnswered, AnswerToAnotherRequestOrTooLongIsFoundAndAnErrorIsFree) {
  struct Answer {
    unsigned function, slot, length;
    std::uint64_t violations;
    unsigned index = 2;
  };
  for (const Answer& each :
       {Answer{0x5E, 1, 5, 1}, Answer{0x5E, 2, 4, 1}, Answer{0x5E, 1, 4, 1, 3}, Answer{0x5F, 1, 4, 1},
        Answer{0xDE, 0x80, 0xFF, 0}, Answer{0xDF, 0x80, 0, 1}, Answer{0x5E, 1, 0, 0}}) {
    Board board;
    fetch_request(board);
    answer(board, each.function, each.slot, each.length, each.index);
    look(board, 0x00);
    EXPECT_EQ(violations(board, Check::kRequestAnswered), each.violations)
        << each.function << ' ' << each.slot << ' ' << each.length;
  }
}

TEST(RequestAnswered, NoAnswerOnC1IsFoundAfterTheLimit) {
  for (const Tick beyond : {Tick{0}, Tick{1}}) {
    Board board;
    finish(board, fetch_request(board), kLimit + beyond);
    EXPECT_EQ(violations(board, Check::kRequestAnswered), beyond == 0 ? 0U : 1U);
  }
}

TEST(RequestAnswered, NewerRequestAndTheEndOfDataExchangeEndTheWait) {
  Board newer;
  fetch_request(newer);
  hold(newer, [&newer] { newer.read(0x00F, 0x01); });
  finish(newer, newer.now(), 2 * kLimit);
  EXPECT_EQ(violations(newer, Check::kRequestAnswered), 0U);

  Board left;
  fetch_request(left);
  left.checks().event({left.now(), profibus::Reason::kC1Dropped, 0, 0, 0});
  finish(left, left.now(), 2 * kLimit);
  EXPECT_EQ(violations(left, Check::kRequestAnswered), 0U);
}

/// Data exchange was left with a request open; the answer of that one comes after the next has.
TEST(RequestAnswered, AnswerOfAnEarlierRequestOnC1IsFound) {
  for (const bool fetches : {false, true}) {
    Board board;
    const auto tell = [&board](profibus::Reason reason) { board.checks().event({board.now(), reason, 0x5E, 1, 2}); };
    tell(profibus::Reason::kC1Request);
    fetch_request(board);
    tell(profibus::Reason::kC1Dropped);
    tell(profibus::Reason::kC1Request);
    if (fetches) fetch_request(board);
    answer(board, 0x5E, 1, 4);
    tell(profibus::Reason::kC1Answer);
    EXPECT_EQ(violations(board, Check::kRequestAnswered), fetches ? 0U : 1U);
    tell(profibus::Reason::kC1Answer);  // to a wrong request, by the chip alone (V9)
    EXPECT_EQ(violations(board, Check::kRequestAnswered), fetches ? 0U : 1U);
  }
  Board board;
  board.checks().event({board.now(), profibus::Reason::kC1Request, 0x5E, 1, 2});
  board.checks().event({board.now(), profibus::Reason::kC1Dropped, 0, 0, 0});
  board.checks().event({board.now(), profibus::Reason::kC1Answer, 0xDE, 0, 0});
  EXPECT_EQ(violations(board, Check::kRequestAnswered), 0U) << "dropped before it was fetched, then a wrong one";
}

Tick fetch_c2_request(Board& board) {
  return fetch(board, 0x00F, 0x02, {{0x6D0, 0x5E}, {0x6D1, 1}, {0x6D2, 2}, {0x6D3, 4}, {0x7C4, 0}, {0x7C5, 0}});
}

TEST(RequestAnswered, OnC2TheChipTellsTheEndOfSendTimeoutElseASecondIsAllowed) {
  struct Case {
    bool tells;
    Tick after;
    std::uint64_t violations;
  };
  constexpr Tick kSecond = bus::kTicksPerSecond;
  for (const Case& each : {Case{false, kSecond, 0}, Case{false, kSecond + 1, 1}, Case{true, 3 * kSecond, 0}}) {
    Board board;
    if (each.tells) refuse(board, profibus::Reason::kVerdictSuperseded);
    finish(board, fetch_c2_request(board), each.after);
    EXPECT_EQ(violations(board, Check::kRequestAnswered), each.violations) << each.tells << each.after;
  }
}

TEST(RequestAnswered, TimerOfTheUserIsReportedOnce) {
  Board board;
  refuse(board, profibus::Reason::kVerdictSuperseded);
  fetch_c2_request(board);
  board.checks().event({board.now(), profibus::Reason::kC2Timeout, 48, 3, 2});
  finish(board, board.now(), 3 * bus::kTicksPerSecond);
  EXPECT_EQ(violations(board, Check::kRequestAnswered), 1U);
}

TEST(RequestAnswered, TimerOfTheUserIsSendTimeout) {
  Board board;
  board.checks().event({board.now(), profibus::Reason::kC2Timeout, 48, 1, 2});  // F: no poll
  EXPECT_EQ(violations(board, Check::kRequestAnswered), 0U);
  board.checks().event({board.now(), profibus::Reason::kC2Timeout, 48, 3, 2});
  EXPECT_EQ(violations(board, Check::kRequestAnswered), 1U);
}

TEST(BlockServed, RequestThatTheChipHasAcknowledgedAsksForALookAtB00F) {
  for (const bool looks : {false, true}) {
    Slave slave;
    slave.bus.request(slave.board, bus::make_telegram(kStation, 2, bus::fc::kRequest | bus::fc::kSrdHigh,
                                                      {0x5E, 1, 1, 4}, bus::sap::kMs1, bus::sap::kMs1));
    slave.board.wait(1000);
    slave.bus.answered(slave.board);
    if (looks) hold(slave.board, [&slave] { slave.board.read(0x00F, 0x00); });
    finish(slave.board, slave.board.now(), 2 * kLimit);
    EXPECT_EQ(violations(slave.board, Check::kBlockServed), looks ? 0U : 1U);
  }
}

}  // namespace
}  // namespace dsdpv1
