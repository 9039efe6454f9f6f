#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>
#include <vector>

#include "bus/baud.hpp"

#include "bus/capture/telegram_printer.hpp"
#include "bus/capture/text_reader.hpp"
#include "bus/telegram/explain_memory.hpp"

namespace dsdpv1::bus::capture {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

struct Result {
  int code;
  std::string text, error;
};

Result decoded(const std::string& input) {
  std::istringstream in(input);
  std::ostringstream out;
  TelegramPrinter printer(out);
  ExplainMemory memory;
  int right = 0, wrong = 0;
  try {
    read_text(
        in, std::nullopt,
        [&](const CapturedTelegram& telegram) {
          const Decoded decoded = decode(telegram.bytes);
          const std::string why = what_is_wrong(telegram, decoded);
          ++(why.empty() ? right : wrong);
          printer.print(telegram, decoded, why, why.empty() ? memory.take(decoded.telegram) : ExplainContext());
        });
  } catch (const CaptureError& error) {
    return {2, out.str(), fmt::format("{}: {}", error.line(), error.what())};
  }
  return {right > 0 && wrong == 0 ? 0 : 1, out.str(), ""};
}

const std::string kStatusText = "10 03 01 49 4D 16";

TEST(DecodeText, AnySpacingPrefixesCommasAndComments) {
  for (const std::string input : {"10 03 01 49 4D 16", "10030149 4d16", "0x10,0x03, 0x01,0X49 4D\t16\r\n",
                                  "10 03 # first\n01 49 ; rest\n4D 16", "\n\n  10 03 01 49 4D 16"}) {
    const Result result = decoded(input);
    EXPECT_EQ(result.code, 0) << input;
    EXPECT_THAT(result.text, HasSubstr("1 -> 3  request FDL status")) << input;
  }
}

TEST(DecodeText, PrintsOffsetHexAndMeaning) {
  EXPECT_EQ(decoded("E5").text, "telegram 1, line 1: SC (short acknowledge)\n     0  E5  SC: short acknowledge\n");
}

TEST(DecodeText, AStreamOfSeveralTelegrams) {
  const Result result = decoded(kStatusText + " E5 DC 01 01 " + kStatusText);
  EXPECT_EQ(result.code, 0);
  EXPECT_THAT(result.text, HasSubstr("telegram 4, line 1"));
}

TEST(DecodeText, GarbageBetweenTelegramsIsReportedAndSkipped) {
  const Result result = decoded(kStatusText + "\n00 FF 12\nE5\n");
  EXPECT_EQ(result.code, 1);
  EXPECT_THAT(result.text, HasSubstr("garbage, line 2: 3 bytes between telegrams"));
  EXPECT_THAT(result.text, HasSubstr("telegram 2, line 3: SC"));
}

TEST(DecodeText, AWrongTelegramDoesNotSwallowTheNext) {
  const Result result = decoded("68 05 05 68 83 81 6D 3C 3E EB\n" + kStatusText);  // ED is missing
  EXPECT_EQ(result.code, 1);
  EXPECT_THAT(result.text, HasSubstr("wrong telegram, line 1: truncated"));
  EXPECT_THAT(result.text, HasSubstr("telegram 1, line 2"));
}

TEST(DecodeText, DataThatLookLikeDelimitersAreNotBelievedInsideAWrongTelegram) {
  const Result result = decoded("68 07 07 68 03 01 7D E5 DC E5 E5 00 16");
  EXPECT_EQ(result.code, 1);
  EXPECT_THAT(result.text, HasSubstr("wrong FCS"));
  EXPECT_THAT(result.text, Not(HasSubstr("telegram 1")));
}

TEST(DecodeText, EveryErrorIsNamed) {
  EXPECT_THAT(decoded("10 03 01 49 4E 16").text, HasSubstr("FCS: wrong, 4D is right"));
  EXPECT_THAT(decoded("10 03 01 49 4D 17").text, HasSubstr("ED: wrong, 16 is right"));
  EXPECT_THAT(decoded("68 05 06 68").text, HasSubstr("LE and LEr differ"));
  EXPECT_THAT(decoded("68 FF FF 68").text, HasSubstr("LE out of range"));
  EXPECT_THAT(decoded("68 05 05 00").text, HasSubstr("second start delimiter"));
  EXPECT_THAT(decoded("10 83 01 49 CD 16").text, HasSubstr("SAP byte that is not there"));
  EXPECT_THAT(decoded("10 03").text, HasSubstr("truncated"));
}

const std::string kLog =
    "        1361750.083 ns  demo         info      BAUD_FOUND: baud rate found: 12M; 1 -> 2\n"
    "        1362000.000 ns  bus          telegram  1 -> 3  request FDL status FCB=0 FCV=0  10 03 01 49 4D 16\n"
    "        1362001.000 ns  demo         text      68 it says 7\n"
    "        1362100.917 ns  bus          telegram  SC (short acknowledge)  [TSDR 11.25]  E5\n";

TEST(DecodeText, TheTelegramsOfALogWithTheirTimes) {
  const Result result = decoded(kLog);
  EXPECT_EQ(result.code, 0) << result.error;
  EXPECT_THAT(result.text, HasSubstr("telegram 1, line 2, 1362000.000 ns: 1 -> 3  request FDL status"));
  EXPECT_THAT(result.text, HasSubstr("telegram 2, line 4, 1362100.917 ns: SC"));
  EXPECT_THAT(result.text, Not(HasSubstr("garbage")));
}

TEST(DecodeText, ALogOfJsonLines) {
  const Result result = decoded(
      "{\"at_ns\":1362.5,\"station\":\"demo\",\"kind\":\"info\",\"text\":\"bytes\",\"bytes\":\"00\"}\n"
      "{\"at_ns\":1400.0,\"station\":\"bus\",\"kind\":\"telegram\",\"text\":\"x\",\"bytes\":\"10 03 01 49 4D 16\"}\n");
  EXPECT_EQ(result.code, 0) << result.error;
  EXPECT_THAT(result.text, HasSubstr("telegram 1, line 2, 1400.000 ns: 1 -> 3  request FDL status"));
  EXPECT_THAT(decoded("{\"at_ns\": 3}\n").error,
              "1: is no line of a log, expected JSON objects with at_ns and kind, or bytes of two digits 00 "
              "to FF");
  EXPECT_EQ(decoded("{not json\n").code, 2);
}

TEST(DecodeText, AWrongTelegramOfALogEndsWithItsLine) {
  const Result result = decoded(
      "  1.000 ns  bus  telegram  not readable  [wrong: truncated]  68 05 05 68 83\n"
      "  2.000 ns  bus  telegram  SC (short acknowledge)  E5\n");
  EXPECT_EQ(result.code, 1);
  EXPECT_THAT(result.text, HasSubstr("wrong telegram, line 1, 1.000 ns: truncated"));
  EXPECT_THAT(result.text, HasSubstr("telegram 1, line 2, 2.000 ns: SC"));
}

TEST(DecodeText, BytesThatTheLogHasCutAreNamed) {
  const Result result = decoded("  1.000 ns  bus  telegram  words  68 1D 1D 68 03 ... (35 bytes)\n");
  EXPECT_EQ(result.code, 1);
  EXPECT_THAT(result.text,
              HasSubstr("the log has 5 of its 35 bytes, all of them with --log-whole or --log FILE.jsonl"));
}

TEST(DecodeText, ASetPrmDecidesHowLaterDiagnosesOfItsSlaveAreRead) {
  const auto hex_of = [](const Telegram& telegram) {
    std::string text;
    for (const std::uint8_t byte : encode(telegram)) text += fmt::format("{:02X} ", byte);
    return text + "\n";
  };
  const std::string diagnosis =
      hex_of(make_telegram(1, 3, 0x08, {0x08, 0x0C, 0, 1, 0, 0, 0x04, 0x81, 1, 0}, sap::kMaster, sap::kSlaveDiag));
  const auto set_prm = [&](std::uint8_t user) {
    return hex_of(make_telegram(3, 1, 0x7D, {0x80, 0, 0, 11, 0, 0, 0, user, 0, 0}, sap::kSetPrm, sap::kMaster));
  };
  const std::string manufacturers = "device related byte 1: 0x81", dpv1 = "Status_Type: status message";
  EXPECT_THAT(decoded(diagnosis).text, HasSubstr(manufacturers + ", in DPV1 " + dpv1));
  EXPECT_THAT(decoded(set_prm(0x80) + diagnosis).text, AllOf(HasSubstr(dpv1), Not(HasSubstr(manufacturers))));
  EXPECT_THAT(decoded(set_prm(0x00) + diagnosis).text, AllOf(HasSubstr(manufacturers), Not(HasSubstr(dpv1))));
}

TEST(DecodeText, TheLongestRowOfBytesInALineOfAnotherLog) {
  const Result result = decoded(
      "PHY-serial: TX   10 03 01 49 4D 16\n"
      "I (394) RX: E5\n"
      "start of phase 2, be patient\n"
      "[12:00:01.5] 02 -> 3: DC 02 01 (token); 12 ms\n"
      "0012 RX 0x68,0x05,0x05,0x68,0x85 cut\n");
  EXPECT_EQ(result.error, "");
  EXPECT_THAT(result.text, HasSubstr("telegram 1, line 1: 1 -> 3  request FDL status"));
  EXPECT_THAT(result.text, HasSubstr("telegram 2, line 2: SC"));
  EXPECT_THAT(result.text, HasSubstr("telegram 3, line 4: 1 -> 2  token"));
  EXPECT_THAT(result.text, HasSubstr("wrong telegram, line 5: truncated"));
  EXPECT_THAT(result.text, Not(HasSubstr("garbage")));
  EXPECT_EQ(decoded("no bytes\nat all, be sure\n").error,
            "1: 'no' is no hexadecimal number, expected bytes of two digits 00 to FF");
}

std::vector<CapturedTelegram> laid_out(const std::string& text, int baud) {
  std::vector<CapturedTelegram> telegrams;
  std::istringstream in(text);
  read_text(in, baud, [&](const CapturedTelegram& telegram) { telegrams.push_back(telegram); });
  return telegrams;
}

TEST(DecodeText, TelegramsOfTextAreLaidOutAtTheRate) {
  constexpr int kBaud = 3;  // 1.5 Mbit/s
  const Tick bit = bus::baud(kBaud).bit;
  const auto telegrams = laid_out(kStatusText + kStatusText + "E5 DC 02 01", kBaud);
  ASSERT_EQ(telegrams.size(), 4U);
  EXPECT_EQ(telegrams[0].start, 37 * bit);
  EXPECT_EQ(telegrams[0].end, (37 + 66) * bit);
  EXPECT_EQ(telegrams[1].start - telegrams[0].end, 37 * bit) << "a request, not an answer";
  EXPECT_EQ(telegrams[2].start - telegrams[1].end, 11 * bit) << "an answer, after min_TSDR";
  EXPECT_EQ(telegrams[3].start - telegrams[2].end, 37 * bit);
  const auto logged = laid_out(kLog, kBaud);
  ASSERT_EQ(logged.size(), 2U);
  EXPECT_EQ(logged[0].end, 1'362'000 * kTicksPerNs) << "the log's time is that of the end";
  EXPECT_EQ(logged[0].start, logged[0].end - 66 * bit);
}

TEST(DecodeText, NothingIsNoTelegram) {
  EXPECT_EQ(decoded("# only a comment\n").code, 1);
  EXPECT_EQ(decoded("").text, "");
}

TEST(DecodeText, WhatIsNotHexadecimalIsAnErrorWithItsLineAndNoOutput) {
  const Result word = decoded("E5\nE5 XY\n");
  EXPECT_EQ(word.code, 2);
  EXPECT_EQ(word.error, "2: 'XY' is no hexadecimal number, expected bytes of two digits 00 to FF");
  EXPECT_EQ(word.text, "");
  const Result odd = decoded("123");
  EXPECT_EQ(odd.code, 2);
  EXPECT_EQ(odd.error, "1: '123' has an odd number of digits, a byte has two: 00 to FF");
}

}  // namespace
}  // namespace dsdpv1::bus::capture
