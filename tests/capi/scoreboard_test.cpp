// The model compared with a chip whose pins come from a model, unchanged or modified.
#include <algorithm>
#include <string>

#include "tests/capi/capi.hpp"

namespace dsdpv1::capi_test {
namespace {

Owned<dpsim_scoreboard> make_scoreboard(int64_t tolerance = 0, int64_t warm_up = 0, const char* kind = nullptr) {
  auto model = sized<dpsim_chip_options>();
  model.kind = kind;
  auto options = sized<dpsim_scoreboard_options>();
  options.tolerance = tolerance;
  options.warm_up = warm_up;
  dpsim_scoreboard* made = nullptr;
  ok(dpsim_scoreboard_create(&model, &options, &made));
  return Owned<dpsim_scoreboard>(made);
}

dpsim_scoreboard_result compared(dpsim_scoreboard* scoreboard, const std::vector<dpsim_change>& changes,
                                 uint64_t until) {
  auto result = sized<dpsim_scoreboard_result>();
  ok(dpsim_scoreboard_compare(scoreboard, changes.data(), changes.size(), until, &result));
  return result;
}

constexpr uint64_t kReset = 20 * kCycle, kEnd = 150 * kUs;

/// All pins of a chip that leaves reset, up to kEnd, and its events.
std::vector<dpsim_change> pins_of_a_start(std::vector<dpsim_chip_event>* events = nullptr) {
  const auto chip = make_chip();
  ok(dpsim_chip_watch(chip.get(), DPSIM_ALL_PINS, nullptr, nullptr));
  const auto keep = [](void* user, const dpsim_chip_event* event) {
    if (user != nullptr) static_cast<std::vector<dpsim_chip_event>*>(user)->push_back(*event);
  };
  ok(dpsim_chip_on_event(chip.get(), keep, events));
  ok(dpsim_chip_set(chip.get(), kReset, DPSIM_DSDPV1_RESET, 1));
  ok(dpsim_chip_advance(chip.get(), kEnd));
  return drain(dpsim_chip_read_changes, chip.get());
}

/// The index of the L_REQ change with this number.
std::size_t place_of_l_req(const std::vector<dpsim_change>& changes, int number) {
  std::size_t place = 0;
  for (int left = number;; ++place)
    if (changes[place].pin == DPSIM_DSDPV1_L_REQ && left-- == 0) return place;
}

/// The pins of a start with one change of L_REQ later.
std::vector<dpsim_change> late(uint64_t ticks) {
  std::vector<dpsim_change> changes = pins_of_a_start();
  changes[place_of_l_req(changes, 4)].tick += ticks;
  std::stable_sort(changes.begin(), changes.end(), [](const auto& a, const auto& b) { return a.tick < b.tick; });
  return changes;
}

TEST(CapiScoreboard, TheModelsOwnPinsAreAlikeAtOnceAndOneByOne) {
  const std::vector<dpsim_change> changes = pins_of_a_start();
  const auto at_once = make_scoreboard(), one_by_one = make_scoreboard();
  const auto all = compared(at_once.get(), changes, kEnd + 1);
  EXPECT_EQ(all.tick, DPSIM_NEVER);
  EXPECT_EQ(all.matched, changes.size() - 1) << "all but RESET";
  EXPECT_GT(all.matched, 100U);
  EXPECT_EQ(all.input_tick, kReset);
  for (const dpsim_change& each : changes) compared(one_by_one.get(), {each}, each.tick);
  const auto last = compared(one_by_one.get(), {}, kEnd + 1);
  EXPECT_EQ(last.tick, DPSIM_NEVER);
  EXPECT_EQ(last.matched, all.matched);
}

TEST(CapiScoreboard, TheFirstDifferenceIsNamedWithTickPinAndLevels) {
  const std::vector<dpsim_change> alike = pins_of_a_start();
  const dpsim_change& change = alike[place_of_l_req(alike, 4)];
  const auto scoreboard = make_scoreboard();
  const auto result = compared(scoreboard.get(), late(1), kEnd);
  EXPECT_EQ(result.tick, change.tick);
  EXPECT_EQ(result.pin, DPSIM_DSDPV1_L_REQ);
  EXPECT_EQ(result.model, change.level);
  EXPECT_EQ(result.dut, 1 - change.level);
  EXPECT_EQ(result.input, DPSIM_DSDPV1_RESET);
  EXPECT_EQ(result.input_level, 1);
  EXPECT_EQ(result.input_tick, kReset);
  const auto later = compared(scoreboard.get(), {{kEnd, 0, DPSIM_DSDPV1_PBF, 0, 0}, {kEnd, 0, 0, 0, 0}}, 2 * kEnd);
  EXPECT_EQ(later.tick, result.tick) << "nothing more is compared";
  EXPECT_EQ(later.matched, result.matched);
  EXPECT_EQ(later.input_tick, kReset);
}

TEST(CapiScoreboard, ADifferenceThatLastsAsLongAsTheToleranceIsNone) {
  EXPECT_EQ(compared(make_scoreboard(30).get(), late(30), kEnd).tick, DPSIM_NEVER);
  EXPECT_NE(compared(make_scoreboard(30).get(), late(31), kEnd).tick, DPSIM_NEVER);
  EXPECT_EQ(compared(make_scoreboard(30).get(), late(30), kEnd + 1).matched, pins_of_a_start().size() - 1);
}

TEST(CapiScoreboard, OnlyWhatATickEndsWithCounts) {
  std::vector<dpsim_change> changes = pins_of_a_start();
  const auto place = changes.begin() + 50;
  const dpsim_change glitch = {place->tick, 0, DPSIM_DSDPV1_PBTXD, 0, 0},
                     back = {place->tick, 0, DPSIM_DSDPV1_PBTXD, 1, 0};
  changes.insert(place, {glitch, back});
  EXPECT_EQ(compared(make_scoreboard().get(), changes, kEnd).tick, DPSIM_NEVER);
}

TEST(CapiScoreboard, ItSaysWhenToLookAgain) {
  const std::vector<dpsim_change> changes = pins_of_a_start();
  const auto scoreboard = make_scoreboard(30);
  auto result = compared(scoreboard.get(), {{kReset, 0, DPSIM_DSDPV1_RESET, 1, 0}}, kReset);
  uint64_t now = kReset;
  for (; result.tick == DPSIM_NEVER && now < kEnd; now = result.next) {
    ASSERT_GE(result.next, now);
    result = compared(scoreboard.get(), {}, result.next);
  }
  EXPECT_EQ(result.tick, changes[1].tick) << "a chip that does nothing differs at the first change";
  EXPECT_EQ(result.pin, changes[1].pin);
}

TEST(CapiScoreboard, WhileRtlLeavesXNothingIsCompared) {
  const dpsim_change x = {0, 0, DPSIM_DSDPV1_PBF, DPSIM_X, 0}, known = {4 * kCycle, 0, DPSIM_DSDPV1_PBF, 1, 0};
  EXPECT_EQ(compared(make_scoreboard(0, 4 * kCycle).get(), {x, known}, 10 * kCycle).tick, DPSIM_NEVER);
  EXPECT_EQ(compared(make_scoreboard(0, 4 * kCycle).get(), {x}, 10 * kCycle).tick, 4 * kCycle);
  EXPECT_EQ(compared(make_scoreboard(0, 0).get(), {x, known}, 10 * kCycle).tick, 0U);
  const dpsim_change high = {0, 0, DPSIM_DSDPV1_RESET, 1, 0}, low = {kCycle, 0, DPSIM_DSDPV1_RESET, 0, 0};
  const auto reset_late = compared(make_scoreboard(0, 4 * kCycle).get(), {x, high, low}, 10 * kCycle);
  EXPECT_EQ(reset_late.tick, 5 * kCycle);
  EXPECT_EQ(reset_late.dut, DPSIM_X);
}

TEST(CapiScoreboard, EventsUpToTheDifferenceAreTheModels) {
  std::vector<dpsim_chip_event> events;
  const std::vector<dpsim_change> changes = pins_of_a_start(&events);
  const auto result = compared(make_scoreboard().get(), changes, kEnd);
  ASSERT_FALSE(events.empty());
  ASSERT_EQ(result.event_count, std::min<std::size_t>(events.size(), DPSIM_LAST_EVENTS));
  for (std::size_t i = 0; i < result.event_count; ++i) {
    EXPECT_EQ(result.events[i].tick, events[events.size() - 1 - i].tick);
    EXPECT_EQ(result.events[i].reason, events[events.size() - 1 - i].reason);
  }
}

/// A frame at the SPI port of a DSDPV1-RSU; MISO as at the model's pin.
std::vector<dpsim_change> pins_of_a_frame() {
  auto options = sized<dpsim_chip_options>();
  options.kind = "dsdpv1_rsu";
  dpsim_chip* made = nullptr;
  ok(dpsim_chip_create(&options, &made));
  const Owned<dpsim_chip> chip(made);
  ok(dpsim_chip_watch(made, DPSIM_ALL_PINS, nullptr, nullptr));
  uint64_t now = 0;
  const auto set = [&](const char* pin, dpsim_level level) {
    uint16_t number = 0;
    ok(dpsim_pin_find("dsdpv1_rsu", pin, &number));
    ok(dpsim_chip_set(made, now, number, level));
  };
  set("MODE", 1);
  set("ADR", 1);
  now = kReset;
  set("RESET", 1);
  now = 200 * kUs + 7;
  set("XSS", 0);
  now += 1200;
  constexpr uint64_t kReadReady = 0x01000401D8C2;  // B004, ready
  for (int bit = 0; bit < 88; ++bit) {
    set("MOSI", bit < 48 ? static_cast<dpsim_level>(kReadReady >> (47 - bit) & 1) : 1);
    now += 720;
    set("SCK", 1);
    now += 720;
    set("SCK", 0);
  }
  now += 1200;
  set("XSS", 1);
  now += 1200;
  ok(dpsim_chip_advance(made, now));
  return drain(dpsim_chip_read_changes, made);
}

TEST(CapiScoreboard, MisoOfTheDutIsTheRegisterWhosePinFollows) {
  uint16_t miso = 0;
  ok(dpsim_pin_find("dsdpv1_rsu", "MISO", &miso));
  const std::vector<dpsim_change> pins = pins_of_a_frame();
  std::vector<dpsim_change> registers = pins;
  std::vector<std::size_t> moved;
  dpsim_level before = DPSIM_Z;
  for (std::size_t i = 0; i < pins.size(); ++i) {
    if (pins[i].pin != miso) continue;
    if (before != DPSIM_Z && pins[i].level != DPSIM_Z) moved.push_back(i);
    before = pins[i].level;
  }
  ASSERT_GT(moved.size(), 5U);
  const auto feed = [&](int64_t tolerance, std::vector<dpsim_change> changes) {
    std::stable_sort(changes.begin(), changes.end(), [](const auto& a, const auto& b) { return a.tick < b.tick; });
    return compared(make_scoreboard(tolerance, 0, "dsdpv1_rsu").get(), changes, changes.back().tick + 1000);
  };
  for (const std::size_t each : moved) registers[each].tick -= 120;  // spi_miso_delay
  EXPECT_EQ(feed(0, registers).tick, DPSIM_NEVER);
  EXPECT_EQ(feed(120, pins).tick, DPSIM_NEVER) << "RTL that is late by itself";
  registers[moved[2]].tick += 5;
  const auto result = feed(0, registers);
  EXPECT_EQ(result.tick, pins[moved[2]].tick) << "the pin's, not the register's";
  EXPECT_EQ(result.pin, miso);
  EXPECT_EQ(result.model, pins[moved[2]].level);
}

TEST(CapiScoreboard, WrongCallsSayWhatIsAllowed) {
  const auto scoreboard = make_scoreboard();
  const auto fails = [&](const dpsim_change& change, uint64_t until, dpsim_status wanted, const std::string& words) {
    EXPECT_EQ(dpsim_scoreboard_compare(scoreboard.get(), &change, 1, until, nullptr), wanted);
    EXPECT_EQ(std::string(dpsim_error_message()), "dpsim_scoreboard_compare: " + words);
  };
  compared(scoreboard.get(), {}, 1000);
  fails({999, 0, 0, 1, 0}, 1000, DPSIM_ERR_TIME, "tick is 999, which is before the present tick 1000");
  fails({1001, 0, 0, 1, 0}, 1000, DPSIM_ERR_TIME, "tick is 1000, which is before the present tick 1001");
  fails({1001, 0, 18, 1, 0}, 1001, DPSIM_ERR_NOT_FOUND, "pin is 18, expected 0 to 17");
  fails({1001, 0, DPSIM_DSDPV1_PBF, 2, 0}, 1001, DPSIM_ERR_ARGUMENT, "PBF is 2, expected -2 to 1");
  fails({1001, 0, DPSIM_DSDPV1_RESET, DPSIM_X, 0}, 1001, DPSIM_ERR_ARGUMENT,
        "the level of RESET is -2, expected 0 to 1");
  auto options = sized<dpsim_scoreboard_options>();
  options.tolerance = -1;
  dpsim_scoreboard* made = nullptr;
  EXPECT_EQ(dpsim_scoreboard_create(nullptr, &options, &made), DPSIM_ERR_ARGUMENT);
  EXPECT_EQ(std::string(dpsim_error_message()).find("dpsim_scoreboard_create: tolerance is -1, expected 0 to "), 0U);
  auto model = sized<dpsim_chip_options>();
  model.kind = "spc9";
  EXPECT_EQ(dpsim_scoreboard_create(&model, nullptr, &made), DPSIM_ERR_NOT_FOUND);
  EXPECT_EQ(made, nullptr);
  dpsim_scoreboard_result unsized{};
  EXPECT_EQ(dpsim_scoreboard_compare(scoreboard.get(), nullptr, 0, 2000, &unsized), DPSIM_ERR_SIZE);
  ok(dpsim_scoreboard_compare(scoreboard.get(), nullptr, 0, 1500, nullptr));
}

}  // namespace
}  // namespace dsdpv1::capi_test
