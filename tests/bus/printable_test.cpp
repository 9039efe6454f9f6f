#include "bus/printable.hpp"

#include <gtest/gtest.h>

#include <string>
#include <utility>

namespace dsdpv1 {
namespace {

using bus::printable;
using bus::printable_lines;

TEST(Printable, ControlCharactersBecomeEscapes) {
  const std::pair<std::string, std::string> cases[] = {
      {"\x1B[2J", R"(\x1B[2J)"},  // CSI of seven bits
      {"\x1B]0;title\a", R"(\x1B]0;title\x07)"},
      {"\xC2\x9B"
       "2J",
       R"(\u009B2J)"},  // CSI as one C1 control
      {"\xC2\x80\xC2\x9F", R"(\u0080\u009F)"},
      {"\x7F", R"(\x7F)"},
      {std::string(1, '\0'), R"(\x00)"},
      {"a\nb\r\tc", R"(a\nb\r\tc)"},
  };
  for (const auto& [text, expected] : cases) EXPECT_EQ(printable(text), expected);
}

TEST(Printable, MarksOfDirectionAndSeparatorsOfLinesBecomeEscapes) {
  EXPECT_EQ(printable("\u202A\u202E\u2066\u2069\u202C\u202C"), R"(\u202A\u202E\u2066\u2069\u202C\u202C)");
  EXPECT_EQ(printable("\u200E\u200F\u061C\u2028\u2029"), R"(\u200E\u200F\u061C\u2028\u2029)");
}

TEST(Printable, BytesThatAreNoUtf8BecomeEscapes) {
  EXPECT_EQ(printable("\xFF\xC3"), R"(\xFF\xC3)");
  EXPECT_EQ(printable("\x9B"
                      "2J"),
            R"(\x9B2J)");                                   // CSI of a terminal with eight bits
  EXPECT_EQ(printable("\xC0\x9B"), R"(\xC0\x9B)");          // ESC, longer than it must be
  EXPECT_EQ(printable("\xED\xA0\x80"), R"(\xED\xA0\x80)");  // half of a pair of UTF-16
}

TEST(Printable, LettersOfEveryScriptStay) {
  const std::string text = "Gerät \"8 Byte\", модуль, 装置, \u00A0, 🙂, \\x1B~";
  EXPECT_EQ(printable(text), text);
}

TEST(Printable, DoneTwiceItIsDoneOnce) {
  EXPECT_EQ(printable(printable("\x1B\n\u202E\u202C")), printable("\x1B\n\u202E\u202C"));
}

TEST(Printable, OfLaidOutTextLineEndsAndTabsStay) { EXPECT_EQ(printable_lines("a\n\tb\r\x1B\n"), "a\n\tb\\r\\x1B\n"); }

}  // namespace
}  // namespace dsdpv1
