// Chips saved and restored through the C API.
#include <algorithm>
#include <string>

#include "tests/capi/capi.hpp"

namespace dsdpv1::capi_test {
namespace {

std::vector<uint8_t> save(const dpsim_chip* chip) {
  size_t size = 0;
  EXPECT_EQ(dpsim_chip_save(chip, nullptr, 0, &size), DPSIM_ERR_SPACE);
  std::vector<uint8_t> state(size);
  ok(dpsim_chip_save(chip, state.data(), state.size(), &size));
  EXPECT_EQ(size, state.size());
  EXPECT_LE(size, static_cast<size_t>(DPSIM_MAX_CHIP_STATE));
  return state;
}
dpsim_status restore(dpsim_chip* chip, const std::vector<uint8_t>& state) {
  return dpsim_chip_restore(chip, state.data(), state.size());
}

constexpr uint64_t kMiddle = 6010 * kCycle;

/// Up to the middle of an access of the user.
Owned<dpsim_chip> begun(dpsim_engine engine = DPSIM_ENGINE_SKIP) {
  auto chip = make_chip(engine);
  ok(dpsim_chip_watch(chip.get(), DPSIM_ALL_PINS, nullptr, nullptr));
  ok(dpsim_chip_set(chip.get(), 1000, DPSIM_DSDPV1_RESET, 1));
  ok(dpsim_chip_set(chip.get(), 6000 * kCycle, DPSIM_DSDPV1_R_REQ, 1));
  for (const uint16_t pin : {DPSIM_DSDPV1_R_STA, DPSIM_DSDPV1_A}) ok(dpsim_chip_set(chip.get(), kMiddle, pin, 1));
  ok(dpsim_chip_set(chip.get(), kMiddle, DPSIM_DSDPV1_A, 4));
  for (const uint16_t pin : {DPSIM_DSDPV1_CSR, DPSIM_DSDPV1_RD}) ok(dpsim_chip_set(chip.get(), kMiddle, pin, 0));
  drain(dpsim_chip_read_changes, chip.get());
  return chip;
}

/// All that changes from there on.
std::vector<dpsim_change> go_on(dpsim_chip* chip) {
  ok(dpsim_chip_set(chip, kMiddle + 2000, DPSIM_DSDPV1_RD, 1));
  ok(dpsim_chip_set(chip, kMiddle + 3000, DPSIM_DSDPV1_CSR, 1));
  ok(dpsim_chip_set(chip, kMiddle + 4000, DPSIM_DSDPV1_R_STA, 0));
  ok(dpsim_chip_set(chip, kMiddle + 4000, DPSIM_DSDPV1_R_REQ, 0));
  ok(dpsim_chip_advance(chip, kMiddle + kMs));
  return drain(dpsim_chip_read_changes, chip);
}

TEST(CapiState, ARestoredChipGoesOnAsTheOneThatWasSaved) {
  const auto first = begun();
  const auto state = save(first.get());
  const auto expected = go_on(first.get());
  EXPECT_TRUE(std::any_of(expected.begin(), expected.end(), [](const dpsim_change& each) {
    return each.pin == DPSIM_DSDPV1_D_OUT && each.level == 0xC5;
  }));
  for (const dpsim_engine engine : {DPSIM_ENGINE_SKIP, DPSIM_ENGINE_STEP}) {
    const auto again = make_chip(engine);
    ok(dpsim_chip_watch(again.get(), DPSIM_ALL_PINS, nullptr, nullptr));
    ok(restore(again.get(), state));
    uint64_t now = 0;
    ok(dpsim_chip_now(again.get(), &now));
    EXPECT_EQ(now, kMiddle);
    dpsim_level level = 0;
    ok(dpsim_chip_level(again.get(), DPSIM_DSDPV1_A, &level));
    EXPECT_EQ(level, 4);
    EXPECT_EQ(go_on(again.get()), expected);
  }
}

TEST(CapiState, RestoringGoesBackInTimeAndForgetsWhatIsKept) {
  const auto chip = begun();
  const auto state = save(chip.get());
  const auto expected = go_on(chip.get());
  ok(dpsim_chip_advance(chip.get(), kMiddle + 2 * kMs));  // and leaves the changes where they are
  ok(restore(chip.get(), state));
  EXPECT_EQ(go_on(chip.get()), expected);
  ok(restore(chip.get(), state));
  EXPECT_EQ(dpsim_chip_advance(chip.get(), kMiddle - 1), DPSIM_ERR_TIME);
}

TEST(CapiState, WhatIsRefusedSaysWhyAndChangesNothing) {
  const auto chip = begun();
  auto state = save(chip.get());
  const auto other = make_chip();
  state[100] = static_cast<uint8_t>(state[100] ^ 1U);
  EXPECT_EQ(restore(other.get(), state), DPSIM_ERR_INPUT);
  EXPECT_STREQ(dpsim_error_message(), "the state is damaged: its checksum is wrong");
  uint64_t now = 1;
  ok(dpsim_chip_now(other.get(), &now));
  EXPECT_EQ(now, 0U);
  state[100] = static_cast<uint8_t>(state[100] ^ 1U);
  auto options = sized<dpsim_chip_options>();
  options.kind = "dsdpv1_r";
  dpsim_chip* made = nullptr;
  ok(dpsim_chip_create(&options, &made));
  const Owned<dpsim_chip> sister(made);
  EXPECT_EQ(restore(sister.get(), state), DPSIM_ERR_INPUT);
  EXPECT_STREQ(dpsim_error_message(), "the state is of a DSDPV1, this chip is a DSDPV1-R");
  size_t size = 0;
  EXPECT_EQ(dpsim_chip_save(chip.get(), state.data(), 10, &size), DPSIM_ERR_SPACE);
  EXPECT_EQ(size, state.size());
  EXPECT_EQ(dpsim_chip_save(chip.get(), nullptr, 10, &size), DPSIM_ERR_ARGUMENT);
  EXPECT_EQ(dpsim_chip_restore(chip.get(), nullptr, 10), DPSIM_ERR_ARGUMENT);
}

TEST(CapiState, AChipOnABusIsNeitherSavedNorRestored) {
  const auto alone = begun();
  const auto state = save(alone.get());
  const auto bus = make_bus();
  dpsim_chip* chip = nullptr;
  ok(dpsim_bus_add_chip(bus.get(), nullptr, &chip));
  size_t size = 0;
  EXPECT_EQ(dpsim_chip_save(chip, nullptr, 0, &size), DPSIM_ERR_STATE);
  EXPECT_EQ(restore(chip, state), DPSIM_ERR_STATE);
}

TEST(CapiState, NotFromACallbackOfTheChip) {
  const auto chip = begun();
  struct Seen {
    dpsim_chip* chip;
    std::vector<uint8_t> state;
    int refused = 0;
  } seen{chip.get(), save(chip.get())};
  const auto told = [](void* user, const dpsim_change*) {
    auto& self = *static_cast<Seen*>(user);
    size_t size = 0;
    if (dpsim_chip_save(self.chip, self.state.data(), self.state.size(), &size) == DPSIM_ERR_STATE) ++self.refused;
    if (restore(self.chip, self.state) == DPSIM_ERR_STATE) ++self.refused;
  };
  ok(dpsim_chip_watch(chip.get(), DPSIM_PIN(DPSIM_DSDPV1_D_OUT), told, &seen));
  ok(dpsim_chip_set(chip.get(), kMiddle + 2000, DPSIM_DSDPV1_RD, 1));
  EXPECT_GE(seen.refused, 2);
}

}  // namespace
}  // namespace dsdpv1::capi_test
