// Coverage from Verilator's records, as a tracefile of lcov, as tables.
#include "lab/coverage/reached.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "io/input/input_error.hpp"
#include "lab/coverage/tables.hpp"

namespace dsdpv1 {
namespace {

using tb::coverage::Files;
using tb::coverage::Way;
using testing::HasSubstr;

/// A record as Verilator writes it.
std::string record(const std::string& page, int line, int column, const std::string& name, int count,
                   const std::string& lines = "") {
  std::string text = "C '\1f\2/rtl/a.sv\1l\2" + std::to_string(line) + "\1n\2" + std::to_string(column) + "\1page\2v_" +
                     page + "/a\1o\2" + name;
  if (!lines.empty()) text += "\1S\2" + lines;
  return text + "\1h\2TOP.a' " + std::to_string(count) + "\n";
}

Files made_up() {
  return tb::coverage::of_verilator("# SystemC::Coverage-3\n" + record("line", 2, 3, "block", 7, "2-3,6") +
                                        record("branch", 3, 5, "if", 0, "4") + record("branch", 3, 6, "else", 7, "6") +
                                        record("line", 9, 1, "case", 0, "9") + record("toggle", 1, 9, "q[0]", 3) +
                                        record("toggle", 1, 9, "q[1]", 0) + record("toggle", 1, 9, "q[2]", 0) +
                                        record("toggle", 1, 9, "q[4]", 0) + record("toggle", 8, 9, "q[0]", 1),
                                    "records");
}

TEST(Reached, LinesBranchesAndTogglesOfVerilatorAreApart) {
  const Files files = made_up();
  ASSERT_EQ(files.size(), 1U);
  const auto& file = files.at("/rtl/a.sv");
  EXPECT_EQ(file.lines, (std::map<int, std::uint64_t>{{2, 7}, {3, 7}, {4, 0}, {6, 14}, {9, 0}}));
  EXPECT_EQ(file.branches.at({3, 5, Way::kIf}), 0U);
  EXPECT_EQ(file.branches.at({3, 6, Way::kElse}), 7U);
  EXPECT_EQ(file.branches.at({9, 1, Way::kCase}), 0U);
  EXPECT_EQ(file.branches.size(), 3U);
  EXPECT_EQ(file.points.at({1, "q[0]"}), 3U);
  EXPECT_EQ(file.points.size(), 5U);
}

TEST(Reached, InstancesOfAModuleAreOne) {
  const Files files = tb::coverage::of_verilator(record("toggle", 1, 9, "q", 0) + record("toggle", 1, 9, "q", 2), "r");
  EXPECT_EQ(files.at("/rtl/a.sv").points.at({1, "q"}), 2U);
}

/// Verilator from 5.038 on.
TEST(Reached, DirectionsOfABitAreOne) {
  const Files files = tb::coverage::of_verilator(
      record("toggle", 1, 9, "q[0]:0->1", 2) + record("toggle", 1, 9, "q[0]:1->0", 1) + record("toggle", 1, 9, "r", 0),
      "r");
  EXPECT_EQ(files.at("/rtl/a.sv").points,
            (std::map<std::pair<int, std::string>, std::uint64_t>{{{1, "q[0]"}, 3}, {{1, "r"}, 0}}));
}

TEST(Reached, SumHasThePointsOfBoth) {
  Files sum = made_up();
  add(sum, made_up());
  add(sum, {{"/rtl/b.sv", {{{1, 1}}, {}, {}}}});
  EXPECT_EQ(sum.at("/rtl/a.sv").lines.at(6), 28U);
  EXPECT_EQ(sum.at("/rtl/a.sv").points.at({1, "q[1]"}), 0U);
  EXPECT_EQ(sum.at("/rtl/b.sv").lines.at(1), 1U);
}

TEST(Reached, TracefileHasAllOfIt) {
  const std::string text = lcov(made_up());
  for (const char* line : {"SF:/rtl/a.sv\n", "FN:1,q[1]\n", "FN:8,q[0]@8\n", "FNDA:3,q[0]\n", "FNF:5\nFNH:2\n",
                           "BRDA:3,5,0,0\nBRDA:3,6,1,7\n", "BRF:3\nBRH:1\n", "DA:6,14\n", "LF:5\nLH:3\n"})
    EXPECT_THAT(text, HasSubstr(line));
  EXPECT_EQ(lcov(tb::coverage::of_lcov(text, "t")), text);
  EXPECT_EQ(tb::coverage::of_lcov(text, "t").at("/rtl/a.sv").points, made_up().at("/rtl/a.sv").points);
}

std::string error_of(Files (*read)(const std::string&, const std::string&), const std::string& text) {
  try {
    read(text, "x");
  } catch (const tb::InputError& error) {
    return error.what();
  }
  return "none";
}

TEST(Reached, OtherTextIsRefusedWithItsLine) {
  using tb::coverage::of_lcov;
  using tb::coverage::of_verilator;
  for (const char* text : {"#\nnonsense\n", "#\nC '' 1\n", "#\nC 'abc' x\n",
                           "#\nC '\1f\2a\1l\2"
                           "1\1page\2v_line/a' -1\n"})
    EXPECT_THAT(error_of(of_verilator, text), HasSubstr("x:2: expected a record of coverage")) << text;
  for (const char* text : {"TN:\nDA:1,1\n", "SF:a\nDA:1\n", "SF:a\nDA:b,1\n", "SF:a\nFNDA:1,q\n",
                           "SF:a\nBRDA:1,1,9,1\n", "SF:a\nBRDA:1,1\n"})
    EXPECT_THAT(error_of(of_lcov, text), HasSubstr("x:2: expected a tracefile")) << text;
  EXPECT_THAT(error_of(of_lcov, "SF:a\nend_of_record\nDA:1,1\n"), HasSubstr("x:3: expected a tracefile"));
}

TEST(Reached, TableSumsFilesAndListsWhatIsMissing) {
  EXPECT_EQ(tsv(made_up()),
            "file\tlines reached\tlines\tbranches reached\tbranches\ttoggles reached\ttoggles\n"
            "/rtl/a.sv\t3\t5\t1\t3\t2\t5\nall\t3\t5\t1\t3\t2\t5\n");
  EXPECT_EQ(missing_tsv(made_up()),
            "place\tnot reached\n/rtl/a.sv:1\ttoggle q[4, 2:1]\n/rtl/a.sv:3\tbranch if in column 5\n"
            "/rtl/a.sv:4\tline\n/rtl/a.sv:9\tline\n/rtl/a.sv:9\tbranch case in column 1\n");
  EXPECT_EQ(summary(made_up()), "3 of 5 lines, 1 of 3 branches, 2 of 5 toggles");
  EXPECT_THAT(html(made_up()), HasSubstr("<td>3 of 5</td><td>60.0 %</td>"));
  EXPECT_THAT(html(made_up()), HasSubstr("/rtl/a.sv:1: toggle q[4, 2:1]\n"));
  EXPECT_EQ(tb::coverage::summary({}), "0 of 0 lines, 0 of 0 branches, 0 of 0 toggles");
}

TEST(Reached, FilesBelowThisFolderAreNamedFromHere) {
  const std::string here = std::filesystem::current_path() / "rtl/b.sv";
  EXPECT_THAT(tb::coverage::tsv({{here, {{{1, 1}}, {}, {}}}}), HasSubstr("\nrtl/b.sv\t1\t1\t"));
}

TEST(Reached, IsAHundredPerCentOnlyWhereNothingIsMissing) {
  Files files;
  for (int line = 1; line <= 10000; ++line) files["a.sv"].lines[line] = line == 1 ? 0 : 1;
  EXPECT_THAT(html(files), HasSubstr("<td>9999 of 10000</td><td>99.9 %</td>"));
  files["a.sv"].lines[1] = 1;
  EXPECT_THAT(html(files), HasSubstr("<td>10000 of 10000</td><td>100.0 %</td>"));
}

}  // namespace
}  // namespace dsdpv1
