// The error table of the header, and the copy of it in docs/programmers_guide.md.
#include <gtest/gtest.h>

#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "driver/dsdpv1.h"

namespace dsdpv1 {
namespace {

struct Row {
  std::string name;
  dsdpv1_error error;
  std::string text;
};

const std::vector<Row>& table() {
  static const std::vector<Row> rows = {
#define ROW(name, value, text) {#name, name, text},
      DSDPV1_ERROR_TABLE(ROW)
#undef ROW
  };
  return rows;
}

TEST(Errors, EachHasItsOwnValueAndText) {
  std::set<int> values;
  std::set<std::string> texts;
  for (const Row& row : table()) {
    EXPECT_TRUE(values.insert(row.error).second) << row.name;
    EXPECT_TRUE(texts.insert(row.text).second) << row.name;
    EXPECT_EQ(dsdpv1_error_text(row.error), row.text);
  }
}

TEST(Errors, UnknownValueHasAText) { EXPECT_STREQ(dsdpv1_error_text(static_cast<dsdpv1_error>(9)), "unknown error"); }

TEST(Errors, GuideHasTheSameTable) {
  std::ifstream file(GUIDE);
  ASSERT_TRUE(file) << GUIDE;
  std::stringstream guide;
  guide << file.rdbuf();
  std::size_t rows_in_guide = 0;
  for (std::string line; std::getline(guide, line);) {
    rows_in_guide +=
        line.find("| `DSDPV1_ERR_") != std::string::npos || line.find("| `DSDPV1_OK`") != std::string::npos;
  }
  EXPECT_EQ(rows_in_guide, table().size());
  for (const Row& row : table()) {
    const std::string expected = "| " + std::to_string(row.error) + " | `" + row.name + "` | " + row.text + " |";
    EXPECT_NE(guide.str().find(expected), std::string::npos) << "missing in the guide: " << expected;
  }
}

}  // namespace
}  // namespace dsdpv1
