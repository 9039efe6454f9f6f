// Coverage of a user's RTL: by each command, of each kind of chip, and in campaigns that resume.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "lab/coverage/reached.hpp"
#include "tests/app/program.hpp"

namespace dsdpv1 {
namespace {

using app_test::call;
using app_test::Called;
using testing::HasSubstr;
using testing::Not;

/// The pins as during RESET, which differ from the chip's before long; its counter stops at 7.
constexpr const char* kPorts = R"(  input logic reset_i, clk_i, pbrxd_i, r_req_i, r_sta_i, csr_i, rd_i, wr_i,
  input logic [10:0] a_i, input logic [7:0] d_i,
  output logic pbtxd_o, pbrts_o, l_req_o, l_sta_o, d_oe_o, intr0_o, pbf_o, br_o, ready_o, output logic [7:0] d_o)";
constexpr const char* kRsuPorts = R"(,
  input logic [1:0] mode_i, adr_i, input logic [2:0] ubr_i, uiv_i, input logic xss_i, sck_i, mosi_i, rxd_i,
  output logic miso_o, miso_oe_o, txd_o)";
constexpr const char* kRsuOutputs = "  assign miso_o = 0, miso_oe_o = 0, txd_o = 1;\n";
constexpr const char* kBody = R"(
  logic [3:0] count_q;
  /* verilator coverage_off */
  logic hidden_q;
  always_ff @(posedge clk_i) if (csr_i) hidden_q <= 1'b0; else hidden_q <= a_i[0];
  /* verilator coverage_on */
  always_ff @(posedge clk_i)
    if (!reset_i) begin
      count_q <= 4'd0;
    end else if (count_q == 4'd9) begin
      count_q <= 4'd0;  // never
    end else if (count_q != 4'd7) begin
      count_q <= count_q + 4'd1;
    end
  assign pbtxd_o = 1'b1, pbrts_o = 1'b0, l_req_o = 1'b0, l_sta_o = 1'b0, d_oe_o = 1'b0, d_o = {8{hidden_q}};
  assign intr0_o = 1'b1, pbf_o = 1'b1, br_o = 1'b0, ready_o = 1'b0;
)";

class RtlCoverage : public testing::Test {
 protected:
  RtlCoverage() {
    std::filesystem::create_directory(folder_.file("rtl"));
    write("");
  }
  /// `more`: statements of the module.
  void write(const std::string& more) const {
    const std::string plain = std::string("module tiny (\n") + kPorts,
                      rsu = std::string("module tiny_rsu (\n") + kPorts;
    std::ofstream(folder_.file("rtl/tiny.sv")) << plain << ");" << kBody << more << "endmodule\n";
    std::ofstream(folder_.file("rtl/tiny_rsu.sv")) << rsu << kRsuPorts << ");" << kBody << kRsuOutputs << "endmodule\n";
  }
  Called with_rtl(const std::string& command, const std::string& top = "tiny") const {
    return call(command + " --rtl rtl --top " + top + " --build build_" + top, folder_.path());
  }
  tb::coverage::Reached reached(const std::string& file, const std::string& source = "tiny.sv") const {
    const auto files = tb::coverage::of_lcov(app_test::read(folder_.file(file)), file);
    const auto found = std::find_if(files.begin(), files.end(), [&](const auto& each) {
      return std::filesystem::path(each.first).filename() == source;
    });
    return found == files.end() ? tb::coverage::Reached() : found->second;
  }
  /// The line of tiny.sv that contains it.
  int line_of(const std::string& text) const {
    std::ifstream file(folder_.file("rtl/tiny.sv"));
    std::string line;
    for (int number = 1; std::getline(file, line); ++number)
      if (line.find(text) != std::string::npos) return number;
    return 0;
  }
  void expect_counted(const tb::coverage::Reached& counts, const std::string& by) const {
    ASSERT_FALSE(counts.lines.empty()) << by;
    EXPECT_GT(counts.lines.at(line_of("count_q + 4'd1")), 0U) << by;
    EXPECT_EQ(counts.lines.at(line_of("// never")), 0U) << by;
    EXPECT_GT(counts.points.at({line_of("logic [3:0] count_q"), "count_q[0]"}), 0U) << by;
    EXPECT_EQ(counts.points.at({line_of("logic [3:0] count_q"), "count_q[3]"}), 0U) << by;
    EXPECT_EQ(counts.lines.count(line_of("hidden_q <= 1'b0")), 0U) << by;
    EXPECT_EQ(counts.points.count({line_of("logic hidden_q"), "hidden_q"}), 0U) << by;
  }

  app_test::Folder folder_;
};

const char* const kScenario = "'" DSDPV1_SOURCE_DIR "/scenarios/power_on_12m.yaml'";
constexpr const char* kStimuli = "'" DSDPV1_SOURCE_DIR "/tests/cosim/stimuli/";

TEST_F(RtlCoverage, EachCommandWritesATracefileAndItsExitCodeIsTheSame) {
  const struct {
    std::string name, command;
  } commands[] = {{"scenario", std::string("cosim ") + kScenario},
                  {"stimulus", std::string("cosim --replay ") + kStimuli + "dsdpv1/host_port.stimulus'"},
                  {"replay", std::string("rtl-random --replay ") + kStimuli + "dsdpv1/host_port.stimulus'"},
                  {"random", "rtl-random --cycles 1000"},
                  {"golden", "traces check power_on_12m --no-progress"}};
  for (const auto& each : commands) {
    const Called counted = with_rtl(each.command + " --coverage " + each.name + ".info");
    EXPECT_EQ(counted.status, 1) << each.name << counted.out << counted.err;
    expect_counted(reached(each.name + ".info"), each.name);
    EXPECT_EQ(with_rtl(each.command).status, 1) << each.name;
  }
}

TEST_F(RtlCoverage, OfEachKindAtEachPort) {
  for (const char* chip : {"dsdpv1", "dsdpv1_r"}) {
    with_rtl(std::string("rtl-random --cycles 1000 --coverage x.info --chip ") + chip);
    expect_counted(reached("x.info"), chip);
    std::filesystem::remove(folder_.file("x.info"));
  }
  for (const char* mode : {"parallel", "spi", "uart"}) {
    with_rtl(std::string("rtl-random --cycles 1000 --coverage x.info --chip dsdpv1_rsu --mode ") + mode, "tiny_rsu");
    EXPECT_FALSE(reached("x.info", "tiny_rsu.sv").lines.empty()) << mode;
    std::filesystem::remove(folder_.file("x.info"));
  }
}

TEST_F(RtlCoverage, RtlWithNothingToCountHasAnEmptyOne) {
  std::string body = kBody;
  body.erase(body.find("/* verilator coverage_on */"), std::string("/* verilator coverage_on */").size());
  std::ofstream(folder_.file("rtl/tiny.sv")) << "/* verilator coverage_off */\nmodule tiny (\n"
                                             << kPorts << ");" << body << "endmodule\n";
  const Called counted = with_rtl(std::string("cosim ") + kScenario + " --coverage x.info");
  EXPECT_EQ(counted.status, 1) << counted.err;
  EXPECT_THAT(app_test::read(folder_.file("x.info")), Not(HasSubstr("tiny.sv")));
}

TEST_F(RtlCoverage, NeedsRtlOfOnesOwnAndAFileOfItsOwn) {
  EXPECT_THAT(call("rtl-random --cycles 1 --coverage x.info", folder_.path()).err, HasSubstr("--rtl"));
  const Called twice = with_rtl("rtl-random --cycles 1 --result x --coverage x");
  EXPECT_EQ(twice.status, 2);
  EXPECT_THAT(twice.err, HasSubstr("--coverage"));
  EXPECT_EQ(with_rtl(std::string("cosim ") + kScenario + " --coverage none/x.info").status, 2);
}

/// verify-rtl of it.
class CountedCampaign : public RtlCoverage {
 protected:
  CountedCampaign() {
    std::ofstream(folder_.file("s.yaml")) << "name: s\nbaud: 12M\nend: 200us\n"
                                             "slaves: [{name: a, address: 5, init: {cfg: \"30\"}}]\n";
  }
  Called verify(const std::string& more) const {
    return with_rtl("verify-rtl s.yaml --only scenarios,random --cycles 1000 --no-progress --out v " + more);
  }
};

TEST_F(CountedCampaign, SumsItsRunsInTracefileTablesAndPage) {
  const Called plain = verify("");
  EXPECT_EQ(plain.status, 1) << plain.out << plain.err;
  EXPECT_FALSE(std::filesystem::exists(folder_.file("v/coverage.info")));
  const Called counted = verify("--coverage");
  EXPECT_EQ(counted.status, 1) << counted.out << counted.err;
  expect_counted(reached("v/coverage.info"), "sum");
  EXPECT_THAT(app_test::read(folder_.file("v/coverage.tsv")), HasSubstr("\nrtl/tiny.sv\t"));
  EXPECT_THAT(app_test::read(folder_.file("v/not_reached.tsv")),
              HasSubstr("\nrtl/tiny.sv:" + std::to_string(line_of("// never")) + "\tline\n"));
  EXPECT_THAT(app_test::read(folder_.file("v/index.html")), HasSubstr("Reached of the RTL"));
  EXPECT_THAT(counted.err, HasSubstr(" lines, "));
  EXPECT_THAT(counted.err, HasSubstr(" rulings with events or situations were exercised"));
}

TEST_F(CountedCampaign, NamesTheRulingsThatItsRunsExerciseBeforeTheDifference) {
  verify("");
  const std::string table = app_test::read(folder_.file("v/rulings.tsv"));
  EXPECT_THAT(table, HasSubstr("\nS26\tchip.md#s26\tnever\t0\t0\t0\t"));
  EXPECT_THAT(app_test::read(folder_.file("v/rulings.info")), HasSubstr("/docs/chip.md\nFN:"));
  EXPECT_THAT(app_test::read(folder_.file("v/index.html")), HasSubstr("<h2>Rulings: "));
}

TEST_F(CountedCampaign, KeepsTheCountsOfRunsThatItKeeps) {
  const Called first = verify("--coverage");
  const std::string sum = app_test::read(folder_.file("v/coverage.info"));
  const Called second = verify("--coverage");
  EXPECT_EQ(second.out, first.out) << "with its times: nothing has run again";
  EXPECT_EQ(app_test::read(folder_.file("v/coverage.info")), sum);
  const Called without = verify("");
  EXPECT_EQ(without.out, first.out) << "nor without counting";
  EXPECT_FALSE(std::filesystem::exists(folder_.file("v/coverage.info")));
  EXPECT_THAT(app_test::read(folder_.file("v/index.html")), Not(HasSubstr("Reached of the RTL")));
  for (const auto& entry : std::filesystem::directory_iterator(folder_.file("v/runs")))
    if (entry.path().extension() == ".info" && entry.path().filename().string().rfind("random", 0) == 0)
      std::filesystem::remove(entry.path());
  EXPECT_NE(verify("--coverage").out, first.out) << "a run without its counts is repeated";
  EXPECT_EQ(app_test::read(folder_.file("v/coverage.info")), sum);
}

TEST_F(CountedCampaign, OfChangedRtlHasNothingOfBefore) {
  verify("--coverage");
  write("  logic new_q;\n  always_ff @(posedge clk_i) new_q <= reset_i;\n");
  verify("--coverage");
  const auto counts = reached("v/coverage.info");
  EXPECT_GT(counts.points.at({line_of("logic new_q"), "new_q"}), 0U);
  expect_counted(counts, "changed");
}

}  // namespace
}  // namespace dsdpv1
