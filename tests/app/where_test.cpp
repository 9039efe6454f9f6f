// A violation names the line of the firmware that caused it, or where the firmware was instead: the example firmware
// with faults planted, or with a fault that the scenario asks for.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/app/program.hpp"

namespace dsdpv1 {
namespace {

using app_test::call;
using app_test::Called;
using app_test::Folder;
using app_test::read;
using Json = nlohmann::json;
using testing::HasSubstr;

/// The one line of a file of the example firmware with these words.
int line_with(const std::string& file, const std::string& words) {
  std::ifstream source(std::string(DSDPV1_SOURCE_DIR) + "/examples/firmware/" + file);
  int number = 0, found = 0;
  for (std::string line; std::getline(source, line);) {
    ++number;
    if (line.find(words) == std::string::npos) continue;
    EXPECT_EQ(found, 0) << file << ": " << words << " twice";
    found = number;
  }
  EXPECT_NE(found, 0) << file << ": no " << words;
  return found;
}

class FirmwareLines : public testing::Test {
 protected:
  /// A slave at the port `chip`, with `script`, for 40 ms.
  void run(const std::string& chip, const std::string& script, const std::string& options = "",
           const std::string& elf = FIRMWARE_O2) {
    std::ofstream(folder_.file("s.yaml"))
        << "name: lines\nend: 40ms\n"
        << chip
        << "slaves:\n  - {name: board, address: 5, init: {ident: 1, max_inputs: 2, max_outputs: 2, cfg: \"31\"}, "
        << "user_cpu: {kind: arm, elf: \"" << elf << "\", cycle: 1ms}}\n"
        << "masters: [{name: plc, address: 2, start: 1ms, bus: {min_slave_interval: 2500}, "
        << "slaves: [{slave: board, outputs: \"01 02\"}]}]\n"
        << "script: [" << script << "]\n";
    called_ =
        call("run s.yaml --no-progress --log log --result result.json --junit junit.xml --report page.html " + options,
             folder_.path());
    ASSERT_EQ(called_.status, 1) << called_.out << called_.err;
    result_ = Json::parse(read(folder_.file("result.json")));
  }
  /// Of the first violation of a check, or of an event.
  Json where(const std::string& code) const {
    for (const Json& each : result_.at("checks"))
      if (each.at("id") == code && !each.at("listed").empty()) return each.at("listed").at(0).at("where");
    for (const Json& each : result_.at("events"))
      if (each.at("code") == code) return each.at("where");
    return "not found: " + code;
  }
  std::string log() const { return read(folder_.file("log")); }

  Folder folder_;
  Called called_;
  Json result_;
};

const std::string kFast = "baud: 12M\n", kParallel = "baud: 1.5M\nchip: {search_window_ms: 2}\n",
                  kSpi = "baud: 1.5M\nchip: {kind: dsdpv1_rsu, mode: spi, search_window_ms: 2}\n",
                  kUart = "baud: 1.5M\nchip: {kind: dsdpv1_rsu, mode: uart, uart_rate: 1.8432M, search_window_ms: 2}\n";

void expect_line(const Json& where, const std::string& file, const std::string& words) {
  ASSERT_TRUE(where.is_object()) << where;
  EXPECT_EQ(where.at("file"), file);
  EXPECT_EQ(where.at("line"), line_with(file, words)) << where;
}

TEST_F(FirmwareLines, PinIsTheStoreThatMovedItInEveryEngineAndView) {
  Json first;
  std::string first_log;
  for (const std::string options : {"--engine skip", "--engine step", "--view tlm"}) {
    run(kFast, "", options + " --set user_cpu.cycle=40us --set masters.plc.bus.min_slave_interval=0",
        FIRMWARE_EARLY_R_STA);
    for (const char* check : {"OWNERSHIP_BOTH_OWN", "LOOK_IN_WINDOW"})
      expect_line(where(check), "dsdpv1_port_stm32.c", "GPIOC->BSRR = level ? bit : bit << 16;");
    EXPECT_TRUE(where("OWNERSHIP_BOTH_OWN").at("stayed_ns").is_null());
    if (first.is_null()) first = result_.at("checks"), first_log = log();
    EXPECT_EQ(result_.at("checks"), first) << options;
    EXPECT_TRUE(log() == first_log) << options;
  }
}

TEST_F(FirmwareLines, LookThatCameTooSoonIsItsLoad) {
  run(kFast + "checks: {LOOK_IN_WINDOW: {min: 1ms}}\n", "");
  expect_line(where("LOOK_IN_WINDOW"), "dsdpv1_port_stm32.c", "return (GPIOC->IDR & kLStaBit) != 0u;");
}

TEST_F(FirmwareLines, OmissionIsWhereTheFirmwareWasInstead) {
  run(kParallel, "{at: 20ms, do: hold_dpram, slave: board, for: 11ms}");
  const Json place = where("OWNERSHIP_NEVER_RELEASED");
  EXPECT_EQ(place.at("file"), "board.c");
  EXPECT_EQ(place.at("function"), "board_sleep") << place;
  EXPECT_NEAR(place.at("stayed_ns"), 11e6, 0.3e6);
  const std::string words = "in board_sleep\\(\\) at board.c:[0-9]+ for 1[01].[0-9]+ ms";
  for (const std::string& text : {called_.out, log(), read(folder_.file("junit.xml")), read(folder_.file("page.html"))})
    EXPECT_THAT(text, testing::ContainsRegex(words));
}

TEST_F(FirmwareLines, BlockIsTheStoreOfItsFlag) {
  run(kParallel, "{at: 20ms, do: wrong_crc, slave: board, area: inputs}");
  expect_line(where("CRC_WRITTEN"), "dsdpv1_port_stm32.h", "= value;");
  expect_line(where("INPUT_CRC"), "dsdpv1_port_stm32.h", "= value;");
  EXPECT_EQ(where("CRC_WRITTEN"), where("INPUT_CRC"));
}

TEST_F(FirmwareLines, TelegramIsTheStoreOfItsLastByte) {
  run(kSpi, "{at: 20ms, do: flip_bit, slave: board}, {at: 25ms, do: hold_dpram, slave: board, for: 11ms}");
  expect_line(where("TELEGRAM_CRC"), "spi_port.c", "card->spi->DR = out[i];");
  EXPECT_EQ(where("B014_HELD").at("function"), "board_sleep");
  run(kUart, "{at: 20ms, do: wrong_parity, slave: board}");
  expect_line(where("UART_PARITY"), "uart_port.c", "USART2->DR = bytes[i];");
  expect_line(where("RXD_PARITY"), "uart_port.c", "USART2->DR = bytes[i];");
}

}  // namespace
}  // namespace dsdpv1
