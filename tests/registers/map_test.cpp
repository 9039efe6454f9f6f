// The map against the datasheet's own numbers (tables 2 to 14), written here a second time.
#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <string>

#include "registers/dsdpv1_regs.hpp"

namespace dsdpv1::regs {
namespace {

const Cell& cell_at(Address address) {
  return *std::find_if(
      std::begin(kMap), std::end(kMap), [address](const Cell& cell) { return address <= cell.last; });
}

TEST(RegisterMap, EveryAddressIsNamedOnce) {
  int expected = 0;
  for (const Cell& cell : kMap) {
    EXPECT_EQ(cell.first, expected) << cell.name;
    expected = cell.last + 1;
  }
  EXPECT_EQ(expected, 0x800);
  EXPECT_EQ(kDpramSize, 0x800);
}

TEST(RegisterMap, ControlBytesAreWhereTable2PutsThem) {
  EXPECT_EQ(kVersion, 0x000);
  EXPECT_EQ(kVersionYear, 0x001);
  EXPECT_EQ(kVersionMonth, 0x002);
  EXPECT_EQ(kVersionDay, 0x003);
  EXPECT_EQ(kValidFlag, 0x004);
  EXPECT_EQ(kDpv1Enable, 0x005);
  EXPECT_EQ(kAccessCount, 0x006);
  EXPECT_EQ(kOfflineCount, 0x008);
  EXPECT_EQ(kChipStatus1, 0x00A);
  EXPECT_EQ(kChipStatus2, 0x00B);
  EXPECT_EQ(kUserStatus1, 0x00C);
  EXPECT_EQ(kUserStatus2, 0x00D);
  EXPECT_EQ(kChipCommand1, 0x00E);
  EXPECT_EQ(kChipCommand2, 0x00F);
  EXPECT_EQ(kUserCommand1, 0x010);
  EXPECT_EQ(kUserCommand2, 0x011);
  EXPECT_EQ(kChipStatus3, 0x012);
  EXPECT_EQ(kChipStatus4, 0x013);
}

TEST(RegisterMap, InitialisationBytesAreWhereTable2PutsThem) {
  EXPECT_EQ(kInitAddress, 0x021);
  EXPECT_EQ(kInitIdentHigh, 0x022);
  EXPECT_EQ(kInitIdentLow, 0x023);
  EXPECT_EQ(kInitCommand, 0x024);
  EXPECT_EQ(kInitMaxInput, 0x027);
  EXPECT_EQ(kInitMaxOutput, 0x028);
  EXPECT_EQ(kInitMaxDiag, 0x029);
  EXPECT_EQ(kInitMaxPrm, 0x02A);
  EXPECT_EQ(kPrmMode, 0x02B);
  EXPECT_EQ(kInitMaxCfg, 0x02C);
  EXPECT_EQ(kCfgMode, 0x02D);
  EXPECT_EQ(kInitCfgLength, 0x02E);
  EXPECT_EQ(kInitCfg, 0x02F);
}

struct AreaCase {
  const char* name;
  Address first, size, crc;
  Address expected_first, expected_size, expected_crc;
};

TEST(RegisterMap, AreasHaveTable2sAddressesAndSizes) {
  const AreaCase areas[] = {
      {"init", kInit, kInitSize, kInitCrc, 0x020, 215, 0x0F7},
      {"input", kInput, kInputSize, kInputCrc, 0x130, 245, 0x225},
      {"diag", kDiag, kDiagSize, kDiagCrc, 0x227, 240, 0x317},
      {"output", kOutput, kOutputSize, kOutputCrc, 0x319, 245, 0x40E},
      {"prm", kPrm, kPrmSize, kPrmCrc, 0x410, 238, 0x4FE},
      {"cfg", kCfg, kCfgSize, kCfgCrc, 0x500, 203, 0x5CB},
      {"c1", kC1, kC1Size, kC1Crc, 0x5D0, 244, 0x6C4},
      {"c2", kC2, kC2Size, kC2Crc, 0x6D0, 244, 0x7C4},
  };
  for (const AreaCase& area : areas) {
    EXPECT_EQ(area.first, area.expected_first) << area.name;
    EXPECT_EQ(area.size, area.expected_size) << area.name;
    EXPECT_EQ(area.crc, area.expected_crc) << area.name;
  }
}

TEST(RegisterMap, VerdictBitsAreThoseOfTable10) {  // D4: the notes under the table have the two exchanged
  EXPECT_EQ(kUserCommand1PrmVerdict, 0x80);
  EXPECT_EQ(kUserCommand1CfgVerdict, 0x40);
  EXPECT_EQ(kUserStatus1PrmWrong, 0x01);
  EXPECT_EQ(kUserStatus1CfgWrong, 0x02);
  EXPECT_EQ(kUserCommand1, 0x010);
  EXPECT_EQ(kUserStatus1, 0x00C);
}

TEST(RegisterMap, BlocksBeginAsTable2Says) {
  EXPECT_EQ(kInitLength, 0x020);
  EXPECT_EQ(kInputLength, 0x130);
  EXPECT_EQ(kInputData, 0x131);
  EXPECT_EQ(kDiagType, 0x227);
  EXPECT_EQ(kDiagLength, 0x228);
  EXPECT_EQ(kDiagData, 0x229);
  EXPECT_EQ(kOutputLength, 0x319);
  EXPECT_EQ(kOutputData, 0x31A);
  EXPECT_EQ(kPrmLength, 0x410);
  EXPECT_EQ(kPrmData, 0x411);
  EXPECT_EQ(kCfgOutputLength, 0x500);
  EXPECT_EQ(kCfgInputLength, 0x501);
  EXPECT_EQ(kCfgLength, 0x502);
  EXPECT_EQ(kCfgData, 0x503);
  EXPECT_EQ(kC1FunctionNum, 0x5D0);
  EXPECT_EQ(kC1Slot, 0x5D1);
  EXPECT_EQ(kC1Index, 0x5D2);
  EXPECT_EQ(kC1Length, 0x5D3);
  EXPECT_EQ(kC1Data, 0x5D4);
  EXPECT_EQ(kC2FunctionNum, 0x6D0);
  EXPECT_EQ(kC2Slot, 0x6D1);
  EXPECT_EQ(kC2Index, 0x6D2);
  EXPECT_EQ(kC2Length, 0x6D3);
  EXPECT_EQ(kC2Data, 0x6D4);
}

struct FlagCase {
  Address byte;
  std::uint8_t flag;
  Address expected_byte;
  std::uint8_t expected_flag;
};

TEST(RegisterMap, FlagsAreTheBitsOfTables3To12) {
  const FlagCase flags[] = {
      {kChipStatus1, kChipStatus1Initialised, 0x00A, 0x01},
      {kChipStatus2, kChipStatus2InitCrc, 0x00B, 0x01},
      {kChipStatus2, kChipStatus2InputCrc, 0x00B, 0x04},
      {kChipStatus2, kChipStatus2DiagCrc, 0x00B, 0x08},
      {kChipStatus2, kChipStatus2C1Crc, 0x00B, 0x10},
      {kChipStatus2, kChipStatus2C2Crc, 0x00B, 0x20},
      {kUserStatus2, kUserStatus2CfgCrc, 0x00D, 0x01},
      {kUserStatus2, kUserStatus2PrmCrc, 0x00D, 0x02},
      {kUserStatus2, kUserStatus2OutputCrc, 0x00D, 0x04},
      {kUserStatus2, kUserStatus2C2Crc, 0x00D, 0x08},  // table 7 has C1 above C2, unlike table 4
      {kUserStatus2, kUserStatus2C1Crc, 0x00D, 0x10},
      {kChipCommand1, kChipCommand1Output, 0x00E, 0x01},
      {kChipCommand1, kChipCommand1Prm, 0x00E, 0x02},
      {kChipCommand1, kChipCommand1Cfg, 0x00E, 0x04},
      {kChipCommand2, kChipCommand2C1, 0x00F, 0x01},
      {kChipCommand2, kChipCommand2C2, 0x00F, 0x02},
      {kUserCommand1, kUserCommand1Input, 0x010, 0x01},
      {kUserCommand1, kUserCommand1Diag, 0x010, 0x02},
      {kUserCommand1, kUserCommand1Init, 0x010, 0x04},
      {kUserCommand2, kUserCommand2C1, 0x011, 0x01},
      {kUserCommand2, kUserCommand2C2, 0x011, 0x02},
      {kInitCommand, kInitCommandAddressChange, 0x024, 0x01},
      {kInitCommand, kInitCommandFreeze, 0x024, 0x02},
      {kInitCommand, kInitCommandSync, 0x024, 0x04},
      {kInitCommand, kInitCommandFailSafe, 0x024, 0x08},
  };
  for (const FlagCase& each : flags) {
    EXPECT_EQ(each.byte, each.expected_byte);
    EXPECT_EQ(each.flag, each.expected_flag) << std::hex << each.expected_byte;
  }
}

TEST(RegisterMap, StatusByte3HoldsBaudRateAndState) {
  EXPECT_EQ(kChipStatus3BaudRate, 0xF0);
  EXPECT_EQ(kChipStatus3BaudRateShift, 4);
  EXPECT_EQ(kChipStatus3DpState, 0x0C);
  EXPECT_EQ(kChipStatus3DpStateShift, 2);
}

TEST(RegisterMap, LimitsAreThoseOfRulingD7) {
  EXPECT_EQ(kInitAddressLimit, 126);
  EXPECT_EQ(kInitMaxInputLimit, 244);
  EXPECT_EQ(kInitMaxOutputLimit, 244);
  EXPECT_EQ(kInitMaxDiagLimit, 238);
  EXPECT_EQ(kInitMaxPrmLimit, 237);
  EXPECT_EQ(kInitMaxCfgLimit, 200);
}

TEST(RegisterMap, ResetValuesAreThoseOfRulingD1) {
  EXPECT_EQ(kVersionReset, 0x01);
  EXPECT_EQ(kVersionYearReset, 0x0D);
  EXPECT_EQ(kVersionMonthReset, 0x07);
  EXPECT_EQ(kVersionDayReset, 0x01);
  EXPECT_EQ(kValidFlagValid, 0xC5);
}

/// The last column of table 2; nothing: reserved, without an attribute.
struct Right {
  Address first, last;
  const char* user;
};
constexpr Right kTable2[] = {
    {0x000, 0x003, "R"},   {0x004, 0x004, "R"},   {0x005, 0x005, "R/W"}, {0x006, 0x006, "R/W"}, {0x007, 0x007, ""},
    {0x008, 0x009, "R"},   {0x00A, 0x00B, "R"},   {0x00C, 0x00D, "R/W"}, {0x00E, 0x00F, "R/W"}, {0x010, 0x011, "R/W"},
    {0x012, 0x013, "R"},   {0x014, 0x01F, ""},    {0x020, 0x0F6, "R/W"}, {0x0F7, 0x0F8, "R/W"}, {0x0F9, 0x12F, ""},
    {0x130, 0x224, "R/W"}, {0x225, 0x226, "R/W"}, {0x227, 0x316, "R/W"}, {0x317, 0x318, "R/W"}, {0x319, 0x40D, "R/W"},
    {0x40E, 0x40F, "R/W"}, {0x410, 0x4FD, "R"},   {0x4FE, 0x4FF, "R"},   {0x500, 0x5CA, "R"},   {0x5CB, 0x5CC, "R"},
    {0x5CD, 0x5CF, ""},    {0x5D0, 0x6C3, "R/W"}, {0x6C4, 0x6C5, "R/W"}, {0x6C6, 0x6CF, ""},    {0x6D0, 0x7C3, "R/W"},
    {0x7C4, 0x7C5, "R/W"}, {0x7C6, 0x7FF, ""},
};

TEST(RegisterMap, WhoWritesFollowsTable2) {
  int next = 0;
  for (const Right& right : kTable2) {
    EXPECT_EQ(right.first, next);
    for (next = right.first; next <= right.last; ++next) {
      if (next == kChipStatus1 || next == kChipStatus2)
        continue;  // R; but D5 and chapter 8 let the user clear their bits
      const Cell& cell = cell_at(static_cast<Address>(next));
      EXPECT_EQ(cell.user_writes, std::string(right.user) == "R/W") << cell.name;
      if (std::string(right.user) == "R") EXPECT_TRUE(cell.chip_writes) << cell.name << " has a writer";
      if (std::string(right.user).empty()) EXPECT_FALSE(cell.chip_writes) << cell.name;
    }
  }
  EXPECT_EQ(next, kDpramSize);
}

}  // namespace
}  // namespace dsdpv1::regs
