// The shipped goldens: one for each scenario, small, and as described in its manifest.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lab/traces/golden.hpp"
#include "tb/scenario/scenario.hpp"
#include "tests/app/program.hpp"

namespace dsdpv1 {
namespace {

namespace fs = std::filesystem;

const std::string kFolder = DSDPV1_SOURCE_DIR "/traces";
constexpr std::uintmax_t kMostBytes = 1U << 20U;  // git keeps a new copy at every regeneration

TEST(ShippedGoldens, AreThoseOfTheScenarios) {
  EXPECT_EQ(tb::traces::golden_names(kFolder), app_test::shipped_scenarios());
}

TEST(ShippedGoldens, AreSmallAndNothingElseIsInTheirFolder) {
  std::uintmax_t bytes = 0;
  std::vector<std::string> allowed = {"README.md"}, found;
  for (const std::string& name : app_test::shipped_scenarios()) {
    allowed.push_back(name + ".json");
    allowed.push_back(name + ".trace.xz");
  }
  for (const auto& entry : fs::directory_iterator(kFolder)) {
    found.push_back(entry.path().filename());
    bytes += entry.file_size();
  }
  EXPECT_THAT(found, testing::UnorderedElementsAreArray(allowed));
  EXPECT_LT(bytes, kMostBytes);
}

class ShippedGolden : public testing::TestWithParam<std::string> {};

TEST_P(ShippedGolden, IsMadeFromItsScenarioAndFitsItsManifest) {
  const auto scenario = tb::scenario::load(DSDPV1_SOURCE_DIR "/scenarios/" + GetParam() + ".yaml");
  const tb::traces::Golden golden = tb::traces::read_golden(kFolder, scenario);
  EXPECT_EQ(golden.trace->end(), scenario.end);
  for (std::size_t i = 0; i < golden.trace->signals().size(); ++i) {
    tb::Tick last = 0;
    std::uint64_t entries = 0;
    for (tb::traces::Cursor each = golden.trace->cursor(i); each.at() != bus::kNever; each.step(), ++entries)
      last = each.at();
    EXPECT_EQ(entries, golden.trace->changes(i) + 1);
    EXPECT_LE(last, scenario.end);
  }
}

INSTANTIATE_TEST_SUITE_P(All, ShippedGolden, testing::ValuesIn(app_test::shipped_scenarios()),
                         [](const auto& each) { return each.param; });

}  // namespace
}  // namespace dsdpv1
