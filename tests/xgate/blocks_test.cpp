// Mailboxes, diagnosis blocks, command 04's data, LEDs; the configuration identifiers of the data sheet's appendix.
#include <gtest/gtest.h>

#include "model/profibus/cfg_identifier.hpp"
#include "model/xgate/diagnosis_block.hpp"
#include "tests/xgate/module_bench.hpp"

namespace dsdpv1::xgate {
namespace {

Frame frame_of(const Bytes& data) {
  Frame frame;
  frame.data.assign(data.data(), static_cast<int>(data.size()));
  return frame;
}
Bytes data_of(const Frame& frame) { return {frame.data.bytes.begin(), frame.data.bytes.begin() + frame.size()}; }
Bytes data_of(const Mailbox& mailbox) { return {mailbox.data, mailbox.data + mailbox.size}; }

// --- mailboxes -------------------------------------------------------------------------------------------------------

class XgateMailbox : public testing::TestWithParam<MailboxForm> {
 protected:
  Config config() const {
    Config given;
    given.mailboxes = GetParam();
    given.mailbox_special = 0x40;
    return given;
  }
};

TEST_P(XgateMailbox, IsIdLengthSpecialDataXor) {
  const std::uint8_t data[] = {0x5E, 1, 2, 4};
  Frame written;
  ASSERT_TRUE(append(written, {7, data, 4}, config()));
  const Bytes with = {7, 4, 0x40, 0x5E, 1, 2, 4, 0x5E ^ 1 ^ 2 ^ 4 ^ 0x40},
              without = {7, 4, 0x5E, 1, 2, 4, 0x5E ^ 1 ^ 2 ^ 4};
  EXPECT_EQ(data_of(written), GetParam() == MailboxForm::kSpecial ? with : without);
  ASSERT_TRUE(append(written, {8, data, 0}, config()));
  MailboxReader reader(written, GetParam());
  Mailbox first, second;
  ASSERT_TRUE(reader.read(first));
  EXPECT_FALSE(reader.at_end());
  ASSERT_TRUE(reader.read(second));
  EXPECT_TRUE(reader.at_end());
  EXPECT_EQ(first.id, 7);
  EXPECT_EQ(data_of(first), Bytes({0x5E, 1, 2, 4}));
  EXPECT_EQ(second.id, 8);
  EXPECT_EQ(second.size, 0);
}

TEST_P(XgateMailbox, CutOrDamagedIsNone) {
  const std::uint8_t data[] = {0x5E, 1, 2, 4};
  Frame whole;
  ASSERT_TRUE(append(whole, {7, data, 4}, config()));
  for (int size = 0; size < whole.size(); ++size) {
    Frame cut = whole;
    cut.data.size = size;
    MailboxReader reader(cut, GetParam());
    Mailbox mailbox;
    EXPECT_FALSE(reader.read(mailbox)) << size;
    EXPECT_TRUE(reader.at_end());
  }
  for (int place = 2; place < whole.size(); ++place) {
    Frame damaged = whole;
    damaged.data.bytes[static_cast<std::size_t>(place)] ^= 0x10;
    MailboxReader reader(damaged, GetParam());
    Mailbox mailbox;
    EXPECT_FALSE(reader.read(mailbox)) << place;
  }
}

TEST_P(XgateMailbox, FillsAFrameAndNoMore) {
  const Bytes data(255);
  const int head = GetParam() == MailboxForm::kSpecial ? 4 : 3;
  Frame full;
  EXPECT_FALSE(append(full, {1, data.data(), 256 - head}, config()));
  EXPECT_EQ(full.size(), 0);
  EXPECT_TRUE(append(full, {1, data.data(), 255 - head}, config()));
  EXPECT_EQ(full.size(), 255);
  EXPECT_FALSE(append(full, {1, data.data(), 0}, config()));
}

INSTANTIATE_TEST_SUITE_P(Both, XgateMailbox, testing::Values(MailboxForm::kSpecial, MailboxForm::kShort));

// --- diagnosis -------------------------------------------------------------------------------------------------------

DiagnosisBlocks read(const Bytes& bytes) { return read_diagnosis(bytes.data(), static_cast<int>(bytes.size())); }

TEST(XgateDiagnosis, AlarmStatusAndChannels) {
  EXPECT_TRUE(read({}).right);
  const DiagnosisBlocks alarm = read({0x05, 0x01, 3, 0x09, 0xAB});
  EXPECT_TRUE(alarm.right && alarm.alarm && !alarm.channel);
  const DiagnosisBlocks status = read({0x05, 0x82, 0, 0x01, 0x1B});
  EXPECT_TRUE(status.right && !status.alarm && !status.channel) << "status of modules";
  const DiagnosisBlocks both = read({0x04, 0x02, 254, 0x00, 0x81, 0x42, 0x21, 0xBF, 0xC0, 0xDF});
  EXPECT_TRUE(both.right && both.alarm && both.channel);
  EXPECT_TRUE(read({0x80, 0x80, 0xA6}).channel);
}

TEST(XgateDiagnosis, EveryTypeOfTheTables) {
  for (unsigned type = 0; type < 256; ++type) {
    const unsigned low = type & 0x7F;
    const bool known = type < 0x80 ? (low >= 1 && low <= 6) || (low >= 32 && low <= 126)
                                   : low == 1 || low == 2 || (low >= 32 && low <= 126);
    EXPECT_EQ(read({0x04, static_cast<std::uint8_t>(type), 0, 0}).right, known) << type;
    const auto fault = static_cast<std::uint8_t>(type);
    const unsigned width = type >> 5, code = type & 0x1F;
    const bool right = width >= 1 && width <= 6 && ((code >= 1 && code <= 9) || code >= 16);
    EXPECT_EQ(read({0x80, 0x40, fault}).right, right) << type;
    const bool header = (type & 0xC0) == 0x80;
    if (type >= 0x40) EXPECT_EQ(read({fault, 0x40, 0x21}).right, header) << type;
  }
}

TEST(XgateDiagnosis, WrongBlocks) {
  EXPECT_FALSE(read({0x03, 0x01, 0}).right) << "shorter than its head";
  EXPECT_FALSE(read({0x05, 0x01, 0, 0}).right) << "longer than the data";
  EXPECT_FALSE(read({0x04, 0x01, 255, 0}).right) << "slot 255";
  EXPECT_FALSE(read({0x04, 0x82, 1, 0}).right) << "the status of modules has slot 0";
  EXPECT_FALSE(read({0x80, 0x40, 0x21, 0x04, 0x01, 0, 0}).right) << "the alarm comes first (4.4.4)";
  EXPECT_FALSE(read({0x80, 0x40}).right) << "cut";
  EXPECT_FALSE(read({0x80, 0x00, 0x21}).right) << "neither input nor output";
  Bytes channels;
  for (int i = 0; i < 80; ++i) channels = channels + Bytes{0x80, 0x40, 0x21};
  EXPECT_FALSE(read(channels).right) << "240 bytes: a telegram has room for 238";
  channels.resize(237);
  EXPECT_TRUE(read(channels).right);
}

// --- command 04 ------------------------------------------------------------------------------------------------------

Error init(const Bytes& data, Initialisation* found = nullptr) {
  Initialisation read;
  const Error error = read_initialisation(frame_of(data), Config(), read);
  if (found != nullptr) *found = read;
  return error;
}
Bytes with(int place, std::uint8_t value) {
  Bytes data = ModuleBench::initialisation();
  data[static_cast<std::size_t>(place)] = value;
  return data;
}
Bytes with_cfg(const Bytes& cfg, int input, int output) {
  Bytes data(19);
  data[3] = static_cast<std::uint8_t>(cfg.size());
  data[4] = static_cast<std::uint8_t>(input);
  data[5] = static_cast<std::uint8_t>(output);
  return data + cfg;
}

TEST(XgateInitialisation, ThreeForms) {
  Initialisation found;
  ASSERT_EQ(init(ModuleBench::initialisation(), &found), error::kNone);
  EXPECT_EQ(found.address, 6);
  EXPECT_EQ(found.ident, 0x0F01) << "the low byte comes first (4.5)";
  EXPECT_FALSE(found.any_cfg || found.any_prm);
  EXPECT_TRUE(found.cfg.equals(ModuleBench::cfg().data(), 4)) << "from byte 19 on";
  EXPECT_TRUE(found.dpv1_on() && found.reads_and_writes() && !found.fail_safe() && !found.cfg_may_differ());
  EXPECT_EQ(found.c2_timeout(), 10);
  EXPECT_EQ(found.c1_size(), 20);
  EXPECT_EQ(found.c2_size(), 30);
  EXPECT_EQ(found.most_alarms(), 2);
  ASSERT_EQ(init({6, 1, 0x0F, 0}, &found), error::kNone) << "the example's";
  EXPECT_TRUE(found.any_cfg && found.any_prm && !found.dpv1_on());
  ASSERT_EQ(init(with_cfg({}, 255, 255), &found), error::kNone) << "the lengths are not looked at (4.2.1)";
  EXPECT_TRUE(found.any_cfg && !found.any_prm);
}

TEST(XgateInitialisation, WhatIsWrongWithIt) {
  for (std::size_t size = 0; size < 24; ++size) {
    Bytes data = ModuleBench::initialisation() + Bytes{0};
    data.resize(size);
    EXPECT_EQ(init(data), size == 23 ? error::kNone : error::kTooFew) << size;
  }
  EXPECT_EQ(init(with(0, 127)), error::kAddress);
  EXPECT_EQ(init(with(0, 126)), error::kNone);
  EXPECT_EQ(init(with(4, 4)), error::kIoLength) << "the identifiers have 3 inputs";
  EXPECT_EQ(init(with(5, 2)), error::kIoLength);
  EXPECT_EQ(init(with(4, 245)), error::kIoLength);
  EXPECT_EQ(init(with(22, 0x40)), error::kConfiguration) << "an identifier without its length";
  EXPECT_EQ(init(with_cfg(Bytes(24, 0x10), 24, 0)), error::kNone);
  EXPECT_EQ(init(with_cfg(Bytes(25, 0x10), 25, 0)), error::kIoLength) << "4.7.3: 24; table 4.11";
  for (const int size : {0, 4, 237}) EXPECT_EQ(init(with(6, static_cast<std::uint8_t>(size))), error::kNone) << size;
  for (const int size : {1, 2, 3, 238, 255})
    EXPECT_EQ(init(with(6, static_cast<std::uint8_t>(size))), error::kParameter) << size;
  for (const int place : {14, 15}) {
    EXPECT_EQ(init(with(place, 240)), error::kNone);
    EXPECT_EQ(init(with(place, 241)), error::kParameter) << "C1, C2 length";
  }
  EXPECT_EQ(init(with(18, 7)), error::kNone);
  EXPECT_EQ(init(with(18, 8)), error::kParameter) << "n is at most 7";
}

TEST(XgateInitialisation, AlarmsByTheirBits) {
  const int bits[] = {-1, 5, 6, 7, 7, 3, 2};
  for (unsigned type = 1; type <= 126; ++type) {
    const int own = type <= 6 ? bits[type] : 4;
    for (int bit = 2; bit < 8; ++bit) {
      Initialisation found;
      ASSERT_EQ(init(with(17, static_cast<std::uint8_t>(1U << bit)), &found), error::kNone);
      EXPECT_EQ(found.alarm_enabled(type), bit == own) << type << ' ' << bit;
    }
  }
}

TEST(XgateInitialisation, UserParameters) {
  Initialisation found;
  ASSERT_EQ(init(ModuleBench::initialisation(10), &found), error::kNone);
  for (int size = 0; size < 20; ++size) EXPECT_EQ(found.prm_fits(size), size == 10) << size;
  ASSERT_EQ(init(ModuleBench::initialisation(0), &found), error::kNone);
  for (int size = 0; size < 20; ++size) EXPECT_EQ(found.prm_fits(size), size == 0 || size == 3) << "DPV1's own";
  ASSERT_EQ(init({6, 1, 0x0F, 0}, &found), error::kNone);
  EXPECT_TRUE(found.prm_fits(0) && found.prm_fits(237));
}

// --- the appendix ----------------------------------------------------------------------------------------------------

struct Printed {  // a column of table 8.1: 16 identifiers with 1 to 16 bytes or words
  unsigned first;
  int unit;
  bool input, output;
};
constexpr Printed kTable81[] = {{0x10, 1, true, false}, {0x20, 1, false, true}, {0x30, 1, true, true},
                                {0x50, 2, true, false}, {0x60, 2, false, true}, {0x70, 2, true, true},
                                {0x90, 1, true, false}, {0xA0, 1, false, true}, {0xB0, 1, true, true},
                                {0xD0, 2, true, false}, {0xE0, 2, false, true}, {0xF0, 2, true, true}};

TEST(XgateAppendix, All192Identifiers) {
  int count = 0;
  for (const Printed& column : kTable81)
    for (int number = 1; number <= 16; ++number, ++count) {
      const auto identifier = static_cast<std::uint8_t>(static_cast<int>(column.first) + number - 1);
      const profibus::CfgLengths found = profibus::cfg_lengths(&identifier, 1);
      EXPECT_TRUE(found.complete());
      EXPECT_EQ(found.input(), column.input ? number * column.unit : 0) << int{identifier};
      EXPECT_EQ(found.output(), column.output ? number * column.unit : 0) << int{identifier};
      EXPECT_EQ(init(with_cfg({identifier}, found.input(), found.output())), error::kNone);
    }
  EXPECT_EQ(count, 192);
}

TEST(XgateAppendix, TheExampleOf484) {
  const Bytes cfg = {0x10, 0x5B, 0x20, 0x61};
  EXPECT_EQ(init(with_cfg(cfg, 25, 5)), error::kNone);
  EXPECT_EQ(init(with_cfg(cfg, 5, 25)), error::kIoLength);
}

// --- LEDs ------------------------------------------------------------------------------------------------------------

TEST(XgateLeds, FourModesAndRates) {
  constexpr Cycle kMs = profibus::kCyclesPerMs;
  const ShownLeds off{}, on = {{{true, false}, {true, true}, {}, {true, true}}};
  Leds leds;
  EXPECT_EQ(leds.next(off, 0), profibus::kNever);
  EXPECT_TRUE(leds.level(Led::kNetworkGreen, on, 0));
  EXPECT_EQ(leds.next(on, 0), 250 * kMs) << "2 Hz in self-control";
  EXPECT_FALSE(leds.level(Led::kNetworkRed, on, 250 * kMs));
  EXPECT_TRUE(leds.level(Led::kNetworkRed, on, 500 * kMs));
  leds.set(0b10'10'10'10, 0b11'10'01'00);
  const Cycle half[] = {0, 1000 * kMs, 500 * kMs, 250 * kMs};
  for (int led = 0; led < kLeds; ++led) {
    const auto name = static_cast<Led>(led);
    EXPECT_EQ(leds.level(name, on, 0), half[led] != 0) << "0 Hz: off";
    if (half[led] == 0) continue;
    EXPECT_TRUE(leds.level(name, on, half[led] - 1));
    EXPECT_FALSE(leds.level(name, on, half[led]));
  }
  leds.set(0b01'00'01'00, 0xFF);
  EXPECT_EQ(leds.next(on, 0), profibus::kNever);
  EXPECT_FALSE(leds.level(Led::kNetworkGreen, on, 0));
  EXPECT_TRUE(leds.level(Led::kModuleRed, off, 250 * kMs));
}

}  // namespace
}  // namespace dsdpv1::xgate
