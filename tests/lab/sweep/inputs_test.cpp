// The files that a sweep reads, checked again for each point.
#include "lab/sweep/inputs.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "io/input/input_error.hpp"
#include "lab/campaign/fingerprint.hpp"

namespace dsdpv1 {
namespace {

namespace fs = std::filesystem;
using tb::sweep::Inputs;
using tb::sweep::Plan;

class SweepInputs : public testing::Test {
 public:
  SweepInputs() : base_(fs::temp_directory_path() / ("dsdpv1_inputs_" + std::to_string(::getpid()))) {
    fs::create_directories(base_);
    write("s.yaml", "name: x\nslaves: [{name: a, gsd: none.gsd}]\n");
    write("a.gsd", "a");
    write("b.gsd", "b");
    plan_.scenario = file("s.yaml");
    plan_.parameters = {{"slaves.0.gsd", {file("a.gsd"), file("b.gsd")}}};
  }
  ~SweepInputs() override { fs::remove_all(base_); }
  SweepInputs(const SweepInputs&) = delete;
  SweepInputs& operator=(const SweepInputs&) = delete;

 protected:
  std::string file(const char* name) const { return (base_ / name).string(); }
  void write(const char* name, const char* text) const { std::ofstream(base_ / name) << text; }
  static std::string error_of(const Inputs& inputs, std::size_t point) {
    try {
      inputs.look(point);
    } catch (const tb::InputError& error) {
      return error.what();
    }
    return "no error";
  }
  std::string changed(const char* name) const {
    return file(name) + ": was changed while the sweep ran, expected the same content for all of its points";
  }

  fs::path base_;
  Plan plan_;
};

TEST_F(SweepInputs, ChangedFileIsNamedAtThePointsThatReadIt) {
  const Inputs inputs(plan_);
  EXPECT_EQ(inputs.look(0), inputs.look(0));
  write("b.gsd", "B");
  EXPECT_EQ(error_of(inputs, 0), "no error");
  EXPECT_EQ(error_of(inputs, 1), changed("b.gsd"));
  fs::remove(file("b.gsd"));
  EXPECT_EQ(error_of(inputs, 1), changed("b.gsd"));
  write("s.yaml", "name: y\n");
  EXPECT_EQ(error_of(inputs, 0), changed("s.yaml"));
}

TEST_F(SweepInputs, FileThatHasComeSinceIsAChangeToo) {
  const Inputs inputs(plan_);
  write("none.gsd", "");
  EXPECT_EQ(error_of(inputs, 0), changed("none.gsd"));
}

// The kernel's clock for files advances in steps; a replaced file is detected by its number.
TEST_F(SweepInputs, ContentThatCameBackShowsInTheTimes) {
  const Inputs inputs(plan_);
  const Inputs::Times before = inputs.look(0);
  write("new", "a");
  fs::rename(file("new"), file("a.gsd"));
  EXPECT_NE(inputs.look(0), before);
}

// A scenario treats "link/../a.gsd" as "a.gsd", whatever "link" is; the system would follow the link.
TEST_F(SweepInputs, PathIsTheOneThatARunOpens) {
  fs::create_directories(base_ / "d/e");
  write("d/a.gsd", "other");
  fs::create_directory_symlink(base_ / "d/e", base_ / "link");
  const std::string relative = fs::relative(base_ / "b.gsd").string();
  plan_.parameters = {{"slaves.0.gsd", {file("link") + "/../a.gsd", relative}}};
  const Inputs inputs(plan_);
  EXPECT_EQ(inputs.content().value(file("a.gsd"), ""), tb::campaign::fingerprint("a"));
  EXPECT_EQ(inputs.content().value(file("b.gsd"), ""), tb::campaign::fingerprint("b"));
  write("a.gsd", "A");
  EXPECT_EQ(error_of(inputs, 0), changed("a.gsd"));
  EXPECT_EQ(error_of(inputs, 1), "no error");
}

TEST_F(SweepInputs, WhatCannotBeReadTwiceIsRefused) {
  ASSERT_EQ(mkfifo(file("fifo").c_str(), 0666), 0);
  plan_.settings = {"slaves.0.gsd=" + file("fifo")};
  plan_.parameters = {{"slaves.0.address", {"1", "2"}}};
  EXPECT_THROW(Inputs{plan_}, tb::InputError);
}

TEST_F(SweepInputs, FileThatIsNotThereOrAFolderHasNoContent) {
  plan_.parameters = {{"slaves.0.gsd", {file("none"), base_.string(), file("a.gsd") + "/x", file("a.gsd")}}};
  const Inputs inputs(plan_);
  EXPECT_EQ(inputs.content()[file("none")], nullptr);
  EXPECT_EQ(inputs.content()[base_.string()], nullptr);
  EXPECT_EQ(inputs.content()[file("a.gsd") + "/x"], nullptr);
  EXPECT_EQ(inputs.content()[file("a.gsd")], tb::campaign::fingerprint("a"));
}

}  // namespace
}  // namespace dsdpv1
