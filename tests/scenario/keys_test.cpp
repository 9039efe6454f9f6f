// Errors of the parser: file, line, what is wrong, what is allowed.
#include <gtest/gtest.h>

#include "io/input/input_error.hpp"
#include "io/input/suggest.hpp"
#include "kinds/dsdpv1/checks/check.hpp"
#include "tb/scenario/scenario.hpp"

namespace dsdpv1 {
namespace {

const std::string kHead = "name: x\nbaud: 12M\nend: 10ms\n";
const std::string kSlave =
    "slaves: [{name: demo, address: 5, init: {ident: 1, max_inputs: 1, max_outputs: 1, cfg: \"30\"}}]\n";

std::string error_of(const std::string& text) {
  try {
    tb::scenario::parse(text, "s.yaml");
  } catch (const tb::InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(Keys, AcceptTheLeastScenario) { EXPECT_EQ(error_of(kHead + kSlave), "no error"); }

TEST(Keys, UnknownKeyIsNamedWithTheNearestKnownOne) {
  EXPECT_EQ(error_of(kHead + "slavs: []\n"),
            "s.yaml:4: unknown key slavs in scenario (did you mean slaves?), expected name, baud, end, chip, "
            "masters, masters2, slaves, script, expect, allow, checks");
}

TEST(Keys, MissingKeyIsNamed) {
  EXPECT_EQ(error_of("name: x\nbaud: 12M\n" + kSlave), "s.yaml:1: end is missing in scenario");
  EXPECT_EQ(error_of(kHead + "slaves: [{address: 5}]\n"), "s.yaml:4: name is missing in slave");
}

TEST(Keys, DuplicateKeyIsRefused) {
  EXPECT_EQ(error_of(kHead + "end: 11ms\n" + kSlave), "s.yaml:4: end is there twice in scenario, expected once");
}

TEST(Keys, WrongWordListsTheAllowedOnes) {
  EXPECT_EQ(error_of("name: x\nbaud: 11M\nend: 1ms\n"),
            "s.yaml:2: baud is \"11M\" (did you mean 12M?), expected 12M, 6M, 3M, 1.5M, 500k, 187.5k, 93.75k, "
            "45.45k, 19.2k, 9.6k");
}

TEST(Keys, TimeWithoutUnitIsRefused) {
  EXPECT_EQ(error_of("name: x\nbaud: 12M\nend: 20\n"),
            "s.yaml:3: end is \"20\", expected a number with a unit ns, us, ms, s or cycles, like 1.5ms");
}

TEST(Keys, NumberOutOfRangeTellsTheRangeWithUnit) {
  EXPECT_EQ(error_of(kHead + "chip: {access_interval: 1}\n" + kSlave),
            "s.yaml:4: access_interval is \"1\", expected a whole number from 16 to 4800 cycles");
  EXPECT_EQ(error_of(kHead + "chip: {access_interval: many}\n" + kSlave),
            "s.yaml:4: access_interval is \"many\", expected a whole number from 16 to 4800 cycles");
}

TEST(Keys, ListInsteadOfMappingIsRefused) {
  EXPECT_EQ(error_of("[1]\n").substr(0, 50), "s.yaml:1: scenario is a list, expected a mapping w");
}

TEST(Keys, OnePlainNumberIsNotTakenForBytes) {
  const std::string start = kHead + kSlave + "script: [{at: 1ms, do: set_inputs, slave: demo, bytes: ";
  EXPECT_EQ(error_of(start + "10}]\n").substr(0, 39), "s.yaml:5: bytes is \"10\", expected 0 to ");
  EXPECT_EQ(error_of(start + "\"10\"}]\n"), "no error");
  EXPECT_EQ(error_of(start + "[10]}]\n"), "no error");
}

TEST(Keys, ActionTakesOnlyTheKeysOfItsWord) {
  EXPECT_EQ(error_of(kHead + kSlave + "script: [{at: 1ms, do: reset_chip, slave: demo, bytes: \"01\"}]\n"),
            "s.yaml:5: unknown key bytes in do reset_chip, expected at, when, do, slave, for");
  EXPECT_EQ(error_of(kHead + kSlave + "script: [{at: 1ms, do: hold_dpram, slave: demo}]\n"),
            "s.yaml:5: for is missing in do hold_dpram");
  EXPECT_EQ(error_of(kHead + kSlave + "script: [{do: reset_chip, slave: demo}]\n"),
            "s.yaml:5: action needs exactly one of at, when");
}

TEST(ChecksKeys, EachCheckTakesTheLimitOfItsKind) {
  EXPECT_EQ(error_of(kHead + kSlave +
                     "checks: {TIMING_TS: {min: 15ns}, INTR0_SERVICE: {max: 1ms}, CRC_WRITTEN: {enabled: false}}\n"),
            "no error");
  EXPECT_EQ(error_of(kHead + kSlave + "checks: {TIMING_TS: {max: 15ns}}\n"),
            "s.yaml:5: unknown key max in check with a least value, expected enabled, min");
  EXPECT_EQ(error_of(kHead + kSlave + "checks: {CRC_WRITTEN: {min: 15ns}}\n"),
            "s.yaml:5: unknown key min in check without a value, expected enabled");
  EXPECT_EQ(error_of(kHead + kSlave + "checks: {TIMING_TS: {min: 15}}\n"),
            "s.yaml:5: min is \"15\", expected a number with a unit ns, us, ms, s or cycles, like 1.5ms");
  EXPECT_EQ(error_of(kHead + kSlave + "checks: {TIMING_TZ: {min: 15ns}}\n").substr(0, 67),
            "s.yaml:5: unknown key TIMING_TZ in checks (did you mean TIMING_TS?)");
}

TEST(ChecksKeys, LimitsReachTheCheckAndOthersKeepTheirDefault) {
  const tb::scenario::Scenario scenario =
      tb::scenario::parse(kHead + kSlave + "checks: {TIMING_TS: {min: 15ns}, TIMING_TW: {enabled: false}}\n", "s.yaml");
  EXPECT_EQ(scenario.checks[checks::Check::kTs].value, 15 * bus::kTicksPerNs);
  EXPECT_FALSE(scenario.checks[checks::Check::kTw].on);
  EXPECT_EQ(scenario.checks[checks::Check::kTd].value, 150);
}

TEST(Check, NamesThatDoNotExistAreRefusedWithASuggestion) {
  EXPECT_EQ(error_of(kHead + kSlave + "expect: [{slave: dem, data_exchanges: 1}]\n"),
            "s.yaml:5: slave dem does not exist (did you mean demo?), expected demo");
  EXPECT_EQ(error_of(kHead + kSlave + "script: [{at: 1ms, do: stop_master}]\n"),
            "s.yaml:5: this needs a master, the scenario has none");
}

TEST(Check, TimesBehindTheEndAreRefused) {
  EXPECT_EQ(error_of(kHead + kSlave + "expect: [{slave: demo, data_exchanges: 1, by: 11ms}]\n"),
            "s.yaml:5: by is 11ms, expected up to the end of the run, 10ms");
}

TEST(Check, AddressesAreThereOnce) {
  EXPECT_EQ(error_of(kHead + kSlave + "masters: [{name: plc, address: 5}]\n"),
            "s.yaml:5: master plc has address 5 of slave demo, expected each address once");
}

TEST(Suggest, FindsTheNearestWordAndNothingForAStrangeOne) {
  EXPECT_EQ(tb::nearest("adress", {"name", "address", "gsd"}), "address");
  EXPECT_EQ(tb::nearest("zzzzzz", {"name", "address", "gsd"}), "");
}

TEST(Suggest, TakesTwoLettersInTheWrongOrderForOneSlip) {
  EXPECT_EQ(tb::nearest("efl", {"kind", "elf"}), "elf");
  EXPECT_EQ(tb::nearest("rnu", {"demo", "run"}), "run");
  EXPECT_EQ(tb::nearest("abc", {"cab"}), "");
}

}  // namespace
}  // namespace dsdpv1
