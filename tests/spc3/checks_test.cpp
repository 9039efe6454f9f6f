// The checks of the user's side: a right user violates none, and each rule is found broken by a fault planted for it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "model/spc3/reasons.hpp"
#include "tests/spc3/script.hpp"

namespace dsdpv1::spc3_test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// A fault of the user, and a word of what is said about it.
struct Planted {
  const char* id;
  const char* name;
  void (*fault)(Script&);
  const char* said;
};

/// An initialisation with one other byte.
template <Address kCell, std::uint8_t kValue>
void start_with(Script& user) {
  user.initialise();
  user.write(kCell, kValue);
  user.start();
}

/// An access at the pins of the asynchronous Intel bus up to XREADY.
void begin_access(Script& user, Pin strobe) {
  user.pin(Pin::kAb, 0x300);
  user.pin(Pin::kDbIn, 0x55);
  user.pin(Pin::kXCs, 0);
  user.pin(strobe, 0);
  user.now += 1000;
}

/// A frame of SPI with so many bits; `half` a period of SCK.
void spi_frame(Script& user, const Bytes& bytes, std::size_t bits, Tick half = 1200) {
  user.pin(Pin::kSerial, 1);
  user.pin(Pin::kXss, 0);
  for (std::size_t i = 0; i < bits; ++i) {
    user.pin(Pin::kMosi, static_cast<tb::Level>(bytes[i / 8] >> (7 - i % 8) & 1));
    user.now += half;
    user.pin(Pin::kSck, 1);
    user.now += half;
    user.pin(Pin::kSck, 0);
  }
  user.pin(Pin::kXss, 1);
  user.checks.finish(user.now);
}

const Planted kPlanted[] = {
    {"SPI_CLOCK", "At6MHz",
     [](Script& user) {
       user.pin(Pin::kSerial, 1);
       user.pin(Pin::kXss, 0);
       for (const Tick half : {1200, 950})
         for (const int level : {1, 0}) {
           user.now += half;
           user.pin(Pin::kSck, static_cast<tb::Level>(level));
         }
     },
     "in a frame"},
    {"SPI_DATA", "MosiWithSck",
     [](Script& user) {
       user.pin(Pin::kSerial, 1);
       user.pin(Pin::kXss, 0);
       user.pin(Pin::kMosi, 1);
       user.now -= 6;
       user.pin(Pin::kSck, 1);
     },
     "MOSI before SCK"},
    {"SPI_DATA", "MosiRightAfterSck",
     [](Script& user) {
       user.pin(Pin::kSerial, 1);
       user.pin(Pin::kXss, 0);
       user.pin(Pin::kSck, 1);
       user.now -= 6;
       user.pin(Pin::kMosi, 1);
     },
     "MOSI after SCK"},
    {"SPI_FRAME", "NoInstruction",
     [](Script& user) {
       spi_frame(user, {0x55, 3, 0, 1}, 32);
     },
     "instruction 55: no"},
    {"SPI_FRAME", "Cut",
     [](Script& user) {
       spi_frame(user, {0x02, 3, 0, 1, 2}, 38);
     },
     "write 300, 1 bytes: cut after 4 bytes and 6 bits"},
    {"SPI_FRAME", "NoData",
     [](Script& user) {
       spi_frame(user, {0x03, 3, 0}, 24);
     },
     "cut after 3 bytes and 0 bits"},
    {"SPI_FRAME", "TwoBytes",
     [](Script& user) {
       spi_frame(user, {0x12, 3, 0, 1, 2}, 40);
     },
     "2 bytes of data, one"},
    {"SPI_FRAME", "BeyondTheMap",
     [](Script& user) {
       spi_frame(user, {0x02, 0x12, 0, 1}, 32);
     },
     "beyond the map"},
    {"SPI_ARRAY", "OfRegisters",
     [](Script& user) {
       spi_frame(user, {0x03, 0, 0, 0}, 32);
     },
     "read 000, 1 bytes"},
    {"BUS_READY", "TooShort",
     [](Script& user) {
       begin_access(user, Pin::kXWr);
       user.pin(Pin::kXWr, 1);
     },
     "write of 300H"},
    {"BUS_READY", "ReadyOfTheAccessBeforeHasRisen",
     [](Script& user) {
       user.pin(Pin::kXReady, 0);
       begin_access(user, Pin::kXWr);
       user.pin(Pin::kXReady, 1);
       user.pin(Pin::kXWr, 1);
     },
     "write of 300H"},
    {"BUS_SETUP", "AddressMovesInTheStrobe",
     [](Script& user) {
       begin_access(user, Pin::kXRd);
       user.pin(Pin::kAb, 0x301);
       user.pin(Pin::kXReady, 0);
       user.pin(Pin::kXRd, 1);
     },
     "-84.333 ns"},
    {"BUS_DATA", "Late",
     [](Script& user) {
       begin_access(user, Pin::kXWr);
       user.pin(Pin::kXReady, 0);
       user.pin(Pin::kDbIn, 0x56);
       user.pin(Pin::kXWr, 1);
     },
     "1.000 ns of at least 20.833 ns"},
    {"BUS_HOLD", "NoDataAfterTheStrobe",
     [](Script& user) {
       begin_access(user, Pin::kXWr);
       user.pin(Pin::kXReady, 0);
       user.pin(Pin::kXWr, 1);
       user.checks.pin(user.now, spc3::number(Pin::kDbIn), tb::kLevelZ);
     },
     "0.000 ns of at least 1.000 ns"},
    {"BUS_LEVELS", "NoData",
     [](Script& user) {
       user.pin(Pin::kDbIn, 1);
       begin_access(user, Pin::kXWr);
       user.pin(Pin::kDbIn, tb::kLevelZ);
       user.now += 1000;
       user.pin(Pin::kXReady, 0);
       user.pin(Pin::kXWr, 1);
     },
     "DB without levels"},
    {"BUS_LEVELS", "NoAddressOfAn80C32",
     [](Script& user) {
       user.pin(Pin::kMode, 1);
       user.pin(Pin::kAb, tb::kLevelZ);
       user.pin(Pin::kXRd, 0);
       user.pin(Pin::kXRd, 1);
     },
     "AB without levels"},
    {"BUS_STROBES", "BothBeforeAnAddressSelects",
     [](Script& user) {
       user.pin(Pin::kMode, 1);
       user.pin(Pin::kAb, 0x40);
       user.pin(Pin::kXRd, 0);
       user.pin(Pin::kXWr, 0);
       user.now += 1000;
       user.pin(Pin::kAb, 0x03);
       user.now += 1000;
       user.pin(Pin::kXWr, 1);
       user.pin(Pin::kXRd, 1);
     },
     "at once"},
    {"BUS_STROBES", "Both",
     [](Script& user) {
       begin_access(user, Pin::kXRd);
       user.pin(Pin::kXReady, 0);
       user.pin(Pin::kXWr, 0);
       user.pin(Pin::kXRd, 1);
       user.pin(Pin::kXReady, 1);
       user.pin(Pin::kXReady, 0);
       user.now += 1000;
       user.pin(Pin::kXWr, 1);
     },
     "at once"},

    {"START_MODE", "NoDpMode", start_with<regs::kMode0 + 1, 0>, "mode register 0 is 0000"},
    {"START_MODE", "WdTest", start_with<regs::kMode0 + 1, 9>, "mode register 0 is 0900"},
    {"START_STATION", "Address127", start_with<regs::kOrgAddress, 127>, "address 127"},
    {"START_STATION", "Ident0",
     [](Script& user) {
       user.initialise();
       user.write_word(regs::kOrgIdentLow, 0);
       user.start();
     },
     "ident 0000"},
    {"START_POINTER", "Below40", start_with<regs::kOrgDoutPointer, 7>, "1BH: 2 bytes from 038, before 040"},
    {"START_POINTER", "BeyondTheRam", start_with<regs::kOrgCfgPointer, 0xBF>,
     "32H: 16 bytes from 5F8, the RAM ends at 600"},
    {"START_POINTER", "Overlap", start_with<regs::kOrgPrmPointer, 19>, "2EH: 16 bytes from 090, 30H begins at 098"},
    {"START_POINTER", "GroupsUnequal", start_with<regs::kOrgAuxLength, 17>, "bytes from"},
    {"START_LENGTH", "DiagOf5", start_with<regs::kOrgDiagLength + 1, 5>, "25H is 5, 6 to 244"},
    {"START_LENGTH", "NoAux2", start_with<regs::kOrgAuxSelect, regs::kOrgAuxSelectPrm>, "29H is 0, 7 to 244"},
    {"START_PRESET", "Reserved", start_with<0x35, 1>, "35H is not set to 00"},
    {"START_PRESET", "ListOfSaps", start_with<regs::kOrgSapPointer, 0xFF>, "17H does not point to FF"},
    {"START_PRESET", "NoResUserWd",
     [](Script& user) {
       user.initialise();
       user.write(regs::kMode1R, regs::kMode1ResUserWd);
       user.start();
     },
     "Res_User_Wd"},
    {"START_OUTPUTS", "NotCleared", start_with<Script::kDout2 + 1, 1>, "049H"},
    {"USE_ORGANISATION", "Mode0",
     [](Script& user) {
       user.online();
       user.write(regs::kMode0, 0);
     },
     "00 to 06H online"},
    {"USE_ORGANISATION", "LengthInDataEx",
     [](Script& user) {
       user.data_ex();
       user.read_events(regs::kEventNewCfg);
       user.write(regs::kOrgDoutLength, 1);
     },
     "01 to 1AH online"},
    {"USE_ORGANISATION", "LengthWithoutCfg",
     [](Script& user) {
       user.online();
       user.write(regs::kOrgDinLength, 1);
     },
     "01 to 1EH online"},
    {"USE_ORGANISATION", "LengthOfTheChipsDiagnosis",
     [](Script& user) {
       user.online();
       user.write(regs::kOrgDiagLength + 1, 8);
     },
     "08 to 25H online"},
    {"USE_RAM", "Beyond",
     [](Script& user) {
       user.online();
       user.read(0x612);
     },
     "612H is beyond the RAM, which ends at 600"},
    {"USE_DATA", "OldOutputs",
     [](Script& user) {
       user.data_ex();
       user.read(regs::kNextDout, 1 | regs::kNextDoutFresh);
       user.read(Script::kDout2);
     },
     "048H is in buffer 2 of Dout, the user's is 1"},
    {"USE_DATA", "InputsOfTheChip",
     [](Script& user) {
       user.data_ex();
       user.write(Script::kDin1, 1);
     },
     "058H is in buffer 1 of Din, the user's is 3"},
    {"USE_DIAG", "TheChips",
     [](Script& user) {
       user.online();
       user.write(Script::kDiag2, 0);
     },
     "the chip's"},
    {"USE_DIAG", "AfterAnswer0",
     [](Script& user) {
       user.online();
       user.read(regs::kNewDiag, 0);
       user.write(Script::kDiag1 + 1, 0);
     },
     "New_Diag has answered 0"},
    {"USE_BLOCK", "Aux",
     [](Script& user) {
       user.online();
       user.read(Script::kAux << 3);
     },
     "080H"},
    {"USE_BLOCK", "StalePointer",
     [](Script& user) {
       user.online();
       user.open_prm();
       user.read(regs::kPrmOk, regs::kVerdictConflict);
       user.read(Script::kAux << 3);
     },
     "080H"},
    {"ACK_TIME", "NeverAnswered",
     [](Script& user) {
       user.online();
       user.open_prm();
       user.wait_ms(101);
     },
     "New_Prm_Data: no answer"},
    {"ACK_TIME", "NeverLooked",
     [](Script& user) {
       user.online();
       user.tell(spc3::Reason::kToUser.row(), 1);
       user.wait_ms(101);
     },
     "New_Cfg_Data: no answer"},
    {"ACK_TIME", "NoSecondRound",
     [](Script& user) {
       user.online();
       user.open_prm();
       user.wait_ms(99);
       user.read(regs::kPrmOk, regs::kVerdictConflict);
       user.wait_ms(101);
     },
     "New_Prm_Data: no answer"},
    {"ACK_FOUNDED", "NoEvent",
     [](Script& user) {
       user.online();
       user.read(regs::kPrmOk, regs::kVerdictNotAllowed);
     },
     "0EH (answer 3): New_Prm_Data was not seen"},
    {"ACK_FOUNDED", "Unread",
     [](Script& user) {
       user.online();
       user.read_events(regs::kEventNewCfg);
       user.read(regs::kCfgOk, regs::kVerdictFinished);
     },
     "New_Cfg_Data, its buffer was not read"},
    {"ACK_SWEEP", "Dump",
     [](Script& user) {
       user.online();
       for (Address each = 0; each <= regs::kMode1Read; ++each) user.read(each, each == 0x04 ? 1 : 0);
     },
     "09H is read after 08H"},
    {"IRQ_EOI", "None",
     [](Script& user) {
       user.online();
       user.pin(Pin::kXInt, 0);
       user.wait_ms(101);
     },
     "no EOI"},
    {"IRQ_SEEN", "AllOnes",
     [](Script& user) {
       user.online();
       user.read_events(regs::kEventDxOut);
       user.write(regs::kIar + 1, 0xFF);
     },
     "clears unseen events, if they have come: 1300"},
    {"IRQ_SEEN", "ZeroToIrr",
     [](Script& user) {
       user.online();
       user.write(regs::kIrr + 1, 0);
     },
     "if they have come: 3F00"},
    {"IRQ_MASK", "OverAStandingEvent",
     [](Script& user) {
       user.online();
       user.read_events(regs::kEventNewGc);
       user.write(regs::kImr + 1, 0xFE);
     },
     "events 0100 stand"},
    {"LIVE_OUTPUTS", "NeverFetched",
     [](Script& user) {
       user.data_ex();
       user.exchange();
       user.exchange();
       user.read(regs::kNewDin, 3);
       user.wait_ms(60);
       user.exchange();
       user.read(regs::kNewDin, 3);
       user.wait_ms(60);
     },
     "outputs of 2 data telegrams"},
    {"LIVE_INPUTS", "NeverRenewed",
     [](Script& user) {
       user.data_ex();
       user.wait_ms(101);
     },
     "no New_Din"},
    {"LIVE_WATCHDOG", "NearItsEnd",
     [](Script& user) {
       user.data_ex();
       for (int i = 0; i < 21; ++i) user.exchange();
     },
     "95 of at most 90, per cent: 19 data telegrams"},
    {"LIVE_FIRST", "NoNewDin",
     [](Script& user) {
       user.initialise();
       user.start();
       user.pin(Pin::kXDataExch, 0);
     },
     "New_Din was never read"},
};

class Spc3PlantedFaults : public testing::TestWithParam<Planted> {};

TEST_P(Spc3PlantedFaults, AreFoundByTheirRuleAlone) {
  const Planted& planted = GetParam();
  Script user;
  planted.fault(user);
  ASSERT_THAT(user.ids(), ElementsAre(planted.id));
  EXPECT_THAT(user.found.front().text, HasSubstr(planted.said));
}

INSTANTIATE_TEST_SUITE_P(Each, Spc3PlantedFaults, testing::ValuesIn(kPlanted),
                         [](const auto& each) { return std::string(each.param.id) + "_" + each.param.name; });

TEST(ListOfPlantedFaults, HasEachRuleWithALimit) {
  std::set<std::string> planted, ruled;
  for (const Planted& each : kPlanted) planted.insert(each.id);
  for (const checks::Rule& each : spc3_checks::rules())
    if (each.limit != checks::kNoLimit) ruled.insert(each.id);
  EXPECT_EQ(planted, ruled);
}

// --- what is right
// -----------------------------------------------------------------------------------------------------

TEST(RightUserOfAnSpc3, HasFramesOfSpi) {
  Script user(spc3::Variant::kVpc3);
  spi_frame(user, {0x13, 0, 4, 0}, 32);
  spi_frame(user, {0x02, 3, 0, 1, 2, 3}, 48);
  spi_frame(user, {0x03, 3, 0, 0, 0}, 40);
  spi_frame(user, {}, 0);
  EXPECT_THAT(user.ids(), IsEmpty());
  EXPECT_EQ(user.checks.record(Check::kSpiFrame).count, 3U);
  EXPECT_TRUE(user.checks.applies(Check::kSpiClock));
  EXPECT_FALSE(user.checks.applies(Check::kBusReady));
}

/// A long `ready_release`: the next access has no fall.
TEST(RightUserOfAnSpc3, MeetsXreadyStillLow) {
  Script user;
  begin_access(user, Pin::kXWr);
  user.pin(Pin::kXReady, 0);
  user.pin(Pin::kXWr, 1);
  begin_access(user, Pin::kXWr);
  user.pin(Pin::kXWr, 1);
  EXPECT_THAT(user.ids(), IsEmpty());
  EXPECT_EQ(user.checks.record(Check::kBusReady).count, 2U);
  EXPECT_EQ(user.checks.record(Check::kBusReady).worst_value, 12);
}

TEST(RightUserOfAnSpc3, BeginsAndJudges) {
  Script user;
  user.initialise();
  user.write(regs::kMode1S, regs::kMode1EnChangeCfg);
  user.read(regs::kNewDin, 3);
  user.start();
  user.open_prm();
  user.read(regs::kPrmOk, regs::kVerdictConflict);
  user.read_events(regs::kEventNewPrm);
  user.read(regs::kOrgPrmPointer, Script::kPrm);
  user.read(Script::kPrm << 3);
  user.read(regs::kPrmNotOk);
  user.read_events(regs::kEventNewCfg);
  user.read(regs::kOrgCfgPointer, Script::kAux);
  user.read(Script::kAux << 3);
  user.write(Script::kDout1 + 2, 0);  // what a third output gains (A27)
  user.write(regs::kOrgDoutLength, 3);
  user.write(regs::kOrgReadCfgLength, 1);
  user.read(regs::kCfgOk);
  user.read(Script::kAux << 3);  // the Read_Cfg buffer now (A26)
  EXPECT_THAT(user.ids(), IsEmpty());
  user.read(24 << 3);  // and that one is exchanged by telegrams
  EXPECT_THAT(user.ids(), ElementsAre("USE_BLOCK"));
}

TEST(RightUserOfAnSpc3, ExchangesData) {
  Script user;
  user.data_ex();
  for (int i = 0; i < 100; ++i) {
    user.exchange();
    user.pin(Pin::kXInt, 0);
    user.read_events(regs::kEventDxOut);
    user.write_word(regs::kIar, regs::kEventDxOut);
    user.read(regs::kNextDout, static_cast<std::uint8_t>(regs::kNextDoutFresh | (i % 3 + 1)));
    user.read(static_cast<Address>(Script::kDout1 + 8 * (i % 3)));
    user.write(static_cast<Address>(Script::kDin1 + 8 * (i == 0 ? 2 : (i - 1) % 3)), 1);
    user.read(regs::kNewDin, static_cast<std::uint8_t>(i % 3 + 1));
    user.write(regs::kMode1S, regs::kMode1ResUserWd | regs::kMode1Eoi);
    user.pin(Pin::kXInt, 1);
    user.wait_ms(9);
  }
  user.checks.finish(user.now);
  EXPECT_THAT(user.ids(), IsEmpty());
  const auto margin = [&user](Check check) { return *user.checks.record(check).worst_margin / bus::kTicksPerMs; };
  EXPECT_EQ(margin(Check::kLiveInputs), 90);
  EXPECT_EQ(margin(Check::kLiveOutputs), 99);
  EXPECT_EQ(margin(Check::kIrqEoi), 99);
  EXPECT_EQ(user.checks.record(Check::kLiveWatchdog).worst_value, 0);
  EXPECT_EQ(user.checks.record(Check::kLiveOutputs).count, 99U) << "the address is learnt from the first answer";
}

TEST(RightUserOfAnSpc3, WaitsForItsDiagnosisBuffer) {
  Script user;
  user.online();
  user.write(Script::kDiag1, 1);
  user.write(regs::kOrgDiagLength, 8);
  user.read(regs::kNewDiag, 0);
  user.read_events(regs::kEventDiagChanged);
  user.write(Script::kDiag2, 1);
  user.read(regs::kNewDiag, 1);
  user.write(Script::kDiag1, 1);
  EXPECT_THAT(user.ids(), IsEmpty());
}

TEST(RightUserOfAnSpc3, FindsNoOutputsUnderSync) {
  for (const auto& [address, value] : {std::pair<Address, std::uint8_t>(regs::kDoutSm, 0xE1), {regs::kIrr + 1, 0}}) {
    Script user;
    user.data_ex();
    for (int i = 0; i < 15; ++i) {
      user.exchange();
      user.read(address, value);
      user.read(regs::kNewDin, 3);
      user.wait_ms(10);
    }
    EXPECT_THAT(user.ids(), IsEmpty()) << address;
  }
}

TEST(RightUserOfAnSpc3, IsNotInterruptedUnderSync) {
  Script user;
  user.online();
  user.write(regs::kImr + 1, 0xDF);
  user.pin(Pin::kXDataExch, 0);
  for (int i = 0; i < 15; ++i) {
    user.exchange();
    user.read(regs::kNewDin, 3);
    user.wait_ms(10);
  }
  EXPECT_THAT(user.ids(), IsEmpty());
}

/// OFFLINE the user may do all that it must not online.
TEST(RightUserOfAnSpc3, BeginsAgain) {
  for (int way = 0; way < 4; ++way) {
    Script user;
    user.online();
    user.open_prm();
    if (way == 0) user.read(regs::kStatus, 0);
    if (way == 1) user.read_events(regs::kEventMacReset);
    if (way == 2) user.tell(spc3::Reason::kOffline.row());
    if (way == 3) {
      user.pin(Pin::kReset, 1);
      user.write(regs::kOrgAddress, 200);  // does nothing
      user.pin(Pin::kReset, 0);
    }
    user.read(regs::kPrmNotOk, regs::kVerdictNotAllowed);
    user.write_word(regs::kIar, 0xFFFF);
    user.read(Script::kAux << 3);
    user.initialise();
    user.read(regs::kNewDin, 3);
    user.start();
    user.read_events(0);
    user.write(Script::kDiag1, 1);
    user.wait_ms(101);
    EXPECT_THAT(user.ids(), IsEmpty()) << way;
  }
}

TEST(RightUserOfAnSpc3, MayMissABlockOfAMasterThatHasGone) {
  Script user;
  user.online();
  user.tell(spc3::Reason::kToUser.row(), 0);
  user.tell(profibus::Reason::kDpState.row(), 2, 1);
  user.wait_ms(101);
  EXPECT_THAT(user.ids(), IsEmpty());
}

TEST(RightUserOfAnSpc3, SetsUpTheRamOfItsName) {
  Script user(spc3::Variant::kVpc3);
  user.initialise();
  user.write(regs::kOrgCfgPointer, 0xBF);
  user.start();
  user.read(0x7FF);
  EXPECT_THAT(user.ids(), IsEmpty());
  user.read(0x800);
  EXPECT_THAT(user.ids(), ElementsAre("USE_RAM"));
}

TEST(ChecksOfAnSpc3, CountWritesThatDoNothing) {
  Script user;
  user.online();
  user.write(regs::kMode1S, regs::kMode1Eoi);
  user.read_events(regs::kEventNewPrm);
  user.write_word(regs::kIar, regs::kEventNewPrm);
  EXPECT_THAT(user.ids(), IsEmpty());
  EXPECT_EQ(user.checks.record(Check::kIrqIdle).worst_value, 2);
}

TEST(ChecksOfAnSpc3, JudgeNothingWithoutAccesses) {
  Script user;
  EXPECT_FALSE(user.checks.applies(Check::kAckTime));
  user.read(regs::kStatus);
  EXPECT_TRUE(user.checks.applies(Check::kAckTime));
}

}  // namespace
}  // namespace dsdpv1::spc3_test
