// Baud search, BAUD_CONTROL and DP_CONTROL: orders, windows and expiries to the cycle (S1, S9, S10, S22).
#include <gtest/gtest.h>

#include "tests/conformance/master_side.hpp"

namespace conformance {
namespace {

using profibus::Cycle;

constexpr Cycle kMs = profibus::kCyclesPerMs;

Cycle cycles_of_bit(int index) { return bus::baud(index).bit / kCycleTicks; }
Cycle window(int index) { return std::max<Cycle>(50 * kMs, 4000 * cycles_of_bit(index)); }

/// Sends so that the chip decides the telegram at this cycle: start edge, synchroniser (P9), characters, 1 bit time (S10).
struct Aimed {
  static constexpr Cycle kSynchroniser = 3;  // an edge at the tick of edge k is seen by k+1 and used at k+3
  static Tick start_for(Cycle decision, int baud, std::size_t characters) {
    const Cycle bits = static_cast<Cycle>(characters - 1) * 11 + 12;
    return (decision - 1 - bits * cycles_of_bit(baud) - kSynchroniser) * kCycleTicks;
  }
};

const bus::Telegram kToNobody = bus::make_telegram(100, 2, kFdlStatus);
const bus::Telegram kToChip = bus::make_telegram(5, 2, kFdlStatus);

void send_decided_at(SlaveBench& bench, Cycle decision, int baud, const bus::Telegram& telegram,
                     bool wants_answer = false) {
  bench.requester.set_baud(baud);
  const Bytes bytes = bus::encode(telegram);
  bench.requester.send(bench.timeline, bytes,
                       {.at = Aimed::start_for(decision, baud, bytes.size()), .wants_answer = wants_answer});
  bench.run_for(bus::baud(baud).bit * 2);
}

// --- the search

class Search : public testing::Test {
 protected:
  /// The cycle at which the search began.
  Cycle initialised(SlaveBench& bench) {
    bench.power_on();
    EXPECT_TRUE(bench.initialise());
    return bench.last(Reason::kInitialised).at / kCycleTicks;
  }
  static Cycle found_at(const SlaveBench& bench) {
    return bench.count(Reason::kBaudFound) == 0 ? -1 : bench.last(Reason::kBaudFound).at / kCycleTicks;
  }
};

class SearchWindow : public Search, public testing::WithParamInterface<int> {
 protected:
  /// First cycle of the window of a rate, in the first turn.
  static Cycle begin(Cycle start, int index) {
    for (int i = 0; i < index; ++i) start += window(i);
    return start;
  }
};

TEST_P(SearchWindow, LocksATelegramDecidedInItsLastCycle) {
  SlaveBench bench;
  const Cycle last = begin(initialised(bench), GetParam() + 1) - 1;
  send_decided_at(bench, last, GetParam(), kToNobody);
  EXPECT_EQ(bench.chip.status().baud_index, GetParam());
  EXPECT_EQ(found_at(bench), last);
}

TEST_P(SearchWindow, HasEndedInTheCycleBehindIt) {
  SlaveBench bench;
  const Cycle next = begin(initialised(bench), GetParam() + 1);
  send_decided_at(bench, next, GetParam(), kToNobody);
  EXPECT_EQ(bench.chip.status().baud_index, 15);
  EXPECT_EQ(found_at(bench), -1);
}

TEST_P(SearchWindow, LocksAtItsBeginning) {
  SlaveBench bench;
  const Cycle first = begin(initialised(bench), GetParam());
  // T_SYN of idle, 6 characters, 1 bit: the first that can be right.
  const Cycle decision = first + (33 + 66 + 1) * cycles_of_bit(GetParam()) + 1;
  send_decided_at(bench, decision, GetParam(), kToNobody);
  EXPECT_EQ(found_at(bench), decision);
  bench.run_cycles(200);
  EXPECT_EQ(bench.peek(0x012) >> 4, GetParam());
  EXPECT_EQ(bench.chip.level(Pin::kBr), 1);
}

INSTANTIATE_TEST_SUITE_P(AllRates, SearchWindow, testing::Range(0, bus::kBaudCount),
                         [](const auto& at) { return "Code" + std::to_string(at.param); });

TEST_F(Search, BeginsAgainAt12MBehindTheSlowestRate) {
  SlaveBench bench;
  Cycle next = initialised(bench);
  for (int i = 0; i < bus::kBaudCount; ++i) next += window(i);
  send_decided_at(bench, next + 500, 0, kToNobody);
  EXPECT_EQ(found_at(bench), next + 500);
}

TEST_F(Search, ShowsFifteenInTheStatusAndBrLowUntilARateIsFound) {
  SlaveBench bench(quick_search());
  initialised(bench);
  settle(bench);
  EXPECT_EQ(bench.peek(0x012), 0xF4);
  EXPECT_EQ(bench.chip.level(Pin::kBr), 0);
  bench.find_baud(3);
  settle(bench);
  EXPECT_EQ(bench.peek(0x012), 0x34);
  EXPECT_EQ(bench.chip.level(Pin::kBr), 1);
}

TEST_F(Search, NeedsTSynBeforeTheTelegram) {
  for (const bool enough : {false, true}) {
    SlaveBench bench(quick_search());
    initialised(bench);
    bench.run_cycles(1000);
    bench.requester.send(bench.timeline, Bytes{0xE5}, {.wants_answer = false});
    bench.requester.send(bench.timeline, kToNobody, {.idle_bits = enough ? 33 : 32, .wants_answer = false});
    bench.run_cycles(20);
    EXPECT_EQ(bench.chip.status().baud_index, enough ? 0 : 15);
  }
}

TEST_F(Search, DoesNotExecuteOrAnswerTheTelegramThatLocks) {
  SlaveBench bench(quick_search());
  initialised(bench);
  bench.run_cycles(33 * 4);
  EXPECT_TRUE(ask(bench, 61, Prm{}.bytes()).silent());
  EXPECT_EQ(bench.chip.status().baud_index, 0);
  EXPECT_EQ(bench.dp_state(), DpState::kWaitPrm);
  EXPECT_EQ(bench.count(Reason::kPrmAccepted), 0);
  EXPECT_TRUE(bench.fdl_status().answered());
  EXPECT_TRUE(is_sc(ask(bench, 61, Prm{}.bytes())));
}

TEST_F(Search, LocksOnSd1Sd2AndSd3OfAnybody) {
  const Bytes eight = {1, 2, 3, 4, 5, 6, 7, 8};
  for (const bus::Telegram& telegram :
       {kToNobody, kToChip, bus::make_telegram(100, 2, 0x6D, {1}),
        bus::prefer_sd3(bus::make_telegram(100, 2, 0x6D, eight)), bus::make_telegram(127, 2, 0x46, {0, 0}, 58, 62)}) {
    SlaveBench bench(quick_search());
    initialised(bench);
    bench.run_cycles(33 * 4);
    bench.requester.send(bench.timeline, telegram);
    EXPECT_EQ(bench.chip.status().baud_index, 0) << static_cast<int>(telegram.kind);
    EXPECT_EQ(bench.chip.status().telegrams_answered, 0U);
  }
}

TEST_F(Search, DoesNotLockOnTokensShortAcknowledgesAndWrongTelegrams) {
  SlaveBench bench(quick_search());
  initialised(bench);
  bench.run_cycles(33 * 4);
  bench.requester.send(bench.timeline, bus::make_token(5, 2));
  bench.requester.send(bench.timeline, bus::make_sc());
  Bytes wrong = bus::encode(kToNobody);
  ++wrong[4];
  bench.requester.send(bench.timeline, wrong);
  bus::WireFaults faults;
  faults.wrong_parity_at = 2;
  bench.requester.send(bench.timeline, bus::encode(kToNobody), {.faults = faults});
  EXPECT_EQ(bench.chip.status().baud_index, 15);
}

TEST_F(Search, DoesNotLockOnTrafficAtAnotherRate) {
  SlaveBench bench(quick_search());
  initialised(bench);
  bench.requester.set_baud(5);  // while the chip listens at 12M, 6M ...
  for (int i = 0; i < 3; ++i) bench.requester.send(bench.timeline, kToNobody, {.wants_answer = false});
  EXPECT_EQ(bench.chip.status().baud_index, 15);
}

// --- BAUD_CONTROL

class BaudControl : public Search {
 protected:
  static dsdpv1::Config config(std::uint32_t ms) {
    dsdpv1::Config config = quick_search();
    config.baud_control_ms = ms;
    return config;
  }
};

TEST_F(BaudControl, EndsSixHundredMillisecondsBehindTheLastTelegramToTheStation) {
  SlaveBench bench(quick_search());
  bench.to_wait_prm();
  const Cycle decision = bench.now() / kCycleTicks + 1000;
  send_decided_at(bench, decision, 0, kToChip);
  bench.run_until((decision + 600 * kMs) * kCycleTicks - 1);
  EXPECT_EQ(bench.chip.level(Pin::kBr), 1);
  bench.run_cycles(1);
  EXPECT_EQ(bench.chip.level(Pin::kBr), 0);
  EXPECT_EQ(bench.last(Reason::kBaudLost).at, (decision + 600 * kMs) * kCycleTicks);
  EXPECT_EQ(bench.chip.status().baud_index, 15);
}

TEST_F(BaudControl, RunsFromTheLockingTelegramOn) {
  SlaveBench bench(config(3));
  bench.to_wait_prm();
  const Tick found = bench.last(Reason::kBaudFound).at;
  bench.run_ms(4);
  EXPECT_EQ(bench.last(Reason::kBaudLost).at, found + 3 * kMs * kCycleTicks);
}

TEST_F(BaudControl, IsKeptAliveInItsLastCycleAndNotInTheNext) {
  for (const bool in_time : {true, false}) {
    SlaveBench bench(config(3));
    bench.to_wait_prm();
    const Cycle end = bench.last(Reason::kBaudFound).at / kCycleTicks + 3 * kMs;
    send_decided_at(bench, in_time ? end - 1 : end, 0, kToChip);
    EXPECT_EQ(bench.count(Reason::kBaudLost), in_time ? 0 : 1);
    // S22: the time is first. S9: the same telegram then only begins the search anew; it came before the restart and locks nothing.
    EXPECT_EQ(bench.chip.status().baud_index, in_time ? 0 : 15);
  }
}

TEST_F(BaudControl, IsNotKeptAliveByTrafficThatIsNotForTheStation) {
  SlaveBench bench(config(3));
  bench.to_wait_prm();
  const Tick found = bench.last(Reason::kBaudFound).at;
  Bytes wrong = bus::encode(kToChip);
  ++wrong[4];
  for (int i = 0; i < 5; ++i) {
    bench.run_for(bus::kTicksPerMs / 4);
    bench.requester.send(bench.timeline, kToNobody, {.wants_answer = false});
    bench.requester.send(bench.timeline, bus::make_telegram(127, 2, 0x46, {0, 0}, 58, 62), {.wants_answer = false});
    bench.requester.send(bench.timeline, wrong, {.wants_answer = false});
    bench.requester.send(bench.timeline, bus::make_token(5, 2), {.wants_answer = false});
  }
  bench.run_until(found + 3 * kMs * kCycleTicks);
  EXPECT_EQ(bench.last(Reason::kBaudLost).at, found + 3 * kMs * kCycleTicks);
}

TEST_F(BaudControl, IsKeptAliveByAnyStationThatAsksThisOne) {
  SlaveBench bench(config(3));
  bench.to_wait_prm();
  for (int i = 0; i < 10; ++i) {
    bench.run_ms(1);
    EXPECT_TRUE(bench.requester.send(bench.timeline, bus::make_telegram(5, 9, kFdlStatus)).answered());
  }
  EXPECT_EQ(bench.count(Reason::kBaudLost), 0);
}

TEST_F(BaudControl, EndsWithoutResettingTheDpState) {
  SlaveBench bench(config(3));
  bench.to_data_exch();
  ASSERT_TRUE(ask(bench, kNoSap, {0xAB, 0xCD}).answered());
  bench.give_inputs({1, 2});
  bench.run_ms(4);
  EXPECT_EQ(bench.count(Reason::kBaudLost), 1);
  EXPECT_EQ(bench.dp_state(), DpState::kDataExch);
  EXPECT_EQ(bench.chip.level(Pin::kPbf), 0);
  EXPECT_EQ(offline_count(bench), 0);
  EXPECT_EQ(output_area(bench), (Bytes{0xAB, 0xCD}));
  settle(bench);
  EXPECT_EQ(bench.peek(0x012), 0xFC);
  EXPECT_TRUE(ask(bench, kNoSap, {3, 4}).silent());
  bench.find_baud(0);
  EXPECT_TRUE(is_data(ask(bench, kNoSap, {5, 6})));
}

class BaudChange : public BaudControl, public testing::WithParamInterface<int> {};

TEST_P(BaudChange, InOperationIsFollowedAndDataExchangeGoesOn) {
  const int to = GetParam();
  SlaveBench bench(config(40));
  bench.to_data_exch({}, {}, (to + 3) % bus::kBaudCount);
  bench.give_inputs({0x5A, 0xA5});
  bench.requester.set_baud(to);
  bench.run_ms(41);
  bench.find_baud(to);
  EXPECT_EQ(bench.dp_state(), DpState::kDataExch);
  const Exchange exchange = ask(bench, kNoSap, {7, 8});
  ASSERT_TRUE(is_data(exchange)) << kind_of(exchange);
  EXPECT_EQ(exchange.answer().data, (Bytes{0x5A, 0xA5}));
  settle(bench);
  EXPECT_EQ(output_area(bench), (Bytes{7, 8}));
  EXPECT_EQ(bench.peek(0x012), (to << 4) | 0x0C);
}

INSTANTIATE_TEST_SUITE_P(AllRates, BaudChange, testing::Range(0, bus::kBaudCount),
                         [](const auto& at) { return "ToCode" + std::to_string(at.param); });

// --- DP_CONTROL

class Watchdog : public Search {
 protected:
  static Prm prm(int wd1, int wd2, bool one_ms) {
    Prm prm;
    prm.status = 0x88;
    prm.wd1 = static_cast<std::uint8_t>(wd1);
    prm.wd2 = static_cast<std::uint8_t>(wd2);
    if (one_ms) prm.user = {0x04};
    return prm;
  }
  Cycle soon() const { return bench.now() / kCycleTicks + 2000; }
  void dx_decided_at(Cycle decision, std::uint8_t master = 2) {
    send_decided_at(bench, decision, 0, bus::make_telegram(5, master, kSrdFirst, {1, 2}), true);
  }

  SlaveBench bench{quick_search()};
};

TEST_F(Watchdog, TimeIsTheProductOfTheFactorsInTheBaseThatSetPrmChose) {
  struct Case {
    int wd1, wd2;
    bool one_ms;
    Cycle ms;
  };
  for (const Case& each : {Case{1, 1, true, 1},
                           {7, 1, true, 7},
                           {1, 9, true, 9},
                           {5, 6, true, 30},
                           {1, 1, false, 10},
                           {2, 3, false, 60},
                           {255, 1, true, 255}}) {
    SlaveBench one(quick_search());
    one.to_data_exch({}, prm(each.wd1, each.wd2, each.one_ms));
    const Cycle decision = one.now() / kCycleTicks + 2000;
    send_decided_at(one, decision, 0, bus::make_telegram(5, 2, kSrdFirst, {1, 2}), true);
    const Tick end = (decision + each.ms * kMs) * kCycleTicks;
    one.run_until(end - 1);
    EXPECT_EQ(one.dp_state(), DpState::kDataExch) << each.ms;
    one.run_until(end);
    EXPECT_EQ(one.dp_state(), DpState::kWaitPrm) << each.ms;
    EXPECT_EQ(one.last(Reason::kWatchdogExpired).at, end);
  }
}

TEST_F(Watchdog, LongestTimeIsSixHundredAndFiftySeconds) {
  bench.to_data_exch({}, prm(255, 255, false));
  EXPECT_EQ(bench.last(Reason::kWatchdogOn).a, 65025U * 10 & 0xFFFF);  // an event carries 16 bits
  bench.run_ms(700);                                                   // BAUD_CONTROL's 600 ms do not run now
  EXPECT_EQ(bench.dp_state(), DpState::kDataExch);
  EXPECT_EQ(bench.count(Reason::kBaudLost), 0);
}

TEST_F(Watchdog, LongestTimeEndsToTheCycle) {
  bench.to_data_exch({}, prm(255, 255, false));
  const Cycle decision = soon();
  dx_decided_at(decision);
  bench.chip.set(bench.now(), Pin::kRReq, 1);  // no accesses: nothing but the time passes
  const Tick end = (decision + 650'250 * kMs) * kCycleTicks;
  // 31 thousand million cycles: only the engine that skips.
  bench.timeline.run_until(end - 1);
  EXPECT_EQ(bench.dp_state(), DpState::kDataExch);
  bench.timeline.run_until(end);
  EXPECT_EQ(bench.dp_state(), DpState::kWaitPrm);
}

TEST_F(Watchdog, RunsFromTheSetPrmOn) {
  bench.to_wait_prm();
  const Cycle decision = soon();
  send_decided_at(bench, decision, 0, bus::make_telegram(5, 2, kSrdFirst, prm(3, 1, true).bytes(), 61, 62), true);
  EXPECT_EQ(bench.last(Reason::kPrmAccepted).at, decision * kCycleTicks);
  bench.run_ms(4);
  EXPECT_EQ(bench.last(Reason::kWatchdogExpired).at, (decision + 3 * kMs) * kCycleTicks);
}

TEST_F(Watchdog, IsTriggeredByARepetitionToo) {
  bench.to_data_exch({}, prm(3, 1, true));
  for (int i = 0; i < 5; ++i) {
    bench.run_ms(2);
    EXPECT_TRUE(send_fc(bench, i == 0 ? 0x6D : 0x7D, kNoSap, kNoSap, {1, 2}).answered());
  }
  EXPECT_EQ(bench.dp_state(), DpState::kDataExch);
}

TEST_F(Watchdog, OfARefusedSetPrmDoesNotRun) {
  bench.to_wait_prm();
  Prm wrong = prm(3, 1, true);
  wrong.ident = 1;
  ASSERT_TRUE(is_sc(ask(bench, 61, wrong.bytes())));
  bench.run_ms(5);
  EXPECT_EQ(bench.count(Reason::kWatchdogExpired), 0);
  EXPECT_EQ(diag(bench).at(1) & 0x08, 0);
}

TEST_F(Watchdog, IsTriggeredInItsLastCycleAndNotInTheNext) {
  for (const bool in_time : {true, false}) {
    SlaveBench one(quick_search());
    one.to_data_exch({}, prm(3, 1, true));
    const Cycle first = one.now() / kCycleTicks + 2000;
    const auto dx = bus::make_telegram(5, 2, kSrdFirst, {1, 2});
    send_decided_at(one, first, 0, dx, true);
    send_decided_at(one, first + 3 * kMs - (in_time ? 1 : 0), 0, dx, true);
    EXPECT_EQ(one.dp_state(), in_time ? DpState::kDataExch : DpState::kWaitPrm);
  }
}

TEST_F(Watchdog, ClearsTheOutputsReleasesTheMasterAndCounts) {
  bench.to_data_exch({}, prm(3, 1, true));
  dx_decided_at(soon());
  bench.chip_accesses();
  ASSERT_EQ(bench.fetch_outputs(), (Bytes{1, 2}));
  bench.run_ms(4);
  EXPECT_EQ(bench.dp_state(), DpState::kWaitPrm);
  EXPECT_EQ(bench.chip.status().master, 255);
  EXPECT_EQ(bench.chip.level(Pin::kPbf), 1);
  EXPECT_EQ(bench.fetch_outputs(), (Bytes{0, 0}));
  EXPECT_EQ(offline_count(bench), 1);
  EXPECT_EQ(bench.peek(0x012), 0x04);
  EXPECT_EQ(ask(bench, bus::sap::kReadOutputs).answer().data, (Bytes{0, 0}));
  EXPECT_TRUE(is_rs(ask(bench, kNoSap, {1, 2})));
  EXPECT_EQ(bench.chip.level(Pin::kBr), 1) << "the baud rate stays";
}

TEST_F(Watchdog, IsTriggeredByEveryTelegramOfTheHolderToTheStation) {
  bench.to_data_exch({}, prm(3, 1, true));
  for (int i = 0; i < 4; ++i) {
    bench.run_ms(2);
    EXPECT_TRUE(bench.fdl_status().answered());
    bench.run_ms(2);
    EXPECT_TRUE(is_data(ask(bench, 60)));
    bench.run_ms(2);
    EXPECT_TRUE(is_rs(ask(bench, 40, {1})));
    bench.run_ms(2);
    tell(bench, 5, 58, {0, 0});
  }
  EXPECT_EQ(bench.dp_state(), DpState::kDataExch);
}

TEST_F(Watchdog, IsNotTriggeredByOthersNorByBroadcasts) {
  bench.to_data_exch({}, prm(3, 1, true));
  const Cycle decision = soon();
  dx_decided_at(decision);
  for (int i = 0; i < 2; ++i) {
    bench.run_ms(1);
    EXPECT_TRUE(is_data(ask(bench, 60, {}, 3)));
    EXPECT_TRUE(bench.requester.send(bench.timeline, bus::make_telegram(5, 3, kFdlStatus)).answered());
    tell(bench, bus::kBroadcast, 58, {0, 0});
    bench.requester.send(bench.timeline, bus::make_telegram(9, 2, kSrdFirst, {1, 2}));
  }
  bench.run_ms(1);
  EXPECT_EQ(bench.last(Reason::kWatchdogExpired).at, (decision + 3 * kMs) * kCycleTicks);
}

TEST_F(Watchdog, RunsInWaitCfgToo) {
  bench.to_wait_cfg({}, prm(3, 1, true));
  bench.run_ms(4);
  EXPECT_EQ(bench.dp_state(), DpState::kWaitPrm);
  EXPECT_EQ(bench.count(Reason::kWatchdogExpired), 1);
}

TEST_F(Watchdog, NeverExpiresWithoutWdOn) {
  Prm off = prm(1, 1, true);
  off.status = 0x80;
  bench.to_data_exch({}, off);
  bench.run_ms(590);
  EXPECT_EQ(bench.dp_state(), DpState::kDataExch);
  EXPECT_EQ(bench.count(Reason::kWatchdogExpired), 0);
}

TEST_F(Watchdog, IsSwitchedOffByASetPrmWithoutIt) {
  bench.to_data_exch({}, prm(3, 1, true));
  ASSERT_TRUE(is_sc(ask(bench, 61, Prm{}.bytes())));
  ASSERT_TRUE(is_sc(ask(bench, 62, {0x11, 0x21})));
  bench.run_ms(20);
  EXPECT_EQ(bench.dp_state(), DpState::kDataExch);
}

TEST_F(Watchdog, TakesItsTimeFromTheNewestSetPrm) {
  bench.to_data_exch({}, prm(50, 1, true));
  ASSERT_TRUE(is_sc(ask(bench, 61, prm(2, 1, true).bytes())));
  ASSERT_TRUE(is_sc(ask(bench, 62, {0x11, 0x21})));
  bench.run_ms(3);
  EXPECT_EQ(bench.dp_state(), DpState::kWaitPrm);
}

TEST_F(Watchdog, IsNotTouchedByASetPrmThatChangesOnlyMinTsdr) {
  bench.to_data_exch({}, prm(3, 1, true));
  Prm only = prm(200, 200, false);
  only.status = 0x08;
  ASSERT_TRUE(is_sc(ask(bench, 61, only.bytes())));
  bench.run_ms(4);
  EXPECT_EQ(bench.dp_state(), DpState::kWaitPrm);
}

TEST_F(Watchdog, ExpiryLeavesTheRateToBaudControl) {
  dsdpv1::Config config = quick_search();
  config.baud_control_ms = 7;
  SlaveBench one(config);
  one.to_data_exch({}, prm(3, 1, true));
  one.run_ms(11);
  const Tick expired = one.last(Reason::kWatchdogExpired).at;
  EXPECT_EQ(one.last(Reason::kBaudLost).at, expired + 7 * kMs * kCycleTicks);
}

TEST_F(Watchdog, EndsWithTheMasterThatUnlocks) {
  dsdpv1::Config config = quick_search();
  config.baud_control_ms = 7;
  SlaveBench one(config);
  one.to_data_exch({}, prm(3, 1, true));
  Prm unlock;
  unlock.status = 0x40;
  ASSERT_TRUE(is_sc(ask(one, 61, unlock.bytes())));
  one.run_ms(8);
  EXPECT_EQ(one.count(Reason::kWatchdogExpired), 0);
  EXPECT_EQ(one.count(Reason::kBaudLost), 1);
}

TEST_F(Watchdog, ShowsInTheDiagnosisWhileItRuns) {
  bench.to_wait_prm();
  EXPECT_EQ(diag(bench)[1] & 0x08, 0);
  ASSERT_TRUE(is_sc(ask(bench, 61, prm(3, 1, true).bytes())));
  EXPECT_EQ(diag(bench)[1] & 0x08, 0x08);
  bench.run_ms(4);
  EXPECT_EQ(diag(bench)[1] & 0x08, 0);
}

}  // namespace
}  // namespace conformance
