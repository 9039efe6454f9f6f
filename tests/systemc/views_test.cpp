// One stimulus for the bare core, the pin module (CLK unbound, bound, with another phase) and the TLM module, in one
// simulation: every pin must change at the same tick of the chip.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "tests/systemc/stimulated.hpp"

namespace dsdpv1 {

using dsdpv1::systemc::to_time;
using stimulated::kEnd;
using stimulated::kFirstAccess;
using stimulated::kPhase;
using stimulated::StimulatedPins;
using stimulated::stimulus;
using stimulated::World;

namespace {

/// Changes at one tick may have any order of pins.
Changes sorted(Changes changes) {
  std::stable_sort(changes.begin(), changes.end(),
                   [](const Change& a, const Change& b) { return a.at != b.at ? a.at < b.at : a.pin < b.pin; });
  return changes;
}

Changes outputs(const Changes& all) {
  Changes some;
  std::copy_if(all.begin(), all.end(), std::back_inserter(some), [](const Change& c) { return !is_input(c.pin); });
  return sorted(some);
}

/// The output changes of the bare core.
Changes core_trace(Engine engine) {
  Config config;
  config.engine = engine;
  dsdpv1::Chip chip(config);
  Changes changes;
  chip.watch({[](void* self, Tick at, Pin pin, Level level) {
                static_cast<Changes*>(self)->push_back({at, pin, level});
              },
              &changes},
             dsdpv1::kOutputPins);
  for (const Change& c : stimulus()) chip.set(c.at, c.pin, c.level);
  chip.advance(kEnd);
  return sorted(changes);
}

/// RESET falls before the chip's next event and rises exactly at its tick, when a chip in RESET does nothing.
template <class Bench>
void reset_up_to_the_next_event(Bench& bench) {
  wait_until(kUs);
  bench.reset.write(true);
  wait_until(80 * kUs);
  const Tick due = bench.chip.chip().next_event();
  wait_until(due - 60);
  bench.reset.write(false);
  wait_until(due);
  bench.reset.write(true);
}

struct ResetPins : PinBench {
  ResetPins() : PinBench("reset_pins") {
    thread([this] { reset_up_to_the_next_event(*this); });
  }
};

struct ResetTlm : sc_core::sc_module {
  dsdpv1::systemc::TlmModule chip{"chip"};
  tlm_utils::simple_initiator_socket<ResetTlm> socket{"socket"};
  sc_core::sc_signal<bool> reset, r_req, r_sta, l_req;

  explicit ResetTlm(const sc_core::sc_module_name& name) : sc_module(name) {
    socket.bind(chip.host_socket);
    chip.RESET(reset), chip.R_REQ(r_req), chip.R_STA(r_sta), chip.L_REQ(l_req);
    thread([this] { reset_up_to_the_next_event(*this); });
  }
};

/// The chip is out of reset, and the user owns the DPRAM.
const Changes kOwnership = {
    {0, Pin::kDIn, kLevelZ}, {kUs, Pin::kReset, 1}, {100 * kUs, Pin::kRReq, 1}, {110 * kUs, Pin::kRSta, 1}};

/// The user already drives D while the chip still drives the same value: D does not change when the chip releases it.
struct SharedD : PinBench {
  static constexpr Tick kEdge = 124 * kUs;
  static constexpr Level kValue = 0x5A;

  SharedD() : PinBench("shared_d") {
    thread([this] {
      play(kOwnership);
      chip.poke(0x021, kValue);
      play({{120 * kUs, Pin::kA, 0x021},
            {120 * kUs, Pin::kCsr, 0},
            {120 * kUs, Pin::kRd, 0},
            {122 * kUs, Pin::kDIn, kValue},
            {123 * kUs, Pin::kRd, 1},
            {123 * kUs, Pin::kCsr, 1},
            {kEdge, Pin::kPbrxd, 0}});
    });
  }
};

/// A write whose CSR and WR rise together.
struct StrobesTogether : PinBench {
  static constexpr std::uint16_t kCell = 0x022;

  StrobesTogether() : PinBench("strobes_together") {
    thread([this] {
      play(kOwnership);
      play({{120 * kUs, Pin::kA, kCell},
            {120 * kUs, Pin::kDIn, 0x77},
            {120 * kUs, Pin::kCsr, 0},
            {120 * kUs, Pin::kWr, 0},
            {121 * kUs, Pin::kCsr, 1},
            {121 * kUs, Pin::kWr, 1}});
    });
  }
};

std::unique_ptr<World> world;
std::unique_ptr<StrobesTogether> strobes_together;
std::unique_ptr<SharedD> shared_d;
std::unique_ptr<ResetPins> reset_pins;
std::unique_ptr<ResetTlm> reset_tlm;

}  // namespace

void simulate() {
  set_resolution();
  collect_reports();
  world = std::make_unique<World>();
  strobes_together = std::make_unique<StrobesTogether>();
  shared_d = std::make_unique<SharedD>();
  reset_pins = std::make_unique<ResetPins>();
  reset_tlm = std::make_unique<ResetTlm>("reset_tlm");
  sc_core::sc_start(to_time(kEnd));
}

namespace {

TEST(Views, PinModuleWithoutClkFollowsTheCore) {
  EXPECT_EQ(outputs(world->unbound.changes), core_trace(Engine::kSkip));
}

TEST(Views, PinModuleInStepFollowsTheCore) { EXPECT_EQ(outputs(world->step.changes), core_trace(Engine::kStep)); }

TEST(Views, PinModuleWithClkFollowsTheCore) { EXPECT_EQ(outputs(world->bound.changes), core_trace(Engine::kSkip)); }

TEST(Views, TlmModuleFollowsTheCore) { EXPECT_EQ(outputs(world->tlm.changes), core_trace(Engine::kSkip)); }

TEST(Views, PinsAndTransactionsMoveTheSameInputs) {
  EXPECT_EQ(sorted(world->tlm.changes), sorted(world->unbound.changes));
  EXPECT_EQ(sorted(world->bound.changes), sorted(world->unbound.changes));
}

TEST(Views, APhaseShiftsTheChipInSimulationTimeOnly) {
  EXPECT_EQ(sorted(world->shifted.changes), sorted(world->unbound.changes));
  ASSERT_EQ(world->shifted.signals.size(), world->unbound.signals.size());
  for (std::size_t i = 0; i < world->shifted.signals.size(); ++i)
    EXPECT_EQ(world->shifted.signals[i].at, world->unbound.signals[i].at + kPhase);
}

TEST(Views, SignalsChangeAtTheExactTimes) {
  const StimulatedPins& pins = world->unbound;
  EXPECT_EQ(only(pins.signals, Pin::kLReq), only(pins.changes, Pin::kLReq));
  EXPECT_EQ(only(pins.signals, Pin::kLSta), only(pins.changes, Pin::kLSta));
  EXPECT_GT(pins.signals.size(), 100U);
  EXPECT_EQ(pins.off_time, 0);
  for (const Change& change : pins.signals) ASSERT_EQ(change.at % 250, 0) << change;
}

TEST(Views, TransactionsReadWhatThePinsShow) {
  EXPECT_THAT(world->tlm.read, testing::ElementsAre(0x5A, 0x01, 0x0D, 0xC5, 0xC3));
}

TEST(Views, TheDataBusIsReleasedThenUnknownThenDriven) {
  std::vector<std::string> seen;
  for (const auto& [at, level] : world->unbound.data_bus)
    if (at >= to_time(kFirstAccess)) seen.push_back(level);
  ASSERT_GE(seen.size(), 5U);
  seen.resize(5);
  // The user's write, then the chip's answer to a read of the same byte.
  EXPECT_THAT(seen, testing::ElementsAre("01011010", "ZZZZZZZZ", "XXXXXXXX", "01011010", "ZZZZZZZZ"));
}

TEST(Views, AWriteCountsWhoseCsrRisesTogetherWithWr) {
  EXPECT_EQ(strobes_together->chip.peek(StrobesTogether::kCell), 0x77);
}

TEST(Views, WhatTheUserDrivesIsHeardOnceTheChipHasLetGoOfD) {
  const Changes heard = only(shared_d->changes, Pin::kDIn), driven = only(shared_d->changes, Pin::kDOut);
  ASSERT_EQ(driven.back().level, kLevelZ);
  ASSERT_FALSE(heard.empty());
  EXPECT_EQ(heard.back(), (Change{SharedD::kEdge, Pin::kDIn, SharedD::kValue}));
}

TEST(Views, AnInputIsHeardThatChangesInTheDeltaCycleAfterTheChipsOwnEvent) {
  EXPECT_EQ(reset_pins->chip.chip().level(Pin::kReset), 1);
  EXPECT_EQ(reset_tlm->chip.chip().level(Pin::kReset), 1);
}

TEST(Views, ARightStimulusIsReportedByNobody) {
  for (const auto& [id, text] : reports()) ADD_FAILURE() << id << " " << text;
}

}  // namespace
}  // namespace dsdpv1
