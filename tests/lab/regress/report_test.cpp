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
  return report;
}

TEST(RegressReport, TsvHasALineARunWithItsFields) {
  const std::string folder = "runs/" + made_up().runs()[1].file_name();
  EXPECT_EQ(tsv(made_up()),
            "verdict\tscenario\tengine\tview\tseed\tsettings\texit\tseconds\treason\tfolder\n"
            "passed\ta.yaml\tskip\tpins\t\t\t0\t0.500\t\t\n"
            "failed\tb<i>.yaml\trtl\tpins\t4\tbaud=6M end=1ms\t1\t0.000\tnot met: a < b\\tc\t" +
                folder + "\n");
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
