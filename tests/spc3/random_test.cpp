// Random users and masters: step and skip agree, states may be saved at any moment, and whatever the user writes, the
// chip keeps its own rules.
#include <random>

#include "tests/spc3/bench.hpp"

namespace dsdpv1::spc3_test {
namespace {

/// Accesses and saved states in the middle of telegrams.
class Meddler : public bus::Agent {
 public:
  Meddler(Bench& bench, std::mt19937& random) : bench_(bench), random_(random) {}
  void begin() {
    left_ = static_cast<int>(random_() % 12);
    plan();
  }
  Tick next() const override { return left_ > 0 ? at_ : bus::kNever; }
  void run(Tick now) override {
    --left_;
    bench_.twins.compare(now);  // also a saved state in the middle of a telegram
    switch (random_() % 4) {
      case 0: bench_.load(static_cast<spc3::Address>(random_() % 0x18)); break;
      case 1: bench_.store(regs::kMode1S, static_cast<std::uint8_t>(1U << random_() % 6)); break;
      default: move_bus();
    }
    plan();
  }

 private:
  /// Any pins of the CPU's bus, also in the order of no access.
  void move_bus() {
    for (int i = 0; i < 4; ++i) {
      const auto pin = static_cast<Pin>(spc3::number(Pin::kXCs) + random_() % 6);
      const unsigned end = pin == Pin::kAb ? 0x18U : pin == Pin::kDbIn ? 0x100U : 2U;
      bench_.twins.set(bench_.now(), pin, static_cast<spc3::Level>(random_() % end));
    }
    if (random_() % 4 == 0) bench_.twins.sample(bench_.now());
  }
  void plan() {
    at_ = bench_.now() + static_cast<Tick>(random_() % (random_() % 2 == 0 ? 400'000 : 3'000));
    announce();
  }
  Bench& bench_;
  std::mt19937& random_;
  Tick at_ = 0;
  int left_ = 0;
};

class RandomRuns : public testing::TestWithParam<unsigned> {
 protected:
  static spc3::Config config_of(unsigned seed) {
    spc3::Config config;
    config.search_window_ms = 1;
    config.search_window_bits = 400;
    config.violation = seed / 3 % 2;
    config.prm7 = seed / 6 % 2;
    config.prm_taken = seed / 2 % 2;
    config.address_cells = seed / 4 % 2;
    config.event_delay = seed % 2 == 0 ? 32 : 192;
    config.int_delay = seed % 5;
    config.clock = seed % 3 == 1 ? 24 : 48;
    config.ram_seed = seed;
    config.ready = 1 + seed % 7;
    config.ready_rule = seed / 2 % 2;
    return config;
  }
  unsigned below(unsigned end) { return static_cast<unsigned>(random() % end); }
  std::uint8_t byte() { return static_cast<std::uint8_t>(below(256)); }
  Bytes bytes(unsigned most) {
    Bytes all(below(most + 1));
    for (std::uint8_t& each : all) each = byte();
    return all;
  }

  void begin() {
    Organisation given;
    given.aux_select = static_cast<std::uint8_t>(below(8));
    given.modes = static_cast<std::uint16_t>(regs::kMode0DpMode | (byte() & 0xD8) | (below(64) & 0x36) << 8U);
    given.inputs = static_cast<std::uint8_t>(below(4));
    given.outputs = static_cast<std::uint8_t>(below(4));
    given.user_watchdog = static_cast<std::uint16_t>(below(40));
    bench.store(regs::kMode1S, regs::kMode1GoOffline);
    bench.run_cycles(2000);
    bench.initialise(given);
    bench.store(regs::kWdBaudControl, static_cast<std::uint8_t>(below(3)));
    if (below(2) == 0) bench.load(regs::kNewDin);
    bench.start();
    for (int i = 0; i < 3; ++i) bench.ask(60);
    bench.set_prm(Bytes(below(10), 0), 0xB0, 0, 0, 0, 1);
    bench.run_cycles(400);
    bench.load(regs::kPrmOk);
    bench.check_cfg();
    bench.run_cycles(400);
    bench.load(regs::kCfgOk);
    bench.load(regs::kNewDin);
    bench.run_cycles(2);
  }
  void telegram() {
    constexpr int kSaps[] = {kDefaultSap, kDefaultSap, kDefaultSap, 55, 56, 57, 58, 59, 60, 60, 61, 62, 33};
    const int sap = kSaps[below(13)];
    const auto master = static_cast<std::uint8_t>(below(20) == 0 ? 7 : 2);
    meddler.begin();
    const auto wd = static_cast<std::uint8_t>(below(8) == 0 ? 0x08 : 0x00);
    switch (sap) {
      case 58:
        return bench.control(static_cast<std::uint8_t>(1U << below(8)), static_cast<std::uint8_t>(below(2)), master);
      case 61: {
        const Bytes user = below(3) == 0 ? Bytes{} : bytes(70);
        const auto status = static_cast<std::uint8_t>((below(8) == 0 ? 0x40 : 0x80) | (byte() & 0x30) | wd);
        bench.set_prm(user, status, byte(), 1, byte(), 1, master);
        return;
      }
      case 62: bench.ask(62, bytes(70), master); return;
      case 55: bench.ask(55, below(2) == 0 ? bytes(6) : Bytes{5, 0x0C, 0xC9, 0, 1}, master); return;
      case kDefaultSap: bench.repeat(sap, Bytes(bench.organisation.outputs, byte()), master, below(2) == 0); return;
      default: bench.repeat(sap, below(9) == 0 ? bytes(3) : Bytes{}, master, below(2) == 0); return;
    }
  }
  void access() {
    const auto anywhere = static_cast<spc3::Address>(below(0x1000));
    const auto cell = static_cast<spc3::Address>(below(0x40));
    switch (below(12)) {
      case 0: bench.store(below(6) == 0 ? anywhere : cell, byte()); return;
      case 1: bench.load(below(6) == 0 ? anywhere : cell); return;
      case 2: bench.load(regs::kPrmOk); return;
      case 3: bench.load(regs::kCfgOk); return;
      case 4: bench.load(regs::kNewDin); return;
      case 5: bench.load(regs::kNextDout); return;
      case 6: bench.load(regs::kNewDiag); return;
      case 7: bench.acknowledge(static_cast<std::uint16_t>(below(0x10000))); return;
      case 8: bench.set_mode1(regs::kMode1Eoi); return;
      case 9: bench.store(regs::kMode1S, static_cast<std::uint8_t>(1U << below(8))); return;
      case 10: bench.store(static_cast<spc3::Address>(regs::kImr + below(2)), byte()); return;
      default: bench.load(static_cast<spc3::Address>(0x0E + below(7))); return;
    }
  }
  void reset() {
    bench.twins.set(bench.now() + below(250), Pin::kReset, 1);
    bench.run_cycles(below(10));
    bench.twins.set(bench.now() + below(250), Pin::kReset, 0);
    bench.run_cycles(5);
  }
  void act() {
    const unsigned what = below(400);
    if (what == 0) return reset();
    if (what < 8) return bench.run_until(bench.now() + static_cast<Tick>(below(3'000'000)));
    if (what < 10) return bench.run_ms(below(60));
    if (bench.state() != DpState::kDataExch && below(30) == 0) return begin();
    if (what < 200) return telegram();
    access();
  }
  void check() {
    const spc3::Chip& chip = bench.twins.chip();
    const auto word = [&](spc3::Address low) {
      return chip.peek(low) | chip.peek(static_cast<spc3::Address>(low + 1)) << 8;
    };
    EXPECT_EQ(word(regs::kIr) & ~word(regs::kIrr), 0);
    for (const spc3::Address machine : {regs::kDinSm, regs::kDoutSm}) {
      unsigned present = 0;
      for (int place = 0; place < 8; place += 2) present |= 1U << (chip.peek(machine) >> place & 3);
      EXPECT_EQ(present, 0xFU) << "each buffer once, and one nil";
    }
    const bool exchanges = bench.state() == DpState::kDataExch;
    EXPECT_EQ(chip.level(Pin::kXDataExch), exchanges ? 0 : 1);
    exchanged |= exchanges;
  }

  std::mt19937 random{GetParam()};
  Bench bench{static_cast<Variant>(GetParam() % 3), config_of(GetParam())};
  Meddler meddler{bench, random};
  bool exchanged = false;
};
INSTANTIATE_TEST_SUITE_P(Seeds, RandomRuns, testing::Range(0U, 12U));

TEST_P(RandomRuns, StepAndSkipAgreeAndStatesContinue) {
  bench.timeline.add(meddler);
  bench.twins.restored = 3;
  bench.power_on();
  begin();
  for (int i = 0; i < 1500 && !HasFailure(); ++i) {
    SCOPED_TRACE(i);
    act();
    bench.run_cycles(1);
    check();
  }
  EXPECT_TRUE(exchanged);
}

}  // namespace
}  // namespace dsdpv1::spc3_test
