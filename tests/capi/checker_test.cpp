// Checks fed from pins.
#include <string>

#include "kinds/dsdpv1/checks/checks.hpp"
#include "tests/capi/capi.hpp"

namespace dsdpv1::capi_test {
namespace {

struct Violated {
  std::string name, text, pins;
  uint64_t tick;
  int64_t margin;
};

void note_violation(void* user, const dpsim_violation* violation) {
  static_cast<std::vector<Violated>*>(user)->push_back(
      {violation->name, violation->text, violation->pins, violation->tick, violation->margin});
}

constexpr uint16_t kCount = 0x006;  ///< incremented by the user in each hold

/// A chip's pins from its reset on, with a hold in which WR is low for `wr_low` ticks.
std::vector<dpsim_change> pins_of_a_write(int64_t wr_low) {
  const auto chip = make_chip();
  ok(dpsim_chip_watch(chip.get(), DPSIM_ALL_PINS, nullptr, nullptr));
  ok(dpsim_chip_set(chip.get(), 1000, DPSIM_DSDPV1_RESET, 1));
  uint64_t now = 6000 * kCycle;
  ok(dpsim_chip_set(chip.get(), now, DPSIM_DSDPV1_R_REQ, 1));
  ok(dpsim_chip_set(chip.get(), now += 170 * DPSIM_TICKS_PER_NS, DPSIM_DSDPV1_R_STA, 1));
  auto timing = sized<dpsim_access_timing>();
  ok(dpsim_access_timing_default(&timing));
  timing.wr_low = wr_low;
  dpsim_level count = 0;
  ok(dpsim_chip_read(chip.get(), now + 1000, kCount, &timing, &count, &now));
  ok(dpsim_chip_write(chip.get(), now, kCount, static_cast<uint8_t>(count + 1), &timing, &now));
  ok(dpsim_chip_set(chip.get(), now, DPSIM_DSDPV1_R_STA, 0));
  ok(dpsim_chip_set(chip.get(), now, DPSIM_DSDPV1_R_REQ, 0));
  ok(dpsim_chip_advance(chip.get(), now + 100 * kUs));
  return drain(dpsim_chip_read_changes, chip.get());
}

std::vector<Violated> judged(const std::vector<dpsim_change>& changes, dpsim_checker* checker) {
  std::vector<Violated> violated;
  ok(dpsim_checker_on_violation(checker, note_violation, &violated));
  ok(dpsim_checker_pins(checker, changes.data(), changes.size(), nullptr));
  ok(dpsim_checker_finish(checker, changes.back().tick + 1000));
  return violated;
}

TEST(CapiChecker, AWriteThatIsTooShortIsReportedWithItsMargin) {
  const auto checker = make_checker();
  const auto violated = judged(pins_of_a_write(100), checker.get());
  ASSERT_EQ(violated.size(), 1U);
  EXPECT_EQ(violated[0].name, "TIMING_TS");
  EXPECT_EQ(violated[0].margin, 100 - 150);
  EXPECT_FALSE(violated[0].text.empty());
  EXPECT_NE(violated[0].pins.find("WR="), std::string::npos) << violated[0].pins;
  size_t rule = 0;
  ok(dpsim_rule_find(nullptr, "TIMING_TS", &rule));
  auto result = sized<dpsim_check_result>();
  ok(dpsim_checker_get_result(checker.get(), rule, &result));
  EXPECT_EQ(result.count, 1U);
  EXPECT_EQ(result.violations, 1U);
  EXPECT_EQ(result.worst_margin, -50);
  EXPECT_EQ(result.at, violated[0].tick);
}

TEST(CapiChecker, LooksThatNobodyTellsAreNotJudged) {
  const auto checker = make_checker();
  EXPECT_TRUE(judged(pins_of_a_write(150), checker.get()).empty());
  size_t rule = 0;
  ok(dpsim_rule_find(nullptr, "LOOK_IN_WINDOW", &rule));
  auto result = sized<dpsim_check_result>();
  ok(dpsim_checker_get_result(checker.get(), rule, &result));
  EXPECT_EQ(result.count, 0U);
}

TEST(CapiChecker, AWriteThatKeepsItsTimesIsNot) {
  const auto checker = make_checker();
  EXPECT_TRUE(judged(pins_of_a_write(150), checker.get()).empty());
  EXPECT_EQ(dpsim_checker_pin(checker.get(), UINT32_MAX, 0, 1), DPSIM_ERR_STATE);
  EXPECT_STREQ(dpsim_error_message(), "dpsim_checker_pin: the checker is finished");
}

TEST(CapiChecker, AnotherLimitJudgesOtherwise) {
  const dpsim_limit limits[] = {{"TIMING_TS", 90, 0, 0}};
  auto options = sized<dpsim_checker_options>();
  options.limits = limits;
  options.limit_count = 1;
  dpsim_checker* made = nullptr;
  ok(dpsim_checker_create(&options, &made));
  const Owned<dpsim_checker> checker(made);
  EXPECT_TRUE(judged(pins_of_a_write(100), made).empty());
}

TEST(CapiChecker, RulesAreThoseOfTheChip) {
  const checks::RuleTable& rules = checks::rules();
  ASSERT_EQ(dpsim_rule_count(nullptr), rules.size());
  for (size_t i = 0; i < rules.size(); ++i) {
    auto info = sized<dpsim_rule_info>();
    ok(dpsim_rule_get(nullptr, i, &info));
    EXPECT_STREQ(info.name, rules[i].id);
    EXPECT_EQ(info.limit, rules[i].limit);
    EXPECT_EQ(info.bound, static_cast<dpsim_bound>(rules[i].bound));
  }
  const auto checker = make_checker();
  uint64_t pins = 0;
  ok(dpsim_checker_wants(checker.get(), &pins));
  EXPECT_EQ(pins, checks::Checks::kPins);
}

// Mode, address and rate come from the pins of the straps.
TEST(CapiChecker, ACharacterOnRxdIsJudgedAtTheRateOfTheStraps) {
  constexpr const char* kKind = "dsdpv1_rsu";
  auto options = sized<dpsim_checker_options>();
  options.kind = kKind;
  dpsim_checker* made = nullptr;
  ok(dpsim_checker_create(&options, &made));
  const Owned<dpsim_checker> checker(made);
  const auto set = [made](uint64_t tick, const char* pin, dpsim_level level) {
    uint16_t number = 0;
    ok(dpsim_pin_find(kKind, pin, &number));
    ok(dpsim_checker_pin(made, tick, number, level));
  };
  std::vector<Violated> violated;
  ok(dpsim_checker_on_violation(made, note_violation, &violated));
  set(0, "MODE", 2);
  set(0, "ADR", 1);
  set(0, "UBR", 7);
  set(5000, "RESET", 1);
  constexpr uint64_t kBit = 26 * kCycle, kFell = 100 * kCycle;  // UA1
  set(kFell, "RXD", 0);
  set(kFell + kBit, "RXD", 1);  // 01, whose parity is 1
  set(kFell + 2 * kBit, "RXD", 0);
  set(kFell + 10 * kBit, "RXD", 1);
  ok(dpsim_checker_finish(made, kFell + 20 * kBit));
  ASSERT_EQ(violated.size(), 1U);
  EXPECT_EQ(violated[0].name, "RXD_PARITY");
  EXPECT_EQ(violated[0].tick, kFell + kCycle + 13 * kCycle + 10 * kBit) << "the edge in the middle of the stop bit";
  EXPECT_NE(violated[0].pins.find("RXD="), std::string::npos) << violated[0].pins;
}

TEST(CapiChecker, TimeDoesNotGoBackAndPinsAreKnown) {
  const auto checker = make_checker();
  ok(dpsim_checker_pin(checker.get(), 1000, DPSIM_DSDPV1_RESET, 1));
  EXPECT_EQ(dpsim_checker_pin(checker.get(), 999, DPSIM_DSDPV1_R_REQ, 1), DPSIM_ERR_TIME);
  EXPECT_EQ(dpsim_checker_pin(checker.get(), 1000, 18, 1), DPSIM_ERR_NOT_FOUND);
  EXPECT_EQ(dpsim_checker_pin(checker.get(), 1000, DPSIM_DSDPV1_R_REQ, 2), DPSIM_ERR_ARGUMENT);
}

}  // namespace
}  // namespace dsdpv1::capi_test
