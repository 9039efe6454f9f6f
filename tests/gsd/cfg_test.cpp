// Identifier bytes, tables A.3 to A.5.
#include <gtest/gtest.h>

#include "bus/gsd/cfg.hpp"

namespace dsdpv1 {
namespace {

using bus::cfg_lengths;

TEST(CfgLengths, EmptyConfigurationHasNoData) {
  const auto lengths = cfg_lengths({});
  EXPECT_TRUE(lengths.ok());
  EXPECT_EQ(lengths.input + lengths.output, 0);
}

TEST(CfgLengths, ExamplesOfTheManualAreFourBytesInAndOut) {
  EXPECT_EQ(cfg_lengths({0x13}).input, 4);
  EXPECT_EQ(cfg_lengths({0x13}).output, 0);
  EXPECT_EQ(cfg_lengths({0x23}).output, 4);
  EXPECT_EQ(cfg_lengths({0x23}).input, 0);
}

TEST(CfgLengths, EveryCompactIdentifierHasItsLengths) {
  for (unsigned id = 0; id < 256; ++id) {
    if ((id & 0x30U) == 0) continue;
    const auto lengths = cfg_lengths({static_cast<std::uint8_t>(id)});
    const int bytes = static_cast<int>((id & 0x0FU) + 1) * ((id & 0x40U) != 0 ? 2 : 1);
    EXPECT_TRUE(lengths.ok());
    EXPECT_EQ(lengths.input, (id & 0x10U) != 0 ? bytes : 0) << id;
    EXPECT_EQ(lengths.output, (id & 0x20U) != 0 ? bytes : 0) << id;
    EXPECT_FALSE(lengths.identifiers.at(0).special);
  }
}

TEST(CfgLengths, SpecialExampleOfTheManualIsSixteenWordsOutAndEightIn) {
  const auto lengths = cfg_lengths({0xC3, 0xCF, 0xC7, 0x11, 0x22, 0x33});
  ASSERT_TRUE(lengths.ok());
  ASSERT_EQ(lengths.identifiers.size(), 1U);
  EXPECT_EQ(lengths.output, 32);
  EXPECT_EQ(lengths.input, 16);
  EXPECT_TRUE(lengths.identifiers[0].output.whole);
  EXPECT_EQ(lengths.identifiers[0].vendor, (bus::Bytes{0x11, 0x22, 0x33}));
  EXPECT_EQ(describe(lengths.identifiers[0]),
            "input 8 words, consistent as a whole; output 16 words, consistent as a whole; 3 vendor bytes");
}

TEST(CfgLengths, SpecialIdentifierReachesSixtyFourWords) {
  EXPECT_EQ(cfg_lengths({0x40, 0x7F}).input, 128);
  EXPECT_EQ(cfg_lengths({0x80, 0x3F}).output, 64);
}

TEST(CfgLengths, EmptySlotsAndVendorBytesHaveNoData) {
  const auto lengths = cfg_lengths({0x00, 0x02, 0xAA, 0xBB, 0x10});
  ASSERT_EQ(lengths.identifiers.size(), 3U);
  EXPECT_EQ(lengths.input, 1);
  EXPECT_EQ(describe(lengths.identifiers[0]), "empty slot");
}

TEST(CfgLengths, VendorLengthFifteenHasNoBytesBehindIt) {
  const auto lengths = cfg_lengths({0x4F, 0x00, 0x10});
  EXPECT_TRUE(lengths.ok());
  EXPECT_EQ(lengths.input, 2);
}

TEST(CfgLengths, CutOffSpecialIdentifierIsAnError) {
  const auto lengths = cfg_lengths({0x10, 0xC2, 0x00});
  EXPECT_FALSE(lengths.ok());
  EXPECT_EQ(lengths.error, "identifier 0xC2 wants 4 more bytes, 1 follow");
  EXPECT_EQ(lengths.input, 1);
}

}  // namespace
}  // namespace dsdpv1
