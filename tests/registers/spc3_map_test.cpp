// The map of the SPC3 family against the APC3 manual's own numbers (chapters 3 to 5), written here a second time.
#include <gtest/gtest.h>

#include <map>
#include <string>
#include <tuple>

#include "registers/spc3_regs.hpp"

namespace dsdpv1::spc3::regs {
namespace {

enum class Side { kRead, kWrite };

/// Address to name. A cell of several bytes stands at each of them.
std::map<int, std::string> names(Side side) {
  std::map<int, std::string> found;
  for (const Cell& cell : kMap)
    if (side == Side::kRead ? cell.user_reads : cell.user_writes)
      for (int address = cell.first; address <= cell.last; ++address) {
        EXPECT_EQ(found.count(address), 0U) << cell.name << " has the address of " << found[address];
        found[address] = cell.name;
      }
  return found;
}

TEST(Spc3Map, EveryAddressIsReadOnceAndRamIsWrittenOnce) {
  const auto reads = names(Side::kRead);
  EXPECT_EQ(reads.size(), 0x800U);
  const auto writes = names(Side::kWrite);
  for (int address = kOrg; address < 0x800; ++address) EXPECT_EQ(reads.at(address), writes.at(address));
}

TEST(Spc3Map, ReadSideIsThatOfTable32) {
  const char* expected[] = {"irr",          "irr",          "ir",       "ir",         "status",  "status",
                            "mode_0_read",  "mode_0_read",  "din_sm",   "new_din",    "dout_sm", "next_dout",
                            "diag_sm",      "new_diag",     "prm_ok",   "prm_not_ok", "cfg_ok",  "cfg_not_ok",
                            "reserved_012", "reserved_013", "ssa_free", "mode_1_read"};
  const auto reads = names(Side::kRead);
  int address = 0;
  for (const char* name : expected) EXPECT_EQ(reads.at(address++), name);
  EXPECT_EQ(address, kOrg);
}

TEST(Spc3Map, WriteSideIsThatOfTable33AsRulingA2ReadsIt) {
  const std::map<int, std::string> expected = {{0, "irr"},
                                               {1, "irr"},
                                               {2, "iar"},
                                               {3, "iar"},
                                               {4, "imr"},
                                               {5, "imr"},
                                               {6, "mode_0"},
                                               {7, "mode_0"},
                                               {8, "mode_1_s"},
                                               {9, "mode_1_r"},
                                               {10, "wd_baud_control"},
                                               {11, "min_tsdr"},
                                               {12, "mode_2"},
                                               {18, "mode_3"}};
  auto writes = names(Side::kWrite);
  writes.erase(writes.lower_bound(kOrg), writes.end());
  EXPECT_EQ(writes, expected);
}

TEST(Spc3Map, CommandsAreTheReadsThatAct) {
  std::string commands;
  for (const Cell& cell : kMap)
    if (cell.command) commands += std::string(cell.name) + " ";
  EXPECT_EQ(commands, "new_din next_dout new_diag prm_ok prm_not_ok cfg_ok cfg_not_ok ssa_free ");
}

TEST(Spc3Map, OrganisationIsThatOfClause33) {
  const std::tuple<Address, Address> cells[] = {{kOrg, 0x16},
                                                {kOrgAddress, 0x16},
                                                {kOrgSapPointer, 0x17},
                                                {kOrgUserWd, 0x18},
                                                {kOrgDoutLength, 0x1A},
                                                {kOrgDoutPointer, 0x1B},
                                                {kOrgDinLength, 0x1E},
                                                {kOrgDinPointer, 0x1F},
                                                {kOrgDiagLength, 0x24},
                                                {kOrgDiagPointer, 0x26},
                                                {kOrgAuxLength, 0x28},
                                                {kOrgAuxSelect, 0x2A},
                                                {kOrgAuxPointer, 0x2B},
                                                {kOrgSsaLength, 0x2D},
                                                {kOrgSsaPointer, 0x2E},
                                                {kOrgPrmLength, 0x2F},
                                                {kOrgPrmPointer, 0x30},
                                                {kOrgCfgLength, 0x31},
                                                {kOrgCfgPointer, 0x32},
                                                {kOrgReadCfgLength, 0x33},
                                                {kOrgReadCfgPointer, 0x34},
                                                {kOrgNoAddressChange, 0x39},
                                                {kOrgIdentLow, 0x3A},
                                                {kOrgIdentHigh, 0x3B},
                                                {kOrgGcCommand, 0x3C},
                                                {kOrgSpecPrmLength, 0x3D},
                                                {kBuffers, 0x40},
                                                {kRamSize, 0x600},
                                                {kOrg + kOrgSize, 0x40},
                                                {kBuffers + kBuffersSize, 0x600},
                                                {kBuffersVpc3 + kBuffersVpc3Size, 0x800}};
  for (const auto& [address, expected] : cells) EXPECT_EQ(address, expected);
  EXPECT_EQ(kOrgAuxSelectPrm | kOrgAuxSelectCfg << 4 | kOrgAuxSelectSsa << 8, 0x421);  // table 5.1
}

TEST(Spc3Map, EventsAreTheBitsOfTable45) {
  const int events[] = {kEventMacReset,    kEventDataEx,    kEventBaudDetect, kEventWdTimeout,
                        kEventUserTimer,   kEventReserved5, kEventReserved6,  kEventReserved7,
                        kEventNewGc,       kEventNewSsa,    kEventNewCfg,     kEventNewPrm,
                        kEventDiagChanged, kEventDxOut,     kEventReserved14, kEventReserved15};
  int bit = 0;
  for (const int event : events) EXPECT_EQ(event, 1 << bit++);
  EXPECT_EQ(kImrReset, 0xFFFF);
}

TEST(Spc3Map, StatusIsThatOfTable44) {
  EXPECT_EQ(kStatusPassiveIdle, 0x0001);
  EXPECT_EQ(kStatusDiagFlag, 0x0004);
  EXPECT_EQ(kStatusRamViolation, 0x0008);
  EXPECT_EQ(kStatusDpState, 0x0030);
  EXPECT_EQ(kStatusWdState, 0x00C0);
  EXPECT_EQ(kStatusBaudRate, 0x0F00);
  EXPECT_EQ(kStatusReset, 0x0F00);
  EXPECT_EQ(kDpStateWaitPrm, 0);
  EXPECT_EQ(kDpStateWaitCfg, 1);
  EXPECT_EQ(kDpStateDataEx, 2);
  EXPECT_EQ(kBaudRate9k6, 9);
}

TEST(Spc3Map, ModeBitsAreThoseOfTables42And43) {
  EXPECT_EQ(kMode0Combi, 1 << 3);
  EXPECT_EQ(kMode0IntPol, 1 << 4);
  EXPECT_EQ(kMode0EarlyRdy, 1 << 5);
  EXPECT_EQ(kMode0SyncSupported, 1 << 6);
  EXPECT_EQ(kMode0FreezeSupported, 1 << 7);
  EXPECT_EQ(kMode0DpMode, 1 << 8);
  EXPECT_EQ(kMode0EoiTimeBase, 1 << 9);
  EXPECT_EQ(kMode0WdTest, 1 << 11);
  EXPECT_EQ(kMode0SpecPrmBuf, 1 << 12);
  EXPECT_EQ(kMode0SpecClear, 1 << 13);
  EXPECT_EQ(kMode1Start, 1 << 0);
  EXPECT_EQ(kMode1Eoi, 1 << 1);
  EXPECT_EQ(kMode1GoOffline, 1 << 2);
  EXPECT_EQ(kMode1UserLeaveMaster, 1 << 3);
  EXPECT_EQ(kMode1EnChangeCfg, 1 << 4);
  EXPECT_EQ(kMode1ResUserWd, 1 << 5);
}

TEST(Spc3Map, BufferStatesAreThoseOfTables53To510) {
  EXPECT_EQ(kSmD | kSmN << 8 | kSmU << 16, 0x300C03);
  EXPECT_EQ(kSmF, 0xC0);
  EXPECT_EQ(kDinSmReset, 0xE1);  // A17
  EXPECT_EQ(kDoutSmReset, 0xE1);
  EXPECT_EQ(kDiagSmReset, 0x09);  // A18
  EXPECT_EQ(kNextDoutFresh, 0x04);
  EXPECT_EQ(kNextDoutCleared, 0x08);
  EXPECT_EQ(kVerdictFinished, 0);
  EXPECT_EQ(kVerdictConflict, 1);
  EXPECT_EQ(kVerdictNotAllowed, 3);
  EXPECT_EQ(kWdBaudControlReset, 0x1E);
  EXPECT_EQ(kMinTsdrReset, 0x0B);
}

}  // namespace
}  // namespace dsdpv1::spc3::regs
