// Baud search and BAUD_CONTROL: order, windows and expiries to the cycle (S1, S9, S10, S22).
#include <gtest/gtest.h>

#include "tests/conformance/master_side.hpp"

namespace dsdpv1::conformance {
namespace {

using profibus::Cycle;

Cycle cycles_of_bit(int index) { return bus::baud(index).bit / kCycleTicks; }
Cycle window(int index) { return std::max<Cycle>(50 * kMs, 4000 * cycles_of_bit(index)); }

const bus::Telegram kToNobody = bus::make_telegram(100, 2, kFdlStatus);
const bus::Telegram kToChip = bus::make_telegram(5, 2, kFdlStatus);

// --- the search

class Search : public testing::Test {
 protected:
  /// The cycle at which the search began.
  Cycle initialised(SlaveBench& bench) {
    bench.power_on();
    EXPECT_TRUE(bench.initialise());
    return bench.last(dpram::Reason::kInitialised).at / kCycleTicks;
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
  EXPECT_EQ(bench.chip.status().baud_index.code(), GetParam());
  EXPECT_EQ(found_at(bench), last);
}

TEST_P(SearchWindow, HasEndedInTheCycleBehindIt) {
  SlaveBench bench;
  const Cycle next = begin(initialised(bench), GetParam() + 1);
  send_decided_at(bench, next, GetParam(), kToNobody);
  EXPECT_EQ(bench.chip.status().baud_index.code(), 15);
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
    EXPECT_EQ(bench.chip.status().baud_index.code(), enough ? 0 : 15);
  }
}

TEST_F(Search, DoesNotExecuteOrAnswerTheTelegramThatLocks) {
  SlaveBench bench(quick_search());
  initialised(bench);
  bench.run_cycles(33 * 4);
  EXPECT_TRUE(ask(bench, 61, Prm{}.bytes()).silent());
  EXPECT_EQ(bench.chip.status().baud_index.code(), 0);
  EXPECT_EQ(bench.dp_state(), DpState::kWaitPrm);
  EXPECT_EQ(bench.count(Reason::kPrmAccepted), 0);
  EXPECT_TRUE(bench.fdl_status().answered());
  EXPECT_TRUE(is_sc(ask(bench, 61, Prm{}.bytes())));
}

TEST_F(Search, LocksOnSd1Sd2AndSd3OfAnybody) {
  const Bytes eight = {1, 2, 3, 4, 5, 6, 7, 8};
  for (const bus::Telegram& telegram :
       {kToNobody, kToChip, bus::make_telegram(100, 2, 0x6D, {1}),
        bus::prefer_sd3(bus::make_telegram(100, 2, 0x6D, eight)), bus::make_telegram(127, 2, 0x46, {0, 0}, 58, 62),
        bus::make_telegram(5, 127, 0x6D, {1})}) {  // S32: 127 as source may lock, too
    SlaveBench bench(quick_search());
    initialised(bench);
    bench.run_cycles(33 * 4);
    bench.requester.send(bench.timeline, telegram);
    EXPECT_EQ(bench.chip.status().baud_index.code(), 0) << static_cast<int>(telegram.kind);
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
  EXPECT_EQ(bench.chip.status().baud_index.code(), 15);
}

TEST_F(Search, DoesNotLockOnTrafficAtAnotherRate) {
  SlaveBench bench(quick_search());
  initialised(bench);
  bench.requester.set_baud(5);  // while the chip listens at 12M, 6M ...
  for (int i = 0; i < 3; ++i) bench.requester.send(bench.timeline, kToNobody, {.wants_answer = false});
  EXPECT_EQ(bench.chip.status().baud_index.code(), 15);
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
  EXPECT_EQ(bench.chip.status().baud_index.code(), 15);
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
    // S22: the time is first. S9: the same telegram then only restarts the search; it came before the restart and
    // locks nothing.
    EXPECT_EQ(bench.chip.status().baud_index.code(), in_time ? 0 : 15);
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
    bench.requester.send(bench.timeline, bus::make_telegram(5, 127, 0x49), {.wants_answer = false});  // S32
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

}  // namespace
}  // namespace dsdpv1::conformance
