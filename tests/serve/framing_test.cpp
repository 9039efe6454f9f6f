// Assembles telegrams from the pieces that an operating system delivers.
#include "tb/serve/framing.hpp"

#include <gtest/gtest.h>

#include "bus/telegram/telegram.hpp"

namespace dsdpv1 {
namespace {

using bus::Bytes;
using tb::serve::Intake;
using tb::serve::WallTime;

const Bytes kStatus = {0x10, 0x08, 0x02, 0x49, 0x53, 0x16};
const Bytes kDiag = {0x68, 0x05, 0x05, 0x68, 0x88, 0x82, 0x6D, 0x3C, 0x3E, 0xF1, 0x16};
constexpr WallTime kNow{};

TEST(Framing, EveryKindOfTelegramHasTheLengthOfItsEncoding) {
  for (const bus::Telegram& telegram :
       {bus::make_telegram(8, 2, 0x49), bus::make_telegram(8, 2, 0x6D, Bytes(100, 7), 60, 62),
        bus::prefer_sd3(bus::make_telegram(8, 2, 0x5D, Bytes(8, 1))), bus::make_token(2, 2), bus::make_sc()}) {
    const Bytes bytes = bus::encode(telegram);
    const tb::serve::Frame frame = tb::serve::frame_of(bytes.data(), bytes.size());
    EXPECT_TRUE(frame.telegram);
    EXPECT_EQ(frame.length, bytes.size());
  }
}

TEST(Framing, ATelegramIsHeldUntilItIsComplete) {
  Intake intake;
  for (std::size_t i = 0; i + 1 < kDiag.size(); ++i) {
    intake.take({kDiag[i]}, kNow);
    EXPECT_FALSE(intake.next(kNow)) << i;
    EXPECT_TRUE(intake.holding());
  }
  intake.take({kDiag.back()}, kNow);
  EXPECT_EQ(intake.next(kNow)->bytes, kDiag);
  EXPECT_FALSE(intake.holding());
}

TEST(Framing, TelegramsInOnePieceAreTakenApart) {
  Intake intake;
  Bytes both = kStatus;
  both.insert(both.end(), kDiag.begin(), kDiag.end());
  both.push_back(0x10);
  intake.take(both, kNow);
  EXPECT_EQ(intake.next(kNow)->bytes, kStatus);
  EXPECT_EQ(intake.next(kNow)->bytes, kDiag);
  EXPECT_FALSE(intake.next(kNow));
  EXPECT_TRUE(intake.holding());
}

TEST(Framing, ATelegramThatBreaksOffIsHandedOverAfterAWhile) {
  Intake intake;
  intake.take({0x68, 0x05}, kNow);
  EXPECT_FALSE(intake.next(kNow + Intake::kPatience - std::chrono::milliseconds(1)));
  EXPECT_EQ(intake.next(kNow + Intake::kPatience)->bytes, (Bytes{0x68, 0x05}));
  EXPECT_FALSE(intake.holding());
}

TEST(Framing, CompleteTelegramsAreTakenApartHoweverLateTheyAreLookedAt) {
  // A busy computer may read them more than kPatience later; joined, they would lack T_SYN on the line.
  Intake intake;
  Bytes twice = kStatus;
  twice.insert(twice.end(), kStatus.begin(), kStatus.end());
  intake.take(twice, kNow);
  const WallTime late = kNow + 2 * Intake::kPatience;
  EXPECT_EQ(intake.next(late)->bytes, kStatus);
  EXPECT_EQ(intake.next(late)->bytes, kStatus);
  EXPECT_FALSE(intake.holding());
}

TEST(Framing, TakingTelegramsFromTheFrontCostsTheSameHoweverManyWait) {
  Intake intake;
  constexpr std::size_t kTelegrams = 700'000;  // 4 MB; moving the rest for each telegram would take minutes
  Bytes many;
  for (std::size_t i = 0; i < kTelegrams; ++i) many.insert(many.end(), kStatus.begin(), kStatus.end());
  intake.take(many, kNow);
  const WallTime begin = tb::serve::WallClock::now();
  std::size_t taken = 0;
  while (const auto telegram = intake.next(kNow)) {
    taken += telegram->bytes == kStatus ? 1 : 0;
    ASSERT_LT(tb::serve::WallClock::now() - begin, std::chrono::seconds(10)) << taken;
  }
  EXPECT_EQ(taken, kTelegrams);
}

TEST(Framing, PatienceBeginsAnewWithEachPiece) {
  Intake intake;
  intake.take({0x68, 0x05}, kNow);
  intake.take({0x05}, kNow + std::chrono::milliseconds(40));
  EXPECT_FALSE(intake.next(kNow + std::chrono::milliseconds(60)));
}

TEST(Framing, ATelegramInEverSmallerPiecesIsGivenUpInTheEnd) {
  Intake intake;
  intake.take({0x68, 0xF9, 0xF9, 0x68}, kNow);
  WallTime now = kNow;
  while (now < kNow + Intake::kMostPatience) {
    EXPECT_FALSE(intake.next(now));
    now += Intake::kPatience / 2;
    intake.take({0x00}, now);
  }
  EXPECT_EQ(intake.next(now)->bytes.size(), 4U + 2 * (Intake::kMostPatience / Intake::kPatience));
  intake.take({0x10}, now);
  EXPECT_EQ(intake.give_up_at(), now + Intake::kPatience) << "the next one has all its time";
}

TEST(Framing, WhatATelegramStillLacksIsKnownFromItsHeader) {
  Intake intake;
  EXPECT_EQ(intake.missing(), 0U);
  intake.take({0x68}, kNow);
  EXPECT_EQ(intake.missing(), 1U) << "LE at least";
  intake.take({0x05}, kNow);
  EXPECT_EQ(intake.missing(), kDiag.size() - 2);
  intake.clear();
  EXPECT_EQ(intake.missing(), 0U);
  EXPECT_FALSE(intake.next(kNow + Intake::kPatience)) << "it was for nobody";
}

TEST(Framing, BytesThatBeginNoTelegramAreHandedOverAtOnce) {
  for (const Bytes& bytes : {Bytes{0x00}, Bytes{0xFF, 0x10}, Bytes{0x68, 0x03}, Bytes{0x68, 0xFA},
                             Bytes{0x68, 0x05, 0x06}, Bytes{0x68, 0x05, 0x05, 0x10}}) {
    Intake intake;
    intake.take(bytes, kNow);
    EXPECT_EQ(intake.next(kNow)->bytes, bytes);
  }
}

TEST(Framing, AMarkedByteIsPassedOnWithItsPlaceInTheTelegram) {
  tb::serve::MarkedBytes marked;
  Bytes bytes;
  std::vector<std::size_t> wrong;
  for (const int read : {0x10, 0xFF, 0xFF, 0xFF, 0x00, 0x02, 0x00, 0xFF, 0x00, 0x00}) {
    const auto byte = marked.take(static_cast<std::uint8_t>(read));
    if (!byte) continue;
    if (byte->wrong) wrong.push_back(bytes.size());
    bytes.push_back(byte->value);
  }
  EXPECT_EQ(bytes, (Bytes{0x10, 0xFF, 0x02, 0x00, 0x00})) << "FF FF is FF, FF 00 02 is 02";
  EXPECT_EQ(wrong, (std::vector<std::size_t>{2, 4}));

  Intake intake;
  Bytes both = kDiag;
  both.insert(both.end(), kStatus.begin(), kStatus.end());
  intake.take(both, kNow, {1, 3, kDiag.size() + 2});
  EXPECT_EQ(intake.next(kNow)->wrong_at, 1U) << "the first one";
  EXPECT_EQ(intake.next(kNow)->wrong_at, 2U);
  intake.take(kStatus, kNow);
  EXPECT_FALSE(intake.next(kNow)->wrong_at);
}

}  // namespace
}  // namespace dsdpv1
