// TSV, JSON, JUnit and the page, of made-up runs.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <regex>

#include "lab/regress/page.hpp"
#include "lab/regress/tables.hpp"

namespace dsdpv1 {
namespace {

using tb::regress::Outcome;
using tb::regress::Report;
using tb::regress::Verdict;
using testing::HasSubstr;
using testing::Not;

Report made_up() {
  Report report;
  report.description.plan.left_out = 3;
  report.description.plan.runs = {{"a.yaml", "skip", "pins", "", {}},
                                  {"b<i>.yaml", "rtl", "pins", "4", {"baud=6M", "end=1ms"}}};
  Outcome good, bad;
  good.seconds = 0.5;
  bad.verdict = Verdict::kFailed;
  bad.exit = 1;
  bad.reason = "not met: a < b\tc";
  bad.log = "line 1\n\x1B[31m</pre><script>\n";
  bad.files = {"run.log"};
  report.outcomes = {good, bad};
  report.folder = "night";
  return report;
}

TEST(RegressReport, TsvHasALineARunWithItsFields) {
  const std::string folder = "runs/" + made_up().runs()[1].file_name();
  EXPECT_EQ(tsv(made_up()),
            "verdict\tscenario\tengine\tview\tseed\tsettings\texit\tseconds\treason\tfolder\tmode\n"
            "passed\ta.yaml\tskip\tpins\t\t\t0\t0.500\t\t\t\n"
            "failed\tb<i>.yaml\trtl\tpins\t4\tbaud=6M end=1ms\t1\t0.000\tnot met: a < b\\tc\t" +
                folder + "\t\n");
}

/// With a random case at a port, and a scenario that is only listed.
Report of_rtl() {
  Report report = made_up();
  report.description.rtl = {"rtl", "chip", "pins.yaml", "build", "dsdpv1"};
  report.description.rtl.tolerance["INTR0"] = 1;
  report.description.rtl.verilator = "Verilator 5.006";
  report.description.plan.runs = {{"random", "random", "pins", "7", {}, {}, "spi"},
                                  {"c.yaml", "cosim", "pins", "", {}, {}, "", "chip.key is not told"}};
  report.outcomes = {Outcome(), tb::regress::not_run("chip.key is not told")};
  return report;
}

TEST(RegressReport, PortOfRandomCasesIsNamedEverywhere) {
  EXPECT_THAT(tsv(of_rtl()), HasSubstr("\npassed\trandom\trandom\tpins\t7\t\t0\t0.000\t\t\tspi\n"));
  EXPECT_EQ(nlohmann::json::parse(tb::regress::json(of_rtl()))["runs"][0]["mode"], "spi");
  EXPECT_THAT(junit(of_rtl()), HasSubstr("name=\"random pins spi seed=7\""));
  EXPECT_THAT(page(of_rtl()), HasSubstr("<td>spi seed=7</td>"));
}

TEST(RegressReport, WhatIsNotRunIsNoFailure) {
  EXPECT_TRUE(of_rtl().passed());
  EXPECT_THAT(summary(of_rtl()), HasSubstr("1 of 1 runs passed; 1 are not run"));
  EXPECT_THAT(tsv(of_rtl()), HasSubstr("\nnot_run\tc.yaml\tcosim\t"));
  EXPECT_THAT(junit(of_rtl()), HasSubstr("<skipped message=\"chip.key is not told\""));
  EXPECT_THAT(junit(of_rtl()), HasSubstr("failures=\"0\""));
  Report nothing = of_rtl();
  nothing.outcomes[0] = nothing.outcomes[1];
  EXPECT_FALSE(nothing.passed()) << "nothing was run";
  EXPECT_TRUE(Report().passed()) << "a shard without a run";
}

TEST(RegressReport, SaysWhatTheRtlWas) {
  const auto json = nlohmann::json::parse(tb::regress::json(of_rtl()));
  EXPECT_EQ(json["rtl"]["tolerance"]["INTR0"], 1);
  EXPECT_EQ(json["versions"]["verilator"], "Verilator 5.006");
  EXPECT_THAT(page(of_rtl()), HasSubstr("chip of rtl as a dsdpv1, pins pins.yaml, INTR0 within 1 cycles"));
}

TEST(RegressReport, FailureIsRepeatedByTheScriptInItsFolder) {
  Report report = made_up();
  EXPECT_EQ(report.again(report.runs()[1], report.outcomes[1]),
            "dsdpv1-sim run 'b<i>.yaml' --engine rtl --view pins --seed 4 --set baud=6M --set end=1ms");
  report.outcomes[1].files = {tb::regress::kAgain};
  EXPECT_EQ(report.again(report.runs()[1], report.outcomes[1]),
            "sh night/runs/" + report.runs()[1].file_name() + "/again.sh");
}

TEST(RegressReport, JsonHasCountsAndRuns) {
  const nlohmann::json json = nlohmann::json::parse(tb::regress::json(made_up()));
  EXPECT_EQ(json["passed"], false);
  EXPECT_EQ(json["left_out"], 3);
  EXPECT_EQ(json["counts"]["passed"], 1);
  EXPECT_EQ(json["counts"]["failed"], 1);
  EXPECT_EQ(json["counts"]["hung"], 0);
  EXPECT_EQ(json["runs"][1]["settings"][1], "end=1ms");
}

TEST(RegressReport, SummaryCountsWhatIsThere) {
  EXPECT_EQ(summary(made_up()), "1 of 2 runs passed, 1 failed; 3 combinations that cannot be are left out");
}

TEST(RegressReport, JunitHasASuiteAScenarioAndTheReasonAsMessage) {
  const std::string xml = junit(made_up());
  EXPECT_THAT(xml, HasSubstr("<testsuite name=\"a.yaml\" tests=\"1\" failures=\"0\""));
  EXPECT_THAT(xml, HasSubstr("name=\"rtl pins seed=4 baud=6M end=1ms\""));
  EXPECT_THAT(xml, HasSubstr("message=\"failed: not met: a &lt; b\\tc\""));
}

TEST(RegressReport, PageNeedsNothingFromOutside) {
  const std::string html = page(made_up());
  EXPECT_FALSE(std::regex_search(html, std::regex("(https?:)?//[a-z]|src=|@import|url\\(")));
  const std::string link = "href=\"runs/" + made_up().runs()[1].file_name() + "/run.log\"";
  EXPECT_THAT(html, HasSubstr(link));
}

TEST(RegressReport, PageShowsTextsAsTexts) {
  const std::string html = page(made_up());
  EXPECT_THAT(html, HasSubstr("b&lt;i&gt;.yaml"));
  EXPECT_THAT(html, HasSubstr("\\x1B[31m&lt;/pre&gt;&lt;script&gt;"));
  EXPECT_THAT(html, Not(HasSubstr("b<i>")));
}

}  // namespace
}  // namespace dsdpv1
