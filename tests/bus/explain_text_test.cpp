#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "bus/explain.hpp"

namespace bus {
namespace {

using testing::HasSubstr;
using testing::Not;

struct Result {
  int code;
  std::string text, error;
};

Result decode(const std::string& input) {
  std::istringstream in(input);
  std::ostringstream out;
  std::string error;
  const int code = decode_text(in, "bus.txt", out, error);
  return {code, out.str(), error};
}

const std::string kStatus = "10 03 01 49 4D 16";

TEST(DecodeText, AnySpacingPrefixesCommasAndComments) {
  for (const std::string input : {"10 03 01 49 4D 16", "10030149 4d16", "0x10,0x03, 0x01,0X49 4D\t16\r\n",
                                  "10 03 # first\n01 49 ; rest\n4D 16", "\n\n  10 03 01 49 4D 16"}) {
    const Result result = decode(input);
    EXPECT_EQ(result.code, 0) << input;
    EXPECT_THAT(result.text, HasSubstr("1 -> 3  request FDL status")) << input;
  }
}

TEST(DecodeText, PrintsOffsetHexAndMeaning) {
  EXPECT_EQ(decode("E5").text, "telegram 1, line 1: SC (short acknowledge)\n     0  E5  SC: short acknowledge\n");
}

TEST(DecodeText, AStreamOfSeveralTelegrams) {
  const Result result = decode(kStatus + " E5 DC 01 01 " + kStatus);
  EXPECT_EQ(result.code, 0);
  EXPECT_THAT(result.text, HasSubstr("telegram 4, line 1"));
}

TEST(DecodeText, GarbageBetweenTelegramsIsReportedAndSkipped) {
  const Result result = decode(kStatus + "\n00 FF 12\nE5\n");
  EXPECT_EQ(result.code, 1);
  EXPECT_THAT(result.text, HasSubstr("garbage, line 2: 3 bytes between telegrams"));
  EXPECT_THAT(result.text, HasSubstr("telegram 2, line 3: SC"));
}

TEST(DecodeText, AWrongTelegramDoesNotSwallowTheNext) {
  const Result result = decode("68 05 05 68 83 81 6D 3C 3E EB\n" + kStatus);  // ED is missing
  EXPECT_EQ(result.code, 1);
  EXPECT_THAT(result.text, HasSubstr("wrong telegram, line 1: truncated"));
  EXPECT_THAT(result.text, HasSubstr("telegram 1, line 2"));
}

TEST(DecodeText, DataThatLookLikeDelimitersAreNotBelievedInsideAWrongTelegram) {
  const Result result = decode("68 07 07 68 03 01 7D E5 DC E5 E5 00 16");
  EXPECT_EQ(result.code, 1);
  EXPECT_THAT(result.text, HasSubstr("wrong FCS"));
  EXPECT_THAT(result.text, Not(HasSubstr("telegram 1")));
}

TEST(DecodeText, EveryErrorIsNamed) {
  EXPECT_THAT(decode("10 03 01 49 4E 16").text, HasSubstr("FCS: wrong, 4D is right"));
  EXPECT_THAT(decode("10 03 01 49 4D 17").text, HasSubstr("ED: wrong, 16 is right"));
  EXPECT_THAT(decode("68 05 06 68").text, HasSubstr("LE and LEr differ"));
  EXPECT_THAT(decode("68 FF FF 68").text, HasSubstr("LE out of range"));
  EXPECT_THAT(decode("68 05 05 00").text, HasSubstr("second start delimiter"));
  EXPECT_THAT(decode("10 83 01 49 CD 16").text, HasSubstr("SAP byte that is not there"));
  EXPECT_THAT(decode("10 03").text, HasSubstr("truncated"));
}

TEST(DecodeText, NothingIsNoTelegram) {
  EXPECT_EQ(decode("# only a comment\n").code, 1);
  EXPECT_EQ(decode("").text, "no telegram\n");
}

TEST(DecodeText, WhatIsNotHexadecimalIsAnErrorWithItsLineAndNoOutput) {
  const Result word = decode("E5\nE5 XY\n");
  EXPECT_EQ(word.code, 2);
  EXPECT_EQ(word.error, "bus.txt:2: 'XY' is no hexadecimal number, allowed are bytes of two digits 00 to FF");
  EXPECT_EQ(word.text, "");
  const Result odd = decode("123");
  EXPECT_EQ(odd.code, 2);
  EXPECT_EQ(odd.error, "bus.txt:1: '123' has an odd number of digits, a byte has two: 00 to FF");
}

}  // namespace
}  // namespace bus
