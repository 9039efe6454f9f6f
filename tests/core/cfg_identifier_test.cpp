// Configuration identifiers (EN 50170; APC3 tables A.3 to A.5).
#include "model/profibus/cfg_identifier.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace dsdpv1::profibus {
namespace {

CfgLengths lengths(const std::vector<std::uint8_t>& bytes) {
  return cfg_lengths(bytes.data(), static_cast<int>(bytes.size()));
}

TEST(CfgIdentifier, EveryCompactIdentifier) {
  // Bits 3..0 length - 1, 5..4 direction (1 input, 2 output, 3 both), 6 words, 7 consistency.
  for (unsigned byte = 0; byte < 256; ++byte) {
    const unsigned direction = byte >> 4 & 3;
    if (direction == 0) continue;  // special format
    const int units = static_cast<int>(byte & 0x0F) + 1, size = units * ((byte & 0x40) != 0 ? 2 : 1);
    const CfgLengths found = lengths({static_cast<std::uint8_t>(byte)});
    EXPECT_EQ(found.input(), (direction & 1) != 0 ? size : 0) << byte;
    EXPECT_EQ(found.output(), (direction & 2) != 0 ? size : 0) << byte;
    EXPECT_TRUE(found.complete());
  }
}

TEST(CfgIdentifier, SpecialFormatWithEveryLengthByte) {
  for (unsigned length = 0; length < 256; ++length) {
    const auto byte = static_cast<std::uint8_t>(length);
    const int size = (static_cast<int>(length & 0x3F) + 1) * ((length & 0x40) != 0 ? 2 : 1);
    EXPECT_EQ(lengths({0x40, byte}).input(), size);
    EXPECT_EQ(lengths({0x40, byte}).output(), 0);
    EXPECT_EQ(lengths({0x80, byte}).output(), size);
    EXPECT_EQ(lengths({0x80, byte}).input(), 0);
    const CfgLengths both = lengths({0xC0, byte, 0x00});
    EXPECT_EQ(both.output(), size) << "the output length comes first";
    EXPECT_EQ(both.input(), 1);
    EXPECT_TRUE(both.complete());
  }
}

TEST(CfgIdentifier, EmptyPlacesAndManufacturerBytes) {
  EXPECT_TRUE(lengths({0x00}).complete());
  for (std::uint8_t count = 0; count <= 14; ++count) {
    std::vector<std::uint8_t> bytes = {count};
    for (std::uint8_t i = 0; i < count; ++i) {
      EXPECT_FALSE(lengths(bytes).complete()) << int{count};
      bytes.push_back(0x1F);  // resembles an identifier
    }
    EXPECT_TRUE(lengths(bytes).complete());
    EXPECT_EQ(lengths(bytes).input(), 0);
    bytes.push_back(0x10);
    EXPECT_EQ(lengths(bytes).input(), 1) << "the next identifier";
  }
  const CfgLengths mixed = lengths({0xC2, 0x41, 0x01, 0x1F, 0x2F, 0x30});
  EXPECT_EQ(mixed.output(), 4 + 1);
  EXPECT_EQ(mixed.input(), 2 + 1);
}

TEST(CfgIdentifier, IncompleteOnes) {
  for (const std::vector<std::uint8_t>& bytes : {std::vector<std::uint8_t>{0x40},
                                                 {0x80},
                                                 {0xC0},
                                                 {0xC0, 0x00},
                                                 {0x41, 0x00},
                                                 {0xC1, 0x00, 0x00},
                                                 {0x11, 0x02, 0x00}})
    EXPECT_FALSE(lengths(bytes).complete());
  EXPECT_TRUE(lengths({}).complete());
}

TEST(CfgIdentifier, ByteByByteIsTheSameAsAtOnce) {
  const std::vector<std::uint8_t> bytes = {0x11, 0xC2, 0x41, 0x01, 0x1F, 0x2F, 0x30, 0x00, 0x75};
  CfgLengths one_by_one;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    one_by_one.add(bytes[i]);
    const CfgLengths at_once = cfg_lengths(bytes.data(), static_cast<int>(i + 1));
    EXPECT_EQ(one_by_one.input(), at_once.input());
    EXPECT_EQ(one_by_one.output(), at_once.output());
    EXPECT_EQ(one_by_one.complete(), at_once.complete());
  }
}

TEST(CfgIdentifier, TwoHundredBytesDoNotOverflow) {
  const std::vector<std::uint8_t> bytes(200, 0xFF);  // 16 words both ways, each
  EXPECT_EQ(lengths(bytes).input(), 200 * 32);
  EXPECT_EQ(lengths(bytes).output(), 200 * 32);
}

}  // namespace
}  // namespace dsdpv1::profibus
