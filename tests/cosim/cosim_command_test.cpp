// RTL of a user's own: the worked example of docs/cosim.md, and what is said when it cannot be built.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "tests/app/program.hpp"

namespace {

using app_test::call;
using testing::HasSubstr;

constexpr const char* kSource = DSDPV1_SOURCE_DIR;

std::string example(const app_test::Folder& folder, const std::string& pins) {
  return "cosim --rtl examples/own_rtl --top board_chip --pins " + pins + " --build '" + folder.file("build") +
         "' --difference '" + folder.file("both.vcd") + "' scenarios/two_slaves.yaml";
}

/// examples/own_rtl/pins.yaml with other lines at its end, in the folder of the test.
std::string pins_with(const app_test::Folder& folder, const std::string& lines) {
  std::ofstream(folder.file("pins.yaml"))
      << app_test::read(kSource + std::string("/examples/own_rtl/pins.yaml")) << lines;
  return "'" + folder.file("pins.yaml") + "'";
}

TEST(RtlRandom, ProgressIsOneLineWrittenOverItself) {
  const app_test::Folder folder;
  const app_test::Called called =
      call("reasons prm_ident >/dev/null && script -qec \"'" DSDPV1_SIM "' rtl-random --cycles 20000\" /dev/null",
           folder.path());
  EXPECT_EQ(called.status, 0) << called.out << called.err;
  EXPECT_THAT(called.out, testing::ContainsRegex("\r[0-9]+ cases, "));
  EXPECT_THAT(called.out, testing::Not(HasSubstr("\\r")));
}

TEST(Cosim, ExampleWithoutAResetValueHasAnUnknownPin) {
  const app_test::Folder folder;
  const app_test::Called called = call(example(folder, "examples/own_rtl/pins.yaml"), kSource);
  EXPECT_EQ(called.status, 1) << called.err;
  EXPECT_THAT(called.out, HasSubstr("pin INTR0: model 1, RTL X"));
  EXPECT_THAT(called.out, HasSubstr("first difference  cycle 0 "));
}

TEST(Cosim, ExampleWithAResetValueHasTooShortAPulse) {
  const app_test::Folder folder;
  const app_test::Called called = call(example(folder, pins_with(folder, "parameters: {RESET_VALUE: 1}\n")), kSource);
  EXPECT_EQ(called.status, 1) << called.err;
  EXPECT_THAT(called.out, HasSubstr("pin INTR0: model no such change within the tolerance, RTL 1"));
  EXPECT_THAT(app_test::read(folder.file("both.vcd")), HasSubstr("module rtl"));
}

TEST(Cosim, MendedExampleIsTheSameWithinItsTolerance) {
  const app_test::Folder folder;
  const app_test::Called called =
      call(example(folder, pins_with(folder, "parameters: {RESET_VALUE: 1, PULSE: 64}\n")), kSource);
  EXPECT_EQ(called.status, 0) << called.out << called.err;
  EXPECT_THAT(called.out, HasSubstr("of model and RTL are the same"));
}

TEST(Cosim, RtlThatVerilatorRefusesIsNamedWithItsLine) {
  const app_test::Folder folder;
  std::ofstream(folder.file("chip.sv")) << "module chip (input logic clk_i);\n  assign = clk_i;\nendmodule\n";
  const app_test::Called called =
      call("cosim --rtl . --top chip '" + std::string(kSource) + "/scenarios/two_slaves.yaml'", folder.path());
  EXPECT_EQ(called.status, 2);
  EXPECT_EQ(called.out, "");
  EXPECT_THAT(called.err, HasSubstr("chip.sv:2:"));
  EXPECT_THAT(called.err, HasSubstr("syntax error"));
  EXPECT_EQ(std::count(called.err.begin(), called.err.end(), '\n'), 1);
}

TEST(Cosim, PortThatTheTopDoesNotHaveIsNamed) {
  const app_test::Folder folder;
  std::ofstream(folder.file("chip.sv")) << "module chip (input logic clk_i);\nendmodule\n";
  const app_test::Called called =
      call("cosim --rtl . --top chip '" + std::string(kSource) + "/scenarios/two_slaves.yaml'", folder.path());
  EXPECT_EQ(called.status, 2);
  EXPECT_THAT(called.err, HasSubstr("chip has no port"));
  EXPECT_THAT(called.err, HasSubstr("--pins"));
}

TEST(Cosim, FolderWithoutRtlIsNamed) {
  const app_test::Folder folder;
  const app_test::Called called =
      call("cosim --rtl . --top chip '" + std::string(kSource) + "/scenarios/two_slaves.yaml'", folder.path());
  EXPECT_EQ(called.status, 2);
  EXPECT_EQ(called.err, ".: holds no RTL, allowed are .sv and .v files\n");
}

}  // namespace
