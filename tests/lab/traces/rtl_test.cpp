// A fault planted in the reference RTL is found by its golden, at the cycle that lockstep names.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <ostream>
#include <regex>

#include "tests/app/program.hpp"

namespace dsdpv1 {
namespace {

using app_test::call;
using app_test::Called;

/// A fault of rtl_ref/dsdpv1/faults.txt, with the pin that shows it in 5 ms of bus_timing.
struct Planted {
  const char* fault;
  const char* pin;
};

void PrintTo(const Planted& each, std::ostream* out) { *out << each.fault; }

std::string matched(const std::string& text, const char* pattern) {
  std::smatch found;
  return std::regex_search(text, found, std::regex(pattern)) ? found[1].str() : "not in: " + text;
}

class PlantedFaults : public testing::TestWithParam<Planted> {};

TEST_P(PlantedFaults, AreFoundByTheGoldenAtTheCycleThatLockstepNames) {
  const app_test::Folder folder;
  const std::string fault = std::string(" --no-progress --fault ") + GetParam().fault;
  const Called golden = call("traces check bus_timing --engine rtl" + fault, DSDPV1_SOURCE_DIR);
  const Called lockstep = call("run scenarios/bus_timing.yaml -q --golden traces --engine lockstep --difference '" +
                                   folder.file("difference.vcd") + "'" + fault,
                               DSDPV1_SOURCE_DIR);
  EXPECT_EQ(golden.status, 1) << golden.err;
  EXPECT_EQ(lockstep.status, 1) << lockstep.err;
  EXPECT_THAT(lockstep.out, testing::Not(testing::HasSubstr("golden")));  // it has said what differs
  const char* const first = "first difference  (cycle .*)\n";
  EXPECT_EQ(matched(golden.out, first), matched(lockstep.out, first));
  const char* const access = "last access       (.*)\n";
  EXPECT_EQ(matched(golden.out, access), matched(lockstep.out, access));
  EXPECT_EQ(matched(golden.out, "pin (.*) of demo: golden"), GetParam().pin);
  EXPECT_EQ(matched(lockstep.out, "pin (.*): model"), GetParam().pin);
}

INSTANTIATE_TEST_SUITE_P(All, PlantedFaults,
                         testing::Values(Planted{"42", "PBTXD"}, Planted{"46", "INTR0"}, Planted{"48", "L_REQ"},
                                         Planted{"58", "INTR0"}),
                         [](const auto& each) { return std::string("Fault") + each.param.fault; });

TEST(TracesDocument, ShowsARealDifference) {
  const Called golden = call("traces check bus_timing --engine rtl --no-progress --fault 46", DSDPV1_SOURCE_DIR);
  EXPECT_THAT(app_test::read(DSDPV1_SOURCE_DIR "/docs/traces.md"), testing::HasSubstr("```\n" + golden.out + "```\n"));
}

TEST(NoFault, IsFoundWhereNoneIsActive) {
  EXPECT_EQ(call("traces check bus_timing --engine rtl --no-progress", DSDPV1_SOURCE_DIR).status, 0);
  EXPECT_EQ(call("traces check bus_timing --engine lockstep --no-progress", DSDPV1_SOURCE_DIR).status, 0);
}

}  // namespace
}  // namespace dsdpv1
