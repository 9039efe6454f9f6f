// Job arrays without a cluster: scripts replace its commands. tests/lab/slurm has a real one.
#include "lab/campaign/slurm.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>

#include "io/input/input_error.hpp"
#include "lab/campaign/fingerprint.hpp"

namespace dsdpv1 {
namespace {

namespace fs = std::filesystem;
using tb::campaign::in_tasks;
using tb::campaign::Slurm;
using tb::campaign::Submission;
using testing::ElementsAre;
using testing::HasSubstr;

/// The search path for commands.
std::string search_path() {
  const char* path = std::getenv("PATH");
  return path != nullptr ? path : "";
}

class SlurmCommands : public testing::Test {
 public:
  SlurmCommands()
      : base_(fs::temp_directory_path() / ("dsdpv1_slurm_" + std::to_string(getpid()))), path_(search_path()) {
    fs::create_directories(base_ / "bin");
    setenv("PATH", ((base_ / "bin").string() + ":" + path_).c_str(), 1);
  }
  ~SlurmCommands() override {
    setenv("PATH", path_.c_str(), 1);
    unsetenv("SLURM_ARRAY_TASK_ID");
    fs::remove_all(base_);
  }
  SlurmCommands(const SlurmCommands&) = delete;
  SlurmCommands& operator=(const SlurmCommands&) = delete;

 protected:
  /// A command that keeps its words, prints `text` and exits.
  void command(const std::string& name, const std::string& text, int exit = 0) const {
    const fs::path file = base_ / "bin" / name;
    std::ofstream(file) << "#!/bin/sh\necho \"$@\" >'" << (base_ / (name + ".words")).string() << "'\nprintf '" << text
                        << "'\nexit " << exit << "\n";
    fs::permissions(file, fs::perms::owner_all);
  }
  std::string words_of(const std::string& name) const {
    return tb::campaign::content((base_ / (name + ".words")).string());
  }

  fs::path base_;
  std::string path_;
};

TEST(SlurmTasks, HaveAJobEachUntilThereAreTooMany) {
  EXPECT_THAT(in_tasks({4, 7, 9}), ElementsAre(ElementsAre(4), ElementsAre(7), ElementsAre(9)));
  EXPECT_THAT(in_tasks({1, 2, 3, 4, 5}, 2), ElementsAre(ElementsAre(1, 2, 3), ElementsAre(4, 5)));
  EXPECT_TRUE(in_tasks({}).empty());
}

TEST_F(SlurmCommands, SubmissionIsAnArrayWhoseTasksCallTheProgramBack) {
  command("sbatch", R"(4711;cluster\n)");
  const Slurm slurm(base_, "--partition=x");
  const Submission made = slurm.submit("id", {{3}, {5}}, {"sweep", "it's.yaml"});
  EXPECT_EQ(made.job, "4711");
  EXPECT_THAT(words_of("sbatch"), HasSubstr("--array=0-1 "));
  EXPECT_THAT(words_of("sbatch"), HasSubstr(" --partition=x " + (base_ / "slurm/1.sh").string()));
  EXPECT_THAT(tb::campaign::content((base_ / "slurm/1.sh").string()),
              HasSubstr(" sweep 'it'\\''s.yaml' --slurm-task 1\n"));
  setenv("SLURM_ARRAY_TASK_ID", "1", 1);
  EXPECT_THAT(tb::campaign::jobs_of_task(base_, 1, 6), ElementsAre(5));
}

TEST_F(SlurmCommands, SubmissionsAreFoundAgainAndForgotten) {
  command("sbatch", R"(1\n)");
  const Slurm slurm(base_, "");
  const Submission first = slurm.submit("id", {{3}}, {"sweep"}), second = slurm.submit("id", {{4}}, {"sweep"});
  EXPECT_EQ(second.number, 2);
  std::ofstream(base_ / "slurm/3.json") << "{\"tasks\": 7}";
  EXPECT_EQ(slurm.submissions().size(), 2U);
  fs::remove(base_ / "slurm/3.json");
  slurm.forget(first);
  slurm.forget(second);
  EXPECT_FALSE(fs::exists(base_ / "slurm"));
}

TEST_F(SlurmCommands, RefusalOfSbatchIsTheLine) {
  command("sbatch", R"(sbatch: error: more\nsbatch: error: invalid partition\n)", 1);
  try {
    Slurm(base_, "--partition=none").submit("id", {{3}}, {"sweep"});
    ADD_FAILURE() << "no error";
  } catch (const tb::InputError& error) {
    EXPECT_STREQ(error.what(), "dsdpv1-sim: --slurm: sbatch says sbatch: error: invalid partition");
  }
  EXPECT_FALSE(fs::exists(base_ / "slurm"));
}

TEST_F(SlurmCommands, TasksUnderWayAreThoseThatSqueueNames) {
  command("squeue", R"(7 0\n7 12\n8 N/A\n9 1\n)");
  const auto tasks = Slurm::under_way();
  ASSERT_TRUE(tasks);
  EXPECT_THAT(tasks->at("7"), ElementsAre(0, 12));
  EXPECT_THAT(tasks->at("9"), ElementsAre(1));
  EXPECT_EQ(tasks->count("8"), 0U);
}

TEST_F(SlurmCommands, ASqueueThatFailsSaysNothingAboutTasks) {
  command("squeue", R"(slurm_load_jobs error\n)", 1);
  EXPECT_FALSE(Slurm::under_way());
}

TEST_F(SlurmCommands, OnlyATaskOfASubmissionHasJobs) {
  command("sbatch", R"(1\n)");
  Slurm(base_, "").submit("id", {{3}, {5}}, {"sweep"});
  for (const char* task : {"", "2", "-1", "x"}) {
    setenv("SLURM_ARRAY_TASK_ID", task, 1);
    EXPECT_THROW(tb::campaign::jobs_of_task(base_, 1, 6), tb::InputError) << task;
  }
  setenv("SLURM_ARRAY_TASK_ID", "0", 1);
  EXPECT_THROW(tb::campaign::jobs_of_task(base_, 1, 3), tb::InputError);
  EXPECT_THROW(tb::campaign::jobs_of_task(base_, 2, 6), tb::InputError);
}

}  // namespace
}  // namespace dsdpv1
