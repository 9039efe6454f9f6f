// Valid states are restored; others are refused with a one-line message, and the chip remains unchanged.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "model/dsdpv1/chip_state.hpp"
#include "tests/state/recorded.hpp"

namespace dsdpv1::state_test {
namespace {

using ::testing::HasSubstr;
using State = std::vector<std::uint8_t>;

constexpr std::size_t kVersionAt = 8, kPartAt = 20, kIntervalAt = 21;  // chip_state.hpp

void play(Chip& chip, const Recorded& slave, Tick until) {
  for (const Input& each : slave.inputs)
    if (each.at > chip.now() && each.at <= until) chip.set(each.at, each.pin, each.level);
  chip.advance(until);
}

/// A state in the middle of data exchange.
State some_state(Engine engine = Engine::kSkip) {
  static const Recorded slave = recorded("power_on_12m").at(0);
  Config config = slave.config;
  config.engine = engine;
  Chip chip(config);
  play(chip, slave, slave.end / 2);
  return chip.save();
}

/// The reason for which a chip with this configuration refuses `state`; also checks that it refuses and remains
/// unchanged.
std::string refusal(const State& state, const Config& config = {}) {
  Chip chip(config);
  chip.set(1000, Pin::kReset, 1);
  chip.advance(2'000'000);
  const State before = chip.save();
  std::string why;
  try {
    chip.restore(state.data(), state.size());
    ADD_FAILURE() << "restored";
  } catch (const StateError& error) {
    why = error.what();
  }
  EXPECT_TRUE(chip.save() == before);
  EXPECT_EQ(why.find('\n'), std::string::npos);
  return why;
}

State with(State state, std::size_t at, std::uint8_t value) {
  state.at(at) = value;
  return state;
}

TEST(ChipState, WhatIsNoStateIsRefused) {
  EXPECT_EQ(refusal({}), "this is no saved state of a chip");
  EXPECT_EQ(refusal(State(20'000, 'D')), "this is no saved state of a chip");
}

TEST(ChipState, CutAnywhereItIsRefused) {
  const State whole = some_state();
  for (std::size_t size = 0; size < whole.size(); size += 1 + size / 7)
    EXPECT_NE(refusal(State(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size))), "");
  EXPECT_EQ(refusal(State(whole.begin(), whole.end() - 1)), "the state has " + std::to_string(whole.size() - 1) +
                                                                " bytes, it was saved with " +
                                                                std::to_string(whole.size()));
}

TEST(ChipState, EachDamagedBitIsFound) {
  const State whole = some_state();
  for (std::size_t at = 0; at < whole.size(); at += 1 + at / 50)
    EXPECT_NE(refusal(with(whole, at, static_cast<std::uint8_t>(whole[at] ^ 1U << at % 8))), "") << "byte " << at;
  EXPECT_EQ(refusal(with(whole, 5000, whole[5000] ^ 4U)), "the state is damaged: its checksum is wrong");
}

TEST(ChipState, OfAnotherVersionItIsRefused) {
  EXPECT_EQ(refusal(with(some_state(), kVersionAt, 1)), "the state has format version 1, allowed here is 2");
}

TEST(ChipState, OfAnotherPartItIsRefused) {
  Config rsu;
  rsu.part = Part::kRsu;
  EXPECT_EQ(refusal(some_state(), rsu), "the state is of a DSDPV1, this chip is a DSDPV1-RSU");
  EXPECT_NE(refusal(profibus::end_frame(with(some_state(), kPartAt, 3))), "");
}

TEST(ChipState, WithOtherParametersItIsRefused) {
  Config config;
  config.intr_gap = 65;
  EXPECT_EQ(refusal(some_state(), config), "the state is of a chip whose intr_gap is 64, here it is 65");
  EXPECT_EQ(refusal(profibus::end_frame(with(some_state(), kIntervalAt, 49))),
            "the state is of a chip whose access_interval is 49, here it is 48");
}

TEST(ChipState, AValueThatNoChipHasIsRefusedThoughItsChecksumIsRight) {
  const State whole = some_state();
  const std::size_t last = whole.size() - 2;  // MISO
  EXPECT_THAT(refusal(profibus::end_frame(with(whole, last, 0x55))),
              HasSubstr("of the state ends a value that no chip has"));
  State longer = whole;
  longer.push_back(0);
  EXPECT_EQ(refusal(profibus::end_frame(longer)), "the state is longer than this chip's");
  EXPECT_NE(refusal(profibus::end_frame(State(whole.begin(), whole.end() - 1))), "");
}

/// Guards the format: a changed state requires a new kStateVersion. Then these numbers become those of the new version.
TEST(ChipState, OfAChipFromPowerOnIsThatOfItsVersion) {
  const State fresh = Chip().save();
  std::uint32_t checksum = 0;
  for (std::size_t i = 0; i < 4; ++i) checksum |= std::uint32_t{fresh[16 + i]} << (8 * i);
  EXPECT_EQ(kStateVersion, 2U);
  EXPECT_EQ(fresh.size(), 11105U);
  EXPECT_EQ(checksum, 3782311560U);
}

void keep(void* pins, Tick at, Pin pin, Level level) {
  static_cast<std::vector<Input>*>(pins)->push_back({at, pin, level});
}

/// The output changes of a chip with the engine `goes_on`, restored from one with `saved` at `tick`. Only this one is
/// watched; the other may have dozed.
std::vector<Input> lives_on(const Recorded& slave, Engine saved, Engine goes_on, Tick tick) {
  Config config = slave.config;
  config.engine = saved;
  Chip first(config);
  play(first, slave, tick);
  const State state = first.save();
  config.engine = goes_on;
  Chip second(config);
  std::vector<Input> pins;
  second.watch({&keep, &pins}, outputs_of(config.part));
  second.restore(state.data(), state.size());
  play(second, slave, tick + 2'000'000);
  return pins;
}

class OtherEngine : public ::testing::TestWithParam<const char*> {};

TEST_P(OtherEngine, GoesOnFromIt) {
  for (const Recorded& slave : recorded(GetParam())) {
    for (int part = 1; part < 8; ++part) {
      const Tick tick = slave.end / 8 * part + 1234 * part;
      const std::vector<Input> expected = lives_on(slave, Engine::kStep, Engine::kStep, tick);
      EXPECT_TRUE(lives_on(slave, Engine::kSkip, Engine::kStep, tick) == expected) << "at tick " << tick;
      EXPECT_TRUE(lives_on(slave, Engine::kStep, Engine::kSkip, tick) == expected) << "at tick " << tick;
      EXPECT_TRUE(lives_on(slave, Engine::kSkip, Engine::kSkip, tick) == expected) << "at tick " << tick;
      EXPECT_GT(expected.size(), 10U);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(ChipState, OtherEngine,
                         ::testing::Values("bus_timing", "rsu_spi_limits", "rsu_uart_limits", "violations"),
                         [](const auto& each) { return std::string(each.param); });

TEST(ChipState, GoesBackInTime) {
  const Recorded slave = recorded("bus_timing").at(0);
  Chip chip(slave.config);
  play(chip, slave, slave.end / 3);
  const State state = chip.save();
  play(chip, slave, slave.end);
  const State end = chip.save();
  chip.restore(state.data(), state.size());
  EXPECT_EQ(chip.now(), slave.end / 3);
  play(chip, slave, slave.end);
  EXPECT_TRUE(chip.save() == end);
}

}  // namespace
}  // namespace dsdpv1::state_test
