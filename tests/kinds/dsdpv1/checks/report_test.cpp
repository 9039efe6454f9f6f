// The program's reports of checks: docs/checks.md, the result file, the table, the log.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/app/program.hpp"

namespace dsdpv1 {
namespace {

using app_test::call;
using app_test::read;
using testing::HasSubstr;
using Json = nlohmann::json;

const char* const kScenario = R"(name: broken
baud: 12M
end: 2ms
slaves:
  - name: demo
    address: 5
    init: {ident: 1, max_inputs: 2, max_outputs: 2, cfg: "31"}
    user_cpu: {cycle: 100us}
script: [{at: 1ms, do: early_r_sta, slave: demo}]
expect: [{slave: demo, event: OWNERSHIP_SYNC_WINDOW, count: 1}]
)";

class ChecksOfTheProgram : public testing::Test {
 protected:
  app_test::Called run(const std::string& arguments) const {
    std::ofstream(folder_.file("s.yaml")) << kScenario;
    return call("run s.yaml --no-progress --log s.log --result s.json " + arguments, folder_.path());
  }
  Json check(const std::string& id) const {
    const Json result = Json::parse(read(folder_.file("s.json")));
    for (const Json& each : result["checks"])
      if (each["id"] == id) return each;
    return nullptr;
  }
  app_test::Folder folder_;
};

TEST_F(ChecksOfTheProgram, ReportListsAndPasses) {
  const app_test::Called called = run("--checks report");
  EXPECT_EQ(called.status, 0) << called.out << called.err;
  EXPECT_THAT(called.out, HasSubstr("PASSED, 1 violation not judged"));
  EXPECT_THAT(called.out, HasSubstr("OWNERSHIP_SYNC_WINDOW"));
  EXPECT_THAT(called.out, HasSubstr("\n    R_STA  "));
  EXPECT_THAT(read(folder_.file("s.log")), HasSubstr("demo         check     OWNERSHIP_SYNC_WINDOW at "));
}

TEST_F(ChecksOfTheProgram, FailFailsTheRun) {
  for (const char* given : {"--checks fail", ""}) EXPECT_EQ(run(given).status, 1);
  EXPECT_THAT(read(folder_.file("s.log")), HasSubstr("demo         violation OWNERSHIP_SYNC_WINDOW at "));
}

TEST_F(ChecksOfTheProgram, OffChecksNothing) {
  EXPECT_EQ(run("--checks off").status, 2) << "the violation that the scenario expects cannot be found";
  EXPECT_EQ(run("--checks off --set expect=none").status, 3);
  EXPECT_EQ(Json::parse(read(folder_.file("s.json")))["checks"], Json::array());
}

TEST_F(ChecksOfTheProgram, ResultHasMarginTimeHistogramAndPinHistory) {
  run("");
  const Json found = check("OWNERSHIP_SYNC_WINDOW");
  ASSERT_FALSE(found.is_null());
  EXPECT_EQ(found["slave"], "demo");
  EXPECT_EQ(found["limit_ns"], 62.5);
  EXPECT_EQ(found["violations"], 1);
  EXPECT_NEAR(found["worst_margin_ns"].get<double>(), 20.833 - 62.5, 0.001);
  EXPECT_GT(found["at_ns"].get<double>(), 1e6);
  std::uint64_t in_bins = 0;
  for (const Json& bin : found["histogram"]) in_bins += bin["count"].get<std::uint64_t>();
  EXPECT_EQ(in_bins, found["count"]);
  EXPECT_EQ(found["histogram"][0]["from_ns"], nullptr);
  ASSERT_EQ(found["listed"].size(), 1U);
  EXPECT_EQ(found["listed"][0]["at_ns"], found["at_ns"]);
  EXPECT_EQ(found["listed"][0]["history"].back()["pin"], "R_STA");
}

TEST_F(ChecksOfTheProgram, UnknownWordIsRefusedInOneLine) {
  const app_test::Called called = run("--checks reprt");
  EXPECT_EQ(called.status, 2);
  EXPECT_EQ(called.err, "dsdpv1-sim run: --checks is reprt (did you mean report?), expected fail, report, off\n");
}

TEST(ChecksDocument, IsWhatTheTableSays) {
  EXPECT_TRUE(read(DSDPV1_SOURCE_DIR "/docs/checks.md") == call("reasons --checks", DSDPV1_SOURCE_DIR).out)
      << "docs/checks.md is stale: ./run generate";
}

}  // namespace
}  // namespace dsdpv1
