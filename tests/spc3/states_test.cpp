// From power-on to DATA_EX and out of it: MAC and DP states, START, Go_Offline, Leave_Master (docs/spc3.md, "State
// machines").
#include "tests/spc3/bench.hpp"

namespace dsdpv1::spc3_test {
namespace {

using spc3::Reason;

class EachName : public testing::TestWithParam<Variant> {};
INSTANTIATE_TEST_SUITE_P(Names, EachName, testing::Values(Variant::kApc3, Variant::kSpc3, Variant::kVpc3),
                         [](const auto& tested) { return std::string(spc3::row(tested.param).name); });

TEST_P(EachName, FromPowerOnToDataExchange) {
  Bench bench(GetParam());
  bench.power_on();
  EXPECT_EQ(bench.load(regs::kStatus), 0x00);
  EXPECT_EQ(bench.load(regs::kStatus + 1) & 0x0F, 0x0F) << "no rate";
  bench.initialise();
  bench.start();
  EXPECT_EQ(bench.load(regs::kStatus), 0x01) << "PASSIVE_IDLE, WAIT_PRM, search";
  EXPECT_EQ(bench.load(regs::kStatus + 1) & 0x0F, 0x00) << "12 Mbit/s is tried";
  EXPECT_EQ(bench.load(regs::kDoutSm), 0x27) << "cleared outputs in N (A17)";
  EXPECT_TRUE(bench.raised(regs::kEventDxOut));
  bench.find_baud();
  EXPECT_TRUE(bench.raised(regs::kEventBaudDetect));
  EXPECT_EQ(bench.load(regs::kStatus), 0x41) << "BAUD_CONTROL";

  EXPECT_EQ(kind_of(bench.set_prm({0x00, 0x77})), "SC");
  EXPECT_TRUE(bench.raised(regs::kEventNewPrm));
  EXPECT_EQ(bench.load(regs::kOrgPrmLength), 9);
  EXPECT_EQ(bench.load(regs::kOrgPrmPointer), kAux) << "exchanged with Aux 1 (A22)";
  EXPECT_EQ(bench.load(regs::kOrgAuxPointer), kPrm);
  EXPECT_EQ(bench.buffer(regs::kOrgPrmPointer, 9), (Bytes{0x80, 0, 0, 0, 0x0C, 0xC9, 0, 0x00, 0x77}));
  EXPECT_EQ(bench.load(regs::kStatus), 0x51) << "WAIT_CFG when it is received (A49)";
  EXPECT_EQ(bench.load(regs::kPrmOk), regs::kVerdictFinished);
  EXPECT_FALSE(bench.raised(regs::kEventNewPrm)) << "the answer takes the event back (A14)";

  EXPECT_EQ(kind_of(bench.check_cfg()), "SC");
  EXPECT_TRUE(bench.raised(regs::kEventNewCfg));
  EXPECT_EQ(bench.buffer(regs::kOrgCfgPointer, bench.load(regs::kOrgCfgLength)), (Bytes{0x12, 0x21}));
  bench.acknowledge(0xFFFF);
  EXPECT_EQ(bench.irr(), regs::kEventNewCfg) << "IAR does not clear it (A15)";
  EXPECT_EQ(bench.load(regs::kCfgOk), regs::kVerdictFinished);
  bench.run_cycles(2);
  if (GetParam() != Variant::kVpc3) {
    EXPECT_EQ(bench.state(), DpState::kWaitCfg) << "no inputs yet (A24)";
    EXPECT_EQ(bench.count(Reason::kExchangeWaits), 1);
  }
  bench.give_inputs({1, 2, 3});
  bench.run_cycles(2);
  EXPECT_EQ(bench.load(regs::kStatus), 0x61);
  EXPECT_TRUE(bench.raised(regs::kEventDataEx));
  EXPECT_EQ(bench.twins.chip().level(Pin::kXDataExch), 0);
  const bus::Exchange answer = bench.exchange({0x55, 0xAA});
  EXPECT_EQ(kind_of(answer), "DL");
  EXPECT_EQ(answer.answer().data, (Bytes{1, 2, 3}));
  EXPECT_EQ(bench.fetch_outputs(), (Bytes{0x55, 0xAA}));
}

TEST_P(EachName, TheEventComesAfterItsDelay) {
  Bench bench(GetParam());
  bench.to_data_ex();
  bench.acknowledge(regs::kEventDxOut);
  const auto telegram = bus::make_telegram(5, 2, 0x6D, {1, 2});
  const bus::Exchange sent = bench.requester.send(bench.timeline, telegram, {.wants_answer = false});
  // S10: decided one bit time after the last stop bit, whose end the logic sees three edges later
  const Cycle decided = sent.request_end / profibus::kTicksPerCycle + 3 + 4 + 1;
  bench.run_until((decided + 31) * profibus::kTicksPerCycle);
  EXPECT_FALSE(bench.raised(regs::kEventDxOut));
  bench.run_cycles(1);
  EXPECT_TRUE(bench.raised(regs::kEventDxOut)) << "A40";
  bench.run_ms(1);
}

TEST(States, DelaysOfAnSpc3With24MhzAreTwiceAsLong) {
  spc3::Config config;
  config.clock = 24;
  Bench bench(Variant::kSpc3, config);
  bench.to_data_ex();
  bench.acknowledge(0xFFFF);
  bench.set_mode1(regs::kMode1Eoi);
  bench.run_cycles(100);
  const auto telegram = bus::make_telegram(5, 2, 0x6D, {1, 2});
  const bus::Exchange sent = bench.requester.send(bench.timeline, telegram, {.wants_answer = false});
  const Cycle decided = sent.request_end / profibus::kTicksPerCycle + 3 + 4 + 1;
  bench.run_until((decided + 63) * profibus::kTicksPerCycle);
  EXPECT_FALSE(bench.raised(regs::kEventDxOut));
  bench.run_cycles(1);
  EXPECT_TRUE(bench.raised(regs::kEventDxOut)) << "A44";
  bench.run_cycles(1);
  EXPECT_EQ(bench.twins.chip().level(Pin::kXInt), 1);
  bench.run_cycles(1);
  EXPECT_EQ(bench.twins.chip().level(Pin::kXInt), 0);
  bench.run_ms(1);
}

TEST(States, NoInputsNeedNoNewDin) {
  Bench bench;
  Organisation given;
  given.inputs = 0;
  bench.to_data_ex(given);
  EXPECT_EQ(kind_of(bench.exchange({1, 2})), "SC");
}

TEST(States, InputsMayBeGivenBeforeStart) {
  Bench bench;
  bench.power_on();
  bench.initialise();
  EXPECT_EQ(bench.give_inputs({7, 8, 9}), 3);
  bench.start();
  bench.find_baud();
  bench.set_prm();
  bench.check_cfg();
  bench.load(regs::kCfgOk);
  bench.run_cycles(2);
  EXPECT_EQ(bench.state(), DpState::kDataExch);
  EXPECT_EQ(bench.exchange({1, 2}).answer().data, (Bytes{7, 8, 9}));
}

TEST(States, DataExchangeWaitsForTheAnswerToTheParametersToo) {
  Bench bench;
  bench.to_wait_prm();
  bench.give_inputs({1, 2, 3});
  bench.set_prm({0});
  EXPECT_EQ(kind_of(bench.check_cfg()), "SC") << "WAIT_CFG already (A49)";
  EXPECT_EQ(bench.load(regs::kCfgOk), 0);
  bench.run_cycles(2);
  EXPECT_EQ(bench.state(), DpState::kWaitCfg);
  EXPECT_EQ(bench.load(regs::kPrmOk), 0);
  bench.run_cycles(2);
  EXPECT_EQ(bench.state(), DpState::kDataExch);
}

TEST(States, ParametersMayWaitForTheirVerdict) {
  spc3::Config config;
  config.prm_taken = 1;
  Bench bench(Variant::kApc3, config);
  bench.to_wait_prm();
  bench.set_prm({0});
  EXPECT_EQ(bench.state(), DpState::kWaitPrm);
  EXPECT_EQ(kind_of(bench.check_cfg()), "RS");
  EXPECT_EQ(bench.load(regs::kPrmOk), 0);
  EXPECT_EQ(bench.state(), DpState::kWaitCfg);
}

TEST(States, DpModeOffAnswersOnlyFdlStatus) {
  Bench bench;
  Organisation given;
  given.modes = 0;
  bench.to_wait_prm(given);
  EXPECT_EQ(bench.count(Reason::kNoDpMode), 1);
  EXPECT_EQ(kind_of(bench.ask(60)), "silent");
  const bus::Exchange status = bench.requester.send(bench.timeline, bus::make_telegram(5, 2, 0x49));
  EXPECT_TRUE(status.answered());
}

TEST(States, GoOfflineOnASilentLineIsAtOnce) {
  Bench bench;
  bench.to_data_ex();
  bench.acknowledge(0xFFFF);
  bench.set_mode1(regs::kMode1GoOffline);
  bench.run_cycles(1);
  EXPECT_EQ(bench.load(regs::kStatus), 0x00);
  EXPECT_EQ(bench.load(regs::kDoutSm), 0xE1) << "A17";
  EXPECT_EQ(bench.load(regs::kDinSm), 0xE1);
  EXPECT_TRUE(bench.raised(regs::kEventMacReset | regs::kEventDataEx));
  EXPECT_EQ(kind_of(bench.exchange({1, 2})), "silent");
  bench.run_ms(3);
  bench.start();
  EXPECT_EQ(bench.state(), DpState::kWaitPrm);
  bench.find_baud();
  EXPECT_EQ(kind_of(bench.ask(60)), "DL");
}

/// Writes a cell at a time.
class UserAt : public bus::Agent {
 public:
  UserAt(Bench& bench, Tick at, Address cell, std::uint8_t value) : bench_(bench), at_(at), cell_(cell), value_(value) {
    bench.timeline.add(*this);
  }
  Tick next() const override { return at_; }
  void run(Tick /*now*/) override {
    bench_.store(cell_, value_);
    at_ = bus::kNever;
    announce();
  }
  bool has_written() const { return at_ == bus::kNever; }

 private:
  Bench& bench_;
  Tick at_;
  const Address cell_;
  const std::uint8_t value_;
};

TEST(States, GoOfflineWaitsForTheTelegramAndItsAnswer) {
  for (int round = 0; round < 2; ++round) {  // as a run and as edges
    Bench bench;
    bench.to_data_ex();
    for (int i = 0; i < round; ++i) bench.exchange({1, 2});
    const Tick begin = bench.now() + 40 * bench.requester.bit();
    const UserAt user(bench, begin + 30 * bench.requester.bit(), regs::kMode1S, regs::kMode1GoOffline);
    const bus::Exchange answer =
        bench.requester.send(bench.timeline, bus::make_telegram(5, 2, 0x6D, {0x31, 0x32}), {.at = begin});
    EXPECT_TRUE(user.has_written());
    EXPECT_EQ(kind_of(answer), "DL");
    bench.run_cycles(100);
    EXPECT_EQ(bench.state(), DpState::kOffline);
    EXPECT_TRUE(bench.raised(regs::kEventMacReset));
  }
}

// Its decision comes a bit time after its last stop bit (S10), and two edges later with the synchroniser.
TEST(States, GoOfflineWaitsForATelegramToAnotherStation) {
  Bench bench;
  bench.to_data_ex();
  const Tick bit = bench.requester.bit(), begin = bench.now() + 40 * bit;
  const UserAt user(bench, begin + 30 * bit, regs::kMode1S, regs::kMode1GoOffline);
  const bus::Exchange sent = bench.requester.send(bench.timeline, bus::make_telegram(9, 2, 0x6D, {0x31, 0x32}),
                                                  {.at = begin, .wants_answer = false});
  EXPECT_TRUE(user.has_written());
  EXPECT_EQ(bench.state(), DpState::kDataExch);
  const auto received = bench.twins.chip().status().telegrams_received;
  bench.run_cycles(100);
  EXPECT_EQ(bench.state(), DpState::kOffline);
  EXPECT_EQ(bench.twins.chip().status().telegrams_received, received + 1);
  const Tick offline = bench.changes(Pin::kXDataExch).back().at;
  EXPECT_GT(offline, sent.request_end + bit);
  EXPECT_LE(offline, sent.request_end + bit + 4 * profibus::kTicksPerCycle);
}

// The request began for another station.
TEST(States, AnAddressThatChangesInARequestIsThatOfItsDecision) {
  spc3::Config config;
  config.address_cells = 1;
  Bench bench(Variant::kApc3, config);
  bench.to_wait_prm();
  bench.ask(60);
  const Tick bit = bench.requester.bit(), begin = bench.now() + 40 * bit;
  const UserAt user(bench, begin + 30 * bit, regs::kOrgAddress, 9);
  const bus::Exchange answer =
      bench.requester.send(bench.timeline, bus::make_telegram(9, 2, 0x6D, {}, 60, 62), {.at = begin});
  EXPECT_TRUE(user.has_written());
  EXPECT_EQ(kind_of(answer), "DL");
  bench.run_cycles(100);
}

TEST(States, TelegramsAreTakenAsRuns) {
  Bench bench;
  bench.to_data_ex();
  const int taken = bench.twins.runs_taken;
  for (int i = 0; i < 4; ++i) bench.exchange({1, 2});
  EXPECT_EQ(bench.twins.runs_taken, taken + 2) << "every second one";
}

TEST(States, GoOfflineWaitsForTheEffectsOfTheLastTelegram) {
  Bench bench;
  bench.to_data_ex();
  bench.acknowledge(0xFFFF);
  bench.requester.send(bench.timeline, bus::make_telegram(bus::kBroadcast, 2, 0x46, {0x02, 0}, 58, 62),
                       {.wants_answer = false});
  bench.run_cycles(10);
  EXPECT_EQ(bench.irr(), 0);
  bench.set_mode1(regs::kMode1GoOffline);
  bench.run_cycles(5);
  EXPECT_EQ(bench.state(), DpState::kDataExch);
  bench.run_cycles(60);
  EXPECT_EQ(bench.state(), DpState::kOffline);
  EXPECT_TRUE(bench.raised(regs::kEventNewGc | regs::kEventDxOut | regs::kEventMacReset));
  EXPECT_EQ(bench.load(regs::kOrgGcCommand), 0x02);
}

TEST(States, StartAndGoOfflineInOneWrite) {
  Bench bench;
  bench.power_on();
  bench.initialise();
  bench.set_mode1(regs::kMode1Start | regs::kMode1GoOffline);
  bench.run_cycles(3);
  EXPECT_EQ(bench.state(), DpState::kWaitPrm) << "START when OFFLINE (A55)";
  bench.set_mode1(regs::kMode1Start);
  EXPECT_EQ(bench.count(Reason::kStartOnline), 1);
  bench.set_mode1(regs::kMode1Start | regs::kMode1GoOffline);
  bench.run_cycles(3);
  EXPECT_EQ(bench.state(), DpState::kOffline);
}

TEST(States, UserLeaveMasterClearsTheOutputs) {
  Bench bench;
  bench.to_data_ex();
  bench.exchange({0x11, 0x22});
  bench.fetch_outputs();
  bench.acknowledge(0xFFFF);
  bench.set_mode1(regs::kMode1UserLeaveMaster);
  bench.run_cycles(2);
  EXPECT_EQ(bench.state(), DpState::kWaitPrm);
  EXPECT_TRUE(bench.raised(regs::kEventDataEx | regs::kEventDxOut));
  int answer = 0;
  EXPECT_EQ(bench.fetch_outputs(&answer), (Bytes{0, 0}));
  EXPECT_EQ(answer & 0x0C, 0x0C) << "new, and cleared";
  EXPECT_EQ(bench.diag()[3], 255);
  EXPECT_EQ(kind_of(bench.exchange({1, 2})), "RS");
}

TEST(States, UnlockInWaitPrmClearsTheOutputsToo) {
  Bench bench;
  bench.to_wait_prm();
  bench.fetch_outputs();
  bench.acknowledge(0xFFFF);
  EXPECT_EQ(kind_of(bench.set_prm({}, 0x40)), "SC");
  EXPECT_TRUE(bench.raised(regs::kEventDxOut));
  EXPECT_FALSE(bench.raised(regs::kEventDataEx));
}

TEST(States, AWrongOutputLengthIsCfgFault) {
  Bench bench;
  bench.to_data_ex();
  EXPECT_EQ(kind_of(bench.exchange({1, 2, 3})), "RR");
  EXPECT_EQ(bench.state(), DpState::kWaitPrm);
  EXPECT_EQ(bench.diag()[0], 0x06) << "Cfg_Fault, not ready";
}

TEST(States, ParametersInDataExchangeLeadBackToWaitCfg) {
  Bench bench;
  bench.to_data_ex();
  bench.exchange({1, 2});
  bench.acknowledge(0xFFFF);
  bench.set_prm({0, 1});
  EXPECT_EQ(bench.state(), DpState::kWaitCfg);
  EXPECT_TRUE(bench.raised(regs::kEventDataEx | regs::kEventDxOut | regs::kEventNewPrm));
  bench.load(regs::kPrmOk);
  bench.check_cfg();
  bench.load(regs::kCfgOk);
  bench.run_cycles(2);
  EXPECT_EQ(bench.state(), DpState::kWaitCfg) << "nothing new in N of Din";
  bench.load(regs::kNewDin);
  bench.run_cycles(2);
  EXPECT_EQ(bench.state(), DpState::kDataExch);
}

TEST(ClearToSend, AnAnswerWaitsForXctsAndIsDroppedAfterItsTime) {
  Bench bench;
  bench.to_data_ex();
  struct User : bus::Agent {
    Bench& bench;
    Tick at = bus::kNever;
    explicit User(Bench& of) : bench(of) {}
    void plan(Tick when) {
      at = when;
      announce();
    }
    Tick next() const override { return at; }
    void run(Tick now) override {
      at = bus::kNever;
      bench.twins.set(now, Pin::kXCts, 0);
    }
  } user(bench);
  bench.timeline.add(user);
  const auto telegram = bus::make_telegram(5, 2, 0x6D, {1, 2});
  const Tick bit = bench.requester.bit(), length = 11 * 11 * bit;
  const double undisturbed = bench.requester.send(bench.timeline, telegram).tsdr_bits();
  bench.run_cycles(400);
  bench.twins.set(bench.now(), Pin::kXCts, 1);
  const Tick begin = bench.now() + 40 * bit;
  user.plan(begin + length + 18 * bit);
  const bus::Exchange late = bench.requester.send(bench.timeline, telegram, {.at = begin});
  EXPECT_EQ(kind_of(late), "DL");
  EXPECT_GT(late.tsdr_bits(), undisturbed + 4);
  EXPECT_LT(late.tsdr_bits(), undisturbed + 11);
  bench.run_cycles(400);
  bench.twins.set(bench.now(), Pin::kXCts, 1);
  EXPECT_EQ(kind_of(bench.exchange({3, 4})), "silent");
  EXPECT_EQ(bench.count(Reason::kNotClear), 1) << "A35";
  EXPECT_EQ(bench.fetch_outputs(), (Bytes{3, 4})) << "only the answer is lost";
  bench.twins.set(bench.now(), Pin::kXCts, 0);
  EXPECT_EQ(kind_of(bench.exchange({3, 4})), "DL");
}

TEST(States, ResetActsAtOnceAndKeepsTheRam) {
  Bench bench;
  bench.to_data_ex();
  bench.twins.set(bench.now() + 7, Pin::kReset, 1);
  EXPECT_EQ(bench.twins.chip().level(Pin::kXDataExch), 1);
  bench.run_cycles(5);
  EXPECT_EQ(bench.load(regs::kOrgDoutLength), 0) << "no access in reset";
  EXPECT_EQ(bench.count(Reason::kInReset), 1);
  bench.twins.set(bench.now(), Pin::kReset, 0);
  bench.run_cycles(2);
  EXPECT_EQ(bench.load(regs::kOrgDoutLength), 0) << "two flip-flops (A9)";
  bench.run_cycles(1);
  EXPECT_EQ(bench.load(regs::kOrgDoutLength), 2);
  EXPECT_EQ(bench.irr(), 0);
  EXPECT_EQ(bench.load(regs::kStatus), 0);
  bench.initialise();
  bench.start();
  bench.find_baud();
}

}  // namespace
}  // namespace dsdpv1::spc3_test
