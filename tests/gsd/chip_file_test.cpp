// scenarios/dsdpv1.gsd, the chip's own file.
#include <gtest/gtest.h>

#include "bus/gsd/setup.hpp"
#include "files.hpp"

namespace dsdpv1 {
namespace {

using gsd_test::content;
using gsd_test::lines;
using gsd_test::parse;

bus::Gsd chip() { return parse(content(GSD_CHIP), "dsdpv1.gsd").gsd.value(); }

TEST(ChipGsd, HasNothingToRemark) { EXPECT_EQ(lines(parse(content(GSD_CHIP))), std::vector<std::string>{}); }

TEST(ChipGsd, StatesTheFactsOfChapterEleven) {
  const bus::Gsd gsd = chip();
  EXPECT_EQ(gsd.revision, 5);
  EXPECT_EQ(gsd.ident, 0x0CC9);
  EXPECT_TRUE(gsd.freeze && gsd.sync && gsd.fail_safe && gsd.auto_baud && gsd.set_slave_add && gsd.wd_base_1ms &&
              gsd.modular);
  EXPECT_TRUE(gsd.dpv1 && gsd.c1_read_write && gsd.c2_read_write);
  EXPECT_EQ(gsd.c1_max_data, 240);
  EXPECT_EQ(gsd.c2_max_data, 240);
  EXPECT_EQ(gsd.c2_channels, 2);
  EXPECT_FALSE(gsd.is_master);
  EXPECT_EQ(gsd.min_slave_interval, 6);
  EXPECT_EQ(gsd.max_diag, 244);
  EXPECT_EQ(gsd.max_input, 244);
  EXPECT_EQ(gsd.max_output, 244);
}

TEST(ChipGsd, MaxTsdrIsThatOfRulingS3) {
  const bus::Gsd gsd = chip();
  const int from_12m[] = {800, 450, 250, 150, 100, 60, 60, 250, 60, 60};
  ASSERT_EQ(bus::kBaudCount, 10);
  for (int i = 0; i < bus::kBaudCount; ++i) {
    const bus::GsdBaud& rate = gsd.bauds.at(static_cast<std::size_t>(i));
    EXPECT_TRUE(rate.supported) << i;
    EXPECT_EQ(rate.max_tsdr, from_12m[i]) << bus::gsd_baud_name(i);
    EXPECT_EQ(bus::baud(i).max_tsdr_bits, from_12m[i]) << "what the bench's masters and tests go by";
  }
}

TEST(ChipGsd, EveryModuleFitsTheChipByItself) {
  const bus::Gsd gsd = chip();
  EXPECT_GE(gsd.modules.size(), 30U);
  for (const bus::GsdModule& module : gsd.modules) {
    EXPECT_TRUE(bus::set_up(gsd, {{module.name}, {}}).ok()) << module.name;
    EXPECT_TRUE(bus::set_up(gsd, {{std::to_string(module.reference.value())}, {}}).ok()) << module.name;
  }
}

TEST(ChipGsd, ModuleNamesSayTheirLengths) {
  const bus::Gsd gsd = chip();
  const auto both = bus::set_up(gsd, {{"8 bytes in, 4 bytes out"}, {}});
  EXPECT_EQ(both.lengths.input, 8);
  EXPECT_EQ(both.lengths.output, 4);
  const auto words = bus::set_up(gsd, {{"16 words in", "2 words out"}, {}});
  EXPECT_EQ(words.lengths.input, 32);
  EXPECT_EQ(words.lengths.output, 4);
}

TEST(ChipGsd, TwoModulesMakeTheLargestStation) {
  const auto setup =
      bus::set_up(chip(), {{"64 words in, 64 words out, consistent", "58 words in, 58 words out, consistent"}, {}});
  EXPECT_TRUE(setup.ok());
  EXPECT_EQ(setup.lengths.input, 244);
  EXPECT_EQ(setup.lengths.output, 244);
}

TEST(ChipGsd, ChipsSwitchesAreOffUntilAskedFor) {
  const bus::Gsd gsd = chip();
  EXPECT_EQ(bus::set_up(gsd, {{"1 byte in"}, {}}).user_prm, (bus::Bytes{0, 0, 0}));
  const auto on =
      bus::set_up(gsd, {{"1 byte in"}, {{std::nullopt, "DPV1_Enable", "on"}, {std::nullopt, "WD_Base", "1 ms"}}});
  EXPECT_TRUE(on.ok());
  EXPECT_EQ(on.user_prm, (bus::Bytes{0x84, 0, 0}));
}

}  // namespace
}  // namespace dsdpv1
