// Tables as wide as their contents, and as wide as a terminal.
#include "tb/report/text_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

namespace dsdpv1 {
namespace {

using tb::TableWidth;
using tb::TextTable;

TextTable checks() {
  TextTable table({"check", "count", "worst margin"});
  table.add({"TIMING_TS", "40743", "56.917 ns measured, no limit"});
  table.add({"HOLD", "7", "-"});
  return table;
}

std::size_t widest_line(const std::string& text) {
  std::istringstream lines(text);
  std::size_t widest = 0;
  for (std::string line; std::getline(lines, line);) widest = std::max(widest, line.size());
  return widest;
}

TEST(TextTable, IsAsWideAsItsCells) {
  EXPECT_EQ(checks().text(),
            "  check      count  worst margin\n"
            "  ---------  -----  ----------------------------\n"
            "  TIMING_TS  40743  56.917 ns measured, no limit\n"
            "  HOLD           7  -\n");
}

TEST(TextTable, WhereThatIsTooWideTheWidestColumnIsWrappedBetweenWords) {
  const TableWidth width(36);
  EXPECT_EQ(checks().text(),
            "  check      count  worst margin\n"
            "  ---------  -----  ----------------\n"
            "  TIMING_TS  40743  56.917 ns\n"
            "                    measured, no\n"
            "                    limit\n"
            "  HOLD           7  -\n");
}

TEST(TextTable, AsWideAsTheTerminalIsNotTooWide) {
  const std::size_t natural = widest_line(checks().text());
  const std::string whole = checks().text();
  const TableWidth width(natural);
  EXPECT_EQ(checks().text(), whole);
}

TEST(TextTable, WhereWordsAreTooWideEachRowIsABlock) {
  const TableWidth width(24);
  EXPECT_EQ(checks().text(),
            "  check         TIMING_TS\n"
            "  count         40743\n"
            "  worst margin  56.917 ns\n"
            "                measured,\n"
            "                no limit\n"
            "\n"
            "  check         HOLD\n"
            "  count         7\n"
            "  worst margin  -\n");
}

TEST(TextTable, WhereBlocksTakeFewerLinesThanWrappedColumnsTheyAreBlocks) {
  TextTable table({"a long head", "what"});
  table.add({"some-word", "a text of many words that goes on and on"});
  const TableWidth width(24);
  EXPECT_EQ(table.text(),
            "  a long head  some-word\n"
            "  what         a text of\n"
            "               many\n"
            "               words\n"
            "               that goes\n"
            "               on and on\n");
}

TEST(TextTable, TheLatestWidthCountsForAsLongAsItLives) {
  const std::string whole = checks().text();
  const TableWidth narrow(36);
  {
    const TableWidth unlimited(TableWidth::kUnlimited);
    EXPECT_EQ(checks().text(), whole);
  }
  EXPECT_EQ(widest_line(checks().text()), 36U);
}

TEST(TextTable, ALetterOfSeveralBytesIsOneColumnWide) {
  TextTable table({"name", "n"});
  table.add({"\xC3\xA4\xC3\xB6\xC3\xBC", "1"});
  EXPECT_THAT(table.text(), testing::HasSubstr("  \xC3\xA4\xC3\xB6\xC3\xBC   1\n"));
}

TEST(TextTable, NumbersAndTimesStandToTheRight) {
  TextTable table({"time", "n", "range", "what"});
  table.add({"105.875 us", "-2", "0..15", "ready"});
  table.add({"1.361750 ms", "10", "2", "7 times"});
  table.add({"-", "", "3", "-"});
  EXPECT_EQ(table.text(),
            "         time   n  range  what\n"
            "  -----------  --  -----  -------\n"
            "   105.875 us  -2  0..15  ready\n"
            "  1.361750 ms  10  2      7 times\n"
            "            -      3      -\n");
}

TEST(TextTable, ANumberIsNotPartedFromItsUnit) {
  TextTable table({"time", "what"});
  table.add({"105.875 us", "a text that is too long"});
  table.add({"1.000 us", "short"});
  const TableWidth width(32);
  EXPECT_THAT(table.text(), testing::HasSubstr("  105.875 us  a text that is too\n"));
  EXPECT_EQ(tb::line_of("nothing for as long as it takes: 105.875 us"),
            "  nothing for as long as it\n  takes: 105.875 us\n");
}

TEST(NamedLine, IsWrappedUnderItsText) {
  EXPECT_EQ(tb::named_line("master", "a few words"), "  master         a few words\n");
  const TableWidth width(24);
  EXPECT_EQ(tb::named_line("master", "a few words"), "  master         a few\n                 words\n");
}

TEST(CommandLines, GoOnAfterABackslash) {
  EXPECT_EQ(tb::command_lines("  run my.yaml --wave my.fst"), "  run my.yaml --wave my.fst\n");
  const TableWidth width(22);
  EXPECT_EQ(tb::command_lines("  run my.yaml --wave my.fst"), "  run my.yaml \\\n      --wave my.fst\n");
}

}  // namespace
}  // namespace dsdpv1
