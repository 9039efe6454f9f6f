// The buffers against the oracle (buffer_oracle.hpp): random telegrams and commands, until every edge of every state
// was taken.
#include <random>
#include <set>

#include "tests/spc3/bench.hpp"
#include "tests/spc3/buffer_oracle.hpp"

namespace dsdpv1::spc3_test {
namespace {

namespace oracle = spc3_oracle;

constexpr std::size_t kStates = 12;  // of D, N, U, F

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  unsigned below(unsigned end) { return static_cast<unsigned>(engine_() % end); }

 private:
  std::mt19937 engine_;
};

// --- Dout and Din ----------------------------------------------------------------------------------------------------

class BuffersByOracle : public testing::TestWithParam<Variant> {
 protected:
  static constexpr std::uint8_t kSync = 0x20, kUnsync = 0x10, kFreeze = 0x08, kUnfreeze = 0x04, kClear = 0x02;

  void SetUp() override {
    bench.power_on();
    bench.initialise();
    bench.start();
    bench.find_baud();
    told(dout.clear());
    compare();
  }
  void to_data_ex() {
    bench.set_prm({}, 0xB0);
    bench.check_cfg();
    bench.load(regs::kCfgOk);
    new_din();
    bench.run_cycles(2);
    ASSERT_EQ(bench.state(), DpState::kDataExch);
  }
  /// True if DX_OUT has come since the last call.
  void told(bool expected) {
    EXPECT_EQ(bench.raised(regs::kEventDxOut), expected);
    bench.acknowledge(0xFFFF);
  }
  void compare() {
    EXPECT_EQ(bench.load(regs::kDoutSm), dout.sm());
    EXPECT_EQ(bench.load(regs::kDinSm), din.sm());
  }
  void note(int event) {
    out_edges.insert({dout.sm(), dout.sync, dout.filled, event});
    in_edges.insert({din.sm(), din.freeze, event});
  }
  void new_din() { EXPECT_EQ(bench.load(regs::kNewDin), din.new_din()); }
  void control(std::uint8_t command) {
    bench.control(command);
    bool dx = (command & kClear) != 0 && dout.clear();
    if ((command & (kSync | kUnsync)) != 0) dx = dout.command((command & kUnsync) == 0) || dx;
    if ((command & (kFreeze | kUnfreeze)) != 0) din.command((command & kUnfreeze) == 0);
    told(dx);
  }
  void act(int event) {
    note(event);
    switch (event) {
      case 0:
        bench.exchange({1, 2});
        din.answer();
        return told(dout.telegram());
      case 1: EXPECT_EQ(bench.load(regs::kNextDout), dout.next()); return;
      case 2: return new_din();
      case 3: bench.ask(56); return din.answer();
      case 4: return control(kSync);
      case 5: return control(kUnsync);
      case 6: return control(kFreeze);
      case 7: return control(kUnfreeze);
      case 8: return control(kClear);
      case 9: return control(kClear | kSync | kFreeze);
      default: return leave();
    }
  }
  void leave() {
    bench.set_mode1(regs::kMode1UserLeaveMaster);
    bench.run_cycles(2);
    dout.sync = din.freeze = false;
    told(dout.clear());
    to_data_ex();
    bench.acknowledge(0xFFFF);
  }
  static constexpr unsigned kEvents = 11;

  Bench bench{GetParam()};
  oracle::Dout dout;
  oracle::Din din;
  std::set<std::tuple<int, bool, bool, int>> out_edges;
  std::set<std::tuple<int, bool, int>> in_edges;
};
INSTANTIATE_TEST_SUITE_P(Names, BuffersByOracle, testing::Values(Variant::kApc3, Variant::kVpc3));

TEST_P(BuffersByOracle, TakesEveryEdgeAsTheOracleDoes) {
  to_data_ex();
  bench.acknowledge(0xFFFF);
  Random random(7);
  // filled only under Sync: three pairs of the two; each with every event
  const std::size_t all_out = kStates * 3 * kEvents, all_in = kStates * 2 * kEvents;
  for (int i = 0; i < 40'000 && (out_edges.size() < all_out || in_edges.size() < all_in) && !HasFailure(); ++i) {
    act(static_cast<int>(random.below(random.below(2) == 0 ? kEvents : 4)));
    compare();
  }
  EXPECT_EQ(out_edges.size(), all_out);
  EXPECT_EQ(in_edges.size(), all_in);
}

// --- Diagnosis -------------------------------------------------------------------------------------------------------

/// New_Diag while the chip sends, at given ticks.
class LateUser : public bus::Agent {
 public:
  LateUser(Bench& bench, oracle::Diagnosis& oracle) : bench_(bench), oracle_(oracle) {}
  void plan(std::vector<Tick> at) {
    at_ = std::move(at);
    turn_ = 0;
    announce();
  }
  Tick next() const override { return turn_ < at_.size() ? at_[turn_] : bus::kNever; }
  void run(Tick /*now*/) override {
    ++turn_;
    EXPECT_EQ(bench_.load(regs::kNewDiag), oracle_.new_diag());
    EXPECT_EQ(bench_.load(regs::kDiagSm), oracle_.sm());
  }

 private:
  Bench& bench_;
  oracle::Diagnosis& oracle_;
  std::vector<Tick> at_;
  std::size_t turn_ = 0;
};

TEST(Diagnoses, AreExchangedAsTheOracleDoes) {
  Bench bench;
  bench.to_data_ex();
  oracle::Diagnosis oracle;
  LateUser late(bench, oracle);
  bench.timeline.add(late);
  Random random(3);
  std::set<std::tuple<int, bool, unsigned>> edges;
  int changed = 0;
  std::array<bool, 2> stat{};
  const auto compare = [&] {
    EXPECT_EQ(bench.load(regs::kDiagSm), oracle.sm());
    EXPECT_EQ((bench.load(regs::kStatus) & regs::kStatusDiagFlag) != 0, oracle.flag);
    EXPECT_EQ(bench.raised(regs::kEventDiagChanged), oracle.changed > changed);
    changed = oracle.changed;
    bench.acknowledge(0xFFFF);
  };
  for (int i = 0; i < 300; ++i) {
    const unsigned late_ones = random.below(3);
    const bool by_holder = random.below(2) == 0, new_stat = random.below(2) == 0;
    edges.insert({oracle.sm(), oracle.flag, late_ones});
    if (random.below(2) == 0) {
      const auto user = static_cast<std::size_t>(oracle.user);
      bench.fill(static_cast<spc3::Address>(regs::kOrgDiagPointer + user - 1),
                 {new_stat ? std::uint8_t{2} : std::uint8_t{0}});
      stat[user - 1] = new_stat;
      EXPECT_EQ(bench.load(regs::kNewDiag), oracle.new_diag());
      compare();
    }
    const Tick bit = bench.requester.bit(), begin = bench.now() + 40 * bit;
    // Its 11 characters, one bit, T_SDR of 11 bits, and RTS before it: the answer has 17 characters.
    const Tick sends = begin + 11 * 11 * bit + 14 * bit;
    std::vector<Tick> at;
    for (unsigned k = 0; k < late_ones; ++k) at.push_back(sends + 40 * bit * (k + 1));
    const auto flags_of_chip = static_cast<std::size_t>(oracle.chip - 1);
    const bool sent_stat = stat[flags_of_chip];
    if (late_ones > 0) stat[static_cast<std::size_t>(oracle.user - 1)] = false;
    oracle.accepted();
    late.plan(at);
    if (late_ones > 0)  // the buffer that will be sent next: as the chip or the user has left it
      bench.fill(static_cast<spc3::Address>(regs::kOrgDiagPointer + oracle.user - 1), {0});
    const auto telegram = bus::make_telegram(5, by_holder ? 2 : 9, 0x6D, {}, 60, 62);
    EXPECT_EQ(kind_of(bench.requester.send(bench.timeline, telegram, {.at = begin})), "DL");
    bench.run_cycles(30);
    oracle.sent(by_holder, sent_stat);
    compare();
    // byte 0 of the buffer that was sent is the chip's now: Stat_Diag only when the user writes it again
    if (HasFailure()) return;
  }
  EXPECT_EQ(edges.size(), 2U * 2U * 3U);
}

// --- Prm, Cfg, SSA ---------------------------------------------------------------------------------------------------

class Blocks : public testing::TestWithParam<unsigned> {
 protected:
  void SetUp() override {
    Organisation given;
    given.aux_select = static_cast<std::uint8_t>(GetParam());
    bench.to_wait_prm(given);
    bench.store(regs::kOrgAuxLength, 20);
    bench.store(regs::kOrgAuxLength + 1, 12);
    bench.acknowledge(0xFFFF);
    expected.select = GetParam();
    expected.aux = {kAux, kAux + 8};
    expected.room = {20, 12};
    expected.target = {kPrm, kCfg, kSsa};
    expected.read_cfg = kReadCfg;
  }
  void compare() {
    const auto cell = [this](spc3::Address address) { return int{bench.load(address)}; };
    EXPECT_EQ(cell(regs::kOrgAuxPointer), expected.aux[0]);
    EXPECT_EQ(cell(regs::kOrgAuxPointer + 1), expected.aux[1]);
    EXPECT_EQ(cell(regs::kOrgPrmPointer), expected.target[oracle::kPrm]);
    EXPECT_EQ(cell(regs::kOrgCfgPointer), expected.target[oracle::kCfg]);
    EXPECT_EQ(cell(regs::kOrgSsaPointer), expected.target[oracle::kSsa]);
    EXPECT_EQ(cell(regs::kOrgReadCfgPointer), expected.read_cfg);
    EXPECT_EQ(cell(regs::kOrgPrmLength), expected.size[oracle::kPrm]);
    EXPECT_EQ(cell(regs::kOrgCfgLength), expected.size[oracle::kCfg]);
    EXPECT_EQ(cell(regs::kOrgSsaLength), expected.size[oracle::kSsa]);
    EXPECT_EQ(bench.raised(regs::kEventNewPrm), expected.event[oracle::kPrm]);
    EXPECT_EQ(bench.raised(regs::kEventNewCfg), expected.event[oracle::kCfg]);
    EXPECT_EQ(bench.raised(regs::kEventNewSsa), expected.event[oracle::kSsa]);
  }
  void drop_both() {
    expected.drop(oracle::kPrm);
    expected.drop(oracle::kCfg);
  }
  void telegram(oracle::Kind kind, int size, const bus::Exchange& answer) {
    EXPECT_EQ(kind_of(answer), expected.telegram(kind, size) ? "SC" : "RR");
  }
  void verdict(oracle::Kind kind, bool good) {
    const bool prm = kind == oracle::kPrm, change = !prm && good && changes;
    const spc3::Address cell = prm ? (good ? regs::kPrmOk : regs::kPrmNotOk) : good ? regs::kCfgOk : regs::kCfgNotOk;
    const int answer = expected.answer(kind, change);
    EXPECT_EQ(bench.load(cell), answer);
    bench.run_cycles(2);
    if (answer == 0 && !good) drop_both();
  }
  void act(unsigned event) {
    const bool wait_prm = bench.state() == DpState::kWaitPrm;
    const auto size = static_cast<int>(random.below(18));
    switch (event) {
      case 0: return telegram(oracle::kPrm, 8 + size, bench.set_prm(Bytes(static_cast<std::size_t>(1 + size), 0)));
      case 1: {
        const bus::Exchange answer = bench.check_cfg(Bytes(static_cast<std::size_t>(5 + size), 0));
        if (!wait_prm) return telegram(oracle::kCfg, 5 + size, answer);
        EXPECT_EQ(kind_of(answer), "RS");
        return;
      }
      case 2: {
        Bytes data = {5, 0x0C, 0xC9, 0};
        data.resize(static_cast<std::size_t>(4 + size));
        const bus::Exchange answer = bench.ask(55, data);
        if (wait_prm) return telegram(oracle::kSsa, 4 + size, answer);
        EXPECT_EQ(kind_of(answer), "RS");
        return;
      }
      case 3: return verdict(oracle::kPrm, true);
      case 4: return verdict(oracle::kPrm, false);
      case 5: return verdict(oracle::kCfg, true);
      case 6: return verdict(oracle::kCfg, false);
      case 7: EXPECT_EQ(bench.load(regs::kSsaFree), 0); return expected.drop(oracle::kSsa);
      case 8: bench.set_prm(); return drop_both();
      case 9:
        bench.set_mode1(regs::kMode1UserLeaveMaster);
        bench.run_cycles(2);
        return drop_both();
      case 10:
        changes = !changes;
        bench.store(changes ? regs::kMode1S : regs::kMode1R, regs::kMode1EnChangeCfg);
        return;
      default:
        bench.acknowledge(0xFFFF);
        expected.event[oracle::kSsa] = false;
        return;
    }
  }

  Bench bench;
  oracle::Control expected;
  Random random{11};
  bool changes = false;
};
INSTANTIATE_TEST_SUITE_P(AuxSelections, Blocks, testing::Range(0U, 8U));

TEST_P(Blocks, AreExchangedAsTheOracleDoes) {
  std::set<std::tuple<oracle::Stage, oracle::Stage, oracle::Stage>> stages;
  for (int i = 0; i < 1500; ++i) {
    SCOPED_TRACE(i);
    act(random.below(12));
    compare();
    stages.insert({expected.stage[0], expected.stage[1], expected.stage[2]});
    if (HasFailure()) return;
  }
  EXPECT_GE(stages.size(), 11U);
}

}  // namespace
}  // namespace dsdpv1::spc3_test
