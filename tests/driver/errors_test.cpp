// The error table of the header.
#include <gtest/gtest.h>

#include <set>
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

}  // namespace
}  // namespace dsdpv1
