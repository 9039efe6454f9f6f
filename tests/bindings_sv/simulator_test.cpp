// The functions that simulators call, without a simulator.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <string>

#include "bindings/simulator/object.hpp"
#include "bindings/simulator/pins.hpp"
#include "bindings/simulator/simulator.h"

namespace dsdpv1::simulator {
namespace {

/// The inputs of the DSDPV1.
const PackedPins& inputs() { return pins_of_kind("dsdpv1").inputs; }
int64_t bit(const char* input) { return static_cast<int64_t>(inputs().mask(input)); }
int64_t output_bit(const char* output) { return static_cast<int64_t>(pins_of_kind("dsdpv1").outputs.mask(output)); }
/// Only RESET is high.
int64_t running() { return static_cast<int64_t>(inputs().at_reset()) | bit("RESET"); }

TEST(SimulatorTime, HalvesOfACycleAreExactAndNothingPassesTheNextEdge) {
  EXPECT_EQ(tick_of(0, 0), 0U);
  EXPECT_EQ(tick_of(3, 0), 375U);
  EXPECT_EQ(tick_of(2, 41), 250U);  // less than half a tick of 83.3 ps
  EXPECT_EQ(tick_of(2, 42), 251U);
  EXPECT_EQ(tick_of(2, 10'400), 374U);  // the next edge is not reached, however late it is
  EXPECT_EQ(tick_of(2, 99'999), 374U);
}

TEST(SimulatorTime, AWakeUpIsAHalfOfACycleOrPicosecondsInThisOne) {
  EXPECT_EQ(wake_of(375, 2), 3);
  EXPECT_EQ(wake_of(376, 2), 3);
  EXPECT_EQ(wake_of(376, 3), -83);
  EXPECT_EQ(wake_of(499, 3), -10'333);
  EXPECT_EQ(wake_of(375, 3), -1) << "what is due at once is never in the past";
  EXPECT_EQ(wake_of(DPSIM_NEVER, 3), INT64_MAX);
}

/// Name, first bit, wires, bit of released and of unknown or -1.
std::string layout(const PackedPins& pins) {
  const auto flag = [](uint64_t mask) { return mask == 0 ? -1 : __builtin_ctzll(mask); };
  std::string text;
  for (const PinPlace& each : pins.places())
    text += fmt::format("{} {} {} {} {}\n", each.name, each.shift, __builtin_popcountll(each.level),
                        flag(each.released), flag(each.unknown));
  return text;
}

TEST(SimulatorPins, OfEachKindAreThoseThatTheCApiLists) {
  const KindPins& pins = pins_of_kind("dsdpv1_rsu");
  EXPECT_EQ(
      layout(pins.inputs),
      "RESET 0 1 -1 -1\nR_REQ 1 1 -1 -1\nR_STA 2 1 -1 -1\nCSR 3 1 -1 -1\nRD 4 1 -1 -1\nWR 5 1 -1 -1\nA 6 11 -1 -1\n"
      "D_IN 17 8 40 -1\nPBRXD 25 1 -1 -1\nXSS 26 1 -1 -1\nSCK 27 1 -1 -1\nMOSI 28 1 -1 -1\nRXD 29 1 -1 -1\n"
      "MODE 30 2 -1 -1\nADR 32 2 -1 -1\nUBR 34 3 -1 -1\nUIV 37 3 -1 -1\n");
  EXPECT_EQ(layout(pins.outputs),
            "L_REQ 0 1 -1 20\nL_STA 1 1 -1 21\nD_OUT 2 8 18 22\nINTR0 10 1 -1 23\nPBTXD 11 1 -1 24\nPBRTS 12 1 -1 25\n"
            "PBF 13 1 -1 26\nBR 14 1 -1 27\nREADY 15 1 -1 28\nMISO 16 1 19 29\nTXD 17 1 -1 30\n");
  EXPECT_EQ(pins_of_kind("dsdpv1_r").outputs.places().size(), 9U);
  EXPECT_EQ(dsdpv1_model_create("kind=dsdpv2"), 0);
  EXPECT_NE(std::string(dsdpv1_error()).find("expected dsdpv1, dsdpv1_r, dsdpv1_rsu"), std::string::npos);
}

TEST(SimulatorPins, ALevelComesBackAsItWasPacked) {
  std::vector<PinPlace> all = pins_of_kind("dsdpv1_rsu").outputs.places();
  const std::vector<PinPlace>& more = pins_of_kind("vpc3").outputs.places();
  all.insert(all.end(), more.begin(), more.end());
  for (const PinPlace& each : all) {
    const uint64_t others = 0x5555'5555'5555'5555U & ~each.all();
    for (const dpsim_level level : {dpsim_level{0}, dpsim_level{1}, DPSIM_X}) {
      const uint64_t pins = with_level(others | each.all(), each, level);
      EXPECT_EQ(level_of(each, pins), level) << each.name;
      EXPECT_EQ(pins & ~each.all(), others) << each.name;
    }
  }
  const KindPins& pins = pins_of_kind("dsdpv1");
  EXPECT_EQ(level_of(pins.inputs.of_pin(DPSIM_DSDPV1_D_IN), pins.inputs.at_reset()), DPSIM_Z);
  EXPECT_EQ(level_of(pins.outputs.of_pin(DPSIM_DSDPV1_D_OUT), pins.outputs.at_reset()), DPSIM_Z);
  EXPECT_THROW(pins.inputs.mask("XSS"), Error);
}

TEST(SimulatorTime, AbsoluteTimesAreThoseOfTheCApi) {
  for (const uint64_t tick : {uint64_t{0}, uint64_t{1}, uint64_t{5}, uint64_t{250}, uint64_t{999'999'999'999},
                              kQuickTicks - 1, kQuickTicks, kQuickTicks + 7, uint64_t{1} << 57U}) {
    const auto ps = static_cast<uint64_t>(ps_of(tick));
    EXPECT_EQ(ps, dpsim_ticks_to(tick, DPSIM_PS)) << tick;
    EXPECT_EQ(tick_of_ps(ps), tick);
    for (const uint64_t near : {ps + 41, ps + 42, ps + 83})
      EXPECT_EQ(tick_of_ps(near), dpsim_ticks_from(near, DPSIM_PS)) << near;
  }
  EXPECT_EQ(ps_of(DPSIM_NEVER), INT64_MAX);
}

TEST(SimulatorModel, OutputsChangeAtTheHalfThatItNames) {
  const int32_t model = dsdpv1_model_create("");
  int64_t next = 0;
  const int64_t before = dsdpv1_model_step(model, 48, 0, running(), &next);
  EXPECT_EQ(before & output_bit("L_REQ"), 0);
  int64_t half = next;
  while ((dsdpv1_model_step(model, half, 0, running(), &next) & output_bit("L_REQ")) == 0) {
    ASSERT_GT(next, half);
    half = next;
  }
  EXPECT_EQ(half, 2 * (24 + 3)) << "R is two cycles after the edge that sees RESET; the access begins there";
  EXPECT_EQ(dsdpv1_close(model), 0);
}

TEST(SimulatorModel, WrongCallsSayWhatIsWrong) {
  int64_t next = 0;
  EXPECT_LT(dsdpv1_model_step(9999, 0, 0, 0, &next), 0);
  EXPECT_EQ(std::string(dsdpv1_error()), "handle 9999 is none: was the object created?");
  EXPECT_EQ(dsdpv1_model_create("rts_lead"), 0);
  EXPECT_EQ(std::string(dsdpv1_error()), "option rts_lead is none, expected NAME=VALUE");
  EXPECT_EQ(dsdpv1_model_create("rts_lead=x"), 0);
  EXPECT_NE(std::string(dsdpv1_error()).find("option rts_lead is x"), std::string::npos);
  EXPECT_EQ(dsdpv1_model_create("rts_lead=33"), 0);
  EXPECT_NE(std::string(dsdpv1_error()).find("rts_lead"), std::string::npos);
  EXPECT_EQ(dsdpv1_master_create("adress=1"), 0);
  EXPECT_NE(std::string(dsdpv1_error()).find("option adress of a master is unknown"), std::string::npos);
  const int32_t model = dsdpv1_model_create("");
  EXPECT_LT(dsdpv1_master_start(model), 0);
  EXPECT_NE(std::string(dsdpv1_error()).find("another kind of object"), std::string::npos);
  EXPECT_EQ(dsdpv1_close(model), 0);
  EXPECT_LT(dsdpv1_close(model), 0);
}

/// A model whose outputs serve as RTL for a scoreboard, one of them wrong between two halves.
class Twins {
 public:
  explicit Twins(int64_t tolerance_ps)
      : model_(dsdpv1_model_create("")), scoreboard_(dsdpv1_scoreboard_create("", tolerance_ps)) {}
  ~Twins() {
    dsdpv1_close(model_);
    dsdpv1_close(scoreboard_);
  }
  Twins(const Twins&) = delete;
  Twins& operator=(const Twins&) = delete;

  /// Halves `from` to `to`; PBF is inverted in those from `wrong_from` up to before `wrong_to`.
  std::string run(int64_t to, int64_t wrong_from, int64_t wrong_to) {
    int64_t next = 0;
    for (int64_t half = 0; half < to; ++half) {
      const int64_t inputs = half < 40 ? (running() & ~bit("RESET")) : running();
      int64_t outputs = dsdpv1_model_step(model_, half, 0, inputs, &next);
      if (half >= wrong_from && half < wrong_to) outputs ^= output_bit("PBF");
      if (dsdpv1_scoreboard_step(scoreboard_, half, 0, inputs, outputs, &next) > 0) return dsdpv1_message(scoreboard_);
    }
    return "";
  }
  int32_t matched() const { return dsdpv1_scoreboard_matched(scoreboard_); }

 private:
  int32_t model_, scoreboard_;
};

TEST(SimulatorScoreboard, EqualPinsAreEqualAndCounted) {
  Twins twins(0);
  EXPECT_EQ(twins.run(2000, 0, 0), "");
  EXPECT_GT(twins.matched(), 1);
}

TEST(SimulatorScoreboard, TheFirstDifferenceIsNamedWithPinLevelsAndCycle) {
  Twins twins(0);
  const std::string text = twins.run(2000, 201, 202);
  EXPECT_NE(text.find("first difference at cycle 100 + 125 ticks (2.094 us): PBF is 0, the model's is 1"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("last input  RESET=1 at cycle 20 (0.417 us)"), std::string::npos) << text;
}

TEST(SimulatorScoreboard, WhatIsWrongBeforeRtlHasLeftXIsNoDifference) {
  EXPECT_EQ(Twins(0).run(2000, 0, 8), "");
  EXPECT_NE(Twins(0).run(2000, 0, 12), "");
}

TEST(SimulatorScoreboard, ADifferenceWithinTheToleranceIsNone) {
  EXPECT_EQ(Twins(21'000).run(2000, 200, 202), "");
  EXPECT_NE(Twins(21'000).run(2000, 200, 204), "");
}

TEST(SimulatorScoreboard, AnUnknownOutputDiffers) {
  const int32_t scoreboard = dsdpv1_scoreboard_create("", 0);
  int64_t next = 0;
  const int64_t in_reset = running() & ~bit("RESET");
  const auto unknown = static_cast<int64_t>(pins_of_kind("dsdpv1").outputs.places().front().unknown);
  int32_t found = 0;
  for (int64_t half = 0; half < 20 && found == 0; ++half)
    found = dsdpv1_scoreboard_step(scoreboard, half, 0, in_reset, unknown, &next);
  EXPECT_EQ(found, 1);
  EXPECT_NE(std::string(dsdpv1_message(scoreboard)).find("L_REQ is X, the model's is 0"), std::string::npos);
  EXPECT_EQ(std::string(dsdpv1_message(scoreboard)), "");
  dsdpv1_close(scoreboard);
}

/// A chip that never moves an output. What the model does not know, DB and the clock output, is not compared; ready is.
TEST(SimulatorScoreboard, ServesTheSpc3Family) {
  for (const char* kind : {"apc3", "spc3", "vpc3"}) {
    const KindPins& pins = pins_of_kind(kind);
    const int32_t scoreboard = dsdpv1_scoreboard_create((std::string("kind=") + kind).c_str(), 0);
    uint64_t inputs = pins.inputs.at_reset(), outputs = pins.outputs.at_reset();
    int64_t next = 0;
    for (const PinPlace& place : pins.outputs.places())
      if (place.name == "CLKOUT2_4") outputs = with_level(outputs, place, 0);
    int32_t found = 0;
    for (int64_t half = 0; half < 200 && found == 0; ++half) {
      if (half == 20) inputs &= ~pins.inputs.mask("RESET");
      if (half == 60) inputs &= ~(pins.inputs.mask("XCS") | pins.inputs.mask("XRD_R_W"));
      found = dsdpv1_scoreboard_step(scoreboard, half, 0, static_cast<int64_t>(inputs), static_cast<int64_t>(outputs),
                                     &next);
    }
    EXPECT_EQ(found, 1) << kind;
    const std::string text = dsdpv1_message(scoreboard);
    EXPECT_NE(text.find("at cycle 37 (0.771 us): XREADY_XDTACK is 1, the model's is 0"), std::string::npos) << text;
    EXPECT_NE(text.find("last input  XRD_R_W=0 at cycle 30"), std::string::npos) << text;
    dsdpv1_close(scoreboard);
  }
}

TEST(SimulatorChecker, AShortWriteStrobeIsAViolationWithItsClause) {
  const int32_t checker = dsdpv1_checker_create("", -1);
  int64_t pins = running();
  const auto outputs = static_cast<int64_t>(pins_of_kind("dsdpv1").outputs.at_reset());
  const auto step = [&](int64_t half, int64_t ps) { return dsdpv1_checker_step(checker, half, ps, pins, outputs); };
  step(0, 0);
  pins &= ~bit("CSR");
  step(10'000, 0);
  pins &= ~bit("WR");
  step(10'010, 0);
  pins |= bit("WR");
  EXPECT_GT(step(10'010, 5000), 0);
  std::string all;
  for (std::string text = dsdpv1_message(checker); !text.empty(); text = dsdpv1_message(checker)) all += text + "\n";
  EXPECT_NE(all.find("TIMING_TS at cycle 5005"), std::string::npos) << all;
  EXPECT_GT(dsdpv1_checker_finish(checker), 0);
  EXPECT_GT(dsdpv1_checker_applied(checker), 0);
  dsdpv1_close(checker);
  EXPECT_EQ(dsdpv1_checker_create("NO_SUCH_RULE=1", -1), 0);
}

TEST(SimulatorMaster, ARequestIsDoneWhenNobodyAnswers) {
  const int32_t master = dsdpv1_master_create("address=2 max_retries=-1");
  int64_t wake = 0;
  dsdpv1_master_step(master, 0, 0, 1, &wake);
  ASSERT_EQ(dsdpv1_master_start(master), 0);
  const int32_t id = dsdpv1_master_ask(master, DPSIM_SERVICE_FDL_STATUS, 5);
  ASSERT_GT(id, 0);
  std::array<uint32_t, DSDPV1_BYTES / 4> data{};
  int32_t outcome = -1, codes = 0, count = 0, edges = 0, before = 1;
  dsdpv1_master_step(master, 0, 0, 1, &wake);
  while (dsdpv1_master_done(master, id, &outcome, &codes, data.data(), &count) == 0) {
    ASSERT_GE(wake, 0);
    const int32_t driver = dsdpv1_master_step(master, wake, 0, 1, &wake);
    edges += driver != before ? 1 : 0;
    before = driver;
  }
  EXPECT_EQ(outcome, DPSIM_OUTCOME_NO_ANSWER);
  EXPECT_GT(edges, 10);
  dsdpv1_close(master);
}

}  // namespace
}  // namespace dsdpv1::simulator
