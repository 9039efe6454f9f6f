// Firmware on the ARM board in place of the native user CPU: the example firmware in every scenario, at every baud rate, and what the program
// says of firmware that is wrong.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/app/program.hpp"

namespace {

using app_test::call;
using app_test::Called;
using app_test::read;
using app_test::shipped_scenarios;
using Json = nlohmann::json;
using testing::HasSubstr;

const std::string kArm = " --set user_cpu.kind=arm --set user_cpu.elf=";

std::string scenario(const std::string& name) { return std::string("scenarios/") + name + ".yaml --no-progress"; }

/// What the bus has seen of a slave in the end. `counts`: its inputs count the exchanges, which hang on the CPU's speed.
Json on_the_bus(const Json& slave, bool counts) {
  Json seen;
  for (const char* key :
       {"name", "address", "dp_state", "baud", "master", "master_state", "inputs", "outputs", "rm_registry"})
    seen[key] = slave.at(key);
  if (counts) seen.erase("inputs");
  return seen;
}

class ArmScenarios : public testing::TestWithParam<std::string> {};

// Also the checks of the handshake are silent, violations.yaml apart, which allows what it provokes.
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

std::vector<std::string> native_scenarios() {
  std::vector<std::string> names = shipped_scenarios();
  names.erase(std::remove(names.begin(), names.end(), "arm_board_12m"), names.end());
  return names;
}
INSTANTIATE_TEST_SUITE_P(All, ArmScenarios, testing::ValuesIn(native_scenarios()),
                         [](const auto& each) { return each.param; });

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

// --- firmware that is wrong -----------------------------------------------------------------------------------------------

TEST(ArmBoard, PlantedEarlyRStaIsCaughtWithTimeAndHistory) {
  const app_test::Folder folder;
  const Called called =
      call("run " + scenario("arm_board_12m") + " --checks fail --set user_cpu.elf=" + FIRMWARE_EARLY_R_STA +
               " --log " + folder.file("log"),
           DSDPV1_SOURCE_DIR);
  EXPECT_EQ(called.status, 1);
  EXPECT_THAT(called.out, HasSubstr("OWNERSHIP_SYNC_WINDOW"));
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
}

TEST(ArmBoard, ActionsForFirmwareWithoutMailboxAreRefused) {
  const Called called =
      call("run " + scenario("arm_board_12m") + " --set user_cpu.elf=" + FIRMWARE_WITHOUT_MAILBOX, DSDPV1_SOURCE_DIR);
  EXPECT_EQ(called.status, 2);
  EXPECT_THAT(called.err, HasSubstr("has no mailbox (dsdpv1_bench)"));
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
  const Called called = call("run s.yaml --no-progress --result r.json", folder.path());
  EXPECT_EQ(called.status, 1);
  EXPECT_THAT(called.out, HasSubstr("run at fault.c:"));
  EXPECT_THAT(called.out, HasSubstr("xpsr"));
  const Json result = Json::parse(read(folder.file("r.json")));
  EXPECT_LT(result.at("simulated_ns").get<double>(), 1e6);
  EXPECT_EQ(result.at("events").back().at("code"), "ARM_FAULT");
}

}  // namespace
