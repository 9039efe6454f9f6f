// The page about results equals the program's output.
#include "tb/report/result_fields.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

namespace dsdpv1 {
namespace {

TEST(ResultDocument, IsTheCheckedInFile) {
  std::ifstream file(DSDPV1_SOURCE_DIR "/docs/result.md");
  std::ostringstream text;
  text << file.rdbuf();
  EXPECT_EQ(text.str(), tb::result_markdown()) << "./run generate writes it again";
}

}  // namespace
}  // namespace dsdpv1
