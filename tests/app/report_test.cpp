// Times and texts of reports.
#include <gtest/gtest.h>

#include "io/waves/wave_writer.hpp"
#include "tb/bench/conditions.hpp"
#include "tb/bench/run_log.hpp"
#include "tb/report/progress.hpp"
#include "tb/report/summary.hpp"

namespace dsdpv1 {
namespace {

TEST(Nanoseconds, AreRoundedOnceFromTheTick) {
  EXPECT_EQ(tb::nanoseconds(0), "0.000");
  EXPECT_EQ(tb::nanoseconds(250), "20.833");
  EXPECT_EQ(tb::nanoseconds(11), "0.917");
  EXPECT_EQ(tb::nanoseconds(bus::kTicksPerSecond), "1000000000.000");
}

TEST(Expectation, IsDescribedInWords) {
  tb::scenario::Expectation expectation;
  expectation.slave.text = "demo";
  expectation.dp_state = profibus::DpState::kDataExch;
  expectation.data_exchanges = 10;
  expectation.by = 9 * bus::kTicksPerMs;
  EXPECT_EQ(tb::describe(expectation), "demo: dp_state DATA_EXCH, data_exchanges >= 10 by 9ms");
}

TEST(Progress, ShowsPartFactorAndRest) {
  EXPECT_EQ(tb::progress_text(60 * bus::kTicksPerMs, 120 * bus::kTicksPerMs, 2.0),
            "[###############               ]  50 %  60.0 of 120.0 ms  0.03 x real time  2 s left");
}

TEST(Summary, NamesWhatIsNotMet) {
  tb::RunResult result;
  result.scenario = "x";
  result.file = "x.yaml";
  result.expectations.push_back({"demo: baud 12M at the end", 7, false, "baud searching"});
  const std::string text = tb::summary(result);
  EXPECT_NE(text.find("NOT MET  x.yaml:7: demo: baud 12M at the end; seen: baud searching\n"), std::string::npos)
      << text;
  EXPECT_NE(text.find("\nFAILED: 1 expectation not met\n"), std::string::npos);
}

TEST(Summary, ListsWhatWasRefused) {
  tb::RunResult result;
  EXPECT_EQ(tb::summary(result).find("refused"), std::string::npos);
  result.refused.push_back(
      {"demo", "PRM_IDENT", "", "Prm_Fault: ident 1234", 2 * bus::kTicksPerUs, 5 * bus::kTicksPerUs, 3, false});
  const std::string text = tb::summary(result);
  EXPECT_NE(text.find("  refused by  reason     times  first / us  last / us  what, the first time\n"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("  demo        PRM_IDENT  3      2.000       5.000      Prm_Fault: ident 1234\n"),
            std::string::npos)
      << text;
}

TEST(Summary, HasEqualViolationsInOneRow) {
  tb::Repetitions repetitions;
  for (tb::Tick at = 1; at <= 6000; ++at)
    repetitions.count(
        {at * bus::kTicksPerUs, "demo", "HOST_NOT_OWNER", profibus::Severity::kViolation, "", "B31A"},
        [] { return "B31A is accessed"; });
  repetitions.count({7 * bus::kTicksPerUs, "demo", "HOST_NOT_OWNER", profibus::Severity::kViolation, "", "B31B"},
                    [] { return "B31B is accessed"; });
  tb::RunResult result;
  result.violated = repetitions.list();
  const std::string text = tb::summary(result);
  EXPECT_NE(text.find("  demo         HOST_NOT_OWNER (B31A)  6000   1.000       6000.000   B31A is accessed\n"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("  demo         HOST_NOT_OWNER (B31B)  1      7.000       7.000      B31B is accessed\n"),
            std::string::npos)
      << text;
}

}  // namespace
}  // namespace dsdpv1
