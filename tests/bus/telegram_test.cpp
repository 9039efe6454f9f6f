#include "bus/telegram/telegram.hpp"

#include <gtest/gtest.h>

#include <array>
#include <random>
#include <stdexcept>

namespace dsdpv1::bus {
namespace {

Bytes counting(std::size_t size) {
  Bytes data;
  for (std::size_t i = 0; i < size; ++i) data.push_back(static_cast<std::uint8_t>(i));
  return data;
}

const Bytes kDiagRequest = {0x68, 0x05, 0x05, 0x68, 0x83, 0x81, 0x6D, 0x3C, 0x3E, 0xEB, 0x16};

TEST(TelegramEncode, KnownTelegrams) {
  EXPECT_EQ(encode(make_telegram(3, 1, 0x49)), (Bytes{0x10, 0x03, 0x01, 0x49, 0x4D, 0x16}));
  EXPECT_EQ(encode(make_telegram(3, 1, 0x6D, {}, sap::kSlaveDiag, sap::kMaster)), kDiagRequest);
  EXPECT_EQ(encode(make_token(1, 2)), (Bytes{0xDC, 0x01, 0x02}));
  EXPECT_EQ(encode(make_sc()), Bytes{0xE5});
}

TEST(TelegramEncode, Sd3OnlyForEightBytesAndWhenAskedFor) {
  EXPECT_EQ(prefer_sd3(make_telegram(3, 1, 0x5D, counting(8))).kind, TelegramKind::kSd3);
  EXPECT_EQ(prefer_sd3(make_telegram(3, 1, 0x5D, counting(6), 61, 62)).kind, TelegramKind::kSd3);
  EXPECT_EQ(make_telegram(3, 1, 0x5D, counting(8)).kind, TelegramKind::kSd2);
  EXPECT_EQ(prefer_sd3(make_telegram(3, 1, 0x5D, counting(8), 61, 62)).kind, TelegramKind::kSd2);
}

TEST(TelegramEncode, RefusesDataThatDoNotFit) {
  EXPECT_NO_THROW(encode(make_telegram(3, 1, 0x5D, counting(246))));
  EXPECT_THROW(encode(make_telegram(3, 1, 0x5D, counting(247))), std::invalid_argument);
  EXPECT_THROW(encode(make_telegram(3, 1, 0x5D, counting(245), 60, 62)), std::invalid_argument);
  Telegram sd1 = make_telegram(3, 1, 0x49);
  sd1.data = {1};
  EXPECT_THROW(encode(sd1), std::invalid_argument);
  Telegram sd3 = make_telegram(3, 1, 0x5D, counting(7));
  sd3.kind = TelegramKind::kSd3;
  EXPECT_THROW(encode(sd3), std::invalid_argument);
}

/// Telegrams of every kind, most of them with something broken.
Bytes perhaps_broken(std::mt19937& random) {
  const auto draw = [&random](std::size_t most) { return std::uniform_int_distribution<std::size_t>(0, most)(random); };
  const auto sap = [&draw] { return draw(1) == 0 ? std::nullopt : std::optional<std::uint8_t>(61); };
  Bytes bytes;
  switch (draw(3)) {
    case 0: bytes = encode(make_sc()); break;
    case 1: bytes = encode(make_token(3, 4)); break;
    default: bytes = encode(prefer_sd3(make_telegram(3, 1, 0x5D, counting(draw(9)), sap(), sap())));
  }
  for (std::size_t faults = draw(2); faults > 0; --faults) {
    const std::size_t at = draw(bytes.size() - 1);
    switch (draw(3)) {
      case 0: bytes[at] = static_cast<std::uint8_t>(bytes[at] ^ (1U << draw(7))); break;
      case 1: bytes.resize(at + 1); break;
      case 2: bytes.push_back(0x16); break;
      default: bytes[0] = std::array<std::uint8_t, 6>{0x10, 0x68, 0xA2, 0xDC, 0xE5, 0x00}.at(draw(5));
    }
  }
  return bytes;
}

TEST(TelegramCodec, ATelegramAsAWholeIsWhatItIsByteByByte) {
  std::mt19937 random(5);
  int right = 0;
  for (int i = 0; i < 20000; ++i) {
    const Bytes bytes = perhaps_broken(random);
    const Decoded one_by_one = decode(bytes);
    const bool whole = one_by_one.error == DecodeError::kNone && one_by_one.bytes.size() == bytes.size();
    ASSERT_EQ(is_telegram(bytes.data(), bytes.size()), whole) << i;
    right += whole ? 1 : 0;
    const Decoded at_once = bus::decode(bytes);
    ASSERT_EQ(at_once.error, one_by_one.error) << i;
    ASSERT_EQ(at_once.readable, one_by_one.readable) << i;
    ASSERT_EQ(at_once.telegram, one_by_one.telegram) << i;
    ASSERT_EQ(at_once.bytes, one_by_one.bytes) << i;
  }
  EXPECT_GT(right, 5000);
  EXPECT_LT(right, 15000);
  EXPECT_FALSE(is_telegram(nullptr, 0));
}

TEST(TelegramCodec, EveryLengthAndSapCombinationComesBack) {
  for (std::size_t size = 0; size <= kMaxData; ++size) {
    for (const bool dsap : {false, true}) {
      for (const bool ssap : {false, true}) {
        const Telegram sent = prefer_sd3(make_telegram(126, 0, 0x7C, counting(size),
                                                       dsap ? std::optional<std::uint8_t>(61) : std::nullopt,
                                                       ssap ? std::optional<std::uint8_t>(62) : std::nullopt));
        const Decoded got = decode(encode(sent));
        ASSERT_EQ(got.error, DecodeError::kNone) << size;
        ASSERT_EQ(got.telegram, sent) << size;
      }
    }
  }
}

TEST(TelegramCodec, TokenAndShortAcknowledgeComeBack) {
  EXPECT_EQ(decode({0xDC, 5, 6}).telegram, make_token(5, 6));
  EXPECT_EQ(decode({0xE5}).telegram, make_sc());
}

TEST(TelegramDecoder, TakesTelegramsOneAfterTheOther) {
  TelegramDecoder decoder;
  Bytes stream = {0xE5};
  stream.insert(stream.end(), kDiagRequest.begin(), kDiagRequest.end());
  stream.push_back(0xE5);
  int right = 0;
  for (const std::uint8_t byte : stream) {
    const auto decoded = decoder.feed(byte);
    if (decoded && decoded->error == DecodeError::kNone) ++right;
  }
  EXPECT_EQ(right, 3);
  EXPECT_FALSE(decoder.finish().has_value());
}

struct WrongTelegram {
  const char* name;
  Bytes bytes;
  DecodeError error;
  std::size_t consumed;
};

class TelegramErrors : public testing::TestWithParam<WrongTelegram> {};

TEST_P(TelegramErrors, AreFoundAtTheFirstByteThatTells) {
  const Decoded decoded = decode(GetParam().bytes);
  EXPECT_EQ(decoded.error, GetParam().error);
  EXPECT_EQ(decoded.bytes.size(), GetParam().consumed);
  EXPECT_STRNE(describe(decoded.error), "");
}

INSTANTIATE_TEST_SUITE_P(
    Kinds, TelegramErrors,
    testing::Values(
        WrongTelegram{"StartDelimiter", {0x11, 0x03}, DecodeError::kStartDelimiter, 1},
        WrongTelegram{"LengthTooShort", {0x68, 0x03, 0x03, 0x68}, DecodeError::kLengthRange, 2},
        WrongTelegram{"LengthTooLong", {0x68, 0xFA, 0xFA, 0x68}, DecodeError::kLengthRange, 2},
        WrongTelegram{"LengthMismatch", {0x68, 0x05, 0x06, 0x68}, DecodeError::kLengthMismatch, 3},
        WrongTelegram{"SecondStartDelimiter", {0x68, 0x05, 0x05, 0x69, 0x83}, DecodeError::kSecondStartDelimiter, 4},
        WrongTelegram{"Fcs", {0x10, 0x03, 0x01, 0x49, 0x4E, 0x16}, DecodeError::kFcs, 6},
        WrongTelegram{"EndDelimiter", {0x10, 0x03, 0x01, 0x49, 0x4D, 0x17}, DecodeError::kEndDelimiter, 6},
        WrongTelegram{"FcsBeforeEnd", {0x10, 0x03, 0x01, 0x49, 0x4E, 0x17}, DecodeError::kFcs, 6},
        WrongTelegram{"MissingSap", {0x10, 0x83, 0x01, 0x49, 0xCD, 0x16}, DecodeError::kMissingSap, 6},
        WrongTelegram{
            "OneSapForTwo", {0x68, 0x04, 0x04, 0x68, 0x83, 0x81, 0x6D, 0x3C, 0xAD, 0x16}, DecodeError::kMissingSap, 10},
        WrongTelegram{"Truncated", {0x68, 0x05, 0x05, 0x68, 0x83}, DecodeError::kTruncated, 5},
        WrongTelegram{"TruncatedToken", {0xDC, 0x01}, DecodeError::kTruncated, 2},
        WrongTelegram{"TruncatedSd3", {0xA2, 0x01, 0x03, 0x5D, 0, 0}, DecodeError::kTruncated, 6}),
    [](const auto& test) { return test.param.name; });

TEST(TelegramDecoder, NoByteIsATruncatedTelegram) {
  const Decoded decoded = bus::decode({});
  EXPECT_EQ(decoded.error, DecodeError::kTruncated);
  EXPECT_FALSE(decoded.readable);
}

TEST(TelegramDecoder, FcsWithoutItsSapBytesIsNotReadable) {
  EXPECT_FALSE(decode({0x10, 0x83, 0x01, 0x49, 0xCE, 0x16}).readable);
  EXPECT_TRUE(decode({0x10, 0x03, 0x01, 0x49, 0x4E, 0x16}).readable);
}

TEST(Telegram, OnlySdnAndBroadcastsWantNoAnswer) {
  EXPECT_TRUE(make_telegram(3, 1, 0x49).wants_answer());
  EXPECT_TRUE(make_telegram(3, 1, 0x7D).wants_answer());
  EXPECT_FALSE(make_telegram(3, 1, 0x46).wants_answer());
  EXPECT_FALSE(make_telegram(3, 1, 0x44).wants_answer());
  EXPECT_FALSE(make_telegram(kBroadcast, 1, 0x49).wants_answer());
  EXPECT_FALSE(make_telegram(3, 1, 0x08).wants_answer());
  EXPECT_FALSE(make_token(3, 1).wants_answer());
}

TEST(Telegram, ResponsesHaveBitSixClear) {
  EXPECT_TRUE(make_sc().is_response());
  EXPECT_TRUE(make_telegram(3, 1, 0x08).is_response());
  EXPECT_FALSE(make_telegram(3, 1, 0x49).is_response());
  EXPECT_FALSE(make_token(3, 1).is_response());
  EXPECT_FALSE(make_token(3, 1).is_request());
}

}  // namespace
}  // namespace dsdpv1::bus
