// Bad scenarios, GSD references, arguments and hexadecimal text: each causes one line on the error channel and exit
// code 2, and no other output or file. The cases are in tests/bad/cases.json; the files beside it are their input.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/app/program.hpp"

namespace dsdpv1 {
namespace {

namespace fs = std::filesystem;

struct Case {
  std::string arguments, line;
};

void PrintTo(const Case& each, std::ostream* out) { *out << each.arguments; }

std::vector<Case> cases() {
  std::vector<Case> list;
  const auto json = nlohmann::json::parse(app_test::read(DSDPV1_SOURCE_DIR "/tests/bad/cases.json"));
  for (const auto& each : json) list.push_back({each["arguments"], each["line"]});
  return list;
}

class BadInput : public testing::TestWithParam<Case> {};

TEST_P(BadInput, HasOneLineAndExitCode2) {
  const app_test::Folder outputs;
  std::string arguments = GetParam().arguments;
  // A run of the scenario must not leave any of its output files.
  if (arguments.rfind("run scenario/", 0) == 0 && arguments.find("--") == std::string::npos) {
    for (const char* name : {"log", "result", "trace"})
      arguments += std::string(" --") + name + " '" + outputs.file(name) + "'";
    arguments += " --wave '" + outputs.file("wave.vcd") + "'";
  }
  const app_test::Called called = app_test::call(arguments, DSDPV1_SOURCE_DIR "/tests/bad");
  EXPECT_EQ(called.status, 2);
  EXPECT_EQ(called.err, GetParam().line + "\n");
  EXPECT_EQ(called.out, "");
  EXPECT_TRUE(fs::is_empty(outputs.path()));
}

INSTANTIATE_TEST_SUITE_P(Cases, BadInput, testing::ValuesIn(cases()));

TEST(BadInputCases, AreAtLeastThirty) { EXPECT_GE(cases().size(), 30U); }

}  // namespace
}  // namespace dsdpv1
