// Every scenario that ships on the reference RTL: in lockstep without a difference; the short ones also with the pin
// trace and log of the model.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "tb/scenario/scenario.hpp"
#include "tests/app/program.hpp"

namespace {

namespace fs = std::filesystem;
using app_test::call;
using app_test::read;
using app_test::shipped_scenarios;

/// A trace of a long one costs minutes, and the lockstep compares each of its cycles all the same.
std::vector<std::string> short_scenarios() {
  constexpr bus::Tick kLongest = 120 * bus::kTicksPerMs;
  std::vector<std::string> names = shipped_scenarios();
  const auto is_long = [](const std::string& name) {
    return tb::scenario::load(DSDPV1_SOURCE_DIR "/scenarios/" + name + ".yaml").end > kLongest;
  };
  names.erase(std::remove_if(names.begin(), names.end(), is_long), names.end());
  return names;
}

class RtlScenarios : public testing::TestWithParam<std::string> {
 protected:
  app_test::Called run(const std::string& arguments) const {
    return call("run scenarios/" + GetParam() + ".yaml --no-progress " + arguments, DSDPV1_SOURCE_DIR);
  }
  std::string files(const std::string& engine) const {
    return "--checks fail --engine " + engine + " --trace '" + folder_.file(engine + ".trace") + "' --log '" +
           folder_.file(engine + ".log") + "'";
  }
  app_test::Folder folder_;
};

class ShortRtlScenarios : public RtlScenarios {};

TEST_P(RtlScenarios, ModelAndRtlDoNotDiffer) {
  const app_test::Called called = run("--engine lockstep --difference '" + folder_.file("difference.vcd") +
                                      "' --log '" + folder_.file("log") + "'");
  EXPECT_EQ(called.status, 0) << called.out << called.err;
  EXPECT_THAT(called.out, testing::HasSubstr("of model and RTL are the same"));
  EXPECT_FALSE(fs::exists(folder_.file("difference.vcd")));
}

TEST_P(ShortRtlScenarios, TraceAndLogOfTheRtlAreThoseOfTheModel) {
  ASSERT_EQ(run(files("skip")).status, 0);
  ASSERT_EQ(run(files("rtl")).status, 0);
  for (const char* ending : {".trace", ".log"})
    EXPECT_TRUE(read(folder_.file(std::string("skip") + ending)) == read(folder_.file(std::string("rtl") + ending)))
        << ending;
}

INSTANTIATE_TEST_SUITE_P(
    All, RtlScenarios, testing::ValuesIn(shipped_scenarios()), [](const auto& each) { return each.param; });
INSTANTIATE_TEST_SUITE_P(All, ShortRtlScenarios, testing::ValuesIn(short_scenarios()),
                         [](const auto& each) { return each.param; });

}  // namespace
