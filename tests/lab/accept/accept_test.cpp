// The plan of a run of accept, and what counts in it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <set>
#include <sstream>

#include "io/input/input_error.hpp"
#include "kinds/dsdpv1/user_cpu/read_spoiler.hpp"
#include "lab/accept/facts.hpp"
#include "lab/accept/outcome.hpp"
#include "lab/accept/plan.hpp"
#include "tb/bench/verdict.hpp"

namespace dsdpv1 {
namespace {

using namespace tb::accept;
using testing::AllOf;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;

Order an_order() {
  Order order;
  order.program = "my 'own'.elf";
  order.gsd = DSDPV1_SOURCE_DIR "/scenarios/dsdpv1.gsd";
  order.modules = {"2 bytes in", "2 bytes out"};
  return order;
}

const Section& section(const Plan& plan, const std::string& name) {
  for (const Section& each : plan.sections)
    if (each.stimulus->name == name) return each;
  throw std::out_of_range(name);
}

TEST(AcceptStimuli, EachHasANameOfItsOwnAndAsksForSomething) {
  std::set<std::string> names;
  for (const Stimulus& each : stimuli()) {
    EXPECT_TRUE(names.insert(each.name).second) << each.name;
    EXPECT_FALSE(each.met.empty()) << each.name;
  }
}

TEST(AcceptStimuli, EachIsInThePage) {
  std::ifstream in(DSDPV1_SOURCE_DIR "/docs/accept.md");
  std::ostringstream page;
  page << in.rdbuf();
  for (const Stimulus& each : stimuli())
    EXPECT_THAT(page.str(), HasSubstr("| " + std::string(each.name) + " | " + each.about + " |"));
}

TEST(AcceptPlan, TheScenarioIsTheTextAndTheSectionsFollowEachOther) {
  const Plan plan = make_plan(an_order(), "a.yaml");
  EXPECT_EQ(tb::scenario::parse(plan.text, "a.yaml").script.size(), plan.scenario.script.size());
  EXPECT_EQ(plan.scenario.name, "Acceptance of my 'own'.elf");
  EXPECT_EQ(plan.scenario.masters.front().slaves.front().pattern, bus::OutputPattern::kRandom);
  bus::Tick at = 0;
  for (const Section& each : plan.sections) {
    EXPECT_EQ(each.from, at) << each.stimulus->name;
    at = each.to;
  }
  EXPECT_EQ(at, plan.end);
  EXPECT_EQ(plan.scenario.end, kLongestStart + plan.end);
}

TEST(AcceptPlan, AnotherSeedHasOtherTimes) {
  Order order = an_order();
  const std::string first = make_plan(order, "a.yaml").text;
  EXPECT_EQ(make_plan(order, "a.yaml").text, first);
  order.seed = 2;
  EXPECT_NE(make_plan(order, "a.yaml").text, first);
}

TEST(AcceptPlan, PausesFollowTheTimeInWhichTheSlaveServes) {
  Order order = an_order();
  const Plan usual = make_plan(order, "a.yaml");
  order.within = 2 * bus::kTicksPerMs;
  const Plan fast = make_plan(order, "a.yaml");
  order.within = 25 * bus::kTicksPerMs;
  const Plan slow = make_plan(order, "a.yaml");
  EXPECT_LT(fast.end, usual.end / 3);
  EXPECT_GT(slow.end, 2 * usual.end);
  EXPECT_EQ(fast.scenario.script.size(), usual.scenario.script.size());
  EXPECT_EQ(fast.scenario.masters2.front().connections.at(1).send_timeout, 1U);
  EXPECT_EQ(slow.scenario.masters2.front().connections.at(1).send_timeout, 3U);
  for (const Plan* each : {&fast, &usual, &slow})
    EXPECT_GT(section(*each, "watchdog").to - section(*each, "watchdog").from, 100 * bus::kTicksPerMs);
}

/// Set_Prm with Unlock from addresses 2, of the master that has stopped, and 3, the probe's.
TEST(AcceptPlan, TheProbeReleasesTheSlaveInTheMastersNameAndThenInItsOwn) {
  Order order = an_order();
  order.only = {"wrong ident"};
  const std::string text = make_plan(order, "a.yaml").text;
  EXPECT_THAT(text, HasSubstr("master: probe, bytes: \"68 0F 0F 68 85 82 6D 3D 3E 40 "));
  EXPECT_THAT(text, HasSubstr("master: probe, bytes: \"68 0F 0F 68 85 83 6D 3D 3E 40 "));
}

TEST(AcceptPlan, MastersHaveOtherAddressesThanTheSlave) {
  for (const int address : {0, 1, 2, 3, 4, 125}) {
    Order order = an_order();
    order.address = address;
    const Plan plan = make_plan(order, "a.yaml");
    EXPECT_EQ(plan.address, address);
    std::set<int> all = {address, plan.scenario.masters2.front().address};
    for (const auto& master : plan.scenario.masters) all.insert(master.address);
    EXPECT_EQ(all.size(), 4U);
  }
}

TEST(AcceptPlan, WhatTheGsdLacksIsLeftOutWithAReason) {
  Order order = an_order();
  order.gsd = DSDPV1_SOURCE_DIR "/tests/lab/accept/plain.gsd";
  order.modules = {};
  const Plan plan = make_plan(order, "a.yaml");
  EXPECT_EQ(section(plan, "C1").left_out, "the GSD has no DPV1_Slave and C1_Read_Write_supp");
  EXPECT_EQ(section(plan, "C2").left_out, "the GSD has no C2_Read_Write_supp");
  EXPECT_EQ(section(plan, "sync and freeze").left_out, "the GSD has no Sync_Mode_supp and Freeze_Mode_supp");
  EXPECT_EQ(section(plan, "C1").to, section(plan, "C1").from);
  EXPECT_THAT(plan.text, Not(HasSubstr("do: c1_read")));
  EXPECT_EQ(section(plan, "wrong configuration").left_out, "");
}

TEST(AcceptPlan, OnlyTheStimuliAskedForAndTheStart) {
  Order order = an_order();
  order.only = {"clear"};
  const Plan plan = make_plan(order, "a.yaml");
  EXPECT_EQ(section(plan, "start").left_out, "");
  EXPECT_EQ(section(plan, "clear").left_out, "");
  EXPECT_EQ(section(plan, "C2").left_out, kNotAskedFor);
}

/// A run of a few events, told to Facts as the bench does.
struct AcceptOutcome : testing::Test {
  AcceptOutcome() {
    Order order = an_order();
    order.only = {"clear", "interrupts"};
    plan = make_plan(order, "a.yaml");
    facts.emplace(plan.scenario, plan.address);
    tell("INITIALISED", 1000);
    tell("DP_STATE", 2000, 0, 3);
    facts->acts(plan.scenario.script.front(), 2000);
  }
  void tell(const char* code, bus::Tick at, std::uint16_t a = 0, std::uint16_t b = 0) {
    for (const profibus::Reason reason : plan.scenario.kind->reasons())
      if (std::string(profibus::code(reason)) == code) return facts->event(0, {at, reason, a, b, 0});
    FAIL() << code;
  }
  tb::RunResult judged() const {
    tb::RunResult result;
    judge(result, plan, *facts);
    return result;
  }
  std::string missed() const {
    std::string text;
    for (const tb::ExpectationResult& each : judged().expectations)
      if (!each.passed) text += each.text + ", seen " + each.seen + "\n";
    return text;
  }
  Plan plan;
  std::optional<Facts> facts;
};

TEST_F(AcceptOutcome, WhatASlaveOwesIsAnExpectation) {
  EXPECT_EQ(missed(),
            "clear: Global_Control at least 1, seen 0 times\n"
            "interrupts: interrupts at least 1, seen 0 times\n");
  EXPECT_EQ(verdict(judged()), tb::Verdict::kFailed);
}

TEST_F(AcceptOutcome, EventsCountForTheStimulusOfTheirTime) {
  tell("GLOBAL_CONTROL", 2000 + section(plan, "clear").from + 5);
  EXPECT_EQ(missed(), "interrupts: interrupts at least 1, seen 0 times\n");
  EXPECT_THAT(table(plan, *facts), ContainsRegex("clear +Global_Control +1  ok"));
}

TEST_F(AcceptOutcome, ViolationsStandBesideTheirStimulus) {
  facts->flag({bus::FlagKind::kCollision, 2000 + section(plan, "clear").from + 5, {}});
  EXPECT_THAT(table(plan, *facts), HasSubstr("VIOLATED: 1 BUS_COLLISION"));
}

/// DC 02 02 that ends within its last character is DC 02 FE.
TEST_F(AcceptOutcome, TheRestOfATelegramThatAMasterCutsOffIsNoViolation) {
  for (const auto kind : {bus::FlagKind::kCharacterError, bus::FlagKind::kTelegramError, bus::FlagKind::kGlitch,
                          bus::FlagKind::kTwoMasters})
    facts->flag({kind, 2000 + section(plan, "clear").from + 5, {}});
  EXPECT_THAT(table(plan, *facts), Not(HasSubstr("VIOLATED")));
}

TEST_F(AcceptOutcome, AnAnswerWithBit7IsAnError) {
  tell("C1_ANSWER", 3000, 0x5E);
  tell("C1_ANSWER", 3001, 0xDE);
  tell("C2_ANSWER", 3002, 0x30, 0xDF);
  EXPECT_EQ(facts->count("C1 data", 0, 4000), 1U);
  EXPECT_EQ(facts->count("C1 error", 0, 4000), 1U);
  EXPECT_EQ(facts->count("C2 error", 0, 4000), 1U);
  EXPECT_EQ(facts->count("C1_ANSWER", 0, 3001), 1U);
}

TEST_F(AcceptOutcome, ABlockBeforeTheVerdictOnTheOneBeforeIsNewer) {
  tell("CFG_TO_USER", 3000);
  tell("CFG_OK", 3001);
  tell("CFG_TO_USER", 3002);
  tell("PRM_TO_USER", 3003);
  EXPECT_EQ(facts->count("newer block", 0, 4000), 0U);
  tell("CFG_TO_USER", 3004);
  EXPECT_EQ(facts->count("newer block", 0, 4000), 1U);
}

TEST_F(AcceptOutcome, WrongBitsThatTheUserReadsCount) {
  facts->action(0, 3000, "reads a wrong bit");
  facts->action(0, 3001, "read B319");
  EXPECT_EQ(facts->count("spoilt", 0, 4000), 1U);
}

TEST(AcceptTable, HasThePhasesOfAHoldOnlyWhereTheUserCanHold) {
  const auto table_of = [](const char* mode) {
    Order order = an_order();
    order.chip = "dsdpv1_rsu";
    order.mode = mode;
    const Plan plan = make_plan(order, "a.yaml");
    return table(plan, Facts(plan.scenario, plan.address));
  };
  EXPECT_THAT(table_of("parallel"), AllOf(HasSubstr("inside a hold"), HasSubstr("waits for the memory")));
  EXPECT_THAT(table_of("spi"), AllOf(HasSubstr("inside a hold"), Not(HasSubstr("waits for the memory"))));
  EXPECT_THAT(table_of("uart"), Not(HasSubstr("hold")));
}

TEST(AcceptPlan, AProgramOfThisComputerIsAProcessAndIsToldNothing) {
  Order order = an_order();
  order.program = "/proc/self/exe";
  EXPECT_THAT(make_plan(order, "a.yaml").text,
              AllOf(HasSubstr("kind: process\n      program: '/proc/self/exe'"), Not(HasSubstr("prm_mode"))));
  order.program.clear();
  EXPECT_THAT(make_plan(order, "a.yaml").text, AllOf(HasSubstr("prm_mode"), Not(HasSubstr("kind: arm"))));
}

TEST(AcceptSpoiler, EachBlockOfTheChipIsReadWronglyOnce) {
  user_cpu::ReadSpoiler spoiler;
  EXPECT_EQ(spoiler.wrong_bits(regs::kCfgData), 0);
  spoiler.arm();
  EXPECT_EQ(spoiler.wrong_bits(regs::kChipCommand1), 0);
  EXPECT_NE(spoiler.wrong_bits(regs::kCfgData), 0);
  EXPECT_EQ(spoiler.wrong_bits(regs::kCfgData), 0);
  EXPECT_NE(spoiler.wrong_bits(regs::kPrmData), 0);
}

/// The first bytes of a reply to a read, 81, and to a write, A1 (SP4).
TEST(AcceptSpoiler, RepliesToReadsOverSpiAreWrongAndNotThoseToWrites) {
  const auto inverted = [](user_cpu::ReadSpoiler& spoiler, unsigned first) {
    unsigned count = 0;
    spoiler.request_begins();
    for (unsigned bit = 0; bit < 48; ++bit) {
      spoiler.sck_rises(bit >= 8 || (first >> (7 - bit) & 1U) != 0);
      count += spoiler.begins_to_invert() ? 1U : 0U;
    }
    return count;
  };
  user_cpu::ReadSpoiler reads, writes;
  reads.arm();
  writes.arm();
  unsigned wrong = 0;
  for (int reply = 0; reply < 20; ++reply) {
    wrong += inverted(reads, 0x81);
    EXPECT_EQ(inverted(writes, 0xA1), 0U);
  }
  EXPECT_EQ(wrong, 3U);
}

/// Of the two pins of a hold and the interrupt.
TEST_F(AcceptOutcome, InterruptsCountByThePhaseOfAHold) {
  const tb::PinNumber interrupt = plan.scenario.kind->board_pins().interrupt;
  std::vector<tb::PinNumber> hold;
  for (tb::PinNumber pin = 0; pin < plan.scenario.kind->pins().size(); ++pin)
    if ((plan.scenario.kind->busy_times().front().pins & tb::mask_of(pin)) != 0) hold.push_back(pin);
  ASSERT_EQ(hold.size(), 2U);
  const auto pulse = [&](bus::Tick at) {
    facts->pin(0, at, interrupt, 0);
    facts->pin(0, at + 10, interrupt, 1);
  };
  const auto count = [this](const char* fact) { return facts->count(fact, 0, bus::kNever); };
  pulse(3000);
  EXPECT_EQ(count("interrupt"), 1U);
  facts->pin(0, 4000, hold[0], 1);
  pulse(4100);
  EXPECT_EQ(count("interrupt waiting"), 1U);
  facts->pin(0, 5000, hold[1], 1);
  pulse(5100);
  EXPECT_EQ(count("interrupt inside"), 1U);
  facts->pin(0, 6000, hold[1], 0);
  facts->pin(0, 6000, hold[0], 0);
  pulse(6100);
  EXPECT_EQ(count("interrupt released"), 1U);
  facts->pin(0, 7000, interrupt, 0);
  facts->pin(0, 7001, hold[0], 1);
  EXPECT_EQ(count("request in interrupt"), 1U);
  EXPECT_EQ(count("interrupt"), 5U);
}

}  // namespace
}  // namespace dsdpv1
