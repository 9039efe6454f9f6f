// Each file of tests/bad/gsd has one fault, with the expected error line beside it.
#include <gmock/gmock.h>

#include "bus/gsd/report.hpp"
#include "files.hpp"

namespace dsdpv1 {
namespace {

using gsd_test::content;
using gsd_test::files_of;
using gsd_test::parse;

class BadGsd : public testing::TestWithParam<std::filesystem::path> {};

std::string expected_line(std::filesystem::path path) {
  std::string line = content(path.replace_extension(".expected"));
  line.erase(line.find_last_not_of('\n') + 1);
  return line;
}

TEST_P(BadGsd, IsRefusedWithItsLine) {
  const bus::GsdResult result = parse(content(GetParam()), GetParam().filename().string());
  EXPECT_FALSE(result.gsd.has_value());
  std::vector<std::string> errors;
  for (const auto& diagnostic : result.diagnostics)
    if (diagnostic.level == bus::GsdDiagnostic::Level::kError) errors.push_back(to_string(diagnostic));
  EXPECT_THAT(errors, testing::ElementsAre(expected_line(GetParam())));
}

TEST_P(BadGsd, MakesTheCommandEndWithTwoAndNoReport) {
  std::ostringstream out, err;
  std::ifstream in(GetParam());
  EXPECT_EQ(bus::gsd_command(in, GetParam().string(), {}, out, err), 2);
  EXPECT_EQ(out.str(), "");
  EXPECT_EQ(err.str(), GetParam().parent_path().string() + "/" + expected_line(GetParam()) + "\n");
}

INSTANTIATE_TEST_SUITE_P(Files, BadGsd, testing::ValuesIn(files_of(GSD_BAD)),
                         [](const auto& parameter) { return parameter.param.stem().string(); });

}  // namespace
}  // namespace dsdpv1
