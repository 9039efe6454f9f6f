// The output of a played stimulus: log, wave of the model's side, result. The RTL is made up.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "cosim/random/play_log.hpp"
#include "cosim/random/play_options.hpp"
#include "cosim/random/play_wave.hpp"
#include "cosim/random/player.hpp"
#include "cosim/random/stimulus_result.hpp"
#include "tests/cosim/made_up_top.hpp"

namespace dsdpv1 {
namespace {

using testing::HasSubstr;

// RESET rises, then an FDL status request for station 5 goes by.
constexpr const char* kStimulus = "reset +0 low=6541\nsync\nsend +100000 rate=0 reply=270 : 10 05 02 49 50 16\n";
constexpr long kWrongFrom = 3000;  // cycle

cosim::MakeTop wrong_interrupt() {
  return [] {
    return std::make_unique<cosim_test::MadeUpTop>([](Level* levels, long cycle) {
      if (cycle >= kWrongFrom) levels[number(Pin::kIntr0)] = 0;
    });
  };
}

const tb::ChipKind& chip_kind() { return *tb::chip_kinds().front(); }

class PlayedStimulus : public testing::Test {
 public:
  PlayedStimulus() { std::filesystem::create_directories(folder_); }
  ~PlayedStimulus() override { std::filesystem::remove_all(folder_); }

 protected:
  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  std::string read(const std::string& name) const {
    std::ifstream in(path(name));
    return {std::istreambuf_iterator<char>(in), {}};
  }
  static cosim::PlayResult play(cosim::PlayLog* log, cosim::PlayWave* wave) {
    cosim::PlayOptions options = cosim::usual_options();
    if (log != nullptr) options.listeners.push_back(log);
    if (wave != nullptr) wave->listen(options);
    return cosim::play(cosim::parse_stimulus(kStimulus, "x", *options.kind), wrong_interrupt(), options);
  }

 private:
  std::filesystem::path folder_ =
      std::filesystem::path(testing::TempDir()) /
      (std::string("played_") + testing::UnitTest::GetInstance()->current_test_info()->name());
};

TEST_F(PlayedStimulus, LogHasPinsOfAllSidesEventsTelegramsAndTheDifferenceInOrderOfTime) {
  cosim::PlayLog log(path("case.log"), chip_kind());
  const cosim::PlayResult result = play(&log, nullptr);
  ASSERT_TRUE(result.difference);
  const std::string text = read("case.log");
  EXPECT_THAT(text, HasSubstr("545.083 ns  inputs       pin       RESET 1\n"));
  EXPECT_THAT(text, HasSubstr("  rtl          pin       L_REQ 1\n"));
  EXPECT_THAT(text, HasSubstr("  bus          telegram  2 -> 5  request"));
  EXPECT_THAT(text, HasSubstr("62500.000 ns  rtl          pin       INTR0 0\n"));
  EXPECT_THAT(text, HasSubstr("62500.000 ns  lockstep     difference pin INTR0: model 1, RTL 0\n"));
  double before = 0;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line); before = std::stod(line))
    EXPECT_GE(std::stod(line), before) << line;
}

TEST_F(PlayedStimulus, WaveHasPinsInsideAndTelegramsOfTheModel) {
  cosim::PlayWave wave(path("case.vcd"), "chip", chip_kind());
  const cosim::PlayResult result = play(nullptr, &wave);
  ASSERT_TRUE(result.difference);
  const std::string text = read("case.vcd");
  for (const char* each : {"$scope module chip", " INTR0 $end", " D_OUT [7:0] $end", "$scope module inside",
                           " owner $end", "request_FDL_status", "schip "})
    EXPECT_NE(text.find(each), std::string::npos) << each;
}

TEST_F(PlayedStimulus, FirstDifferenceIsTheSameWhoeverListens) {
  const cosim::PlayResult alone = play(nullptr, nullptr);
  cosim::PlayLog log(path("case.log"), chip_kind());
  cosim::PlayWave wave(path("case.vcd"), "chip", chip_kind());
  const cosim::PlayResult heard = play(&log, &wave);
  ASSERT_TRUE(alone.difference && heard.difference);
  EXPECT_EQ(alone.difference->at, heard.difference->at);
  EXPECT_EQ(alone.difference->what, heard.difference->what);
  EXPECT_EQ(alone.difference->last_telegram, heard.difference->last_telegram);
  EXPECT_EQ(alone.counts.pin_changes, heard.counts.pin_changes);
}

TEST_F(PlayedStimulus, ResultNamesVerdictCountsAndFirstDifference) {
  const cosim::PlayResult played = play(nullptr, nullptr);
  cosim::StimulusResult result;
  result.replayed = "case.stimulus";
  result.counts = played.counts;
  result.coverage = played.coverage;
  result.difference = played.difference;
  const nlohmann::json json = nlohmann::json::parse(cosim::result_json(result));
  EXPECT_EQ(json["schema"], "dsdpv1-sim rtl-random");
  EXPECT_EQ(json["version"], "1.2");
  EXPECT_EQ(json["chip"], "dsdpv1");
  EXPECT_EQ(json["verdict"], "different");
  EXPECT_EQ(json["replayed"], "case.stimulus");
  EXPECT_EQ(json["difference"]["cycle"], kWrongFrom);
  EXPECT_EQ(json["difference"]["what"], "pin INTR0: model 1, RTL 0");
  EXPECT_EQ(json["cycles"], kWrongFrom);
  EXPECT_TRUE(json["rtl"].is_null() && json["cases"].is_null() && json["case"].is_null());
  result.difference.reset();
  EXPECT_EQ(nlohmann::json::parse(cosim::result_json(result))["verdict"], "same");
}

TEST(StimulusResult, CountsTheRulingsOfEventsAndSituations) {
  cosim::StimulusResult result;
  result.coverage.add(profibus::Reason::kPrmIdent, 3);
  result.situations.add({"Sync and Freeze", "Sync: Freeze"}, 2);
  result.situations.add({"events", "PRM_IDENT"}, 3);  // the same ones
  result.documents = {DSDPV1_SOURCE_DIR "/docs/chip.md"};
  EXPECT_EQ(nlohmann::json::parse(cosim::result_json(result))["coverage"]["rulings"],
            nlohmann::json({{"S27", 2}, {"S4", 2}, {"S6", 3}}))
      << "T19-4 is a clause";
}

TEST(StimulusResult, HasItsTableInTheDocument) {
  std::ifstream page(DSDPV1_SOURCE_DIR "/docs/cosim.md");
  const std::string text{std::istreambuf_iterator<char>(page), {}};
  EXPECT_THAT(text, HasSubstr(cosim::stimulus_result_table())) << "dsdpv1-sim schema --rtl-random --markdown prints it";
}

}  // namespace
}  // namespace dsdpv1
