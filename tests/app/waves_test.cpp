// --wave and its options: the contents of the files of whole runs.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tests/app/program.hpp"

namespace dsdpv1::app_test {
namespace {

using testing::Contains;
using testing::IsSupersetOf;
using testing::UnorderedElementsAre;

/// The changes of a VCD of this program.
struct Vcd {
  struct Change {
    std::uint64_t ps;
    std::string value;
    bool operator==(const Change& other) const { return ps == other.ps && value == other.value; }
  };
  std::map<std::string, std::vector<Change>> signals;  ///< by "scope.name"
  std::set<std::uint64_t> times;

  explicit Vcd(const std::string& text) {
    std::istringstream in(text);
    std::map<std::string, std::string> names;
    std::vector<std::string> scopes;
    std::uint64_t now = 0;
    for (std::string line; std::getline(in, line);) {
      std::istringstream words(line);
      std::string word, type, width, id, name;
      words >> word;
      if (word == "$scope") words >> type >> name, scopes.push_back(name);
      if (word == "$upscope") scopes.pop_back();
      if (word == "$var") {
        words >> type >> width >> id >> name;
        std::string path;
        for (const std::string& scope : scopes) path += scope + ".";
        names[id] = path + name;
        signals[path + name];
      }
      if (word[0] == '$') continue;
      if (word[0] == '#') {
        times.insert(now = std::stoull(word.substr(1)));
        continue;
      }
      const bool single = word[0] != 'b' && word[0] != 's';
      if (!single) words >> id;
      signals[names.at(single ? word.substr(1) : id)].push_back({now, single ? word.substr(0, 1) : word.substr(1)});
    }
  }
  std::set<std::string> values(const std::string& signal) const {
    std::set<std::string> values;
    for (const Change& change : signals.at(signal)) values.insert(change.value);
    return values;
  }
  std::vector<std::string> names() const {
    std::vector<std::string> names;
    for (const auto& [name, changes] : signals) names.push_back(name);
    return names;
  }
};

/// A slave that is brought up within 3 ms.
constexpr const char* kScenario = R"({"name": "One slave", "baud": "12M", "end": "3ms",
  "slaves": [{"name": "demo", "address": 5, "init": {"ident": 3273, "max_inputs": 8, "max_outputs": 8, "max_prm": 10,
              "max_cfg": 1, "cfg": [55]}}],
  "masters": [{"name": "plc", "address": 2, "slaves": [{"slave": "demo"}]}]})";

/// The wave of a run of `scenario`; default: kScenario.
Vcd wave_of(const std::string& options, const std::string& scenario = "one.yaml") {
  const Folder folder;
  std::ofstream(folder.file("one.yaml")) << kScenario;
  const Called run = call("run " + scenario + " --quiet --wave w.vcd " + options, folder.path());
  EXPECT_EQ(run.status, 0) << run.err;
  return Vcd(read(folder.file("w.vcd")));
}

TEST(WaveOptions, TheInsideOfAChipIsShownOnRequest) {
  const Vcd wave = wave_of("--wave-inside --wave-signals 'demo.inside.*'");
  EXPECT_THAT(wave.names(), UnorderedElementsAre("demo.inside.B00E", "demo.inside.B00F", "demo.inside.B010",
                                                 "demo.inside.B011", "demo.inside.address", "demo.inside.baud",
                                                 "demo.inside.byte", "demo.inside.crc", "demo.inside.item",
                                                 "demo.inside.move", "demo.inside.owner", "demo.inside.watchdog"));
  EXPECT_THAT(wave.values("demo.inside.owner"), UnorderedElementsAre("-", "chip", "user"));
  EXPECT_THAT(wave.values("demo.inside.watchdog"), UnorderedElementsAre("BAUD_SEARCH", "BAUD_CONTROL"));
  EXPECT_THAT(wave.values("demo.inside.baud"), UnorderedElementsAre("-", "search_12M", "12M"));
  EXPECT_THAT(wave.values("demo.inside.crc"), UnorderedElementsAre("-", "initialisation_right", "inputs_right"));
  EXPECT_THAT(wave.values("demo.inside.item"),
              UnorderedElementsAre("-", "start-up", "commands", "initialisation", "inputs", "valid_flag", "Set_Prm",
                                   "Chk_Cfg", "outputs", "status_B00A", "status_B00B", "status_B012", "status_B013"));
  EXPECT_THAT(wave.values("demo.inside.B010"), IsSupersetOf({"00000000", "00000100"}));  // initialise
}

TEST(WaveOptions, TheInsideChangesNoPin) {
  const Vcd with = wave_of("--wave-inside"), without = wave_of("");
  EXPECT_EQ(with.signals.size(), without.signals.size() + 12);
  for (const auto& [name, changes] : without.signals) EXPECT_EQ(with.signals.at(name), changes) << name;
}

TEST(WaveOptions, CharactersServicesActionsAndEventsAreWords) {
  const Vcd wave = wave_of("");
  EXPECT_THAT(wave.values("bus.character"), Contains("DC"));
  EXPECT_THAT(wave.values("demo.service"), Contains(testing::HasSubstr("Set_Prm")));
  EXPECT_THAT(wave.values("demo.service"), testing::Not(Contains(testing::HasSubstr("token"))));
  EXPECT_THAT(wave.values("demo.user"), Contains("read_B004"));
  EXPECT_THAT(wave.values("demo.user"), Contains("R_REQ_1"));
  EXPECT_THAT(wave.values("demo.event"), Contains("INITIALISED_1"));
  EXPECT_THAT(wave.values("bus.flag"), Contains("BUS_UNANSWERED_1"));
}

std::vector<std::string> words_at(const Vcd& wave, const std::string& signal) {
  std::vector<std::string> words;
  for (const Vcd::Change& each : wave.signals.at(signal)) words.push_back(each.value);
  return words;
}

const std::string kScenarios = DSDPV1_SOURCE_DIR "/scenarios/";

// Every word of the scenario's script, and the chip's replies as in docs/chip_rsu.md.
TEST(WaveOptions, TelegramsOfTheUartAreWords) {
  const Vcd wave = wave_of("--wave-signals 'card.uart_*'", kScenarios + "rsu_uart_1m8432.yaml");
  EXPECT_THAT(words_at(wave, "card.uart_request"),
              testing::ElementsAre(
                  "-", "read_B004,_length_1,_card_1,_CRC_right__01_00_04_01_D8_C2",
                  "write_B020,_length_2,_card_1,_CRC_right__21_00_20_02_0F_05_59_69",
                  "read_B020,_length_2,_card_1,_CRC_right__01_00_20_02_D9_99",
                  "exchange_B130,_function_00,_length_2,_card_1,_CRC_right__41_00_01_30_02_01_55_AB_18",
                  "exchange_B227,_function_02,_length_1,_card_1,_CRC_right__41_02_02_27_01_00_E9_C6",
                  "exchange_B5D0,_function_00,_length_4,_card_1,_CRC_right__41_00_05_D0_04_5E_01_01_00_4B_C2",
                  "exchange_B6D0,_function_00,_length_4,_card_1,_CRC_right__41_00_06_D0_04_5E_01_01_00_4B_F1",
                  "read_B005,_length_1,_card_1,_CRC_wrong__[wrong:_CRC_D8C2,_computed_48C3]__01_00_05_01_D8_C2",
                  "read_B804,_length_1,_card_1,_CRC_right__01_08_04_01_1A_43",
                  "write_B7FF,_length_2,_card_1,_CRC_right__21_07_FF_02_00_00_BE_22",
                  "read_B804,_length_0,_card_1,_CRC_right__01_08_04_00_DA_82",
                  "exchange_B319,_function_00,_length_1,_card_1,_CRC_right__41_00_03_19_01_00_19_DF",
                  "exchange_B227,_function_00,_length_1,_card_1,_CRC_right__41_00_02_27_01_00_29_BF",
                  "exchange_B130,_function_00,_length_0,_card_1,_CRC_right__41_00_01_30_00_CF_5D",
                  "read_B004,_length_1,_card_2,_CRC_right__02_00_04_01_9C_C2",
                  "no_telegram:_begins_with_61__[wrong:_no_telegram]__61_00_04_01_D8_DC",
                  "read,_card_1__[wrong:_cut_after_2_bytes]__01_00",
                  "read_B004,_length_1,_card_1,_CRC_right__[wrong:_wrong_parity_in_byte_2]__01_00_04_01_D8_C2",
                  "read_B004,_length_1,_card_1,_CRC_right__01_00_04_01_D8_C2",
                  "read_B020,_length_1,_card_1,_CRC_right__[wrong:_not_heard:_the_chip_replies]__01_00_20_01_D8_D9",
                  "read_B004,_length_1,_card_1,_CRC_right__01_00_04_01_D8_C2"));
  EXPECT_THAT(words_at(wave, "card.uart_reply"),
              testing::ElementsAre(
                  "-", "reply_to_read,_length_1,_code_00,_card_1,_CRC_right__81_00_C5_BB_E1",
                  "reply_to_write,_code_00,_card_1,_CRC_right__A1_00_20_78",
                  "reply_to_read,_length_2,_code_00,_card_1,_CRC_right__81_00_0F_05_EB_ED",
                  "reply_with_B319,_function_00,_length_1,_card_1,_CRC_right__01_00_03_19_01_00_D9_D1",
                  "reply_with_B319,_function_00,_length_1,_card_1,_CRC_right__01_00_03_19_01_00_D9_D1",
                  "reply_with_B319,_function_00,_length_1,_card_1,_CRC_right__01_00_03_19_01_00_D9_D1",
                  "reply_with_B319,_function_00,_length_1,_card_1,_CRC_right__01_00_03_19_01_00_D9_D1",
                  "error,_code_01_(CRC),_card_1,_CRC_right__E1_01_20_88",
                  "error,_code_02_(address),_card_1,_CRC_right__E1_02_21_C8",
                  "error,_code_04_(data_length),_card_1,_CRC_right__E1_04_23_48",
                  "error,_code_06_(address,_data_length),_card_1,_CRC_right__E1_06_E2_C9",
                  "error_to_exchange,_code_02_(address),_function_80_(error),_card_1,_CRC_right__01_80_02_01_C0",
                  "error_to_exchange,_code_02_(address),_function_80_(error),_card_1,_CRC_right__01_80_02_01_C0",
                  "error_to_exchange,_code_04_(data_length),_function_80_(error),_card_1,_CRC_right__01_80_04_03_40",
                  "reply_to_read,_length_1,_code_00,_card_1,_CRC_right__81_00_C5_BB_E1",
                  "reply_to_read,_length_1,_code_00,_card_1,_CRC_right__81_00_C5_BB_E1"));
}

TEST(WaveOptions, TelegramsOfSpiAreWords) {
  const Vcd wave = wave_of("--wave-signals 'fast.spi_*'", kScenarios + "rsu_spi_telegrams.yaml");
  EXPECT_THAT(words_at(wave, "fast.spi_request"),
              testing::ElementsAre(
                  "-", "read_B014,_length_1,_card_1,_CRC_right__01_00_14_01_18_CF",
                  "write_B014,_length_1,_card_1,_CRC_right__21_00_14_01_02_52_58",
                  "write_B014,_length_1,_card_1,_CRC_right__21_00_14_01_02_52_58",
                  "write_B014,_length_1,_card_1,_CRC_right__21_00_14_01_02_52_58",
                  "write_B020,_length_2,_card_1,_CRC_right__21_00_20_02_0F_05_59_69",
                  "read_B020,_length_2,_card_1,_CRC_right__01_00_20_02_D9_99",
                  "write_B014,_length_1,_card_1,_CRC_right__21_00_14_01_00_93_D9",
                  "read_and_write,_length_1,_card_1,_CRC_right__41_01_55_7B_E0",
                  "read_B020,_length_2,_card_1,_CRC_right__01_00_20_02_D9_99",
                  "read_B094,_length_1,_card_1,_CRC_wrong__[wrong:_CRC_18CF,_computed_D8AE]__01_00_94_01_18_CF",
                  "read_B814,_length_1,_card_1,_CRC_right__01_08_14_01_DA_4E",
                  "write_B7FF,_length_2,_card_1,_CRC_right__21_07_FF_02_00_00_BE_22",
                  "read_B814,_length_0,_card_1,_CRC_right__01_08_14_00_1A_8F",
                  "read_and_write,_length_245,_card_1,_CRC_right__41_F5_5A_5A_5A_5A_5A_5A_5A_5A_5A_5A_5A_5A_5A_5A_5A_"
                  "5A_5A_5A_5A_5A_5A_5A_5A_5A_5A_5A_5A_5A_5A_5A_..._(249_bytes)",
                  "read_B014,_length_1,_card_2,_CRC_right__02_00_14_01_5C_CF",
                  "no_telegram:_begins_with_61__[wrong:_no_telegram]__61_00_14_01_18_D1_FF_FF_FF_FF_FF_FF_FF_FF",
                  "read,_card_1__[wrong:_cut_after_2_bytes_and_3_bits]__01_00",
                  "read_B014,_length_1,_card_1,_CRC_right__01_00_14_01_18_CF",
                  "write_B014,_length_1,_card_1,_CRC_right__21_00_14_01_00_93_D9",
                  "read_B014,_length_1,_card_1,_CRC_right__01_00_14_01_18_CF",
                  "read_B014,_length_1,_card_1,_CRC_right__01_00_14_01_18_CF"));
  EXPECT_THAT(words_at(wave, "fast.spi_reply"),
              testing::ElementsAre("-", "reply_to_read,_length_1,_code_00,_card_1,_CRC_right__81_00_00_E8_21",
                                   "reply_to_write,_code_00,_card_1,_CRC_right__A1_00_20_78",
                                   "reply_to_write,_code_00,_card_1,_CRC_right__A1_00_20_78",
                                   "reply_to_write,_code_00,_card_1,_CRC_right__A1_00_20_78",
                                   "reply_to_write,_code_00,_card_1,_CRC_right__A1_00_20_78",
                                   "reply_to_read,_length_2,_code_00,_card_1,_CRC_right__81_00_0F_05_EB_ED",
                                   "reply_to_write,_code_00,_card_1,_CRC_right__A1_00_20_78",
                                   "reply_to_read_and_write,_length_0,_code_00,_card_1,_CRC_right__C1_00_00_3C_20",
                                   "reply_to_read,_length_2,_code_00,_card_1,_CRC_right__81_00_0F_05_EB_ED",
                                   "error,_code_01_(CRC),_card_1,_CRC_right__E1_01_20_88",
                                   "error,_code_02_(address),_card_1,_CRC_right__E1_02_21_C8",
                                   "error,_code_04_(data_length),_card_1,_CRC_right__E1_04_23_48",
                                   "error,_code_06_(address,_data_length),_card_1,_CRC_right__E1_06_E2_C9",
                                   "error,_code_04_(data_length),_card_1,_CRC_right__E1_04_23_48",
                                   "reply__[wrong:_cut_after_2_bytes]__81_00",
                                   "reply_to_read,_length_1,_code_00,_card_1,_CRC_right__81_00_01_28_E0"));
}

/// The reply in data exchange with news of each kind.
TEST(WaveOptions, RepliesOfTheUartNameTheirAreas) {
  const auto replies =
      wave_of("--wave-signals 'drive.uart_reply'", kScenarios + "rsu_uart.yaml").values("drive.uart_reply");
  for (const char* each :
       {"reply_with_B410,_function_10_(parameters)", "reply_with_B500,_function_21_(data_exchange,_configuration)",
        "reply_with_B5D0,_function_05_(data_exchange,_C1)", "reply_with_B6D0,_function_09_(data_exchange,_C2)",
        "reply_with_B319,_function_01_(data_exchange)"})
    EXPECT_THAT(replies, Contains(testing::StartsWith(each)));
}

/// A character lasts 11 bits of 83.333 ns, so each of a telegram without gaps is shown 916.667 ns after the one before.
TEST(WaveOptions, EachCharacterIsShownInTheMiddleOfItsStopBit) {
  const Vcd wave = wave_of("");
  const auto& shown = wave.signals.at("bus.character");
  const auto first =
      std::find_if(shown.begin(), shown.end(), [](const Vcd::Change& each) { return each.value == "68"; });
  std::string bytes;
  for (auto each = first; each != shown.end() && each < first + 11; ++each) {
    bytes += each->value + " ";
    EXPECT_NEAR(static_cast<double>(each->ps - first->ps), 916'666.7 * static_cast<double>(each - first), 1.0);
  }
  EXPECT_EQ(bytes, "68 05 05 68 85 82 6D 3C 3E EE 16 ");  // Get_Diag
  const auto& line = wave.signals.at("bus.line");
  EXPECT_TRUE(std::any_of(line.begin(), line.end(), [&](const Vcd::Change& each) {
    return each.value == "0" && each.ps + 875'000 - first->ps + 1 <= 2;
  })) << "no start bit 10.5 bits before it";
}

// A trace needs each change of each pin, so telegrams are then reported change by change.
TEST(WaveOptions, TelegramsToldAsRunsAreTheSameBytes) {
  for (const char* const name : {"two_slaves", "judging_modes", "violations"}) {
    const Folder folder;
    const std::string run = std::string("run " DSDPV1_SOURCE_DIR "/scenarios/") + name + ".yaml --quiet --wave ";
    call(run + "runs.vcd", folder.path());
    call(run + "changes.vcd --trace changes.trace", folder.path());
    const std::string runs = read(folder.file("runs.vcd"));
    EXPECT_GT(runs.size(), 100'000U) << name;
    EXPECT_TRUE(runs == read(folder.file("changes.vcd"))) << name;
  }
}

TEST(WaveOptions, AWindowIsRecordedRoundEachViolation) {
  const Vcd wave = wave_of("--wave-on TIMING_TS --wave-around 1us", DSDPV1_SOURCE_DIR "/scenarios/violations.yaml");
  const auto& events = wave.signals.at("short_writes.event");
  EXPECT_THAT(events, Contains(Vcd::Change{53252417U, "TIMING_TS_1"}));  // as the log says: 53252.417 ns
  EXPECT_EQ(*wave.times.begin(), 52252417U);
  EXPECT_TRUE(wave.times.count(54252417U)) << "the window's end";
  EXPECT_THAT(wave.values("short_writes.CSR"), UnorderedElementsAre("0", "1", "x"));
}

TEST(WaveOptions, ARunWithoutTheEventSaysSo) {
  const Folder folder;
  std::ofstream(folder.file("one.yaml")) << kScenario;
  const Called run = call("run one.yaml --quiet --wave w.vcd --wave-on violation", folder.path());
  EXPECT_EQ(run.err, "dsdpv1-sim: w.vcd shows nothing: nothing of violation happened\n");
  EXPECT_THAT(Vcd(read(folder.file("w.vcd"))).values("demo.CSR"), UnorderedElementsAre("x"));
}

TEST(WaveOptions, ClkRisesAtEachCycleOfTheWindow) {
  const Vcd wave = wave_of("--wave-clk --wave-signals bus.line --wave-from 1ms --wave-to 1001us");
  const auto& clk = wave.signals.at("clock.CLK");
  ASSERT_EQ(clk.size(), 97U);  // 48 cycles and the edge at the end
  EXPECT_EQ(clk[0].ps, 1'000'000'000U);
  EXPECT_EQ(clk[0].value, "1");
  EXPECT_EQ(clk[1].ps, 1'000'010'417U);
  EXPECT_EQ(clk[2].ps, 1'000'020'833U);
}

}  // namespace
}  // namespace dsdpv1::app_test
