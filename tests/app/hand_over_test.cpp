// dsdpv1-sim hands scenarios with an ARM board over to dsdpv1-board: whatever the command, wherever the scenario comes
// from, and with a line that says what is missing where that program is not there.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>

#include "tests/app/program.hpp"

namespace dsdpv1 {
namespace {

namespace fs = std::filesystem;
using app_test::call;
using app_test::Called;
using app_test::read;
using testing::HasSubstr;

const std::string kBoard = DSDPV1_BOARD;

class HandOver : public testing::Test {
 protected:
  HandOver() {
    write("s.yaml", std::string("{kind: arm, elf: \"") + FIRMWARE_WITHOUT_MAILBOX + "\"}",
          "expect: [{slave: own, dp_state: wait_prm}]\n");
    write("native.yaml", "{}");
  }
  void write(const std::string& name, const std::string& user_cpu, const std::string& more = "") const {
    std::ofstream(file(name)) << "name: x\nbaud: 12M\nend: 3ms\nslaves:\n  - {name: own, address: 5, init: {ident: 1, "
                                 "max_inputs: 2, max_outputs: 2, cfg: \"31\"},\n     user_cpu: "
                              << user_cpu
                              << "}\nmasters:\n  - {name: plc, address: 2, slaves: [{slave: own, outputs: "
                                 "\"01 02\"}]}\n"
                              << more;
  }
  std::string file(const std::string& name) const { return folder_.file(name); }
  Called sim(const std::string& arguments) const { return call(arguments, folder_.path()); }
  /// Another dsdpv1-sim, alone in a folder.
  std::string copy_of_sim() const {
    fs::create_directory(folder_.path() / "bin");
    fs::copy_file(DSDPV1_SIM, folder_.path() / "bin" / "dsdpv1-sim");
    return file("bin/dsdpv1-sim");
  }
  app_test::Folder folder_;
};

/// What `write` writes into a FIFO of this name, while somebody reads it.
class Fifo {
 public:
  Fifo(const std::string& path, const std::string& content) : path_(path) {
    EXPECT_EQ(mkfifo(path.c_str(), 0600), 0);
    writer_ = std::thread([path, content] { std::ofstream(path, std::ios::binary) << content; });
  }
  ~Fifo() { writer_.join(); }
  Fifo(const Fifo&) = delete;
  Fifo& operator=(const Fifo&) = delete;

 private:
  std::string path_;
  std::thread writer_;
};

TEST_F(HandOver, OfAScenarioThatCanBeReadOnce) {
  const Fifo scenario(file("pipe.yaml"), read(file("s.yaml")));
  const Called called = sim("run pipe.yaml --no-progress --result r.json");
  EXPECT_EQ(called.status, 0) << called.out << called.err;
  EXPECT_THAT(read(file("r.json")), HasSubstr("arm_board"));
}

TEST_F(HandOver, OfACaptureThatCanBeReadOnce) {
  ASSERT_EQ(sim("run s.yaml --quiet --no-progress --capture c.pcapng").status, 0);
  const Fifo capture(file("pipe.pcapng"), read(file("c.pcapng")));
  const Called called = sim("replay pipe.pcapng --as 5 --scenario s.yaml --no-progress");
  EXPECT_EQ(called.status, 0) << called.out << called.err;
}

TEST_F(HandOver, ServeAndSweepKeepTheirWays) {
  EXPECT_EQ(sim("serve s.yaml --tcp 0 --for 5ms --quiet").status, 0);
  std::ofstream(file("no.elf")) << "no firmware";
  const Called swept =
      sim("sweep s.yaml --quiet --no-progress --out o --param 'user_cpu.elf=" + std::string(FIRMWARE_WITHOUT_MAILBOX) +
          ",no.elf'");
  EXPECT_EQ(swept.status, 0) << swept.err;
  EXPECT_THAT(read(file("o/results.csv")), HasSubstr("no.elf: is not an ELF file"));
}

TEST_F(HandOver, TracesOfAllKindsAreOneCommand) {
  const Called called = call("traces check watchdog arm_board_12m --no-progress", DSDPV1_SOURCE_DIR);
  EXPECT_EQ(called.status, 0) << called.out << called.err;
}

TEST_F(HandOver, SignalReachesWhoGoesOn) {
  const Called called = call(std::string("--preserve-status -s INT 0.5 '") + DSDPV1_SIM +
                                 "' run s.yaml --no-progress --quiet --set end=1000s --result r.json",
                             folder_.path(), "timeout");
  EXPECT_EQ(called.status, 130) << called.err;
  EXPECT_THAT(read(file("r.json")), HasSubstr("\"interrupted\": true"));
}

TEST_F(HandOver, TlmViewIsRefusedInOneLine) {
  const Called called = sim("run s.yaml --no-progress --view tlm --result r.json");
  EXPECT_EQ(called.status, 2);
  EXPECT_EQ(called.err,
            "dsdpv1-sim run: --view tlm is in SystemC, which is never in one program with an ARM board "
            "(docs/licences.md), allowed with kind: arm is --view pins\n");
  EXPECT_FALSE(fs::exists(file("r.json")));
}

TEST_F(HandOver, RegressionHasTheTlmViewOfOthersOnly) {
  const Called called = sim("regress s.yaml native.yaml --view pins,tlm --no-progress");
  EXPECT_EQ(called.status, 0) << called.out;
  EXPECT_THAT(called.err, HasSubstr("3 of 3 runs passed"));
  EXPECT_THAT(called.err, HasSubstr("; 1 combinations that cannot be are left out"));
}

TEST_F(HandOver, RegressionRunsAgainWhenTheBoardIsAnotherOne) {
  const std::string program = copy_of_sim();
  fs::copy_file(kBoard, folder_.path() / "bin" / "dsdpv1-board");
  const auto regress = [&] {
    return call("regress s.yaml native.yaml --quiet --no-progress", folder_.path(), program);
  };
  EXPECT_EQ(regress().status, 0);
  EXPECT_THAT(regress().err, HasSubstr("2 of 2 runs are there already"));
  std::ofstream(file("bin/dsdpv1-board"), std::ios::app) << "another one";
  EXPECT_THAT(regress().err, HasSubstr("1 of 2 runs are there already"));
}

TEST_F(HandOver, WithoutTheProgramOneLineSaysWhatIsMissing) {
  const std::string program = copy_of_sim();
  const Called called = call("run s.yaml --no-progress --result r.json", folder_.path(), program);
  EXPECT_EQ(called.status, 2);
  EXPECT_EQ(called.err,
            "s.yaml:6: kind is arm, which dsdpv1-board carries out, and that is neither beside this program nor in "
            "PATH: it is built where Unicorn is (Debian: libunicorn-dev), allowed without it is native\n");
  EXPECT_FALSE(fs::exists(file("r.json")));
  EXPECT_EQ(call("run native.yaml --no-progress", folder_.path(), program).status, 0);
}

/// A copy of the program whose Unicorn has a name that no library has.
TEST_F(HandOver, WithoutALibraryOfTheProgramOneLineSaysWhichIsMissing) {
  const std::string program = copy_of_sim();
  std::string board = read(kBoard);
  for (std::size_t at = 0; (at = board.find("libunicorn.so", at)) != std::string::npos;)
    board.replace(at, 10, "libabsent_");
  std::ofstream(file("bin/dsdpv1-board"), std::ios::binary) << board;
  fs::permissions(file("bin/dsdpv1-board"), fs::perms::owner_exec, fs::perm_options::add);
  const Called called = call("run s.yaml --no-progress --result r.json", folder_.path(), program);
  EXPECT_EQ(called.status, 2);
  EXPECT_EQ(called.err, "dsdpv1-sim: " + file("bin/dsdpv1-board") +
                            " cannot be started: its library libabsent_.so.2 is not installed\n");
  EXPECT_FALSE(fs::exists(file("r.json")));
}

TEST_F(HandOver, TheProgramIsFoundInLibexecAndInPath) {
  const std::string program = copy_of_sim();
  const auto run = [&] { return call("run s.yaml --no-progress --quiet", folder_.path(), program).status; };
  fs::create_directories(folder_.path() / "libexec" / "dsdpv1");
  fs::create_symlink(kBoard, folder_.path() / "libexec" / "dsdpv1" / "dsdpv1-board");
  EXPECT_EQ(run(), 0);
  fs::remove_all(folder_.path() / "libexec");
  EXPECT_EQ(run(), 2);
  const char* const given = std::getenv("PATH");
  ASSERT_NE(given, nullptr);
  const std::string path = given;
  setenv("PATH", (path + ":" + fs::path(kBoard).parent_path().string()).c_str(), 1);
  EXPECT_EQ(run(), 0);
  setenv("PATH", path.c_str(), 1);
}

}  // namespace
}  // namespace dsdpv1
