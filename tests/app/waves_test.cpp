// --wave and the options that go with it: what is in the files of whole runs.
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

/// The wave of a run of `scenario`, or of kScenario.
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

// Who writes a trace wants each change of each pin, so that telegrams are told change by change.
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
