// The format of a trace: a written trace can be read again, other files are refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/input/input_error.hpp"
#include "tests/lab/traces/small.hpp"

namespace dsdpv1 {
namespace {

using tb::traces::Cursor;
using tb::traces::Trace;
using traces_test::Changes;

class Traces : public testing::Test {
 protected:
  std::vector<std::pair<tb::Tick, tb::Level>> read(const Trace& trace, const std::string& pin) const {
    std::vector<std::pair<tb::Tick, tb::Level>> changes;
    for (Cursor each = trace.cursor(traces_test::signal_of(scenario_, pin)); each.at() != bus::kNever; each.step())
      changes.emplace_back(each.at(), each.level());
    return changes;
  }
  tb::scenario::Scenario scenario_ = traces_test::small_scenario();
  Changes changes_ = {{"A", 0x7F, 0x7FF},
                      {"L_REQ", 250, 1},
                      {"D_OUT", 300, tb::kLevelX},
                      {"D_OUT", 300, 0xA5},
                      {"D_OUT", 90'000, tb::kLevelZ},
                      {"line", 100'000, 1},
                      {"L_REQ", 5'000'000'000, 0}};
};

TEST_F(Traces, HoldEveryChangeWithItsTickAndLevel) {
  const auto trace = traces_test::trace_of(scenario_, changes_);
  EXPECT_THAT(read(*trace, "D_OUT"),
              testing::ElementsAre(std::pair(0, 0), std::pair(300, -2), std::pair(300, 0xA5), std::pair(90'000, -1)));
  EXPECT_THAT(read(*trace, "A"), testing::ElementsAre(std::pair(0, 0), std::pair(0x7F, 0x7FF)));
  EXPECT_THAT(read(*trace, "L_REQ"),
              testing::ElementsAre(std::pair(0, 0), std::pair(250, 1), std::pair(5'000'000'000, 0)));
  EXPECT_THAT(read(*trace, "line"), testing::ElementsAre(std::pair(0, 0), std::pair(100'000, 1)));
  EXPECT_EQ(trace->changes(), changes_.size());
  EXPECT_EQ(trace->end(), traces_test::kEnd);
  EXPECT_EQ(trace->signals(), tb::traces::signals_of(scenario_));
}

// docs/traces.md describes these bytes.
TEST(TraceFormat, IsThatOfTheDocument) {
  tb::traces::TraceWriter writer(
      {{"io", "A", 11, tb::traces::Signal::Kind::kInput}, {"bus", "line", 1, tb::traces::Signal::Kind::kLine}});
  writer.change(1, 0, 1);
  writer.change(0, 0, tb::kLevelZ);
  writer.change(0, 300, 0x7F);
  writer.change(0, 301, tb::kLevelX);
  using namespace std::string_literals;
  EXPECT_EQ(writer.content(12'000),
            "golden trace 1\nend 12000\nsignal io A 11 input 3 4 4\nsignal bus line 1 line 1 1 1\ndata\n"
            "\0\xAC\x02\x01"
            "\0\x81\x01\x01"
            "\0\x03"s);
}

TEST_F(Traces, ThatAreCutOrForeignAreRefusedInOneLine) {
  const std::string content = traces_test::trace_of(scenario_, changes_)->content();
  const std::size_t data = content.find("data\n");
  std::vector<std::string> wrong = {"", "hello", "golden trace 2\n", content + "x"};
  for (const std::size_t size : {data + 20, data + 5, data, data / 2, std::size_t{20}, content.size() - 1})
    wrong.push_back(content.substr(0, size));
  for (const char* line :
       {"signal io A 11 input 0 1 1\n", "signal io A 11 both 1 1 1\n", "signal io A 16 input 1 1 1\n",
        "signal io A 0 input 1 1 1\n", "signal io A 11 input 2 1 1\n",
        "signal io A 11 input 1 99999999999999999999 1\n", "nothing\n"})
    wrong.push_back("golden trace 1\nend 5\n" + std::string(line) + "data\n\1\1");
  for (const std::string& each : wrong) {
    try {
      const Trace trace(each, "f.xz");
      ADD_FAILURE() << "taken: " << each;
    } catch (const tb::InputError& error) {
      EXPECT_THAT(error.what(), testing::StartsWith("f.xz: holds no trace, expected"));
    }
  }
}

/// With wrong bytes in a column, a reader stops at its end.
TEST_F(Traces, WithAnyByteDamagedAreReadToTheirEnd) {
  const std::string content = traces_test::trace_of(scenario_, changes_)->content();
  for (std::size_t i = content.find("data\n") + 5; i < content.size(); ++i) {
    std::string damaged = content;
    damaged[i] = static_cast<char>(damaged[i] ^ 0x80);
    const Trace trace(damaged, "f.xz");
    for (std::size_t signal = 0; signal < trace.signals().size(); ++signal) {
      std::uint64_t entries = 0;
      for (Cursor each = trace.cursor(signal); each.at() != bus::kNever; each.step()) ++entries;
      EXPECT_LE(entries, trace.changes(signal) + 1);
    }
  }
}

}  // namespace
}  // namespace dsdpv1
