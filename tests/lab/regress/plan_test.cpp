// From the command line to the runs: combinations, exclusions, errors, and the shard of a run.
#include "lab/regress/plan.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <functional>
#include <set>

#include "io/input/input_error.hpp"
#include "tests/app/folder.hpp"

namespace dsdpv1 {
namespace {

namespace fs = std::filesystem;
using tb::regress::parse_seeds;
using tb::regress::parse_shard;
using tb::regress::Plan;
using tb::regress::plan_of;
using tb::regress::Request;
using OneRun = tb::regress::Run;  // testing::Test has a Run, too
using testing::ElementsAre;
using testing::HasSubstr;

std::string error_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const tb::InputError& error) {
    return error.what();
  }
  return "no error";
}

class RegressPlan : public testing::Test {
 protected:
  RegressPlan() {
    fs::create_directories(folder_.path() / "sub");
    for (const char* name : {"b.yaml", "a.yaml", "sub/c.yml", "notes.txt"}) std::ofstream(folder_.file(name)) << "";
  }
  /// Without the folder.
  std::vector<std::string> names(const Plan& plan) const {
    std::vector<std::string> names;
    for (const OneRun& run : plan.runs) names.push_back(run.name().substr(folder_.path().string().size() + 1));
    return names;
  }
  Request request(const std::vector<std::string>& scenarios) const {
    Request request;
    for (const std::string& each : scenarios) request.scenarios.push_back(folder_.file(each));
    return request;
  }

  app_test::Folder folder_;
};

TEST_F(RegressPlan, FolderIsAllOfItsScenariosInOrderEachOnce) {
  EXPECT_THAT(names(plan_of(request({""}), {})),
              ElementsAre("a.yaml skip pins", "b.yaml skip pins", "sub/c.yml skip pins"));
  EXPECT_THAT(names(plan_of(request({"b.yaml", "."}), {})),
              ElementsAre("b.yaml skip pins", "a.yaml skip pins", "sub/c.yml skip pins"));
}

TEST_F(RegressPlan, EnginesViewsSeedsAndSettingsAreCombined) {
  Request all = request({"a.yaml"});
  all.engines = {"skip", "rtl"};
  all.views = {"pins", "tlm"};
  all.seeds = {"1", "2"};
  all.parameters = {{"baud", {"12M", "6M"}}};
  const Plan plan = plan_of(all, {});
  EXPECT_THAT(names(plan), ElementsAre("a.yaml skip pins baud=12M", "a.yaml skip pins baud=6M",
                                       "a.yaml skip tlm baud=12M", "a.yaml skip tlm baud=6M",
                                       "a.yaml rtl pins seed=1 baud=12M", "a.yaml rtl pins seed=1 baud=6M",
                                       "a.yaml rtl pins seed=2 baud=12M", "a.yaml rtl pins seed=2 baud=6M"));
  EXPECT_EQ(plan.left_out, 4U);
}

TEST_F(RegressPlan, ShardsHaveEveryRunOnce) {
  Request all = request({"a.yaml", "b.yaml"});
  all.engines = {"step", "skip"};
  all.parameters = {{"user_cpu.fsmc.datast", {"1", "2", "3", "4", "5", "6", "7", "8", "9", "10"}}};
  const std::vector<std::string> whole = names(plan_of(all, {}));
  std::multiset<std::string> parts;
  for (std::uint64_t i = 1; i <= 5; ++i) {
    const std::vector<std::string> part = names(plan_of(all, {i, 5}));
    EXPECT_FALSE(part.empty());
    parts.insert(part.begin(), part.end());
  }
  EXPECT_EQ(parts, std::multiset<std::string>(whole.begin(), whole.end()));
}

TEST_F(RegressPlan, ANewScenarioMovesNoRunToAnotherShard) {
  const std::vector<std::string> before = names(plan_of(request({""}), {1, 2}));
  std::ofstream(folder_.file("0.yaml")) << "";
  const std::vector<std::string> after = names(plan_of(request({""}), {1, 2}));
  for (const std::string& name : before) EXPECT_THAT(after, testing::Contains(name));
}

TEST_F(RegressPlan, WhatIsNotThereOrChangesNothingIsRefused) {
  EXPECT_THAT(error_of([this] { plan_of(request({"none"}), {}); }),
              HasSubstr("none: no such file or folder, expected scenarios and folders of them"));
  fs::create_directories(folder_.path() / "empty");
  EXPECT_THAT(error_of([this] { plan_of(request({"empty"}), {}); }), HasSubstr("empty: holds no scenario, expected"));
  Request seeds = request({"a.yaml"});
  seeds.seeds = {"1"};
  EXPECT_THAT(error_of([&] { plan_of(seeds, {}); }), HasSubstr("--seed changes nothing with --engine skip"));
  Request impossible = request({"a.yaml"});
  impossible.engines = {"rtl"};
  impossible.views = {"tlm"};
  EXPECT_THAT(error_of([&] { plan_of(impossible, {}); }), HasSubstr("nothing is left to be run"));
  Request twice = request({"a.yaml"});
  twice.parameters = {{"baud", {"12M"}}, {"baud", {"6M"}}};
  EXPECT_EQ(error_of([&] { plan_of(twice, {}); }), "--set baud: is set twice, expected once");
  Request many = request({"a.yaml", "b.yaml"});
  many.parameters = {{"a", std::vector<std::string>(1000, "1")}, {"b", std::vector<std::string>(51, "1")}};
  EXPECT_THAT(error_of([&] { plan_of(many, {}); }), HasSubstr("more than 100000 runs"));
}

TEST(RegressShard, IsAPartOfSoMany) {
  EXPECT_EQ(parse_shard("2/5").index, 2U);
  EXPECT_EQ(parse_shard("5/5").count, 5U);
  for (const char* text : {"", "2", "0/5", "6/5", "a/b", "1/", "1/0", "-1/5", "1/2/3"})
    EXPECT_THAT(error_of([text] { parse_shard(text); }), HasSubstr("expected something like 2/5")) << text;
}

TEST(RegressSeeds, AreListsAndRangesOfWholeNumbers) {
  EXPECT_THAT(parse_seeds("1..3,7"), ElementsAre("1", "2", "3", "7"));
  EXPECT_THAT(error_of([] { parse_seeds("1,x"); }), HasSubstr("seed is \"x\", expected a whole number from 0 to"));
  EXPECT_THAT(error_of([] { parse_seeds("4294967296"); }), HasSubstr("expected a whole number"));
  EXPECT_THAT(error_of([] { parse_seeds("1,1"); }), HasSubstr("1 is there twice"));
}

TEST(RegressRun, ItsFileNameIsPlainAndItsOwn) {
  const OneRun run{"x/ä b\n.yaml", "skip", "pins", "", {"baud=6M"}};
  for (const char c : run.file_name())
    EXPECT_TRUE(std::isalnum(c) != 0 || std::string("._-").find(c) != std::string::npos);
  OneRun other = run;
  other.scenario = "y/ä b\n.yaml";
  EXPECT_NE(run.file_name(), other.file_name());
  other = run;
  other.settings = {"baud=12M"};
  EXPECT_NE(run.file_name(), other.file_name());
}

TEST(RegressRun, IsReadBackFromItsJson) {
  const OneRun run{"x.yaml", "rtl", "pins", "3", {"baud=6M", "end=1ms"}};
  EXPECT_EQ(tb::regress::run_of(json_of(run)).name(), run.name());
  EXPECT_THROW(tb::regress::run_of({{"scenario", 7}}), nlohmann::json::exception);
}

}  // namespace
}  // namespace dsdpv1
