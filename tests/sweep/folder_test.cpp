// What a sweep keeps, when it goes on and when it starts anew.
#include "tb/sweep/folder.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <functional>

#include "tb/scenario/input_error.hpp"

namespace {

namespace fs = std::filesystem;
using tb::sweep::Folder;
using tb::sweep::Plan;

class SweepFolder : public testing::Test {
 protected:
  SweepFolder() : base_(fs::temp_directory_path() / ("dsdpv1_sweep_" + std::to_string(::getpid()))) {
    fs::create_directories(base_);
    write(base_ / "s.yaml", "name: x\nslaves: [{name: a, gsd: a.gsd}]\n");
    write(base_ / "a.gsd", "one");
    plan_.scenario = (base_ / "s.yaml").string();
    plan_.parameters = {{"slaves.0.address", {"1", "2"}}};
  }
  ~SweepFolder() override { fs::remove_all(base_); }
  SweepFolder(const SweepFolder&) = delete;
  SweepFolder& operator=(const SweepFolder&) = delete;

  static void write(const fs::path& path, const std::string& text) { std::ofstream(path) << text; }
  Folder open() { return {base_ / "out", tb::sweep::identity(plan_, program_)}; }
  void finish(const Folder& folder, std::size_t point, int exit) {
    write(folder.error_file(point), "the reason\nmore\n");
    folder.finish(point, plan_, exit);
  }

  /// Finishes a point, changes something and opens the folder again: why that started anew.
  std::string anew_after(const std::function<void()>& change) {
    finish(open(), 0, 2);
    change();
    const Folder folder = open();
    EXPECT_FALSE(folder.finished(0));
    return folder.started_anew();
  }

  fs::path base_;
  std::string program_ = "p";
  Plan plan_;
};

TEST_F(SweepFolder, FinishedPointIsThereWhenTheSameSweepComesAgain) {
  finish(open(), 1, 2);
  const Folder again = open();
  EXPECT_EQ(again.started_anew(), "");
  EXPECT_FALSE(again.finished(0));
  ASSERT_TRUE(again.finished(1));
  EXPECT_EQ(again.finished(1)->exit, 2);
  EXPECT_EQ(again.finished(1)->error, "the reason");
  EXPECT_FALSE(fs::exists(again.error_file(1)));
}

TEST_F(SweepFolder, PointOfARunThatWasKilledIsTriedAgain) {
  finish(open(), 1, 137);
  EXPECT_FALSE(open().finished(1));
}

TEST_F(SweepFolder, AnotherScenarioGsdProgramOrParameterStartsAnewAndSaysSo) {
  EXPECT_EQ(anew_after([this] { write(base_ / "s.yaml", "name: y\nslaves: [{name: a, gsd: a.gsd}]\n"); }),
            "another scenario or other content of its files");
  EXPECT_EQ(anew_after([this] { write(base_ / "a.gsd", "two"); }), "another scenario or other content of its files");
  EXPECT_EQ(anew_after([this] { program_ = "q"; }), "another version of the program");
  EXPECT_EQ(anew_after([this] { plan_.parameters[0].values.emplace_back("3"); }), "other parameters");
  EXPECT_EQ(anew_after([this] { plan_.settings = {"slaves.0.address=4"}; }), "other settings");
}

TEST_F(SweepFolder, FolderWithSomethingElseIsLeftAlone) {
  fs::create_directories(base_ / "out");
  write(base_ / "out/thesis.txt", "x");
  EXPECT_THROW(open(), tb::InputError);
  write(base_ / "out/sweep.json", "{}");
  EXPECT_THROW(open(), tb::InputError);
  EXPECT_TRUE(fs::exists(base_ / "out/thesis.txt"));
}

TEST_F(SweepFolder, FileInItsPlaceIsRefused) {
  write(base_ / "out", "x");
  EXPECT_THROW(open(), tb::InputError);
}

}  // namespace
