// Jobs in child processes: how many at a time, tries, signals, time limits. The children are this program.
#include "lab/campaign/runner.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>

#include "io/input/input_error.hpp"

namespace dsdpv1 {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using tb::campaign::Carrying;
using tb::campaign::Ended;
using tb::campaign::Kind;
using tb::campaign::Runner;
using testing::ElementsAre;
using Words = std::vector<std::string>;

const Kind kKind{"test", "jobs", [](const std::string& /*name*/) { return false; }};

/// A child's actions: exit CODE TEXT, kill SIGNAL TEXT, wait FILE (until it exists), hang.
int play(const Words& words) {
  if (words[0] == "hang")
    for (;;) pause();
  if (words[0] == "wait")
    while (!fs::exists(words[1])) usleep(1000);
  if (words.size() > 2) {
    const std::string text = words[2] + "\n";
    if (write(STDOUT_FILENO, text.data(), text.size() / 2) < 0) return 99;
    if (write(STDERR_FILENO, text.data() + text.size() / 2, text.size() - text.size() / 2) < 0) return 99;
  }
  if (words[0] == "kill") raise(std::atoi(words[1].c_str()));
  return words[0] == "exit" ? std::atoi(words[1].c_str()) : 0;
}

/// Jobs that are finished when a run exits with 0; each has its words for the first try and for those after it.
class FakeJobs : public tb::campaign::Jobs {
 public:
  explicit FakeJobs(std::vector<std::vector<Words>> tries)
      : tries_(std::move(tries)), finished_(tries_.size(), false) {}

  std::size_t size() const override { return tries_.size(); }
  bool finished(std::size_t job) const override { return finished_[job]; }
  bool look(std::size_t job) override { return finished_[job]; }
  Words begin(std::size_t job) override {
    begun.push_back(job);
    most = std::max(most, ++running);
    if (on_begin) on_begin(job);
    return tries_[job].at(std::min(count_[job]++, tries_[job].size() - 1));
  }
  std::string end(const Ended& each) override {
    --running;
    ended.push_back(each);
    finished_[each.job] = each.exit == 0;
    return fate(each);
  }
  void forget(std::size_t job) override { forgotten.push_back(job); }
  std::string name(std::size_t job) const override { return "job " + std::to_string(job); }

  std::vector<std::size_t> begun, forgotten;
  std::vector<Ended> ended;
  std::size_t running = 0, most = 0;
  std::function<void(std::size_t)> on_begin;

 private:
  std::vector<std::vector<Words>> tries_;
  std::vector<bool> finished_;
  std::map<std::size_t, std::size_t> count_;
};

Carrying carrying(unsigned at_a_time, bool interrupted = false) {
  return {kKind, at_a_time, std::nullopt, false, [interrupted] { return interrupted; }};
}

const Words kGood = {"exit", "0"};

TEST(CampaignRunner, RunsAllJobsNotMoreThanWantedAtATime) {
  FakeJobs jobs({{kGood}, {kGood}, {kGood}, {kGood}, {kGood}});
  EXPECT_TRUE(Runner(jobs, carrying(2)).run());
  EXPECT_THAT(jobs.begun, ElementsAre(0, 1, 2, 3, 4));
  EXPECT_EQ(jobs.most, 2U);
}

TEST(CampaignRunner, RunsOnlyTheJobsThatAreWantedAndNotFinished) {
  FakeJobs jobs({{kGood}, {kGood}, {kGood}, {kGood}});
  EXPECT_TRUE(Runner(jobs, carrying(1), {1}).run());
  EXPECT_TRUE(Runner(jobs, carrying(1), {1, 3}).run());
  EXPECT_THAT(jobs.begun, ElementsAre(1, 3));
}

// Job 1 runs until job 2 has begun: a retry must not start it a second time.
TEST(CampaignRunner, AnotherTryLeavesThoseUnderWayAlone) {
  const fs::path file = fs::temp_directory_path() / ("dsdpv1_runner_" + std::to_string(getpid()));
  FakeJobs jobs({{{"kill", "9"}, kGood}, {{"wait", file.string()}}, {kGood}, {kGood}});
  jobs.on_begin = [&file](std::size_t job) {
    if (job == 2) std::ofstream(file) << "";
  };
  EXPECT_TRUE(Runner(jobs, carrying(2)).run());
  EXPECT_THAT(jobs.begun, ElementsAre(0, 1, 0, 2, 3));
  fs::remove(file);
}

TEST(CampaignRunner, OneThatIsKilledTwiceEndsAllAndIsNamed) {
  FakeJobs jobs({{kGood}, {{"kill", "9"}}, {kGood}});
  Runner runner(jobs, carrying(1));
  try {
    runner.run();
    ADD_FAILURE() << "no error";
  } catch (const tb::InputError& error) {
    EXPECT_STREQ(error.what(),
                 "dsdpv1-sim test: job 1 cannot be run: its run was killed by signal 9; 1 of 3 jobs are kept");
  }
  EXPECT_THAT(jobs.begun, ElementsAre(0, 1, 1));
}

TEST(CampaignRunner, InterruptedItEndsThoseUnderWay) {
  FakeJobs jobs({{{"hang"}}, {{"hang"}}});
  bool stop = false;
  jobs.on_begin = [&stop](std::size_t job) { stop = job == 1; };
  Carrying two = carrying(2);
  two.interrupted = [&stop] { return stop; };
  EXPECT_FALSE(Runner(jobs, two).run());
  EXPECT_THAT(jobs.forgotten, testing::UnorderedElementsAre(0, 1));
}

// The limit leaves the second try time to start on a busy machine, under the sanitizers, too.
TEST(CampaignRunner, OneThatTakesTooLongIsKilledAndSaysSo) {
  FakeJobs jobs({{{"hang"}, kGood}});
  Carrying limited = carrying(1);
  limited.limit = 2s;
  EXPECT_TRUE(Runner(jobs, limited).run());
  ASSERT_EQ(jobs.ended.size(), 2U);
  EXPECT_TRUE(jobs.ended[0].too_long);
  EXPECT_EQ(jobs.ended[0].exit, tb::campaign::kSignalled + SIGKILL);
  EXPECT_GE(jobs.ended[0].seconds, 2);
  EXPECT_FALSE(jobs.ended[1].too_long);
}

TEST(CampaignRunner, WhatARunSaysOnBothChannelsIsKeptInOrder) {
  FakeJobs jobs({{{"exit", "0", "first\nsecond\n"}}});
  EXPECT_TRUE(Runner(jobs, carrying(1)).run());
  EXPECT_EQ(jobs.ended.at(0).output, "first\nsecond\n\n");
  EXPECT_EQ(jobs.ended.at(0).last_line(), "second");
}

TEST(CampaignRunner, ASignalShowsInTheExitCode) {
  FakeJobs jobs({{{"kill", std::to_string(SIGTERM), "last words"}, kGood}});
  EXPECT_TRUE(Runner(jobs, carrying(1)).run());
  EXPECT_EQ(jobs.ended.at(0).exit, tb::campaign::kSignalled + SIGTERM);
  EXPECT_EQ(fate(jobs.ended.at(0)), "last words");
}

}  // namespace
}  // namespace dsdpv1

int main(int argc, char** argv) {
  const dsdpv1::Words words(argv, argv + argc);
  if (words[0] == "dsdpv1-sim") return dsdpv1::play({words.begin() + 1, words.end()});
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
