// Times and texts of reports.
#include <gtest/gtest.h>

#include "bus/time_text.hpp"
#include "io/waves/wave_writer.hpp"
#include "tb/bench/conditions.hpp"
#include "tb/bench/run_log.hpp"
#include "tb/report/progress.hpp"
#include "tb/report/summary.hpp"
#include "tb/report/text_table.hpp"

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
  EXPECT_NE(text.find("  refused by  reason     times     first      last  what, the first time\n"), std::string::npos)
      << text;
  EXPECT_NE(text.find("  demo        PRM_IDENT      3  2.000 us  5.000 us  Prm_Fault: ident 1234\n"), std::string::npos)
      << text;
}

TEST(Summary, HasEqualViolationsInOneRow) {
  tb::Repetitions repetitions;
  const auto of_cell = [&repetitions](const char* cell) -> tb::Repeated& {
    return repetitions.entry({0, "demo", "HOST_NOT_OWNER", profibus::Severity::kViolation, "", cell});
  };
  for (tb::Tick at = 1; at <= 6000; ++at)
    of_cell("B31A").add(
        at * bus::kTicksPerUs, [] { return "B31A is accessed"; });
  of_cell("B31B").add(7 * bus::kTicksPerUs, [] { return "B31B is accessed"; });
  tb::RunResult result;
  result.violated = repetitions.list();
  const std::string text = tb::summary(result);
  EXPECT_NE(text.find("  demo         HOST_NOT_OWNER (2 places)   6001  1.000 us  6.000 ms  B31A is accessed\n"),
            std::string::npos)
      << text;
}

TEST(Summary, SaysWhichOfEqualViolationsAreAllowed) {
  tb::RunResult result;
  result.violated = {{"demo", "HOST_TS", "B006", "too short", 12, 24, 3, true},
                     {"demo", "HOST_TS", "B007", "too short", 36, 48, 2, false},
                     {"other", "HOST_TS", "B006", "too short", 60, 60, 1, true}};
  const std::string text = tb::summary(result);
  EXPECT_NE(text.find("HOST_TS (2 places)  5, 3 allowed  1.000 ns  4.000 ns  too short\n"), std::string::npos) << text;
  EXPECT_NE(text.find("HOST_TS (B006)      1 allowed     5.000 ns  5.000 ns  too short\n"), std::string::npos) << text;
}

/// A run of one slave with two checks: one is kept with a margin, the other violated this many times.
struct CheckedRun {
  explicit CheckedRun(std::uint64_t violations) {
    result.slaves.resize(1);
    result.slaves.front().name = "demo";
    result.checks.resize(2);
    for (tb::CheckResult& each : result.checks) each.slave = "demo";
    result.checks[0].rule = &kept;
    result.checks[1].rule = &violated;
    result.checks[0].record.count = result.checks[1].record.count = 7;
    result.checks[0].record.worst_margin = 17;
    result.checks[0].record.at = 63280 * bus::kTicksPerNs;
    result.checks[1].record.violations = violations;
  }
  checks::Rule kept{}, violated{};
  tb::RunResult result;
};

TEST(Summary, HasOneLineWhenAllChecksAreKept) {
  CheckedRun run(0);
  run.kept.id = "HOLD";
  run.violated.id = "SETUP";
  const std::string text = tb::summary(run.result);
  EXPECT_NE(text.find("  checks         all 2 kept, HOLD by only 1.417 ns at 63.280 us\n"), std::string::npos) << text;
  EXPECT_EQ(text.find("SETUP"), std::string::npos) << text;
  EXPECT_NE(tb::summary(run.result, tb::CheckRows::kAll).find("  SETUP      7         0        0         -"),
            std::string::npos);
}

TEST(Summary, HasARowForEachCheckThatIsViolated) {
  CheckedRun run(3);
  run.kept.id = "HOLD";
  run.violated.id = "SETUP";
  const std::string text = tb::summary(run.result);
  EXPECT_NE(text.find("  checks         1 of 2 kept\n"), std::string::npos) << text;
  EXPECT_NE(text.find("  SETUP      7         3        0  -"), std::string::npos) << text;
  EXPECT_EQ(text.find("  HOLD  "), std::string::npos) << text;
}

TEST(Summary, SaysHowMuchSlowerOrFasterThanRealTimeItWas) {
  tb::RunResult result;
  result.simulated = bus::kTicksPerSecond;
  result.wall_s = 20;
  EXPECT_NE(tb::summary(result).find("1.000 s in 20.00 s: 20 times slower than real time"), std::string::npos);
  result.wall_s = 0.4;
  EXPECT_NE(tb::summary(result).find("1.000 s in 0.40 s: 2.5 times faster than real time"), std::string::npos);
}

TEST(Summary, WrapsItsSentencesToTheTerminal) {
  tb::RunResult result;
  result.engine = "rtl";
  result.view = "pins";
  const tb::TableWidth narrow(50);
  EXPECT_NE(tb::summary(result).find("0.000 ns in 0.00 s (engine rtl,\n                 view pins)\n"),
            std::string::npos)
      << tb::summary(result);
}

TEST(Summary, NamesEngineAndViewThatAreNotTheUsualOnes) {
  tb::RunResult result;
  result.engine = "skip";
  result.view = "pins";
  EXPECT_EQ(tb::summary(result).find("engine"), std::string::npos);
  result.view = "tlm";
  EXPECT_NE(tb::summary(result).find("0.000 ns in 0.00 s (engine skip, view tlm)\n"), std::string::npos);
}

TEST(Summary, PutsStatesAndTimesOfSlavesIntoTwoTablesWhereOneIsTooWide) {
  tb::RunResult result;
  result.slaves.resize(2);
  result.slaves[0].name = "one";
  result.slaves[1].name = "other";
  const std::string whole = "TSDR / bit times  chip waited", states = "  slave  address  DP state",
                    times = "  slave  chip waited";
  EXPECT_NE(tb::summary(result).find(whole), std::string::npos);
  const tb::TableWidth narrow(80);
  const std::string text = tb::summary(result);
  EXPECT_EQ(text.find(whole), std::string::npos);
  EXPECT_NE(text.find(states), std::string::npos) << text;
  EXPECT_NE(text.find(times), std::string::npos) << text;
}

TEST(Summary, OfAPassingRunIsShort) {
  tb::RunResult result;
  result.slaves.resize(1);
  result.expectations.resize(3);
  for (tb::ExpectationResult& each : result.expectations) each.passed = true;
  result.expectations[2].implied = true;
  const auto happens = [&result](const char* station, const char* text) {
    tb::Occurrence each;
    each.at = 1200;
    each.station = station;
    each.code = "DP_STATE";
    each.text = text;
    result.occurrences.push_back(each);
  };
  happens("a", "one");
  happens("a", "two");
  happens("b", "three");
  const std::string text = tb::summary(result);
  EXPECT_NE(text.find("  100.000 ns  a        one; two\n  100.000 ns  b        three\n"), std::string::npos) << text;
  EXPECT_EQ(text.find("longest hold"), std::string::npos) << text;
  EXPECT_NE(text.find("2 of 2 met; 1 of 1 slaves in data exchange to the end\n"), std::string::npos) << text;
  EXPECT_NE(tb::summary(result, tb::CheckRows::kAll).find("longest hold"), std::string::npos);
  result.expectations[2].passed = false;
  const std::string failed = tb::summary(result);
  EXPECT_NE(failed.find("longest hold"), std::string::npos);
  EXPECT_NE(failed.find("0 of 1 slaves of masters to the end\n"), std::string::npos) << failed;
}

TEST(ShortTime, HasTheUnitThatLeaves1To999) {
  EXPECT_EQ(bus::short_time(0), "0.000 ns");
  EXPECT_EQ(bus::short_time(17), "1.417 ns");
  EXPECT_EQ(bus::short_time(-17), "-1.417 ns");
  EXPECT_EQ(bus::short_time(bus::kTicksPerUs - 1), "999.917 ns");
  EXPECT_EQ(bus::short_time(bus::kTicksPerUs), "1.000 us");
  EXPECT_EQ(bus::short_time(bus::kTicksPerMs - 1), "1.000 ms") << "rounded to three digits it is one";
  EXPECT_EQ(bus::short_time(119'476'893'996), "9.956 s");
}

TEST(MomentText, IsExactToTheNanosecond) {
  EXPECT_EQ(bus::moment_text(0), "0.000 ns");
  EXPECT_EQ(bus::moment_text(63280 * bus::kTicksPerNs), "63.280 us");
  EXPECT_EQ(bus::moment_text(5'000'021 * bus::kTicksPerNs), "5.000021 ms");
  EXPECT_EQ(bus::moment_text(120 * bus::kTicksPerMs), "120.000 ms");
  EXPECT_EQ(bus::moment_text(7 * bus::kTicksPerSecond + bus::kTicksPerNs), "7.000000001 s");
  EXPECT_EQ(bus::moment_text(bus::kTicksPerSecond - 1), "1.000 s");
}

}  // namespace
}  // namespace dsdpv1
