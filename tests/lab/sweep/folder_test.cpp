// The files that a sweep keeps, and when it resumes or starts again.
#include "lab/sweep/folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <functional>

#include "io/input/input_error.hpp"
#include "lab/campaign/fingerprint.hpp"

namespace dsdpv1 {
namespace {

namespace fs = std::filesystem;
using tb::sweep::Folder;
using tb::sweep::Plan;

class SweepFolder : public testing::Test {
 public:
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

 protected:
  static void write(const fs::path& path, const std::string& text) { std::ofstream(path) << text; }
  std::string point_file(const char* number) const { return (base_ / "out/points" / number).string() + ".json"; }
  Folder open() { return {base_ / "out", tb::sweep::identity(plan_, tb::sweep::Inputs(plan_), program_)}; }
  /// A point that has failed, with this many violations.
  bool finish(const Folder& folder, std::size_t point, const std::string& violations = "7") {
    write(folder.result_file(point),
          R"({"violations": )" + violations + R"(, "slaves": [], "expectations": [{"passed": true}]})");
    return folder.finish(point, plan_, 1, "").has_value();
  }

  /// Finishes a point, changes something and opens the folder again: the reason why it started again.
  std::string anew_after(const std::function<void()>& change) {
    finish(open(), 0);
    change();
    const Folder folder = open();
    EXPECT_FALSE(folder.finished(0, plan_));
    return folder.started_anew();
  }

  fs::path base_;
  std::string program_ = "p";
  Plan plan_;
};

TEST_F(SweepFolder, FinishedPointIsThereWhenTheSameSweepComesAgain) {
  finish(open(), 1);
  const Folder again = open();
  EXPECT_EQ(again.started_anew(), "");
  EXPECT_FALSE(again.finished(0, plan_));
  ASSERT_TRUE(again.finished(1, plan_));
  EXPECT_EQ(again.finished(1, plan_)->exit, 1);
  EXPECT_EQ(again.finished(1, plan_)->violations, 7);
  EXPECT_FALSE(fs::exists(again.result_file(1)));
}

TEST_F(SweepFolder, RefusedPointIsKeptWithItsReason) {
  EXPECT_TRUE(open().finish(1, plan_, 2, "the \xFF reason"));
  EXPECT_EQ(open().finished(1, plan_)->exit, 2);
  EXPECT_EQ(open().finished(1, plan_)->error, "the \xEF\xBF\xBD reason");  // valid UTF-8, the first time too
  EXPECT_EQ(open().finish(1, plan_, 2, "the \xFF reason")->error, "the \xEF\xBF\xBD reason");
}

TEST_F(SweepFolder, OnlyAResultThatSaysSomethingAboutThePointIsKept) {
  const Folder folder = open();
  for (const int exit : {0, 1, 2, 3, 127, 130, 137}) {
    EXPECT_FALSE(folder.finish(1, plan_, exit, "")) << exit;
    EXPECT_FALSE(fs::exists(point_file("00001"))) << exit;
  }
  for (const char* violations : {"\"many\"", "null", "[]", "1,,", ""})
    EXPECT_FALSE(finish(folder, 1, violations)) << violations;
  write(folder.result_file(1), "7");
  EXPECT_FALSE(folder.finish(1, plan_, 1, ""));
  EXPECT_FALSE(fs::exists(point_file("00001")));
  EXPECT_FALSE(fs::exists(folder.result_file(1)));
}

TEST_F(SweepFolder, PointCutShortAnywhereIsDoneAgain) {
  const Folder folder = open();
  finish(folder, 0);
  const std::string whole = tb::campaign::content(point_file("00000"));
  for (std::size_t length = 0; length + 1 < whole.size(); ++length) {  // the last byte is a line end
    write(point_file("00000"), whole.substr(0, length));
    EXPECT_FALSE(folder.finished(0, plan_)) << length;
  }
  write(point_file("00000"), whole);
  EXPECT_TRUE(folder.finished(0, plan_));
}

TEST_F(SweepFolder, PointOfAnotherFormOrWithAnotherByteIsDoneAgain) {
  const Folder folder = open();
  finish(folder, 0);
  const std::string whole = tb::campaign::content(point_file("00000"));
  for (const char* text : {"{}", "[]", "null", "7", R"({"sum": 1})", R"({"exit": 0, "error": "", "result": null})"}) {
    write(point_file("00000"), text);
    EXPECT_FALSE(folder.finished(0, plan_)) << text;
  }
  for (std::size_t at = 0; at + 1 < whole.size(); ++at) {
    std::string other = whole;
    other[at] = static_cast<char>(other[at] ^ 1);
    write(point_file("00000"), other);
    EXPECT_FALSE(folder.finished(0, plan_)) << other;
  }
  fs::remove(point_file("00000"));
  fs::create_directory(point_file("00000"));
  EXPECT_FALSE(folder.finished(0, plan_));
}

TEST_F(SweepFolder, PointInThePlaceOfAnotherOrOfAnotherSweepIsDoneAgain) {
  finish(open(), 0);
  fs::copy_file(point_file("00000"), point_file("00001"));
  EXPECT_TRUE(open().finished(0, plan_));
  EXPECT_FALSE(open().finished(1, plan_));
  fs::rename(point_file("00001"), base_ / "kept");
  program_ = "q";
  open();
  fs::rename(base_ / "kept", point_file("00000"));
  EXPECT_FALSE(open().finished(0, plan_));
}

TEST_F(SweepFolder, AnotherScenarioGsdProgramOrParameterStartsAnewAndSaysSo) {
  EXPECT_EQ(anew_after([this] { write(base_ / "s.yaml", "name: y\nslaves: [{name: a, gsd: a.gsd}]\n"); }),
            "another scenario or other content of its files");
  EXPECT_EQ(anew_after([this] { write(base_ / "a.gsd", "two"); }), "another scenario or other content of its files");
  EXPECT_EQ(anew_after([this] { program_ = "q"; }), "another version of the program");
  EXPECT_EQ(anew_after([this] { plan_.parameters[0].values.emplace_back("3"); }), "other parameters");
  EXPECT_EQ(anew_after([this] { plan_.settings = {"slaves.0.address=4"}; }), "other settings");
}

TEST_F(SweepFolder, AnotherFileThatOnlyASettingNamesStartsAnew) {
  write(base_ / "b.gsd", "one");
  write(base_ / "c.elf", "one");
  fs::create_directory(base_ / "d");
  write(base_ / "d/d.gsd", "one");
  plan_.parameters = {{"gsd", {(base_ / "b.gsd").string(), (base_ / "d/../d/d.gsd").string()}}};
  plan_.settings = {"slaves.a.user_cpu.elf=" + (base_ / "c.elf").string()};
  for (const char* file : {"b.gsd", "c.elf", "d/d.gsd"})
    EXPECT_EQ(anew_after([&] { write(base_ / file, "two"); }), "another scenario or other content of its files")
        << file;
  EXPECT_EQ(anew_after([&] { fs::remove(base_ / "b.gsd"); }), "another scenario or other content of its files");
  EXPECT_EQ(anew_after([&] { write(base_ / "b.gsd", ""); }), "another scenario or other content of its files");
}

TEST_F(SweepFolder, FolderWithSomethingElseIsLeftAlone) {
  fs::create_directories(base_ / "out");
  write(base_ / "out/thesis.txt", "x");
  EXPECT_THROW(open(), tb::InputError);
  write(base_ / "out/sweep.json", "{}");
  EXPECT_THROW(open(), tb::InputError);
  write(base_ / "out/sweep.json", "{");
  EXPECT_THROW(open(), tb::InputError);
  EXPECT_EQ(tb::campaign::content((base_ / "out/thesis.txt").string()), "x");
  EXPECT_FALSE(fs::exists(base_ / "out" / tb::campaign::Lock::name("sweep")));
}

TEST_F(SweepFolder, ResultsThatNoSweepHasWrittenAreSomethingElse) {
  fs::create_directories(base_ / "out");
  write(base_ / "out/results.csv", "mine");
  EXPECT_THROW(open(), tb::InputError);
  EXPECT_EQ(tb::campaign::content((base_ / "out/results.csv").string()), "mine");
}

TEST_F(SweepFolder, DamagedDescriptionStartsAnew) {
  finish(open(), 0);
  for (const char* text : {"", R"({"format": "dsdp)"}) {
    write(base_ / "out/sweep.json", text);
    const Folder folder = open();
    EXPECT_EQ(folder.started_anew(), "nothing that can be known, its sweep.json is damaged");
    EXPECT_FALSE(folder.finished(0, plan_));
    finish(folder, 0);
  }
  EXPECT_TRUE(open().finished(0, plan_));
}

TEST_F(SweepFolder, OneThatWasKilledBeforeItsDescriptionWasWrittenIsTakenOver) {
  fs::create_directories(base_ / "out");
  write(base_ / "out" / tb::campaign::Lock::name("sweep"), "1");
  write(base_ / "out/sweep.json.part", "{");
  EXPECT_EQ(open().started_anew(), "");
  EXPECT_FALSE(fs::exists(base_ / "out/sweep.json.part"));
}

TEST_F(SweepFolder, WhatAKilledSweepHasLeftIsRemovedByTheNext) {
  finish(open(), 0);
  for (const char* name : {"results.csv.part", "map.svg.77.part", ".map_2.svg.part", "points/00000.json.part",
                           "points/00001.77.run", "points/00001.77.run.part", "points/00001.err"})
    write(base_ / "out" / name, "half");
  for (const char* name : {"results.csv", "map.svg", "points/notes.txt", "points/00000.json.bak"})
    write(base_ / "out" / name, "whole");
  open();
  std::vector<std::string> left;
  for (const auto& entry : fs::recursive_directory_iterator(base_ / "out")) left.push_back(entry.path().filename());
  EXPECT_THAT(left, testing::UnorderedElementsAre("points", "00000.json", "00000.json.bak", "notes.txt", "sweep.json",
                                                  "results.csv", "map.svg"));
}

TEST_F(SweepFolder, HasOneOwnerAtATime) {
  {
    const Folder first = open();
    try {
      open();
      ADD_FAILURE() << "two owners";
    } catch (const tb::InputError& error) {
      EXPECT_EQ(error.what(), (base_ / "out").string() + ": a sweep with process id " + std::to_string(::getpid()) +
                                  " is using it, expected one sweep at a time");
    }
  }
  open();
}

TEST_F(SweepFolder, FileInItsPlaceIsRefused) {
  write(base_ / "out", "x");
  EXPECT_THROW(open(), tb::InputError);
}

}  // namespace
}  // namespace dsdpv1
