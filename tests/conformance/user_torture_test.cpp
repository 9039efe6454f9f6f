// A user without manners: every input pin at random times, with and without a reset, while the master works.
// In every case step and skip agree in pins, events and DPRAM, the chip keeps its rules, and it works again
// afterwards.
#include <random>

#include "tests/conformance/user_helpers.hpp"

namespace dsdpv1::conformance {
namespace {

/// Toggles the user's pins at random for a while.
class RudeUser : public bus::Agent {
 public:
  RudeUser(SlaveBench& bench, unsigned seed, bool resets)
      : bench_(bench), random_(seed), resets_(resets), at_(bench.now() + 1) {
    bench.timeline.add(*this);
  }
  void stop() {
    at_ = bus::kNever;
    announce();
  }

  Tick next() const override { return at_; }
  void run(Tick now) override {
    toggle(now);
    at_ = now + 1 + static_cast<Tick>(random_() % (random_() % 16 == 0 ? 100'000 : 900));
  }

 private:
  void toggle(Tick now) {
    constexpr Pin kPins[] = {Pin::kRReq, Pin::kRSta, Pin::kCsr, Pin::kRd,   Pin::kWr,
                             Pin::kWr,   Pin::kA,    Pin::kDIn, Pin::kReset};
    const Pin pin = kPins[random_() % 9];
    if (pin == Pin::kReset && (!resets_ || (bench_.chip.level(pin) != 0 && random_() % 400 != 0))) return;
    Level level = bench_.chip.level(pin) == 0 ? Level{1} : Level{0};
    // Mostly the cells that make the chip do something.
    if (pin == Pin::kA) level = static_cast<Level>(random_() % 3 == 0 ? random_() % 0x800 : 0x005 + random_() % 0x30);
    if (pin == Pin::kDIn) level = static_cast<Level>(static_cast<int>(random_() % 257) - 1);
    bench_.chip.set(now, pin, level);
  }

  SlaveBench& bench_;
  std::mt19937 random_;
  bool resets_;
  Tick at_;
};

void calm_down(SlaveBench& bench) {
  bench.chip.set(bench.now(), Pin::kWr, 1);
  bench.chip.set(bench.now(), Pin::kRd, 1);
  bench.chip.set(bench.now(), Pin::kCsr, 1);
  bench.chip.set(bench.now(), Pin::kDIn, dsdpv1::kLevelZ);
  bench.release();
}

void expect_same_dpram(const SlaveBench& bench) {
  for (std::uint16_t cell = 0; cell < regs::kDpramSize; ++cell)
    ASSERT_EQ(bench.chip.peek(cell), bench.chip.peek_step(cell)) << "B" << std::hex << cell;
}

/// H1 and H8 whatever the user does; accesses broken off by a reset are shorter, even than a cycle.
void expect_own_rules(const SlaveBench& bench, bool resets) {
  const std::vector<Access> found = accesses(bench);
  for (std::size_t i = 0; i < found.size(); ++i) {
    ASSERT_GE(found[i].length(), resets ? 0 : 7);
    ASSERT_GE(i == 0 ? 1 : found[i].rise - found[i - 1].fall, 1);
  }
}

class Torture : public testing::TestWithParam<unsigned> {};

TEST_P(Torture, ChipSurvivesAndBothEnginesAgree) {
  const bool resets = GetParam() % 2 == 0;
  SlaveBench bench;
  bench.to_data_exch();
  RudeUser user(bench, GetParam(), resets);
  std::mt19937 random(GetParam());
  for (int i = 0; i < 150; ++i) {
    switch (random() % 6) {
      case 0: bench.set_prm({}); break;
      case 1: bench.check_cfg(); break;
      case 2: bench.slave_diag(); break;
      default: bench.data_exchange({static_cast<std::uint8_t>(i), 1}); break;
    }
    expect_same_dpram(bench);
    if (HasFatalFailure()) return;
  }
  user.stop();
  calm_down(bench);
  bench.run_ms(1);
  expect_own_rules(bench, resets);
  bench.chip.set(bench.now(), Pin::kReset, 0);
  bench.fcb = true;
  bench.fcb_valid = false;
  bench.to_data_exch();
  bench.give_inputs({3, 4});
  EXPECT_EQ(bench.data_exchange({1, 2}).answer().data, (Bytes{3, 4}));
  expect_same_dpram(bench);
}

INSTANTIATE_TEST_SUITE_P(User, Torture, testing::Range(1U, 41U));

TEST(UserTorture, ResetAtEveryTickRoundAnEdgeIsTheSameInBothEngines) {
  for (Tick offset = -5 * kCycleTicks; offset < 60 * kCycleTicks; offset += 125) {
    for (const Tick low : {1, 125, 250, 1000}) {
      SlaveBench bench;
      bench.run_cycles(10);
      bench.chip.set(bench.now(), Pin::kReset, 1);
      bench.run_cycles(2200);
      const Tick fall = bench.now() / kCycleTicks * kCycleTicks + 8 * kCycleTicks + offset;
      bench.run_until(fall);
      bench.chip.set(fall, Pin::kReset, 0);
      bench.run_until(fall + low);
      bench.chip.set(fall + low, Pin::kReset, 1);
      bench.run_cycles(2300);
      EXPECT_EQ(bench.chip.level(Pin::kReady), 0);
      expect_same_dpram(bench);
    }
  }
}

}  // namespace
}  // namespace dsdpv1::conformance
