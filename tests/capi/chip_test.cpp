// One chip through the C API compared with the core.
#include <algorithm>
#include <cstring>
#include <map>
#include <string>
#include <thread>
#include <vector>

#include "model/dsdpv1/chip.hpp"
#include "model/dsdpv1/reasons.hpp"
#include "tests/capi/capi.hpp"
#include "tests/capi/pin_by_pin.h"

namespace dsdpv1::capi_test {
namespace {

using profibus::Tick;

std::vector<dpsim_change> driven_from_c(uint64_t released) {
  std::vector<dpsim_change> changes(1000);
  changes.resize(drive_pin_by_pin(released, changes.data(), changes.size()));
  return changes;
}

void note_change(void* self, Tick at, Pin pin, dsdpv1::Level level) {
  static_cast<std::vector<dpsim_change>*>(self)->push_back(
      {static_cast<uint64_t>(at), 0, static_cast<uint16_t>(pin), level, 0});
}

/// The same as pin_by_pin.c, on the core.
std::vector<dpsim_change> driven_core(Tick released) {
  constexpr Tick kNs = profibus::kTicksPerNs;
  std::vector<dpsim_change> changes;
  dsdpv1::Chip chip;
  chip.watch({note_change, &changes}, dsdpv1::kOutputPins);
  chip.set(released, Pin::kReset, 1);
  Tick now = 7200 * profibus::kTicksPerCycle;
  chip.advance(now);
  chip.set(now, Pin::kRReq, 1);
  do chip.advance(now += 100 * kNs);
  while (chip.level(Pin::kLReq) != 0 || chip.level(Pin::kLSta) != 0);
  chip.set(now, Pin::kRSta, 1);
  now += 50 * kNs;
  chip.set(now, Pin::kA, 4);
  chip.set(now, Pin::kCsr, 0);
  chip.set(now + 10 * kNs, Pin::kRd, 0);
  chip.sample(now + 50 * kNs);
  chip.set(now + 50 * kNs, Pin::kRd, 1);
  chip.set(now + 50 * kNs, Pin::kCsr, 1);
  chip.set(now + 100 * kNs, Pin::kRSta, 0);
  chip.set(now + 100 * kNs, Pin::kRReq, 0);
  chip.advance(now + 2000 * kNs);
  return changes;
}

TEST(CapiChip, DrivenPinByPinFromCItChangesItsPinsAsTheCoreDoes) {
  const auto changes = driven_from_c(5000);
  ASSERT_GT(changes.size(), 100U);
  EXPECT_EQ(changes, driven_core(5000));
}

TEST(CapiChip, ChipsInTwoThreadsDoWhatEachDoesAlone) {
  const auto alone = driven_core(5000), later = driven_core(7777);
  ASSERT_NE(alone, later);
  const auto work = [](uint64_t released, const std::vector<dpsim_change>& expected, bool& same) {
    same = true;
    for (int i = 0; i < 20; ++i) {
      dpsim_chip* none = nullptr;
      const std::string mine = "dpsim_chip_set: chip is NULL";
      same = same && driven_from_c(released) == expected;
      same = same && dpsim_chip_set(none, released, 0, 0) == DPSIM_ERR_ARGUMENT && mine == dpsim_error_message();
    }
  };
  bool first = false, second = false;
  std::thread one(work, 5000, std::cref(alone), std::ref(first));
  std::thread two(work, 7777, std::cref(later), std::ref(second));
  one.join();
  two.join();
  EXPECT_TRUE(first);
  EXPECT_TRUE(second);
}

TEST(CapiChip, PinsOfTheRegistryAreThoseOfTheHeaderAndOfTable1) {
  const char* const kinds[] = {"dsdpv1", "dsdpv1_r", "dsdpv1_rsu", "apc3", "spc3", "vpc3", "xgate"};
  ASSERT_EQ(dpsim_kind_count(), std::size(kinds));
  for (size_t i = 0; i < std::size(kinds); ++i) EXPECT_STREQ(dpsim_kind_name(i), kinds[i]);
  EXPECT_EQ(dpsim_kind_name(std::size(kinds)), nullptr);
  EXPECT_EQ(dpsim_pin_count("dsdpv1_r"), static_cast<size_t>(dsdpv1::kPinCount));
  EXPECT_EQ(dpsim_pin_count("dsdpv1_rsu"), static_cast<size_t>(dsdpv1::kRsuPinCount));
  ASSERT_EQ(dpsim_pin_count("dsdpv1"), static_cast<size_t>(dsdpv1::kPinCount));
  EXPECT_EQ(dpsim_pin_count("spc9"), 0U);
  const dsdpv1::Chip fresh;
  for (size_t i = 0; i < dpsim_pin_count(nullptr); ++i) {
    const auto pin = static_cast<Pin>(i);
    auto info = sized<dpsim_pin_info>();
    ok(dpsim_pin_get(nullptr, i, &info));
    EXPECT_EQ(info.number, i);
    EXPECT_STREQ(info.name, dsdpv1::name(pin));
    EXPECT_EQ(info.width, dsdpv1::width(pin));
    EXPECT_EQ(info.input != 0, dsdpv1::is_input(pin));
    EXPECT_EQ(info.reset_level, fresh.level(pin)) << info.name;
    uint16_t number = 0;
    ok(dpsim_pin_find("", info.name, &number));
    EXPECT_EQ(number, i);
  }
}

TEST(CapiChip, NumbersOfPinsInTheHeaderAreThoseOfTheRegistry) {
  const std::pair<int, const char*> pins[] = {
      {DPSIM_DSDPV1_RESET, "RESET"}, {DPSIM_DSDPV1_R_REQ, "R_REQ"}, {DPSIM_DSDPV1_R_STA, "R_STA"},
      {DPSIM_DSDPV1_CSR, "CSR"},     {DPSIM_DSDPV1_RD, "RD"},       {DPSIM_DSDPV1_WR, "WR"},
      {DPSIM_DSDPV1_A, "A"},         {DPSIM_DSDPV1_D_IN, "D_IN"},   {DPSIM_DSDPV1_PBRXD, "PBRXD"},
      {DPSIM_DSDPV1_L_REQ, "L_REQ"}, {DPSIM_DSDPV1_L_STA, "L_STA"}, {DPSIM_DSDPV1_D_OUT, "D_OUT"},
      {DPSIM_DSDPV1_INTR0, "INTR0"}, {DPSIM_DSDPV1_PBTXD, "PBTXD"}, {DPSIM_DSDPV1_PBRTS, "PBRTS"},
      {DPSIM_DSDPV1_PBF, "PBF"},     {DPSIM_DSDPV1_BR, "BR"},       {DPSIM_DSDPV1_READY, "READY"}};
  ASSERT_EQ(std::size(pins), dpsim_pin_count(nullptr));
  for (const auto& [number, name] : pins) {
    uint16_t found = 0;
    ok(dpsim_pin_find(nullptr, name, &found));
    EXPECT_EQ(found, number) << name;
  }
}

TEST(CapiChip, ParametersOfTheRulingsAreThoseThatTheChipTakes) {
  size_t found = 0;
  for (size_t i = 0; i < dpsim_parameter_count(nullptr); ++i) {
    auto info = sized<dpsim_parameter_info>();
    ok(dpsim_parameter_get(nullptr, i, &info));
    EXPECT_LE(info.minimum, info.default_value) << info.name;
    EXPECT_LE(info.default_value, info.maximum) << info.name;
    if (std::string(info.name) != "ready_cycles") continue;
    ++found;
    EXPECT_EQ(info.default_value, dsdpv1::Config().ready_cycles);
  }
  EXPECT_EQ(found, 1U);
  const dpsim_parameter late = {"ready_cycles", 10'000};
  auto options = sized<dpsim_chip_options>();
  options.parameters = &late;
  options.parameter_count = 1;
  dpsim_chip* made = nullptr;
  ok(dpsim_chip_create(&options, &made));
  const Owned<dpsim_chip> chip(made);
  uint8_t cell = 0;
  ok(dpsim_chip_set(made, 0, DPSIM_DSDPV1_RESET, 1));
  ok(dpsim_chip_advance(made, 9'900 * kCycle));
  ok(dpsim_chip_peek(made, 4, &cell));
  EXPECT_EQ(cell, 0);
  ok(dpsim_chip_advance(made, 10'200 * kCycle));
  ok(dpsim_chip_peek(made, 4, &cell));
  EXPECT_EQ(cell, 0xC5);
}

/// In scenarios fcb_rule is a word.
TEST(CapiChip, AParameterThatIsAWordIsItsPlace) {
  auto info = sized<dpsim_parameter_info>();
  for (size_t i = 0; std::string(info.name == nullptr ? "" : info.name) != "fcb_rule"; ++i)
    ok(dpsim_parameter_get(nullptr, i, &info));
  EXPECT_EQ(info.minimum, 0);
  EXPECT_EQ(info.maximum, 1);
  EXPECT_EQ(info.default_value, 0) << "letter";
  dpsim_parameter content = {"fcb_rule", 2};
  auto options = sized<dpsim_chip_options>();
  options.parameters = &content;
  options.parameter_count = 1;
  dpsim_chip* made = nullptr;
  EXPECT_NE(dpsim_chip_create(&options, &made), DPSIM_OK);
  content.value = 1;
  ok(dpsim_chip_create(&options, &made));
  const Owned<dpsim_chip> chip(made);
  ok(dpsim_chip_create(nullptr, &made));
  const Owned<dpsim_chip> usual(made);
  std::vector<uint8_t> state(DPSIM_MAX_CHIP_STATE);
  size_t size = 0;
  ok(dpsim_chip_save(chip.get(), state.data(), state.size(), &size));
  EXPECT_EQ(dpsim_chip_restore(usual.get(), state.data(), size), DPSIM_ERR_INPUT) << "another fcb_rule";
}

TEST(CapiChip, ParametersOfTheRsuAreNumbersAndItsStrapsArePins) {
  std::map<std::string, dpsim_parameter_info> all;
  for (size_t i = 0; i < dpsim_parameter_count("dsdpv1_rsu"); ++i) {
    auto info = sized<dpsim_parameter_info>();
    ok(dpsim_parameter_get("dsdpv1_rsu", i, &info));
    all[info.name] = info;
  }
  for (size_t i = 0; i < dsdpv1::Config().uart_gaps.size(); ++i) {
    const std::string name = "uart_gaps[" + std::to_string(i) + "]";
    ASSERT_EQ(all.count(name), 1U) << name;
    EXPECT_EQ(all[name].default_value, dsdpv1::Config().uart_gaps.at(i));
    EXPECT_EQ(all[name].maximum, 1000);
  }
  EXPECT_EQ(all.at("spi_write_gap").default_value, 128);
  for (const char* strap : {"mode", "address", "uart_rate", "interval", "uart_gaps"}) EXPECT_EQ(all.count(strap), 0U);
}

TEST(CapiChip, OneOfTheRsusGapsIsSetByItself) {
  const dpsim_parameter gap = {"uart_gaps[7]", 1}, mode = {"mode", 1};
  auto options = sized<dpsim_chip_options>();
  options.kind = "dsdpv1_rsu";
  options.parameters = &mode;
  options.parameter_count = 1;
  dpsim_chip* made = nullptr;
  EXPECT_EQ(dpsim_chip_create(&options, &made), DPSIM_ERR_NOT_FOUND);
  options.parameters = &gap;
  ok(dpsim_chip_create(&options, &made));
  const Owned<dpsim_chip> chip(made);
  const auto set = [&](const char* name, uint64_t at, int16_t level) {
    uint16_t pin = 0;
    ok(dpsim_pin_find("dsdpv1_rsu", name, &pin));
    ok(dpsim_chip_set(made, at, pin, level));
  };
  set("MODE", 0, 2), set("ADR", 0, 1), set("UBR", 0, 7), set("UIV", 0, 7);
  set("RESET", 1000, 1);
  // A character 01, then silence: with an interval of half a character the telegram is dropped at once.
  std::vector<std::string> codes;
  const auto note = [](void* user, const dpsim_chip_event* event) {
    auto info = sized<dpsim_reason_info>();
    ok(dpsim_reason_get("dsdpv1_rsu", event->reason, &info));
    static_cast<std::vector<std::string>*>(user)->emplace_back(info.code);
  };
  ok(dpsim_chip_on_event(made, note, &codes));
  constexpr uint64_t kBit = 26 * kCycle, kStart = 1000 * kCycle;
  set("RXD", kStart, 0), set("RXD", kStart + kBit, 1), set("RXD", kStart + 2 * kBit, 0),
      set("RXD", kStart + 9 * kBit, 1);
  ok(dpsim_chip_advance(made, kStart + 18 * kBit));
  EXPECT_EQ(codes, std::vector<std::string>{"TELEGRAM_CUT"});
}

/// Some accesses of the user and some time.
std::vector<dpsim_change> short_life(dpsim_engine engine) {
  const auto chip = make_chip(engine);
  ok(dpsim_chip_watch(chip.get(), DPSIM_ALL_PINS, nullptr, nullptr));
  ok(dpsim_chip_set(chip.get(), 1000, DPSIM_DSDPV1_RESET, 1));
  ok(dpsim_chip_advance(chip.get(), 6000 * kCycle));
  ok(dpsim_chip_set(chip.get(), 6000 * kCycle, DPSIM_DSDPV1_R_REQ, 1));
  uint64_t now = 6010 * kCycle;
  ok(dpsim_chip_set(chip.get(), now, DPSIM_DSDPV1_R_STA, 1));
  ok(dpsim_chip_write(chip.get(), now, 0x123, 0x5A, nullptr, &now));
  dpsim_level value = 0;
  ok(dpsim_chip_read(chip.get(), now + 1000, 0x123, nullptr, &value, &now));
  EXPECT_EQ(value, 0x5A);
  return drain(dpsim_chip_read_changes, chip.get());
}

TEST(CapiChip, StepAndSkipChangeTheSamePinsInputsToo) {
  const auto skip = short_life(DPSIM_ENGINE_SKIP);
  EXPECT_EQ(skip, short_life(DPSIM_ENGINE_STEP));
  const dpsim_change address = {0, 0, DPSIM_DSDPV1_A, 0x123, 0};
  EXPECT_EQ(std::count_if(
                skip.begin(), skip.end(),
                [&](const dpsim_change& each) { return each.pin == address.pin && each.level == address.level; }),
            2);
  EXPECT_TRUE(std::is_sorted(skip.begin(), skip.end(),
                             [](const dpsim_change& a, const dpsim_change& b) { return a.tick < b.tick; }));
}

TEST(CapiChip, ManyChangesInOneCallAreThoseOfManyCalls) {
  const std::vector<dpsim_change> inputs = {{1000, 0, DPSIM_DSDPV1_RESET, 1, 0},
                                            {6000 * kCycle, 0, DPSIM_DSDPV1_R_REQ, 1, 0},
                                            {6000 * kCycle + 17, 0, DPSIM_DSDPV1_R_STA, 1, 0}};
  const auto one = make_chip(), many = make_chip();
  for (const auto& chip : {one.get(), many.get()}) ok(dpsim_chip_watch(chip, DPSIM_ALL_PINS, nullptr, nullptr));
  size_t done = 0;
  ok(dpsim_chip_set_many(many.get(), inputs.data(), inputs.size(), &done));
  EXPECT_EQ(done, inputs.size());
  for (const dpsim_change& each : inputs) ok(dpsim_chip_set(one.get(), each.tick, each.pin, each.level));
  EXPECT_EQ(drain(dpsim_chip_read_changes, one.get()), drain(dpsim_chip_read_changes, many.get()));
}

TEST(CapiChip, CharactersAreTheirEdges) {
  const uint8_t bytes[] = {0x10, 0x00, 0xFF, 0x5A};
  const auto told = make_chip(), edges = make_chip();
  for (const auto& chip : {told.get(), edges.get()}) {
    ok(dpsim_chip_watch(chip, DPSIM_ALL_PINS, nullptr, nullptr));
    ok(dpsim_chip_set(chip, 1000, DPSIM_DSDPV1_RESET, 1));
  }
  uint64_t end = 0;
  ok(dpsim_chip_receive(told.get(), 6000 * kCycle, 1000, bytes, sizeof bytes, &end));
  EXPECT_EQ(end, 6000 * kCycle + 11 * 1000 * sizeof bytes);
  EXPECT_EQ(receive_edges(edges.get(), 6000 * kCycle, 1000, bytes), end);
  const auto changes = drain(dpsim_chip_read_changes, told.get());
  EXPECT_EQ(changes, drain(dpsim_chip_read_changes, edges.get()));
  EXPECT_GT(std::count_if(changes.begin(), changes.end(),
                          [](const dpsim_change& each) { return each.pin == DPSIM_DSDPV1_PBRXD; }),
            10);
  EXPECT_EQ(dpsim_chip_receive(told.get(), end, 0, bytes, sizeof bytes, &end), DPSIM_ERR_ARGUMENT);
}

TEST(CapiChip, WhatIsToldAtOnceIsWhatIsKept) {
  std::vector<dpsim_change> told;
  const auto chip = make_chip(), keeping = make_chip();
  ok(dpsim_chip_watch(
      chip.get(), DPSIM_PIN(DPSIM_DSDPV1_L_REQ),
      [](void* user, const dpsim_change* change) { static_cast<std::vector<dpsim_change>*>(user)->push_back(*change); },
      &told));
  ok(dpsim_chip_watch(keeping.get(), DPSIM_PIN(DPSIM_DSDPV1_L_REQ), nullptr, nullptr));
  for (const auto& each : {chip.get(), keeping.get()}) {
    ok(dpsim_chip_set(each, 0, DPSIM_DSDPV1_RESET, 1));
    ok(dpsim_chip_advance(each, kMs));
  }
  EXPECT_GT(told.size(), 1000U);
  EXPECT_EQ(told, drain(dpsim_chip_read_changes, keeping.get()));
}

TEST(CapiChip, NextIsWhenAnOutputMayChange) {
  const auto chip = make_chip();
  uint64_t next = 0;
  ok(dpsim_chip_next(chip.get(), &next));
  EXPECT_EQ(next, DPSIM_NEVER);  // in reset
  ok(dpsim_chip_set(chip.get(), 0, DPSIM_DSDPV1_RESET, 1));
  ok(dpsim_chip_watch(chip.get(), DPSIM_PIN(DPSIM_DSDPV1_L_REQ), nullptr, nullptr));
  for (int i = 0; i < 50; ++i) {
    ok(dpsim_chip_next(chip.get(), &next));
    ASSERT_NE(next, DPSIM_NEVER);
    if (next > 0) ok(dpsim_chip_advance(chip.get(), next - 1));
    EXPECT_TRUE(drain(dpsim_chip_read_changes, chip.get()).empty()) << "before tick " << next;
    ok(dpsim_chip_advance(chip.get(), next));
    drain(dpsim_chip_read_changes, chip.get());
  }
}

struct ToldEvents {
  std::vector<dpsim_chip_event> events;
  static void call(void* user, const dpsim_chip_event* event) {
    static_cast<ToldEvents*>(user)->events.push_back(*event);
  }
};

TEST(CapiChip, AnEventHasItsReasonItsNumbersAndItsWords) {
  ToldEvents told;
  const auto chip = make_chip();
  ok(dpsim_chip_on_event(chip.get(), ToldEvents::call, &told));
  ok(dpsim_chip_set(chip.get(), 0, DPSIM_DSDPV1_RESET, 1));
  ok(dpsim_chip_advance(chip.get(), 6000 * kCycle));
  told.events.clear();
  uint64_t end = 0;
  ok(dpsim_chip_write(chip.get(), 6000 * kCycle, 0x123, 1, nullptr, &end));  // without ownership, P12
  ASSERT_EQ(told.events.size(), 1U);
  auto reason = sized<dpsim_reason_info>();
  ok(dpsim_reason_get(nullptr, told.events[0].reason, &reason));
  EXPECT_EQ(reason.severity, DPSIM_SEVERITY_VIOLATION);
  char text[256];
  ok(dpsim_chip_event_text(nullptr, &told.events[0], text, sizeof text));
  const auto known = dsdpv1::reasons();
  EXPECT_STREQ(reason.code, profibus::code(known[told.events[0].reason]));
  EXPECT_NE(std::strstr(text, "123"), nullptr) << text;
  EXPECT_EQ(dpsim_chip_event_text(nullptr, &told.events[0], text, 5), DPSIM_ERR_SPACE);
  EXPECT_EQ(std::strlen(text), 4U);
}

TEST(CapiChip, NoTextOfAnEventIsLongerThanTheHeaderPromises) {
  for (size_t i = 0; i < dpsim_reason_count(nullptr); ++i) {
    const dpsim_chip_event event = {0, 0, static_cast<uint16_t>(i), 0xFFFF, 0xFFFF, 0xFFFF, {}};
    char text[256];
    ok(dpsim_chip_event_text(nullptr, &event, text, sizeof text));
  }
}

TEST(CapiChip, AFreshChipIsOfflineAndSearchesItsRate) {
  const auto chip = make_chip();
  auto status = sized<dpsim_chip_status>();
  ok(dpsim_chip_get_status(chip.get(), &status));
  EXPECT_EQ(status.dp_state, DPSIM_DP_OFFLINE);
  EXPECT_EQ(status.baud, DPSIM_BAUD_NONE);
  EXPECT_EQ(status.master, 255);
  EXPECT_EQ(status.size, sizeof status);
}

TEST(CapiChip, ACellThatIsPokedIsSeenByPeekAndAtThePins) {
  constexpr uint16_t kCell = 0x100;
  const auto chip = make_chip();
  ok(dpsim_chip_set(chip.get(), 1000, DPSIM_DSDPV1_RESET, 1));
  ok(dpsim_chip_advance(chip.get(), 6000 * kCycle));
  ok(dpsim_chip_poke(chip.get(), kCell, 0x5A));
  uint8_t peeked = 0;
  ok(dpsim_chip_peek(chip.get(), kCell, &peeked));
  EXPECT_EQ(peeked, 0x5A);
  uint64_t now = 6000 * kCycle;
  ok(dpsim_chip_set(chip.get(), now, DPSIM_DSDPV1_R_REQ, 1));
  ok(dpsim_chip_set(chip.get(), now += 100 * kCycle, DPSIM_DSDPV1_R_STA, 1));
  dpsim_level read = 0;
  ok(dpsim_chip_read(chip.get(), now + kCycle, kCell, nullptr, &read, &now));
  EXPECT_EQ(read, 0x5A);
  EXPECT_EQ(dpsim_chip_poke(chip.get(), 0x800, 0), DPSIM_ERR_ARGUMENT);
}

/// An APC3 out of RESET, which is high-active and its first pin.
Owned<dpsim_chip> make_apc3(const char* kind = "apc3") {
  auto options = sized<dpsim_chip_options>();
  options.kind = kind;
  dpsim_chip* chip = nullptr;
  ok(dpsim_chip_create(&options, &chip));
  ok(dpsim_chip_set(chip, 20 * kCycle, 0, 0));
  ok(dpsim_chip_advance(chip, 30 * kCycle));
  return Owned<dpsim_chip>(chip);
}

TEST(CapiChip, RegistersWithoutABusAreReadAndWrittenWithTheirEffects) {
  const auto chip = make_apc3();
  uint64_t now = 30 * kCycle;
  const auto load = [&](uint16_t address) {
    uint8_t value = 0;
    ok(dpsim_chip_load(chip.get(), now += kCycle, address, &value));
    return value;
  };
  const auto store = [&](uint16_t address, uint8_t value) {
    ok(dpsim_chip_store(chip.get(), now += kCycle, address, value));
  };
  EXPECT_EQ(load(0x08), 0xE1) << "buffers of the inputs: D 1, U 2, F 3 (A17)";
  EXPECT_EQ(load(0x09), 3) << "New_Din is a command: the user has another buffer now";
  EXPECT_EQ(load(0x08), 0x39) << "D 1, N 2, U 3";
  store(0x07, 0x01);  // DP_Mode
  store(0x16, 5);
  store(0x08, 0x01);  // START
  EXPECT_EQ(load(0x04) & 0x09, 0x01) << "PASSIVE_IDLE";
  load(0x7FF);
  EXPECT_EQ(load(0x04) & 0x09, 0x08) << "a violation, and OFFLINE (A3)";
}

TEST(CapiChip, AChipOfTheSpc3FamilyHasTheSameAccessesAtItsPins) {
  const auto chip = make_apc3();
  uint64_t now = 30 * kCycle;
  const auto read = [&](uint16_t address) {
    dpsim_level value = DPSIM_X;
    ok(dpsim_chip_read(chip.get(), now, address, nullptr, &value, &now));
    return value;
  };
  const auto write = [&](uint16_t address, uint8_t value) {
    ok(dpsim_chip_write(chip.get(), now, address, value, nullptr, &now));
  };
  int events = 0;
  ok(dpsim_chip_on_event(
      chip.get(), [](void* user, const dpsim_chip_event*) { ++*static_cast<int*>(user); }, &events));
  EXPECT_EQ(read(0x09), 3);
  EXPECT_EQ(read(0x08), 0x39) << "New_Din, once";
  write(0x120, 0xA5);
  EXPECT_EQ(read(0x120), 0xA5);
  EXPECT_EQ(events, 0) << "the default waits for XREADY";
  auto timing = sized<dpsim_access_timing>();
  ok(dpsim_access_timing_default(&timing));
  dpsim_level value = 0;
  ok(dpsim_chip_read(chip.get(), now, 0x120, &timing, &value, &now));
  EXPECT_EQ(value, 0xA5);
  EXPECT_EQ(events, 1) << "too soon (A42)";
  uint16_t mode = 0;
  ok(dpsim_pin_find("apc3", "MODE", &mode));
  ok(dpsim_chip_set(chip.get(), now, mode, 1));
  EXPECT_EQ(dpsim_chip_read(chip.get(), now, 0x120, nullptr, &value, &now), DPSIM_ERR_UNSUPPORTED);
  const auto vpc3 = make_apc3("vpc3");
  ok(dpsim_chip_write(vpc3.get(), now, 0x120, 0x5A, nullptr, &now));
  uint16_t serial = 0;
  ok(dpsim_pin_find("vpc3", "SERIAL", &serial));
  ok(dpsim_chip_set(vpc3.get(), now, serial, 1));
  EXPECT_EQ(dpsim_chip_read(vpc3.get(), now, 0x120, nullptr, &value, &now), DPSIM_ERR_UNSUPPORTED) << "SPI (A59)";
}

TEST(CapiChip, RegistersAreOnlyCalledInTimeAndOfAKindWithoutPinsForThem) {
  uint8_t value = 0;
  const auto apc3 = make_apc3();
  EXPECT_EQ(dpsim_chip_load(apc3.get(), 29 * kCycle, 4, &value), DPSIM_ERR_TIME);
  EXPECT_EQ(dpsim_chip_load(apc3.get(), 31 * kCycle, 4, nullptr), DPSIM_ERR_ARGUMENT);
  const auto dsdpv1 = make_chip();
  EXPECT_EQ(dpsim_chip_load(dsdpv1.get(), kCycle, 4, &value), DPSIM_ERR_UNSUPPORTED);
  EXPECT_EQ(dpsim_chip_store(dsdpv1.get(), kCycle, 4, 0), DPSIM_ERR_UNSUPPORTED);
}

TEST(CapiTime, ConvertsAbsoluteTimesWithoutDrift) {
  EXPECT_EQ(dpsim_ticks_to(250, DPSIM_FS), 20'833'333U);
  EXPECT_EQ(dpsim_ticks_to(250, DPSIM_PS), 20'833U);
  EXPECT_EQ(dpsim_ticks_to(12'000'000'000, DPSIM_FS), 1'000'000'000'000'000U);
  EXPECT_EQ(dpsim_ticks_from(1, DPSIM_S), 12'000'000'000U);
  EXPECT_EQ(dpsim_ticks_from(3, DPSIM_CYCLES), 750U);
  EXPECT_EQ(dpsim_ticks_from(1, 99), DPSIM_NEVER);
  EXPECT_EQ(dpsim_ticks_from(UINT64_MAX, DPSIM_S), DPSIM_NEVER);
  EXPECT_EQ(dpsim_ticks_to(DPSIM_LAST_TICK, DPSIM_FS), UINT64_MAX);
  for (uint64_t tick = 1; tick < DPSIM_LAST_TICK / 1000; tick = tick * 3 + 1) {
    EXPECT_EQ(dpsim_ticks_from(dpsim_ticks_to(tick, DPSIM_PS), DPSIM_PS), tick);
    if (dpsim_ticks_to(tick, DPSIM_FS) != UINT64_MAX)
      EXPECT_EQ(dpsim_ticks_from(dpsim_ticks_to(tick, DPSIM_FS), DPSIM_FS), tick);
  }
}

TEST(CapiTime, VersionsAreThoseOfTheHeader) {
  EXPECT_EQ(dpsim_abi_version(), DPSIM_ABI_MAJOR * 65536U + DPSIM_ABI_MINOR);
  EXPECT_STREQ(dpsim_version(), DSDPV1_VERSION);
}

}  // namespace
}  // namespace dsdpv1::capi_test
