#include "bus/capture/logic_decoder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "bus/baud.hpp"
#include "bus/telegram/telegram.hpp"
#include "bus/wire/uart.hpp"

namespace dsdpv1::bus::capture {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

const Bytes kRequest = encode(make_telegram(5, 2, 0x6D, {}, 60, 62));

struct LogicDecoderTest : testing::Test {
  /// Sends bytes from `at` on, every edge moved to the next multiple of `grid`.
  static void send(LogicDecoder& decoder, Tick at, int baud, const Bytes& bytes, bool inverted = false, Tick grid = 1) {
    const Tick bit = bus::baud(baud).bit;
    for (const Character& character : characters(bytes))
      for (int i = 0; i < kCharacterBits; ++i, at += bit)
        decoder.level((at + grid - 1) / grid * grid, (((character.bits >> i) & 1) != 0) != inverted);
  }
  std::vector<CapturedTelegram> taken;
  TakeTelegram take = [this](const CapturedTelegram& each) { taken.push_back(each); };

  void run(const LogicSettings& settings, int baud, bool inverted = false, Tick grid = 1) {
    taken.clear();
    LogicDecoder decoder(settings, take);
    decoder.level(0, !inverted);
    const Tick step = 1000 * bus::baud(baud).bit;
    for (int i = 1; i <= 5; ++i) send(decoder, i * step, baud, kRequest, inverted, grid);
    decoder.finish(6 * step);
  }
  std::string error(const LogicSettings& settings, int baud, bool inverted) {
    try {
      run(settings, baud, inverted);
    } catch (const CaptureError& error) {
      return error.what();
    }
    return "";
  }
};

TEST_F(LogicDecoderTest, EveryRateIsFound) {
  for (int baud = 0; baud < kBaudCount; ++baud) {
    run({}, baud);
    EXPECT_THAT(taken, SizeIs(5)) << baud;
    for (const CapturedTelegram& each : taken) EXPECT_EQ(each.bytes, kRequest);
    for (const CapturedTelegram& each : taken) EXPECT_EQ(each.baud, baud);
  }
}

TEST_F(LogicDecoderTest, FourSamplesABitAreEnough) {
  for (int baud = 0; baud < kBaudCount; ++baud) {
    run({}, baud, false, bus::baud(baud).bit / 4 + 1);
    ASSERT_THAT(taken, SizeIs(5)) << baud;
    for (const CapturedTelegram& each : taken) EXPECT_EQ(each.bytes, kRequest);
  }
}

TEST_F(LogicDecoderTest, InvertedLineIsReadWhenItIsSaid) {
  LogicSettings settings;
  settings.inverted = true;
  run(settings, 4, true);
  EXPECT_THAT(taken, SizeIs(5));
  EXPECT_THAT(error({}, 4, true), HasSubstr("with --invert there are some"));
  EXPECT_THAT(error(settings, 4, false), HasSubstr("without --invert there are some"));
}

TEST_F(LogicDecoderTest, GivenRateIsNotDoubted) {
  LogicSettings settings;
  settings.baud = 3;
  run(settings, 4);
  for (const CapturedTelegram& each : taken) EXPECT_NE(each.bytes, kRequest);
}

TEST_F(LogicDecoderTest, LineThatOnlyIdlesHasNoRate) {
  LogicDecoder decoder({}, take);
  decoder.level(0, true);
  EXPECT_THROW(decoder.finish(1'000'000), CaptureError);
  EXPECT_THAT(taken, IsEmpty());
}

TEST_F(LogicDecoderTest, LongRecordingIsDecodedWhileItIsRead) {
  LogicDecoder decoder({}, take);
  decoder.level(0, true);
  Tick at = 100'000;
  for (std::size_t i = 0; i < LogicDecoder::kTrialChanges / 40; ++i, at += 200'000) send(decoder, at, 0, kRequest);
  EXPECT_THAT(taken, testing::Not(IsEmpty())) << "before the end";
  EXPECT_EQ(decoder.baud(), 0);
}

TEST(ChooseSignal, TheOnlyOneOrTheMostLikelyOne) {
  EXPECT_EQ(choose_signal({"x"}, ""), 0U);
  EXPECT_EQ(choose_signal({"demo.PBRXD", "bus.line"}, ""), 1U);
  EXPECT_EQ(choose_signal({"a", "demo.PBTXD", "demo.PBRXD"}, ""), 2U);
  EXPECT_EQ(choose_signal({"D0", "uart_rxd"}, ""), 1U);
  EXPECT_EQ(choose_signal({"a.x", "b.x"}, "b.x"), 1U);
  EXPECT_EQ(choose_signal({"a", "demo.PBRXD"}, "pbrxd"), 1U);
}

TEST(ChooseSignal, OthersAreAskedFor) {
  EXPECT_THROW(choose_signal({}, ""), CaptureError);
  EXPECT_THROW(choose_signal({"D0", "D1"}, ""), CaptureError);
  EXPECT_THROW(choose_signal({"D0", "D1"}, "D2"), CaptureError);
}

}  // namespace
}  // namespace dsdpv1::bus::capture
