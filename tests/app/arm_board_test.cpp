// Firmware on the ARM board instead of the native user CPU: the example firmware in every scenario, at every baud rate,
// and the program's errors for wrong firmware.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "tb/scenario/scenario.hpp"
#include "tests/app/program.hpp"

namespace dsdpv1 {
namespace {

using app_test::call;
using app_test::Called;
using app_test::read;
using app_test::shipped_scenarios;
using Json = nlohmann::json;
using testing::HasSubstr;

const std::string kArm = " --set user_cpu.kind=arm --set user_cpu.elf=";

std::string scenario(const std::string& name) { return std::string("scenarios/") + name + ".yaml --no-progress"; }

/// The final bus results of a slave. `counts`: its inputs count the exchanges, which depends on the CPU's speed. So
/// does the progress of a master with a slave that it brings up repeatedly.
Json on_the_bus(const Json& slave, bool counts) {
  Json seen;
  for (const char* key :
       {"name", "address", "dp_state", "baud", "master", "master_state", "inputs", "outputs", "rm_registry"})
    seen[key] = slave.at(key);
  if (counts) seen.erase("inputs");
  if (slave.at("dp_state") != "DATA_EXCH") seen.erase("master_state");
  return seen;
}

class ArmScenarios : public testing::TestWithParam<std::string> {};

// The checks of the handshake must also be silent, except in violations.yaml, which allows its violations.
TEST_P(ArmScenarios, EndOnTheBusAsWithTheNativeCpu) {
  const app_test::Folder folder;
  const std::string run = "run " + scenario(GetParam()) + " --result ";
  const Called native = call(run + folder.file("native.json"), DSDPV1_SOURCE_DIR);
  ASSERT_EQ(native.status, 0) << native.out << native.err;
  const Called arm = call(run + folder.file("arm.json") + " --checks fail" + kArm + FIRMWARE_O2, DSDPV1_SOURCE_DIR);
  ASSERT_EQ(arm.status, 0) << arm.out << arm.err;
  const Json native_result = Json::parse(read(folder.file("native.json")));
  const Json arm_result = Json::parse(read(folder.file("arm.json")));
  const std::string text = read(std::string(DSDPV1_SOURCE_DIR) + "/scenarios/" + GetParam() + ".yaml");
  const bool counts = text.find("behaviour: count") != std::string::npos;
  for (std::size_t i = 0; i < native_result.at("slaves").size(); ++i)
    EXPECT_EQ(on_the_bus(arm_result.at("slaves").at(i), counts), on_the_bus(native_result.at("slaves").at(i), counts));
}

/// The firmware is for chips with the handshake of the DPRAM.
bool has_another_chip(const std::string& name) {
  const tb::ChipKinds kinds = tb::scenario::kinds(tb::scenario::load(DSDPV1_SOURCE_DIR "/scenarios/" + name + ".yaml"));
  return std::any_of(kinds.begin(), kinds.end(), [](const tb::ChipKind* kind) {
    const tb::PinTable& pins = kind->pins();
    return std::none_of(pins.begin(), pins.end(),
                        [](const tb::PinInfo& pin) { return pin.name == std::string("R_REQ"); });
  });
}

/// Scenarios of chips for the firmware whose names begin otherwise.
std::vector<std::string> shipped_but(const std::vector<std::string>& beginnings) {
  std::vector<std::string> names = shipped_scenarios();
  const auto is_left_out = [&](const std::string& name) {
    return has_another_chip(name) ||
           std::any_of(beginnings.begin(), beginnings.end(),
                       [&](const std::string& beginning) { return name.rfind(beginning, 0) == 0; });
  };
  names.erase(std::remove_if(names.begin(), names.end(), is_left_out), names.end());
  return names;
}

/// foreign.c only supports the parallel port.
std::vector<std::string> parallel_scenarios() { return shipped_but({"rsu_spi", "rsu_uart", "arm_spi", "arm_uart"}); }

/// Scenarios over SPI, and those over the UART with own times or telegrams, need a native CPU; a board rejects them.
std::vector<std::string> native_scenarios() {
  return shipped_but({"rsu_spi", "rsu_uart_", "arm_board_12m", "arm_spi", "arm_uart"});
}
INSTANTIATE_TEST_SUITE_P(All, ArmScenarios, testing::ValuesIn(native_scenarios()),
                         [](const auto& each) { return each.param; });

class ArmViews : public testing::TestWithParam<std::string> {};

TEST_P(ArmViews, HaveTheSameLog) {
  const app_test::Folder folder;
  for (const std::string view : {"pins", "tlm"}) {
    const Called called = call("run " + scenario(GetParam()) + kArm + FIRMWARE_O2 + " --view " + view + " --log " +
                                   folder.file(view) + " --result " + folder.file(view + ".json"),
                               DSDPV1_SOURCE_DIR);
    ASSERT_EQ(called.status, 0) << called.out << called.err;
  }
  EXPECT_TRUE(read(folder.file("pins")) == read(folder.file("tlm")));
  const auto board = [&](const std::string& view) {
    return Json::parse(read(folder.file(view + ".json"))).at("slaves").at(0).at("arm_board");
  };
  EXPECT_EQ(board("pins"), board("tlm"));
}
INSTANTIATE_TEST_SUITE_P(All, ArmViews, testing::ValuesIn(parallel_scenarios()),
                         [](const auto& each) { return each.param; });

/// Loop passes are only skipped in skip.
TEST(ArmPolls, SeeThePinsInTheSameCyclesInEveryEngine) {
  const app_test::Folder folder;
  std::ofstream(folder.file("s.yaml"))
      << "name: looks\nbaud: 12M\nend: 3ms\nslaves: [{name: board, address: 5, gsd: '" << DSDPV1_SOURCE_DIR
      << "/scenarios/dsdpv1.gsd', modules: ['8 bytes in, 8 bytes out'], user_cpu: {kind: arm, elf: '" << FIRMWARE_LOOKS
      << "', fsmc: {hclk: 72}}}]\nexpect: [{slave: board, dp_state: offline}]\n";
  const auto log = [&](const std::string& options) {
    const Called called = call("run s.yaml --no-progress --log log " + options, folder.path());
    EXPECT_EQ(called.status, 0) << called.out << called.err;
    return read(folder.file("log"));
  };
  const std::string stepped = log("--engine step --checks off");
  EXPECT_GT(std::count(stepped.begin(), stepped.end(), '\n'), 190);
  EXPECT_EQ(log("--engine skip --checks off"), stepped) << "nobody watches the pins";
  EXPECT_EQ(log("--view tlm --checks off"), stepped);
  const std::string watched = log("--engine step");
  EXPECT_EQ(log("--engine skip"), watched);
  EXPECT_EQ(log("--view tlm"), watched);
}

class ArmBaudRates : public testing::TestWithParam<std::tuple<const char*, const char*>> {};

TEST_P(ArmBaudRates, ReachDataExchangeJudgedByTheFirmware) {
  const auto& [rate, elf] = GetParam();
  const app_test::Folder folder;
  std::ofstream(folder.file("s.yaml"))
      << "name: rate\nbaud: " << rate << "\nend: 1200ms\nchip: {search_window_ms: 5}\n"
      << "slaves:\n  - {name: board, address: 5, init: {ident: 1, max_inputs: 2, max_outputs: 2, max_prm: 10, cfg: "
         "\"31\", "
         "prm_mode: 2, cfg_mode: 2}, user_cpu: {kind: arm, elf: \""
      << elf << "\", cycle: 1ms}}\n"
      << "masters:\n  - {name: plc, address: 2, bus: {gap_factor: 0, min_slave_interval: 10000}, slaves: [{slave: "
         "board, outputs: \"01 02\"}]}\n"
      << "expect:\n  - {slave: board, dp_state: data_exch, baud: " << rate
      << ", inputs: \"01 02\", data_exchanges: 3}\n  - {slave: board, event: PRM_TO_USER}\n"
      << "  - {slave: board, event: CFG_TO_USER}\n";
  const Called called = call("run s.yaml --no-progress --checks fail", folder.path());
  EXPECT_EQ(called.status, 0) << called.out << called.err;
}

INSTANTIATE_TEST_SUITE_P(All, ArmBaudRates,
                         testing::Combine(testing::Values("12M", "6M", "3M", "1.5M", "500k", "187.5k", "93.75k",
                                                          "45.45k", "19.2k", "9.6k"),
                                          testing::Values(FIRMWARE_O0, FIRMWARE_O2)));

// --- the DSDPV1-RSU --------------------------------------------------------------------------------------------------

class ArmUartRates : public testing::TestWithParam<const char*> {};

TEST_P(ArmUartRates, ReachDataExchangeWithoutAnErrorOnTheLine) {
  const app_test::Folder folder;
  std::ofstream(folder.file("s.yaml"))
      << "name: rate\nbaud: 1.5M\nend: 1000ms\nchip: {kind: dsdpv1_rsu, mode: uart, uart_rate: " << GetParam()
      << ", interval: 1, search_window_ms: 5}\n"
      << "slaves:\n  - {name: board, address: 5, init: {ident: 1, max_inputs: 2, max_outputs: 2, max_prm: 10, cfg: "
         "\"31\"}, user_cpu: {kind: arm, elf: \""
      << FIRMWARE_O2 << "\", cycle: 20ms}}\n"
      << "masters:\n  - {name: plc, address: 2, bus: {gap_factor: 0, min_slave_interval: 3000}, slaves: [{slave: "
         "board, outputs: \"01 02\"}]}\n"
      // At 9600 bit/s a turn takes longer than 100 ms.
      << "checks: {BLOCK_SERVED: {max: 300ms}, OUTPUTS_FETCHED: {max: 300ms}, INPUTS_RENEWED: {max: 300ms}}\n"
      << "expect:\n  - {slave: board, dp_state: data_exch, inputs: \"01 02\", data_exchanges: 3}\n";
  const Called called = call("run s.yaml --no-progress --checks fail --log log", folder.path());
  EXPECT_EQ(called.status, 0) << called.out << called.err;
  EXPECT_THAT(read(folder.file("log")), testing::Not(testing::ContainsRegex("UART_|TELEGRAM_|DSDPV1_ERR_|lost")));
}

INSTANTIATE_TEST_SUITE_P(All, ArmUartRates,
                         testing::Values("9.6k", "19.2k", "38.4k", "57.6k", "115.2k", "230.4k", "460.8k", "1.8432M"));

TEST(ArmPorts, Card2IsReachedOverSpi2AndTheUart) {
  for (const char* port : {"arm_spi", "arm_uart"}) {
    const Called called =
        call("run " + scenario(port) + " --set chip.address=2 --checks fail --set user_cpu.elf=" + FIRMWARE_O2,
             DSDPV1_SOURCE_DIR);
    EXPECT_EQ(called.status, 0) << called.out << called.err;
  }
}

TEST(ArmPorts, HoldsOverSpiAreCountedFromThePins) {
  const app_test::Folder folder;
  ASSERT_EQ(call("run " + scenario("arm_spi") + " --result " + folder.file("r.json"), DSDPV1_SOURCE_DIR).status, 0);
  const Json handshake = Json::parse(read(folder.file("r.json"))).at("slaves").at(0).at("handshake");
  EXPECT_GT(handshake.at("user_holds"), 100);
  EXPECT_GT(handshake.at("user_longest_hold_ns"), 500'000);
}

/// The log and the final report of a run whose firmware fetches bytes too late.
std::pair<std::string, std::string> late(const std::string& port) {
  const app_test::Folder folder;
  const Called called =
      call("run " + scenario(port) + " --set user_cpu.elf=" + FIRMWARE_LATE_READ + " --log " + folder.file("log"),
           DSDPV1_SOURCE_DIR);
  EXPECT_EQ(called.status, 1) << called.err;
  return {read(folder.file("log")), called.out};
}

TEST(ArmPorts, FirmwareThatReadsDrOfSpiTooLateLosesBytesAndSaysSo) {
  const auto [log, out] = late("arm_spi");
  EXPECT_THAT(log, HasSubstr("serial port: "));
  EXPECT_THAT(log, HasSubstr("bytes lost, the ones before were fetched too late"));
  EXPECT_THAT(log, HasSubstr("DSDPV1_ERR_NO_REPLY"));
  EXPECT_THAT(out, testing::ContainsRegex("SPI1: [0-9]+ bytes were lost.*\\(OVR\\)"));
}

TEST(ArmPorts, FirmwareThatReadsDrOfUsart2TooLateLosesCharactersAndSaysSo) {
  const auto [log, out] = late("arm_uart");
  EXPECT_THAT(log, HasSubstr("bytes lost, the ones before were fetched too late"));
  EXPECT_THAT(log, HasSubstr("DSDPV1_ERR_REPLY"));
  EXPECT_THAT(out, testing::ContainsRegex("USART2: [0-9]+ bytes were lost.*\\(ORE\\)"));
}

// --- wrong firmware --------------------------------------------------------------------------------------------------

TEST(ArmBoard, PlantedEarlyRStaIsCaughtWithTimeAndHistory) {
  const app_test::Folder folder;
  const Called called =
      call("run " + scenario("arm_board_12m") + " --checks fail --set user_cpu.elf=" + FIRMWARE_EARLY_R_STA +
               " --log " + folder.file("log"),
           DSDPV1_SOURCE_DIR);
  EXPECT_EQ(called.status, 1);
  EXPECT_THAT(called.out, HasSubstr("OWNERSHIP_BOTH_OWN"));
  const std::string log = read(folder.file("log"));
  EXPECT_THAT(log, testing::ContainsRegex("ns  board        violation OWNERSHIP_BOTH_OWN"));
  EXPECT_THAT(log, testing::ContainsRegex("R_REQ.*R_STA"));
}

TEST(ArmBoard, FilesThatAreNoFirmwareGiveOneLine) {
  const auto refused = [](const std::string& elf) {
    const Called called = call("run " + scenario("arm_board_12m") + " --set user_cpu.elf=" + elf, DSDPV1_SOURCE_DIR);
    EXPECT_EQ(called.status, 2) << elf;
    EXPECT_EQ(std::count(called.err.begin(), called.err.end(), '\n'), 1) << called.err;
    return called.err;
  };
  EXPECT_THAT(refused(DSDPV1_SIM), HasSubstr("64"));  // a program of this computer
  EXPECT_THAT(refused(std::string(DSDPV1_SOURCE_DIR) + "/README.md"), HasSubstr("ELF"));
  EXPECT_THAT(refused("nowhere.elf"), HasSubstr("nowhere.elf"));
  EXPECT_THAT(refused("/dev/zero"), HasSubstr("elf /dev/zero: is larger than 64 MB, expected an executable"));
}

// --- foreign firmware: no mailbox ------------------------------------------------------------------------------------

/// The first demand of each shipped scenario on the program of its user CPU.
const std::map<std::string, std::string> kDemands = {
    {"baud_change", "outputs are"},    {"diagnosis", "set_diagnosis"},
    {"dpv1_c1", "wrong_crc"},          {"dpv1_c2_two_masters", "answer_acyc"},
    {"judging_modes", "verdict"},      {"min_tsdr_45k45", "outputs are"},
    {"power_on_12m", "set_diagnosis"}, {"power_on_9k6", "outputs are"},
    {"read_services", "outputs are"},  {"r", "set_diagnosis"},
    {"rsu_parallel", "set_diagnosis"}, {"reinitialise", "reinitialise"},
    {"sync_freeze", "outputs are"},    {"two_slaves", "outputs are"},
    {"violations", "early_r_sta"},     {"watchdog", "outputs are"}};

const std::string kForeign = kArm + FIRMWARE_WITHOUT_MAILBOX;

class DemandingScenarios : public testing::TestWithParam<std::pair<const std::string, std::string>> {};

TEST_P(DemandingScenarios, AreRefusedInOneLineThatNamesTheDemand) {
  const auto& [name, demand] = GetParam();
  const Called called = call("run " + scenario(name) + kForeign, DSDPV1_SOURCE_DIR);
  EXPECT_EQ(called.status, 2);
  EXPECT_THAT(called.err, testing::MatchesRegex("scenarios/" + name + "\\.yaml:[0-9]+: " + demand +
                                                ".*foreign.elf, which has no mailbox \\(dsdpv1_bench\\), cannot "
                                                "(be told|tell them); expected .*leave_out}\n"));
}
INSTANTIATE_TEST_SUITE_P(All, DemandingScenarios, testing::ValuesIn(kDemands),
                         [](const auto& each) { return each.param.first; });

class ForeignFirmware : public testing::TestWithParam<std::string> {};

bool is_of_the_program(const std::string& expectation) {
  return expectation.find(" outputs ") != std::string::npos || expectation.find("DSDPV1_ERR") != std::string::npos;
}

TEST_P(ForeignFirmware, RunsWithTheDemandsLeftOutAndWhatIsNotKnownIsNull) {
  const app_test::Folder folder;
  const std::string file = folder.file("r.json");
  const bool demands = kDemands.count(GetParam()) != 0;
  const std::string leave_out = demands ? " --set user_cpu.without_mailbox=leave_out" : "";
  const Called called =
      call("run " + scenario(GetParam()) + kForeign + leave_out + " --checks fail --result " + file, DSDPV1_SOURCE_DIR);
  ASSERT_THAT(called.status, testing::AnyOf(0, 1)) << called.err;
  EXPECT_EQ(called.out.find("left out: scenarios/") != std::string::npos, demands) << called.out;
  EXPECT_THAT(called.out, HasSubstr("its counters and the outputs that it has fetched are not known"));
  EXPECT_THAT(called.out, testing::ContainsRegex("it is not told address \\(line [0-9]+\\)"));
  const Json result = Json::parse(read(file));
  for (const Json& slave : result.at("slaves")) {
    EXPECT_TRUE(slave.at("outputs").is_null());
    for (const char* counter : {"exchanges", "outputs_received", "inputs_written", "judgements", "driver_errors"})
      EXPECT_TRUE(slave.at("user_cpu").at(counter).is_null()) << counter;
    EXPECT_GT(slave.at("handshake").at("user_holds"), 0);  // from the pins
  }
  for (const Json& check : result.at("checks")) EXPECT_EQ(check.at("violations"), check.at("allowed")) << check;
  for (const Json& each : result.at("expectations")) {
    if (each.at("implied") == true) continue;
    EXPECT_EQ(each.at("passed").is_null(), is_of_the_program(each.at("text"))) << each;
  }
}

INSTANTIATE_TEST_SUITE_P(All, ForeignFirmware, testing::ValuesIn(parallel_scenarios()),
                         [](const auto& each) { return each.param; });

TEST(ArmBoard, ForeignFirmwareLoopsBackInTheBoardsScenario) {
  const Called called =
      call("run " + scenario("arm_board_12m") + " --checks fail --set user_cpu.elf=" + FIRMWARE_WITHOUT_MAILBOX,
           DSDPV1_SOURCE_DIR);
  EXPECT_EQ(called.status, 0) << called.out << called.err;
  EXPECT_THAT(called.out, testing::ContainsRegex("init.prm_mode \\(line [0-9]+\\), init.cfg_mode \\(line [0-9]+\\), "
                                                 "behaviour \\(line [0-9]+\\), cycle \\(line [0-9]+\\)"));
}

// foreign.c has seven switches for its address, pulled up.
TEST(ArmBoard, SwitchesHoldInputPins) {
  const std::string foreign = std::string(" --set user_cpu.elf=") + FIRMWARE_WITHOUT_MAILBOX;
  const auto run = [&](const std::string& switches) {
    return call("run " + scenario("arm_board_12m") + foreign + " --set 'user_cpu.switches=" + switches + "'",
                DSDPV1_SOURCE_DIR);
  };
  EXPECT_THAT(run("[PA0=low, PA1=low, PA3=low, PA4=low, PA5=low, PA6=low]").out, HasSubstr("initialised: address 4"));
  EXPECT_THAT(run("[PA0=high]").out, HasSubstr("initialised: address 5"));
  for (const char* wrong :
       {"PA0=up", "PA=low", "PA16=low", "PA00=low", "PA+1=low", "PH0=low", "QA0=low", "PA0=", "PA0"})
    EXPECT_THAT(run("[" + std::string(wrong) + "]").err, HasSubstr("expected something like PA0=low or PG15=high"))
        << wrong;
  EXPECT_THAT(run("[PG14=low]").err, HasSubstr("a pin that the board wires to the chip"));
  EXPECT_THAT(run("[PA0=low, PA0=high]").err, HasSubstr("a pin that is there twice"));
}

TEST(ArmBoard, SettingsForAProgramThatCannotBeToldAreRefusedWhereTheyAreDemanded) {
  const auto refused = [](const std::string& arguments) {
    const Called called = call("run " + arguments, DSDPV1_SOURCE_DIR);
    EXPECT_EQ(called.status, 2) << arguments << called.out;
    return called.err;
  };
  const std::string foreign = std::string(" --set user_cpu.elf=") + FIRMWARE_WITHOUT_MAILBOX;
  for (const char* setting : {"user_cpu.behaviour=count", "user_cpu.cycle=60us", "slaves.board.init.prm_mode=1"})
    EXPECT_THAT(refused(scenario("arm_board_12m") + foreign + " --set " + setting),
                testing::StartsWith(std::string("--set ") + setting + ": "));
  const app_test::Folder folder;
  std::ofstream(folder.file("s.yaml")) << "name: x\nbaud: 12M\nend: 1ms\nslaves:\n"
                                          "  - name: own\n    address: 5\n"
                                          "    init: {ident: 1, max_inputs: 2, max_outputs: 2, cfg: \"31\"}\n"
                                          "    user_cpu:\n      kind: arm\n      elf: \""
                                       << FIRMWARE_WITHOUT_MAILBOX << "\"\n      behaviour: count\n";
  EXPECT_THAT(refused(folder.file("s.yaml")), HasSubstr("s.yaml:11: behaviour is for the program of own"));
}

TEST(ArmBoard, PathOfTheCommandLineIsRelativeToWhereTheUserStandsOneOfTheScenarioToItsFolder) {
  const app_test::Folder folder;
  for (const char* name : {"scenarios", "here"}) std::filesystem::create_directory(folder.path() / name);
  std::filesystem::copy_file(FIRMWARE_WITHOUT_MAILBOX, folder.path() / "here" / "mine.elf");
  std::ofstream(folder.path() / "scenarios" / "s.yaml")
      << "name: x\nbaud: 12M\nend: 1ms\nslaves:\n  - {name: own, address: 5, init: {ident: 1, max_inputs: 2, "
         "max_outputs: "
         "2, cfg: \"31\"}, user_cpu: {kind: arm, elf: ../here/mine.elf}}\nexpect: [{slave: own, event: READY_FLAG}]\n";
  EXPECT_EQ(call("run s.yaml", folder.path() / "scenarios").status, 0);
  EXPECT_EQ(call("run scenarios/s.yaml", folder.path()).status, 0);
  EXPECT_EQ(call("run ../scenarios/s.yaml --set user_cpu.elf=mine.elf", folder.path() / "here").status, 0);
  EXPECT_EQ(call("run scenarios/s.yaml --set user_cpu.elf=here/mine.elf", folder.path()).status, 0);
  EXPECT_EQ(call("sweep scenarios/s.yaml --quiet --no-progress --param user_cpu.elf=here/mine.elf --param "
                 "user_cpu.cpi=1,2 --out o",
                 folder.path())
                .status,
            0);
  const Called called = call("run scenarios/s.yaml --set user_cpu.elf=mine.elf", folder.path());
  EXPECT_EQ(called.status, 2);
  EXPECT_THAT(called.err, HasSubstr(folder.file("mine.elf") + ": no such file"));
}

TEST(ArmBoard, KeysOfTheOtherKindAreRefused) {
  const auto refused = [](const std::string& settings) {
    const Called called = call("run " + scenario("power_on_12m") + settings, DSDPV1_SOURCE_DIR);
    EXPECT_EQ(called.status, 2) << settings;
    return called.err;
  };
  EXPECT_THAT(refused(" --set user_cpu.kind=arm"), HasSubstr("elf is missing"));
  EXPECT_THAT(refused(std::string(" --set user_cpu.elf=") + FIRMWARE_O2), HasSubstr("elf without kind: arm"));
  EXPECT_THAT(refused(kArm + FIRMWARE_O2 + " --set user_cpu.timing.overhead=1us"),
              HasSubstr("timing is that of kind: native"));
  EXPECT_THAT(refused(" --gdb 0"), HasSubstr("--gdb needs a slave whose user_cpu has kind: arm"));
}

TEST(ArmBoard, FaultEndsTheRunWithTheSourceLine) {
  const app_test::Folder folder;
  std::ofstream(folder.file("s.yaml")) << "name: fault\nbaud: 12M\nend: 10ms\nslaves:\n  - {name: board, address: 5, "
                                          "init: {ident: 1, max_inputs: 2, max_outputs: 2, "
                                          "cfg: \"31\"}, user_cpu: {kind: arm, elf: \""
                                       << FIRMWARE_FAULT << "\"}}\n";
  for (const std::string view : {"pins", "tlm"}) {
    const Called called =
        call("run s.yaml --no-progress --result r.json --log " + view + " --view " + view, folder.path());
    EXPECT_EQ(called.status, 1);
    EXPECT_THAT(called.out, testing::ContainsRegex("at fault.c:[0-9]+ in run\\(\\)"));
    EXPECT_THAT(called.out, HasSubstr("xpsr"));
    const Json result = Json::parse(read(folder.file("r.json")));
    EXPECT_LT(result.at("simulated_ns").get<double>(), 1e6);
    const Json event = result.at("events").back(), where = event.at("where");
    EXPECT_EQ(event.at("code"), "ARM_FAULT");
    EXPECT_EQ(where.at("file"), "fault.c");
    EXPECT_EQ(where.at("function"), "run");
    EXPECT_EQ(result.at("violated").at(0).at("where"), where);
  }
  EXPECT_EQ(read(folder.file("pins")), read(folder.file("tlm")));
}

TEST(ArmBoard, WhatARealBoardWouldNotForgiveFailsTheRunUnlessItIsAllowed) {
  const app_test::Folder folder;
  const std::string scenario =
      "name: careless\nbaud: 12M\nend: 1ms\nslaves: [{name: board, address: 5, init: {ident: 1, "
      "max_inputs: 2, max_outputs: 2, cfg: \"31\"}, user_cpu: {kind: arm, elf: '" +
      std::string(FIRMWARE_CARELESS) + "'}}]\nexpect: [{slave: board, event: READY_FLAG}]\n";
  std::ofstream(folder.file("s.yaml")) << scenario;
  std::ofstream(folder.file("allowed.yaml")) << scenario << "allow: [{event: BOARD_CLOCK_OFF, slave: board}]\n";
  for (const std::string view : {"pins", "tlm"}) {
    const Called called =
        call("run s.yaml --no-progress --result r.json --log " + view + " --view " + view, folder.path());
    EXPECT_EQ(called.status, 1);
    EXPECT_THAT(called.out, HasSubstr("FAILED: 4 violations"));
    EXPECT_THAT(called.out, testing::ContainsRegex("BOARD_CLOCK_OFF +4 "));
    EXPECT_THAT(read(folder.file(view)),
                HasSubstr("GPIOB is used while its clock is off in RCC_APB2ENR  [at careless.c:8 in run()]"));
    const Json violated = Json::parse(read(folder.file("r.json"))).at("violated");
    ASSERT_EQ(violated.size(), 1U);
    EXPECT_EQ(violated.at(0).at("count"), 4);
  }
  EXPECT_EQ(read(folder.file("pins")), read(folder.file("tlm")));
  const Called allowed = call("run allowed.yaml --no-progress", folder.path());
  EXPECT_EQ(allowed.status, 0) << allowed.out;
  EXPECT_THAT(allowed.out, HasSubstr("PASSED, 4 violations allowed"));
}

// --- commands --------------------------------------------------------------------------------------------------------

TEST(ArmBoard, ScenarioAndCaptureMayBePipes) {
  const app_test::Folder folder;
  std::ofstream(folder.file("s.yaml")) << "name: x\nbaud: 12M\nend: 3ms\nslaves:\n  - {name: own, address: 5, init: "
                                          "{ident: 1, max_inputs: 2, max_outputs: 2, cfg: \"31\"}, user_cpu: {kind: "
                                          "arm, elf: \""
                                       << FIRMWARE_WITHOUT_MAILBOX
                                       << "\"}}\nmasters:\n  - {name: plc, address: 2, slaves: [{slave: own, outputs: "
                                          "\"01 02\"}]}\nexpect: [{slave: own, dp_state: wait_prm}]\n";
  const Called called = call(
      "-ec 'mkfifo s c; cat s.yaml >s & \"$0\" run s --quiet --no-progress --capture c.pcapng; cat c.pcapng >c & "
      "\"$0\" replay c --as 5 --scenario s.yaml --no-progress' '" +
          app_test::simulator() + "'",
      folder.path(), "bash");
  EXPECT_EQ(called.status, 0) << called.out << called.err;
}

TEST(ArmBoard, InterruptEndsTheRunInBothViews) {
  const app_test::Folder folder;
  for (const std::string view : {"pins", "tlm"}) {
    const Called called =
        call("--preserve-status -s INT 0.5 '" + app_test::simulator() +
                 "' run '" DSDPV1_SOURCE_DIR
                 "/scenarios/arm_board_12m.yaml' --no-progress --quiet --set end=1000s --result r.json "
                 "--view " +
                 view,
             folder.path(), "timeout");
    EXPECT_EQ(called.status, 130) << called.err;
    EXPECT_THAT(read(folder.file("r.json")), HasSubstr("\"interrupted\": true"));
  }
}

TEST(ArmBoard, ViewTlmHasNoSerialPinsForIt) {
  const app_test::Folder folder;
  const Called called =
      call("run scenarios/arm_spi.yaml --view tlm --result " + folder.file("r.json"), DSDPV1_SOURCE_DIR);
  EXPECT_EQ(called.status, 2);
  EXPECT_EQ(called.err,
            "dsdpv1-sim run: --view tlm has transactions at the chips' ports, and in scenarios/arm_spi.yaml a user CPU "
            "moves their pins, expected --view pins\n");
  EXPECT_FALSE(std::filesystem::exists(folder.file("r.json")));
  const std::string folder_of = "'" DSDPV1_SOURCE_DIR "/scenarios/";
  const Called regressed =
      call("regress " + folder_of + "arm_spi.yaml' " + folder_of + "arm_board_12m.yaml' --view pins,tlm --no-progress",
           folder.path());
  EXPECT_EQ(regressed.status, 0) << regressed.out;
  EXPECT_THAT(regressed.err, HasSubstr("3 of 3 runs passed; 1 combinations that cannot be are left out"));
}

}  // namespace
}  // namespace dsdpv1
