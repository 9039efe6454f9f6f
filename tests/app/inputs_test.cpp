// Unusual inputs: pipes and devices, names with terminal control sequences, a small stack.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/app/program.hpp"

namespace dsdpv1 {
namespace {

using app_test::call;
using app_test::Called;
using app_test::read;
using testing::HasSubstr;

// ESC, BEL, CSI of one byte as UTF-8, DEL, a mark of direction, a line end; and a letter that stays.
const std::string kNasty =
    "\x1B]0;x\x07\xC2\x9B"
    "2J\x7F\u202E\nPASSED ü";
const std::string kEscaped = R"(\x1B]0;x\x07\u009B2J\x7F\u202E\nPASSED ü)";

/// True for characters, other than line ends, that a terminal might take for a command.
bool steers(const std::string& text) {
  const auto is_order = [](char c) { return (static_cast<unsigned char>(c) < 0x20 && c != '\n') || c == 0x7F; };
  return std::any_of(text.begin(), text.end(), is_order) || text.find("\xC2\x9B") != std::string::npos ||
         text.find("\u202E") != std::string::npos;  // NOLINT(misc-misleading-bidirectional): the searched character
}

std::string scenario_named(const std::string& name) {
  return "name: " + nlohmann::json(name).dump() +
         "\nbaud: 12M\nend: 1ms\nslaves:\n  - {name: demo, address: 5, init: {ident: 1, max_inputs: 2, max_outputs: 2, "
         "cfg: \"31\"}}\nexpect:\n  - {slave: demo, dp_state: data_exch}\n";
}

class Inputs : public testing::Test {
 protected:
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_.path() / name, std::ios::binary) << text;
  }
  Called in_folder(const std::string& arguments) const { return call(arguments, folder_.path()); }
  /// A shell command, in which the program is $SIM.
  Called in_shell(const std::string& script) const {
    write("script", "SIM='" DSDPV1_SIM "'\n" + script + "\n");
    return in_folder("reasons prm_ident >/dev/null && sh ./script");
  }
  const app_test::Folder folder_;
};

TEST_F(Inputs, ScenarioIsAlsoFoundByItsNameWhereNoFileIsCalledSo) {
  EXPECT_EQ(in_folder("run two_slaves -q --set end=1ms --set expect=none --no-progress").status, 3);
  write("two_slaves", scenario_named("own"));
  EXPECT_THAT(in_folder("run two_slaves --no-progress").out, HasSubstr("\nown\n"));
}

TEST_F(Inputs, NameOfAScenarioSteersNeitherTerminalNorLogNorWave) {
  write("s.yaml", scenario_named(kNasty));
  const Called called = in_folder("run s.yaml --no-progress --log l.txt --wave w.vcd --result r.json");
  EXPECT_EQ(called.status, 1) << called.err;
  EXPECT_THAT(called.out, HasSubstr("\n" + kEscaped + "\n"));
  for (const std::string& text :
       {called.out, called.err, read(folder_.path() / "l.txt"), read(folder_.path() / "w.vcd")})
    EXPECT_FALSE(steers(text)) << text;
  EXPECT_EQ(nlohmann::json::parse(read(folder_.path() / "r.json")).at("scenario"), kNasty) << "JSON escapes by itself";
}

TEST_F(Inputs, NameOfAFileSteersNoTerminal) {
  const std::string name = kNasty.substr(0, kNasty.find('\n')) + "\nPASSED";
  write(name, scenario_named("x") + "  - {slave: none}\n");
  const Called wrong = in_folder("run '" + name + "'");
  EXPECT_EQ(wrong.status, 2);
  EXPECT_THAT(wrong.err, HasSubstr(R"(\x1B]0;x\x07\u009B2J\x7F\u202E\nPASSED:)"));
  EXPECT_EQ(std::count(wrong.err.begin(), wrong.err.end(), '\n'), 1) << wrong.err;
  EXPECT_FALSE(steers(wrong.err));
  write(name, scenario_named("x"));
  const Called not_met = in_folder("run --no-progress '" + name + "'");
  EXPECT_THAT(not_met.out, HasSubstr(R"(NOT MET  \x1B]0;x\x07\u009B2J\x7F\u202E\nPASSED:)"));
  EXPECT_FALSE(steers(not_met.out));
}

TEST_F(Inputs, TextsOfAGsdFileSteerNoTerminal) {
  std::string gsd = read(DSDPV1_SOURCE_DIR "/scenarios/dsdpv1.gsd");
  const std::string vendor = "Vendor_Name";
  const std::size_t line = gsd.find(vendor), end = gsd.find('\n', line);
  ASSERT_NE(line, std::string::npos);
  gsd.replace(line, end - line,
              "Vendor_Name = \"a\xC2\x9B"
              "2J\u202E\tü\"");
  write("x.gsd", gsd);
  const Called called = in_folder("gsd x.gsd");
  EXPECT_EQ(called.status, 0) << called.err;
  EXPECT_THAT(called.out, HasSubstr(R"(a\u009B2J\u202E\tü)"));
  EXPECT_FALSE(steers(called.out));
}

TEST_F(Inputs, PipesAreReadLikeFiles) {
  write("s.yaml", scenario_named("through a pipe"));
  const Called run = in_shell("cat s.yaml | \"$SIM\" run /dev/stdin --no-progress");
  EXPECT_EQ(run.status, 1);
  EXPECT_THAT(run.out, HasSubstr("through a pipe"));
  const Called gsd = in_shell("mkfifo g; cat '" DSDPV1_SOURCE_DIR "/scenarios/dsdpv1.gsd' >g & \"$SIM\" gsd g");
  EXPECT_EQ(gsd.status, 0) << gsd.err;
  EXPECT_THAT(gsd.out, HasSubstr("Ident_Number"));
  const Called decode = in_shell("mkfifo d; echo E5 >d & \"$SIM\" decode d");
  EXPECT_EQ(decode.status, 0) << decode.err;
}

TEST_F(Inputs, OneThatComesThroughADescriptorIsNotReplaced) {
  write("s.yaml", scenario_named("x"));
  const Called called = in_shell("\"$SIM\" run /dev/stdin --log s.yaml <s.yaml");
  EXPECT_EQ(called.status, 2);
  EXPECT_EQ(called.err, "dsdpv1-sim run: --log would replace the scenario, s.yaml, expected a separate file\n");
  EXPECT_EQ(read(folder_.path() / "s.yaml"), scenario_named("x"));
}

// Both limits of the stack, as `ulimit -s` sets them.
TEST_F(Inputs, StackThatIsTooSmallIsOneLine) {
  write("s.yaml", scenario_named("x"));
  for (const char* arguments : {"run s.yaml", "reasons", "gsd x.gsd", "decode"}) {
    const Called called = in_shell(std::string("ulimit -s 128; exec \"$SIM\" ") + arguments);
    EXPECT_EQ(called.status, 2) << arguments;
    EXPECT_EQ(called.err, "dsdpv1-sim: the stack is limited to 128 KB, expected 512 KB or more\n");
    EXPECT_EQ(called.out, "");
  }
}

TEST_F(Inputs, StackThatMayGrowGrows) {
  write("s.yaml", scenario_named("x"));
  const Called called = in_shell("ulimit -S -s 128; exec \"$SIM\" run s.yaml --no-progress");
  EXPECT_EQ(called.status, 1) << called.err;
  EXPECT_THAT(called.out, HasSubstr("FAILED"));
}

}  // namespace
}  // namespace dsdpv1
