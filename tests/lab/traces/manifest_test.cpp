#include "lab/traces/manifest.hpp"

#include <gtest/gtest.h>

#include "tests/lab/traces/small.hpp"

namespace dsdpv1 {
namespace {

using tb::traces::first_other;
using tb::traces::Json;

TEST(Manifest, HashesAreThoseOfSha256sum) {
  EXPECT_EQ(tb::traces::sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

TEST(Manifest, TheFirstOtherEntryIsNamedWithBothValues) {
  const Json present = {{"cycles", 5}, {"files", {{"a.gsd", "1"}}}};
  EXPECT_EQ(first_other(present, present), "");
  EXPECT_EQ(first_other({{"tool", "x"}, {"files", {{"a.gsd", "1"}}}, {"cycles", 5}}, present), "");
  EXPECT_EQ(first_other({{"files", {{"a.gsd", "1"}}}}, present), "cycles is missing");
  EXPECT_EQ(first_other({{"cycles", 6}, {"files", {{"a.gsd", "1"}}}}, present), "cycles is 6 there and 5 now");
  EXPECT_EQ(first_other({{"cycles", 5}, {"files", {{"a.gsd", "2"}}}}, present),
            "files: a.gsd is \"2\" there and \"1\" now");
  EXPECT_EQ(first_other({{"cycles", 5}, {"files", {{"a.gsd", "1"}, {"b.gsd", "1"}}}}, present),
            "files: it has more entries");
  EXPECT_EQ(first_other(Json::array(), present), "it is no JSON object");
}

TEST(Manifest, CountsTheChangesOfEachPinAndOfTheLine) {
  const auto scenario = traces_test::small_scenario();
  const auto trace = traces_test::trace_of(scenario, {{"L_REQ", 250, 1}, {"L_REQ", 500, 0}, {"line", 700, 1}});
  const Json contents = tb::traces::contents_of(*trace);
  EXPECT_EQ(contents["changes"], 3);
  EXPECT_EQ(contents["line"], 1);
  EXPECT_EQ(contents["cycles"], 4000);
  EXPECT_EQ(contents["slaves"]["io"]["changes"], 2);
  EXPECT_EQ(contents["slaves"]["io"]["pins"]["L_REQ"], 2);
  EXPECT_EQ(contents["slaves"]["io"]["pins"]["RESET"], 0);
  EXPECT_EQ(contents["trace"]["sha256"], tb::traces::sha256(trace->content()));
  EXPECT_EQ(contents["trace"]["bytes"], trace->content().size());
}

}  // namespace
}  // namespace dsdpv1
