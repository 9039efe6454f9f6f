// The functions that simulators call, without a simulator.
#include <gtest/gtest.h>

#include <array>
#include <string>

#include "bindings/simulator/pins.hpp"
#include "bindings/simulator/simulator.h"

namespace dsdpv1::simulator {
namespace {

constexpr int32_t kRunning = static_cast<int32_t>(kInputsAtReset | 1U);  ///< RESET high, nothing else

TEST(SimulatorTime, HalvesOfACycleAreExactAndNothingPassesTheNextEdge) {
  EXPECT_EQ(tick_of(0, 0), 0U);
  EXPECT_EQ(tick_of(3, 0), 375U);
  EXPECT_EQ(tick_of(2, 41), 250U);  // less than half a tick of 83.3 ps
  EXPECT_EQ(tick_of(2, 42), 251U);
  EXPECT_EQ(tick_of(2, 10'400), 374U);  // the next edge is not reached, however late it is
  EXPECT_EQ(tick_of(2, 99'999), 374U);
  EXPECT_EQ(half_of(375), 3);
  EXPECT_EQ(half_of(376), 4);
  EXPECT_EQ(half_of(DPSIM_NEVER), INT64_MAX);
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
  const int32_t before = dsdpv1_model_step(model, 48, 0, kRunning, &next);
  EXPECT_EQ(before & 1, 0) << "L_REQ";
  int64_t half = next;
  while ((dsdpv1_model_step(model, half, 0, kRunning, &next) & 1) == 0) {
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
  EXPECT_EQ(std::string(dsdpv1_error()), "option rts_lead is none, allowed is NAME=VALUE");
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

/// A model whose outputs are somebody's RTL for a scoreboard, one of them wrong between two halves.
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
      const int32_t inputs = half < 40 ? kRunning & ~1 : kRunning;
      int32_t outputs = dsdpv1_model_step(model_, half, 0, inputs, &next);
      if (half >= wrong_from && half < wrong_to) outputs ^= 1 << 5;
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
  const int32_t in_reset = kRunning & ~1, unknown = 0xFF << 18;
  int32_t found = 0;
  for (int64_t half = 0; half < 20 && found == 0; ++half)
    found = dsdpv1_scoreboard_step(scoreboard, half, 0, in_reset, unknown, &next);
  EXPECT_EQ(found, 1);
  EXPECT_NE(std::string(dsdpv1_message(scoreboard)).find("L_REQ is X, the model's is 0"), std::string::npos);
  EXPECT_EQ(std::string(dsdpv1_message(scoreboard)), "");
  dsdpv1_close(scoreboard);
}

TEST(SimulatorChecker, AShortWriteStrobeIsAViolationWithItsClause) {
  const int32_t checker = dsdpv1_checker_create("", -1);
  int32_t pins = kRunning;
  const auto step = [&](int64_t half, int64_t ps) { return dsdpv1_checker_step(checker, half, ps, pins, 0x2C); };
  step(0, 0);
  pins &= ~(1 << 3);  // CSR
  step(10'000, 0);
  pins &= ~(1 << 5);  // WR
  step(10'010, 0);
  pins |= 1 << 5;
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
