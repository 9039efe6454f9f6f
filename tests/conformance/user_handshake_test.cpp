// Ownership of the DPRAM: figures 4 and 5; rulings H1, H2, H3, H8, P9.
#include <random>
#include <string>

#include "tests/conformance/user_helpers.hpp"

namespace dsdpv1::conformance {
namespace {

constexpr Cycle kInterval = 48, kShortest = 7;

/// Up and running, B012 and B004 written: nothing is due any more.
void idle_chip(SlaveBench& bench) {
  bench.power_on();
  bench.chip_accesses(3);
}

void set(SlaveBench& bench, Tick at, Pin pin, Level level) {
  bench.run_until(at);
  bench.chip.set(at, pin, level);
}

TEST(UserHandshake, UndisturbedAccessesComeEvery48CyclesAndLast7) {
  SlaveBench bench;
  idle_chip(bench);
  const std::size_t first = accesses(bench).size();
  bench.run_ms(2);
  const std::vector<Access> found = accesses(bench);
  ASSERT_GT(found.size(), first + 1900);
  for (std::size_t i = first; i < found.size(); ++i) {
    ASSERT_EQ(found[i].length(), kShortest);
    ASSERT_EQ(found[i].rise - found[i - 1].rise, kInterval);
  }
  EXPECT_EQ(bench.chip.status().longest_wait, 0U);
  for (const PinChange& change : bench.chip.trace()) EXPECT_EQ(change.at % kCycleTicks, 0);
}

TEST(UserHandshake, IntervalIsAParameter) {
  dsdpv1::Config config;
  config.access_interval = 100;
  SlaveBench bench(config);
  idle_chip(bench);
  bench.run_ms(1);
  const std::vector<Access> found = accesses(bench);
  EXPECT_EQ(found.back().rise - found[found.size() - 2].rise, 100);
}

TEST(UserHandshake, RequestHoldsTheChipOffAndReleaseLetsItInAtOnceAtEveryPhase) {
  SlaveBench bench;
  idle_chip(bench);
  Cycle longest = 0;
  for (Tick offset = 0; offset < kInterval * kCycleTicks; offset += 83) {
    const Cycle start = run_to_l_sta(bench, 1);
    const Tick asked = start * kCycleTicks + offset;
    const Tick released = asked + 100 * kCycleTicks + offset / 7;
    set(bench, asked, Pin::kRReq, 1);
    // Due at start + 48; held off when the logic sees the request by then. Otherwise that access is made, and the next
    // one waits.
    const bool held = seen_at(asked) <= start + kInterval;
    const Cycle due = held ? start + kInterval : start + 2 * kInterval;
    bench.run_until(released - 1);
    EXPECT_EQ(last_rise(bench), due - kInterval) << "offset " << offset;
    EXPECT_EQ(bench.chip.level(Pin::kLSta), 0);
    set(bench, released, Pin::kRReq, 0);
    run_to_cycle(bench, std::max(seen_at(released), due));
    EXPECT_EQ(last_rise(bench), std::max(seen_at(released), due)) << "offset " << offset;
    longest = std::max(longest, seen_at(released) - due);
    EXPECT_EQ(bench.chip.status().longest_wait, static_cast<std::uint64_t>(longest));
  }
}

TEST(UserHandshake, ChipMayStartUpTo2CyclesAfterTheRequestAndNotLater) {
  SlaveBench bench;
  idle_chip(bench);
  Tick latest = 0;
  for (Tick before = 0; before < 1200; before += 13) {
    const Cycle due = run_to_l_sta(bench, 1) + kInterval;
    const Tick asked = due * kCycleTicks - before;
    set(bench, asked, Pin::kRReq, 1);
    bench.run_cycles(20);
    if (last_rise(bench) == due) latest = std::max(latest, before);
    bench.chip.set(bench.now(), Pin::kRReq, 0);
    bench.run_cycles(60);
  }
  EXPECT_GT(latest, 2 * kCycleTicks - 14);
  EXPECT_LE(latest, 2 * kCycleTicks) << "H2";
}

TEST(UserHandshake, RunningAccessIsFinished) {
  SlaveBench bench;
  idle_chip(bench);
  for (Cycle into = 0; into < kShortest; ++into) {
    const Cycle start = run_to_l_sta(bench, 1);
    set(bench, (start + into) * kCycleTicks + 1, Pin::kRReq, 1);
    bench.run_cycles(20);
    EXPECT_EQ(accesses(bench).back().length(), kShortest);
    bench.chip.set(bench.now(), Pin::kRReq, 0);
    bench.run_cycles(60);
  }
}

TEST(UserHandshake, ReleaseBetweenTwoHoldsLetsTheChipInWhenAnEdgeSamplesIt) {
  SlaveBench bench;
  idle_chip(bench);
  for (const Tick phase : {0, 1, 120, 249}) {
    for (const Tick low : {1, 100, 249, 250, 300, 3000}) {
      bench.chip.set(bench.now(), Pin::kRReq, 1);
      bench.run_cycles(150);
      const std::size_t before = accesses(bench).size();
      const Tick released = (bench.now() / kCycleTicks + 1) * kCycleTicks + phase;
      set(bench, released, Pin::kRReq, 0);
      set(bench, released + low, Pin::kRReq, 1);
      bench.run_cycles(30);
      const bool sampled = sampled_at(released + low) > sampled_at(released);
      EXPECT_EQ(accesses(bench).size() - before, sampled ? 1U : 0U) << "low for " << low << ", phase " << phase;
      EXPECT_TRUE(!sampled || last_rise(bench) == seen_at(released));
      bench.chip.set(bench.now(), Pin::kRReq, 0);
      bench.run_cycles(60);
    }
  }
}

TEST(UserHandshake, OneCycleLowBetweenAccessesAlsoWhenOverdue) {
  SlaveBench bench;
  Init init;
  init.cfg = {0x40, 0x73};  // 52 input words make the access longer than the interval
  bench.power_on();
  ASSERT_TRUE(bench.initialise(init));
  bench.chip_accesses(3);
  bench.give_inputs(Bytes(104, 0x11));
  bench.run_cycles(300);
  const std::vector<Access> found = accesses(bench);
  bool overdue = false;
  for (std::size_t i = 1; i < found.size(); ++i) {
    ASSERT_GE(found[i].rise - found[i - 1].fall, 1);
    if (found[i - 1].length() < kInterval) continue;
    overdue = true;
    EXPECT_EQ(found[i].rise, found[i - 1].fall + 1);
  }
  EXPECT_TRUE(overdue);
}

TEST(UserHandshake, OverlongAccessesLeaveTheOneLowCycleToAUserWhoWaits) {
  SlaveBench bench;
  idle_chip(bench);
  bench.acquire();
  bench.write_block(regs::kInit, Init{}.block(), regs::kInitCrc);
  bench.write(regs::kUserCommand1, regs::kUserCommand1Init);
  bench.release();
  run_to_l_sta(bench, 1);
  bench.chip.set(bench.now(), Pin::kRReq, 1);
  const Cycle end = run_to_l_sta(bench, 0);
  bench.run_cycles(500);
  EXPECT_EQ(accesses(bench).back().fall, end) << "the chip waits for the user";
}

TEST(UserHandshake, UsersWaitIsAtMostTheRunningAccess) {
  SlaveBench bench;
  idle_chip(bench);
  Tick longest = 0;
  for (Tick offset = 0; offset < kInterval * kCycleTicks; offset += 111) {
    const Cycle start = run_to_l_sta(bench, 1);
    bench.run_until(start * kCycleTicks + offset);
    const Tick asked = bench.now();
    bench.chip.set(asked, Pin::kRReq, 1);
    bench.run_cycles(3);
    while (bench.chip.level(Pin::kLSta) != 0) bench.run_for(10);
    longest = std::max(longest, bench.now() - asked);
    bench.chip.set(bench.now(), Pin::kRReq, 0);
    bench.run_cycles(60);
  }
  EXPECT_GE(longest, (kShortest + 1) * kCycleTicks);
  EXPECT_LE(longest, (kShortest + 3) * kCycleTicks);
}

TEST(UserHandshake, UserWhoRaisesStateWhileTheChipOwnsIsReported) {
  SlaveBench bench;
  idle_chip(bench);
  run_to_l_sta(bench, 1);
  bench.run_for(333);
  bench.chip.set(bench.now(), Pin::kRReq, 1);
  EXPECT_EQ(bench.count(dsdpv1::Reason::kBothOwn), 0);
  bench.chip.set(bench.now(), Pin::kRSta, 1);
  const Tick both = bench.now();
  bench.run_cycles(20);
  EXPECT_EQ(bench.count(dsdpv1::Reason::kBothOwn), 1);
  EXPECT_EQ(bench.last(dsdpv1::Reason::kBothOwn).at, both);
}

TEST(UserHandshake, ChipThatStartsOnAnImpatientUserIsReported) {
  SlaveBench bench;
  idle_chip(bench);
  const Cycle due = run_to_l_sta(bench, 1) + kInterval;
  set(bench, due * kCycleTicks - 400, Pin::kRReq, 1);
  bench.chip.set(bench.now(), Pin::kRSta, 1);  // sooner than H2 allows
  bench.run_cycles(20);
  EXPECT_EQ(last_rise(bench), due);
  EXPECT_EQ(bench.count(dsdpv1::Reason::kBothOwn), 1);
  EXPECT_EQ(bench.last(dsdpv1::Reason::kBothOwn).at, due * kCycleTicks);
}

// H1, until an audit, read "with or without R_STA"; 5.1 releases with R_REQ = 0 and R_STA = 0.
TEST(UserHandshake, StateAloneHoldsTheChipOffAndReleaseLetsItInAtOnceAtEveryPhase) {
  SlaveBench bench;
  idle_chip(bench);
  for (Tick offset = 0; offset < kInterval * kCycleTicks; offset += 83) {
    const Cycle start = run_to_l_sta(bench, 1);
    const Tick raised = start * kCycleTicks + offset;
    const Tick lowered = raised + 100 * kCycleTicks + offset / 7;
    const int overlaps = bench.count(dsdpv1::Reason::kBothOwn);
    set(bench, raised, Pin::kRSta, 1);  // nothing was asked for
    const bool held = seen_at(raised) <= start + kInterval;
    const Cycle due = held ? start + kInterval : start + 2 * kInterval;
    set(bench, lowered, Pin::kRSta, 0);
    EXPECT_EQ(last_rise(bench), due - kInterval) << "offset " << offset;
    run_to_cycle(bench, std::max(seen_at(lowered), due));
    EXPECT_EQ(last_rise(bench), std::max(seen_at(lowered), due)) << "offset " << offset;
    const bool in_access = raised < (start + kShortest) * kCycleTicks;
    EXPECT_EQ(bench.count(dsdpv1::Reason::kBothOwn) - overlaps, in_access || !held ? 1 : 0) << "offset " << offset;
  }
  EXPECT_GT(bench.chip.status().longest_wait, 90U) << "R_STA made it wait";
}

struct Release {
  Pin first, later;
  Tick apart;
};

class ReleaseOf : public testing::TestWithParam<Release> {};

// The text of figure 5: the two may be pulled low with a delay between them.
TEST_P(ReleaseOf, IsCompleteWithTheLaterAtEveryPhase) {
  const Release release = GetParam();
  SlaveBench bench;
  idle_chip(bench);
  for (Tick phase = 0; phase < kCycleTicks; phase += 31) {
    bench.acquire();
    bench.run_cycles(2 * kInterval);  // an access is overdue
    const std::size_t before = accesses(bench).size();
    const Tick first = (bench.now() / kCycleTicks + 1) * kCycleTicks + phase;
    set(bench, first, release.first, 0);
    set(bench, first + release.apart, release.later, 0);
    const Cycle start = seen_at(first + release.apart);
    run_to_cycle(bench, start - 1);
    EXPECT_EQ(accesses(bench).size(), before);
    EXPECT_EQ(bench.chip.level(Pin::kLSta), 0) << "phase " << phase;
    run_to_cycle(bench, start);
    EXPECT_EQ(bench.chip.level(Pin::kLSta), 1) << "phase " << phase;
    bench.chip_accesses();
  }
  expect_no_violation(bench);
}

std::vector<Release> releases() {
  std::vector<Release> all = {{Pin::kRReq, Pin::kRSta, 0}};
  for (const Tick apart : {1L, 100L, 249L, 250L, 251L, 500L, 750L, 12'000L, 300'000L}) {
    all.push_back({Pin::kRReq, Pin::kRSta, apart});
    all.push_back({Pin::kRSta, Pin::kRReq, apart});
  }
  return all;
}

INSTANTIATE_TEST_SUITE_P(UserHandshake, ReleaseOf, testing::ValuesIn(releases()), [](const auto& at) {
  return std::string(at.param.first == Pin::kRReq ? "RequestFirst" : "StateFirst") + std::to_string(at.param.apart);
});

TEST(UserHandshake, ReleaseTakenBackBeforeStateFallsOpensNoWindow) {
  SlaveBench bench;
  idle_chip(bench);
  for (const Tick phase : {0, 1, 120, 249}) {
    for (const Tick low : {250, 1000, 5000}) {
      for (const Tick overlap : {-300, -250, -249, -1, 0, 1, 249, 250, 3000}) {
        bench.acquire();
        bench.run_cycles(2 * kInterval);
        const std::size_t before = accesses(bench).size();
        const Tick dropped = (bench.now() / kCycleTicks + 1) * kCycleTicks + phase;
        const Tick asked_again = dropped + low, state_low = asked_again + overlap;
        std::vector<PinChange> changes = {
            {dropped, Pin::kRReq, 0}, {asked_again, Pin::kRReq, 1}, {state_low, Pin::kRSta, 0}};
        std::stable_sort(changes.begin(), changes.end(), [](const auto& x, const auto& y) { return x.at < y.at; });
        for (const PinChange& change : changes) set(bench, change.at, change.pin, change.level);
        bench.run_cycles(30);
        const Cycle both_low = std::max(sampled_at(dropped), sampled_at(state_low));
        const bool window = both_low < sampled_at(asked_again);
        EXPECT_EQ(accesses(bench).size() - before, window ? 1U : 0U) << "phase " << phase << ", overlap " << overlap;
        bench.chip.set(bench.now(), Pin::kRReq, 0);
        bench.run_cycles(60);
      }
    }
  }
  expect_no_violation(bench);
}

TEST(UserHandshake, AccessCountIsSetByEveryAccessOfTheChipAndIncrementedByTheUser) {
  SlaveBench bench;
  idle_chip(bench);
  for (int round = 0; round < 20; ++round) {
    bench.acquire();
    ASSERT_EQ(bench.read(regs::kAccessCount), 1) << "the chip has been there since";
    bench.write(regs::kAccessCount, 2);
    bench.run_cycles(4);
    ASSERT_EQ(bench.read(regs::kAccessCount), 2);
    bench.release();
    const Cycle start = run_to_l_sta(bench, 1);
    ASSERT_EQ(bench.peek(regs::kAccessCount), 2);
    run_to_cycle(bench, start + 1);
    ASSERT_EQ(bench.peek(regs::kAccessCount), 1) << "the first move of the access";
    bench.chip_accesses();
  }
}

TEST(UserHandshake, AccessCountShowsTwoHoldsWithoutTheChipBetween) {
  SlaveBench bench;
  idle_chip(bench);
  run_to_l_sta(bench, 0);
  bench.acquire();
  bench.write(regs::kAccessCount, static_cast<std::uint8_t>(bench.read(regs::kAccessCount) + 1));
  bench.chip.set(bench.now(), Pin::kRSta, 0);  // R_REQ stays: the chip is not let in
  bench.run_cycles(200);
  bench.chip.set(bench.now(), Pin::kRSta, 1);
  EXPECT_EQ(bench.read(regs::kAccessCount), 2);
}

// --- contention ------------------------------------------------------------------------------------------------------

/// A user that takes the DPRAM again and again at random times, keeps H2, gives one input block a hold, fetches
/// outputs, and lowers the two pins in either order.
class RandomUser : public bus::Agent {
 public:
  RandomUser(SlaveBench& bench, unsigned seed, Tick most_gap) : bench_(bench), random_(seed), most_gap_(most_gap) {
    bench.timeline.add(*this);
    wait(draw(1, most_gap_), &RandomUser::ask);
  }
  void stop() { stopping_ = true; }
  bool idle() const { return step_ == nullptr; }

  Tick next() const override { return step_ == nullptr ? bus::kNever : at_; }
  void run(Tick now) override {
    now_ = now;
    const auto step = std::exchange(step_, nullptr);
    (this->*step)();
  }

  int holds = 0, given = 0, refused = 0;
  Tick longest_wait = 0;
  std::vector<std::uint8_t> fetched;

 private:
  using Step = void (RandomUser::*)();
  Tick draw(Tick from, Tick to) { return std::uniform_int_distribution<Tick>(from, to)(random_); }
  void wait(Tick time, Step step) {
    at_ = now_ + time;
    step_ = step;
    announce();
  }
  void ask() {
    bench_.chip.set(now_, Pin::kRReq, 1);
    asked_ = now_;
    wait(draw(3 * kCycleTicks, 12 * kCycleTicks), &RandomUser::look);
  }
  void look() {
    if (bench_.chip.level(Pin::kLReq) != 0 || bench_.chip.level(Pin::kLSta) != 0) {
      if (draw(0, 20) == 0) return give_up();
      return wait(draw(10, 2000), &RandomUser::look);
    }
    longest_wait = std::max(longest_wait, now_ - asked_);
    wait(draw(0, 5000), &RandomUser::take);  // the chip stays away while R_REQ is high
  }
  void give_up() {
    bench_.chip.set(now_, Pin::kRReq, 0);
    wait(draw(1, most_gap_), &RandomUser::ask);
  }
  void take() {
    bench_.chip.set(now_, Pin::kRSta, 1);
    ++holds;
    wait(draw(0, 300), &RandomUser::work);
  }
  void work() {
    // The cells are read by peek and written through the pins: the strobes have separate tests.
    const std::uint8_t flags = bench_.chip.peek(regs::kUserCommand1), command = bench_.chip.peek(regs::kChipCommand1);
    if ((bench_.chip.peek(regs::kChipStatus2) & regs::kChipStatus2InputCrc) != 0) ++refused;
    if ((flags & regs::kUserCommand1Input) == 0 && draw(0, 1) == 0) plan_inputs();
    if ((command & regs::kChipCommand1Output) != 0) fetch(command);
    next_write();
  }
  void plan_inputs() {
    ++given;
    const auto low = static_cast<std::uint8_t>(given & 0xFF), high = static_cast<std::uint8_t>(given >> 8);
    const Bytes block = {2, high, low};
    const std::uint16_t crc = document_crc(block);
    writes_ = {{0x130, 2},
               {0x131, high},
               {0x132, low},
               {0x225, static_cast<std::uint8_t>(crc >> 8)},
               {0x226, static_cast<std::uint8_t>(crc & 0xFF)},
               {regs::kUserCommand1, regs::kUserCommand1Input}};
  }
  void fetch(std::uint8_t command) {
    const Bytes block = {bench_.peek(0x319), bench_.peek(0x31A), bench_.peek(0x31B)};
    const int crc = bench_.peek(0x40E) << 8 | bench_.peek(0x40F);
    EXPECT_EQ(crc, document_crc(block)) << "torn outputs";
    EXPECT_EQ(block[1] ^ 0xFF, block[2]) << "torn outputs";
    fetched.push_back(block[1]);
    writes_.emplace_back(regs::kChipCommand1, static_cast<std::uint8_t>(command & ~regs::kChipCommand1Output));
  }
  void next_write() {
    if (writes_.empty()) return wait(draw(750, 20'000), &RandomUser::leave);
    bench_.chip.set(now_, Pin::kA, static_cast<Level>(writes_.front().first));
    bench_.chip.set(now_, Pin::kDIn, writes_.front().second);
    bench_.chip.set(now_, Pin::kCsr, 0);
    bench_.chip.set(now_, Pin::kWr, 0);
    wait(draw(150, 900), &RandomUser::strobe);
  }
  void strobe() {
    bench_.chip.set(now_, Pin::kWr, 1);
    writes_.pop_front();
    wait(draw(150, 500), &RandomUser::next_write);
  }
  void leave() {
    bench_.chip.set(now_, Pin::kCsr, 1);
    bench_.chip.set(now_, Pin::kDIn, dsdpv1::kLevelZ);
    lower_ = draw(0, 1) == 0 ? Pin::kRReq : Pin::kRSta;
    lower_one();
    wait(draw(0, 3000), &RandomUser::finish);
  }
  void finish() {
    lower_one();
    if (!stopping_) wait(draw(1, most_gap_), &RandomUser::ask);
  }
  void lower_one() {  // one of the two, then the other
    bench_.chip.set(now_, lower_, 0);
    lower_ = lower_ == Pin::kRReq ? Pin::kRSta : Pin::kRReq;
  }

  SlaveBench& bench_;
  std::mt19937 random_;
  Tick most_gap_, now_ = 0, at_ = 0, asked_ = 0;
  Step step_ = nullptr;
  Pin lower_ = Pin::kRReq;
  bool stopping_ = false;
  std::deque<std::pair<std::uint16_t, std::uint8_t>> writes_;
};

class Contention : public testing::TestWithParam<unsigned> {};

TEST_P(Contention, NeverBothOwnNothingIsTornOrLost) {
  SlaveBench bench;
  bench.to_data_exch();
  bench.chip_accesses();
  if (bench.fetch_outputs()) bench.chip_accesses();
  RandomUser user(bench, GetParam(), GetParam() % 2 == 0 ? 4'000 : 60'000);
  int last_input = 0;
  std::uint8_t output = 0;
  for (int i = 0; i < 2000; ++i) {
    ++output;
    const bus::Exchange exchange = bench.data_exchange({output, static_cast<std::uint8_t>(output ^ 0xFF)});
    ASSERT_TRUE(exchange.answered());
    ASSERT_EQ(exchange.answer().data.size(), 2U);
    const int input = exchange.answer().data[0] << 8 | exchange.answer().data[1];
    ASSERT_GE(input, last_input) << "inputs go backwards";
    ASSERT_LE(input, user.given);
    last_input = input;
  }
  user.stop();
  bench.run_ms(1);
  ASSERT_TRUE(user.idle());
  bench.chip_accesses(3);
  const bus::Exchange exchange = bench.data_exchange({0x80, 0x7F});
  EXPECT_EQ(exchange.answer().data[0] << 8 | exchange.answer().data[1], user.given) << "the last inputs arrived";
  bench.chip_accesses(3);
  EXPECT_EQ(bench.fetch_outputs(), (Bytes{0x80, 0x7F})) << "the last outputs arrived";
  expect_no_violation(bench);
  EXPECT_EQ(bench.count(dpram::Reason::kInputCrc), 0);
  EXPECT_EQ(user.refused, 0);
  EXPECT_GT(user.holds, 400);
  EXPECT_GT(user.given, 50);
  EXPECT_GT(user.fetched.size(), 50U);
  EXPECT_GT(bench.chip.status().longest_wait, 0U);
  EXPECT_LT(user.longest_wait, 100 * kCycleTicks);
  RecordProperty("holds", user.holds);
}

INSTANTIATE_TEST_SUITE_P(UserHandshake, Contention, testing::Range(1U, 9U));

}  // namespace
}  // namespace dsdpv1::conformance
