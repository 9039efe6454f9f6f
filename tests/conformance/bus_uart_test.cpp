// The bit engine at the pins: tolerance of the receiver (S2, P9, S10), exact bits of the transmitter (P2).
#include <gtest/gtest.h>

#include "tests/conformance/master_side.hpp"

namespace dsdpv1::conformance {
namespace {

using bus::Character;

constexpr int kRates[] = {0, 1, 3, 5};  // 4, 8, 32, 256 cycles a bit

Bytes fdl_status_request() { return bus::encode(bus::make_telegram(5, 2, kFdlStatus)); }

/// The requirements of S2 and P9 for a receiver, computed on the wire of a sender with a wrong clock: the first edge
/// strictly after the start edge starts the character; the edges half a bit and whole bits later sample it.
class SamplingOracle {
 public:
  SamplingOracle(Tick start, Tick bit, std::int64_t ppm, const Bytes& bytes) : start_(start), bit_(bit), ppm_(ppm) {
    for (const std::uint8_t byte : bytes) {
      const Character character = Character::of(byte);
      for (int i = 0; i < bus::kCharacterBits; ++i) levels_.push_back((character.bits >> i & 1) != 0);
    }
  }

  bool accepts() const {
    for (std::size_t first = 0; first < levels_.size(); first += bus::kCharacterBits)
      if (!accepts_character(first)) return false;
    return true;
  }

 private:
  Tick edge(std::size_t index) const {  // as the sender rounds it
    const std::int64_t nominal = static_cast<std::int64_t>(index) * 1000 * bit_;
    return start_ + (nominal + nominal * ppm_ / 1'000'000 + 500) / 1000;
  }
  bool level_before(Tick tick, std::size_t near) const {
    std::size_t index = near == 0 ? 0 : near - 1;
    while (index + 1 <= levels_.size() && edge(index + 1) < tick) ++index;
    return index >= levels_.size() || levels_[index];
  }
  bool accepts_character(std::size_t first) const {
    const Tick base = profibus::first_edge_after(edge(first)) * kCycleTicks + bit_ / 2;
    for (std::size_t i = 0; i < bus::kCharacterBits; ++i)
      if (level_before(base + static_cast<Tick>(i) * bit_, first + i) != levels_[first + i]) return false;
    return true;
  }

  Tick start_, bit_;
  std::int64_t ppm_;
  std::vector<bool> levels_;
};

class ReceiverTolerance : public testing::TestWithParam<int> {
 protected:
  void SetUp() override { bench.to_wait_prm({}, GetParam()); }
  /// An FDL status request from a clock that is wrong by `ppm`, its start edge `phase` ticks after a rising edge of
  /// CLK.
  bool answered(std::int64_t ppm, Tick phase) {
    const Tick bit = bus::baud(GetParam()).bit;
    at_ = (bench.now() + 60 * bit) / kCycleTicks * kCycleTicks + phase;
    bench.requester.set_baud(GetParam(), ppm);
    const Exchange exchange = bench.requester.send(bench.timeline, fdl_status_request(), {.at = at_});
    bench.requester.set_baud(GetParam());
    bench.run_for(bit * 60);
    bench.chip.compare(bench.now());
    return exchange.answered();
  }
  bool oracle(std::int64_t ppm) const {
    return SamplingOracle(at_, bus::baud(GetParam()).bit, ppm, fdl_status_request()).accepts();
  }

  SlaveBench bench{quick_search()};
  Tick at_ = 0;
};

TEST_P(ReceiverTolerance, AcceptsExactlyWhatSamplingInMidBitCanRead) {
  int accepted = 0, refused = 0;
  for (std::int64_t ppm = -70'000; ppm <= 80'000; ppm += 1'500) {
    for (const Tick phase : {0, 1, 90, 180, 249}) {
      const bool answer = answered(ppm, phase);
      ASSERT_EQ(answer, oracle(ppm)) << ppm << " ppm, " << phase << " ticks behind the CLK edge";
      ++(answer ? accepted : refused);
    }
  }
  EXPECT_GT(accepted, 100);
  EXPECT_GT(refused, 100);
}

TEST_P(ReceiverTolerance, ReachesTheTheoreticalLimitButForTheQuantisation) {
  // The start edge is seen up to one cycle late, so samples lie 0 to 1 cycle after mid-bit. A slow clock must not
  // bring the parity bit to the stop sample: 10 b' < 10.5 b + d. A fast one not the next start bit: 11 b' >= 10.5 b +
  // d.
  const std::int64_t bit = bus::baud(GetParam()).bit;
  const std::int64_t slow = 1'000'000 * (bit / 2) / (10 * bit);
  const std::int64_t fast = 1'000'000 * (bit / 2 - kCycleTicks) / (11 * bit);
  for (const Tick phase : {0, 1, 125, 249}) {
    EXPECT_TRUE(answered(slow - 100, phase)) << slow - 100 << " ppm, phase " << phase;
    EXPECT_TRUE(answered(-(fast - 100), phase)) << -(fast - 100) << " ppm, phase " << phase;
  }
  const std::int64_t too_fast = 1'000'000 * (bit / 2) / (11 * bit) + 200;
  const std::int64_t too_slow = 1'000'000 * (bit / 2 + kCycleTicks) / (8 * bit) + 200;  // any data bit edge
  for (const Tick phase : {0, 1, 125, 249}) {
    EXPECT_FALSE(answered(too_slow, phase)) << too_slow << " ppm, phase " << phase;
    EXPECT_FALSE(answered(-too_fast, phase)) << -too_fast << " ppm, phase " << phase;
  }
  EXPECT_TRUE(answered(0, 0));
}

INSTANTIATE_TEST_SUITE_P(Rates, ReceiverTolerance, testing::ValuesIn(kRates),
                         [](const auto& at) { return "Code" + std::to_string(at.param); });

// --- glitches (S10)

class Glitches : public testing::Test {
 protected:
  void SetUp() override { bench.to_wait_prm({}, 4); }
  Exchange request(const bus::WireFaults& faults) {
    Exchange exchange = bench.requester.send(bench.timeline, fdl_status_request(), {.idle_bits = 60, .faults = faults});
    bench.run_for(bench.requester.bit() * 60);
    bench.chip.compare(bench.now());
    return exchange;
  }
  /// The line low for `length` ticks, `after` ticks from now.
  void low(Tick after, Tick length) {
    bench.run_for(after);
    bench.segment.force(bench.now(), false);
    bench.run_for(length);
    bench.segment.force(bench.now(), std::nullopt);
  }

  SlaveBench bench{quick_search()};
};

TEST_F(Glitches, BesideTheSampleOfAnyBitAreIgnored) {
  const std::size_t size = fdl_status_request().size();
  for (std::size_t character = 0; character < size; ++character) {
    for (int bit = 0; bit < bus::kCharacterBits; ++bit) {
      for (const int offset : {50, 560}) {  // before and after mid-bit
        bus::WireFaults faults;
        faults.glitch_at = character;
        faults.glitch = {bit * 1000 + offset, 400};
        ASSERT_TRUE(request(faults).answered()) << "character " << character << ", bit " << bit << ", " << offset;
      }
    }
  }
}

TEST_F(Glitches, OnTheSampleOfAnyBitSpoilTheTelegram) {
  const std::size_t size = fdl_status_request().size();
  for (std::size_t character = 0; character < size; ++character) {
    for (int bit = 0; bit < bus::kCharacterBits; ++bit) {
      bus::WireFaults faults;
      faults.glitch_at = character;
      faults.glitch = {bit * 1000 + 400, 200};
      ASSERT_TRUE(request(faults).silent()) << "character " << character << ", bit " << bit;
      ASSERT_TRUE(request({}).answered()) << "the next right one, after character " << character << ", bit " << bit;
    }
  }
}

TEST_F(Glitches, ShorterThanHalfABitDoNotEndTheIdleTime) {
  const Tick bit = bench.requester.bit();
  for (const Tick length : {bit / 100, bit / 4, bit / 2 - kCycleTicks}) {
    ASSERT_TRUE(request({}).answered());
    bench.requester.send(bench.timeline, bus::encode(bus::make_telegram(9, 2, kFdlStatus)), {.wants_answer = false});
    const Tick end = bench.requester.last_activity();
    low(10 * bit, length);
    low(15 * bit, length);
    const Exchange exchange = bench.requester.send(bench.timeline, fdl_status_request(), {.at = end + 33 * bit});
    EXPECT_TRUE(exchange.answered()) << "glitches of " << length << " ticks";
    bench.run_for(60 * bit);
  }
}

TEST_F(Glitches, LongerThanHalfABitAreAStartBitAndEndTheIdleTime) {
  const Tick bit = bench.requester.bit();
  bench.requester.send(bench.timeline, bus::encode(bus::make_telegram(9, 2, kFdlStatus)), {.wants_answer = false});
  const Tick end = bench.requester.last_activity();
  low(10 * bit, bit / 2 + 2 * kCycleTicks);
  EXPECT_TRUE(bench.requester.send(bench.timeline, fdl_status_request(), {.at = end + 40 * bit}).silent());
  bench.run_for(60 * bit);
  EXPECT_TRUE(request({}).answered());
}

TEST_F(Glitches, BehindTheLastStopBitDoNotVoidTheRequest) {
  bus::WireFaults faults;
  faults.glitch_at = fdl_status_request().size() - 1;
  faults.glitch = {10'700, 250};
  EXPECT_TRUE(request(faults).answered());
}

// --- the transmitter

class Transmitter : public testing::TestWithParam<int> {};

/// Level of a pin at a tick from its changes.
Level level_at(const std::vector<PinChange>& changes, Tick tick, Level before) {
  for (const PinChange& change : changes)
    if (change.at <= tick) before = change.level;
  return before;
}

std::vector<PinChange> since(const std::vector<PinChange>& changes, Tick tick) {
  std::vector<PinChange> found;
  for (const PinChange& change : changes)
    if (change.at >= tick) found.push_back(change);
  return found;
}

TEST_P(Transmitter, EveryBitIsExactInCyclesWithEvenParity) {
  SlaveBench bench(quick_search());
  bench.to_wait_prm({}, GetParam());
  const Exchange exchange = ask(bench, bus::sap::kSlaveDiag);
  ASSERT_TRUE(exchange.answered());
  const Tick bit = bus::baud(GetParam()).bit;
  const auto txd = since(bench.changes(Pin::kPbtxd), exchange.request_end);
  ASSERT_FALSE(txd.empty());
  const Tick start = txd.front().at;
  EXPECT_EQ(start, exchange.answer_start());
  EXPECT_EQ(start % kCycleTicks, 0);
  for (const PinChange& change : txd) EXPECT_EQ((change.at - start) % bit, 0) << "an edge off the grid of bits";
  std::size_t at = 0;
  for (const std::uint8_t byte : exchange.raw) {
    const Character character = Character::of(byte);
    for (int i = 0; i < bus::kCharacterBits; ++i, ++at) {
      ASSERT_EQ(level_at(txd, start + static_cast<Tick>(at) * bit, 1), (character.bits >> i) & 1)
          << "character " << at / 11 << ", bit " << i;
    }
  }
  EXPECT_EQ(txd.back().level, 1);
  EXPECT_LT(txd.back().at, start + static_cast<Tick>(at) * bit);
}

INSTANTIATE_TEST_SUITE_P(AllRates, Transmitter, testing::Range(0, bus::kBaudCount),
                         [](const auto& at) { return "Code" + std::to_string(at.param); });

void expect_driver(const dsdpv1::Config& config, std::uint32_t lead, std::uint32_t trail) {
  SlaveBench bench(config);
  bench.to_wait_prm({}, 0);
  for (const bool wide : {false, true}) {
    const Exchange exchange = wide ? ask(bench, bus::sap::kSlaveDiag) : bench.fdl_status();
    ASSERT_TRUE(exchange.answered());
    bench.run_cycles(trail + 10);
    const auto rts = since(bench.changes(Pin::kPbrts), exchange.request_start);
    ASSERT_EQ(rts.size(), 2U);
    EXPECT_EQ(rts[0].level, 1);
    EXPECT_EQ(rts[0].at, exchange.answer_start() - static_cast<Tick>(lead) * kCycleTicks);
    EXPECT_EQ(rts[1].level, 0);
    EXPECT_EQ(rts[1].at, exchange.answer_end() + static_cast<Tick>(trail) * kCycleTicks);
  }
}

TEST(Driver, IsEnabledFourCyclesBeforeAndAfter) { expect_driver(quick_search(), 4, 4); }
TEST(Driver, TakesOtherTimesFromTheConfiguration) {
  for (const auto& [lead, trail] :
       std::vector<std::pair<std::uint32_t, std::uint32_t>>{{0, 0}, {1, 0}, {0, 1}, {20, 37}}) {
    dsdpv1::Config config = quick_search();
    config.rts_lead = lead;
    config.rts_trail = trail;
    expect_driver(config, lead, trail);
  }
}

TEST(Driver, StaysOffAndThePinHighWhenNothingIsAnswered) {
  SlaveBench bench(quick_search());
  bench.to_wait_prm();
  bench.requester.send(bench.timeline, bus::make_telegram(9, 2, kFdlStatus));
  bench.requester.send(bench.timeline, bus::make_token(5, 2), {.wants_answer = false});
  bench.run_cycles(1000);
  EXPECT_EQ(bench.chip.level(Pin::kPbtxd), 1);
  EXPECT_EQ(bench.chip.level(Pin::kPbrts), 0);
  EXPECT_TRUE(bench.changes(Pin::kPbtxd).size() <= 1 && bench.changes(Pin::kPbrts).size() <= 1);
}

TEST(Driver, IsOffAtOnceWhenAnInitialisationOrAResetComesInAnAnswer) {
  for (const bool reset : {false, true}) {
    SlaveBench bench(quick_search());
    bench.to_wait_prm({}, 9);  // an answer of 17 characters takes 20 ms
    bench.requester.send(bench.timeline, bus::make_telegram(5, 2, kSrdFirst, {}, 60, 62), {.wants_answer = false});
    bench.run_for(bench.requester.bit() * 40);
    ASSERT_EQ(bench.chip.level(Pin::kPbrts), 1);
    if (reset)
      bench.chip.set(bench.now(), Pin::kReset, 0);
    else
      ASSERT_TRUE(bench.initialise());
    EXPECT_EQ(bench.chip.level(Pin::kPbrts), 0);
    EXPECT_EQ(bench.chip.level(Pin::kPbtxd), 1);
    bench.run_ms(1);
    EXPECT_EQ(bench.chip.level(Pin::kPbrts), 0);
  }
}

TEST(Driver, NeverFightsWithTheRequester) {
  SlaveBench bench(quick_search());
  int collisions = 0;
  bench.segment.on_collision = [&](const bus::Collision&) { ++collisions; };
  bench.to_data_exch();
  for (int i = 0; i < 20; ++i) EXPECT_TRUE(bench.data_exchange({1, 2}).answered());
  EXPECT_EQ(collisions, 0);
}

}  // namespace
}  // namespace dsdpv1::conformance
