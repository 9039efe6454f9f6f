// The driver of the SPC3 family against a chip that is no more than memory: what is written, in which order, and which
// commands follow.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <sstream>
#include <string>
#include <utility>

#include "tests/driver/spc3/fake_spc3.hpp"

namespace dsdpv1::spc3 {
namespace {

using namespace regs;  // NOLINT(google-build-using-namespace): the whole file is about them
using Bytes = FakeSpc3::Bytes;
using testing::ElementsAre;
using testing::IsEmpty;

class Spc3DriverTest : public testing::Test {
 protected:
  void SetUp() override {
    application.ctx = this;
    application.prm = [](void* ctx, const std::uint8_t* bytes, std::uint8_t length) {
      auto& test = *static_cast<Spc3DriverTest*>(ctx);
      test.prm_seen.emplace_back(bytes, bytes + length);
      return test.prm_right;
    };
    application.address = [](void* ctx, std::uint8_t now, bool locked, const std::uint8_t* more, std::uint8_t length) {
      auto& test = *static_cast<Spc3DriverTest*>(ctx);
      test.address = {now, locked};
      test.rest.assign(more, more + length);
    };
    application.control = [](void* ctx, std::uint8_t command) {
      static_cast<Spc3DriverTest*>(ctx)->controls.push_back(command);
    };
    config.address = 5;
    config.ident = 0x0CC9;
    config.max_output = 4;
    config.max_input = 10;
    config.max_diag = 9;
    config.max_prm = 20;
    config.max_cfg = 3;
    config.cfg = cfg.data();
    config.cfg_length = 2;
  }

  void judge_cfg_by_test() {
    application.cfg = [](void* ctx, spc3_cfg* block) {
      auto& test = *static_cast<Spc3DriverTest*>(ctx);
      test.cfg_seen.emplace_back(block->bytes, block->bytes + block->length);
      test.offered = {block->output_length, block->input_length};
      if (test.lengths.first >= 0) block->output_length = static_cast<std::uint8_t>(test.lengths.first);
      if (test.lengths.second >= 0) block->input_length = static_cast<std::uint8_t>(test.lengths.second);
      return test.cfg_right;
    };
  }

  /// Up to and with START; the reset states of the buffers (A17, A18), D cleared by START.
  void start() {
    chip.answers[kStatus] = 0;
    const spc3_port port = chip.port();
    ASSERT_EQ(spc3_open(&device, &port, &application), SPC3_OK);
    ASSERT_EQ(spc3_initialise(&device, &config), SPC3_OK);
    chip.answers[kDinSm] = kDinSmReset;
    chip.answers[kDoutSm] = 0x27;
    chip.answers[kDiagSm] = kDiagSmReset;
    spc3_start(&device);
    chip.commands.clear();
    chip.writes.clear();
  }

  spc3_error initialise() {
    const spc3_port port = chip.port();
    EXPECT_EQ(spc3_open(&device, &port, &application), SPC3_OK);
    return spc3_initialise(&device, &config);
  }

  void dp_state(std::uint8_t state) {
    chip.answers[kStatus] = static_cast<std::uint8_t>(state << kStatusDpStateShift | 1);
  }

  FakeSpc3 chip;
  spc3_device device{};
  spc3_application application{};
  spc3_config config{};
  Bytes cfg = {0x13, 0x29};
  bool prm_right = true, cfg_right = true;
  std::pair<int, int> lengths{-1, -1}, offered, address;
  std::vector<Bytes> prm_seen, cfg_seen;
  Bytes rest, controls;
};

// ---------------------------------------------------------------------------------------------------------- bring-up

TEST_F(Spc3DriverTest, OrganisationIsThatOfTheConfiguration) {
  config.address_locked = true;
  config.user_wd = 0x1234;
  ASSERT_EQ(initialise(), SPC3_OK);
  EXPECT_EQ(chip.ram[kOrgAddress], 5);
  EXPECT_EQ(chip.ram[static_cast<std::size_t>(chip.ram[kOrgSapPointer] << 3)], 0xFF);
  EXPECT_EQ(chip.ram[kOrgUserWd], 0x34);
  EXPECT_EQ(chip.ram[kOrgUserWd + 1], 0x12);
  EXPECT_EQ(chip.ram[kOrgDoutLength], 4);
  EXPECT_EQ(chip.ram[kOrgDinLength], 10);
  EXPECT_EQ(chip.ram[kOrgDiagLength], 6);
  EXPECT_EQ(chip.ram[kOrgDiagLength + 1], 6);
  EXPECT_EQ(chip.ram[kOrgNoAddressChange], kAddressChangeLocked);
  EXPECT_EQ(chip.ram[kOrgIdentLow], 0xC9);
  EXPECT_EQ(chip.ram[kOrgIdentHigh], 0x0C);
  EXPECT_EQ(chip.ram[kOrgReadCfgLength], 2);
  EXPECT_EQ(chip.buffer(kOrgReadCfgPointer, 2), cfg);
  EXPECT_EQ(chip.ram[kOrgSsaPointer], 0);  // no Set_Slave_Address
  config.address_locked = false;
  config.max_ssa = 4;
  ASSERT_EQ(initialise(), SPC3_OK);
  EXPECT_EQ(chip.ram[kOrgNoAddressChange], 0);
  EXPECT_NE(chip.ram[kOrgSsaPointer], 0);
  for (const std::size_t preset : {0x22U, 0x23U, 0x35U, 0x36U, 0x37U, 0x38U}) EXPECT_EQ(chip.ram.at(preset), 0);
}

TEST_F(Spc3DriverTest, RegistersAreThoseOfTheConfiguration) {
  config.sync = config.freeze = config.int_active_high = true;
  config.interrupts = kEventNewPrm | kEventNewCfg | kEventMacReset;
  config.min_tsdr = 60;
  config.change_cfg = true;
  ASSERT_EQ(initialise(), SPC3_OK);
  EXPECT_EQ(chip.last(kMode0), kMode0SyncSupported | kMode0FreezeSupported | kMode0IntPol);
  EXPECT_EQ(chip.last(kMode0 + 1), kMode0DpMode >> 8);
  EXPECT_EQ(chip.last(kImr), 0xFE);
  EXPECT_EQ(chip.last(kImr + 1), 0xF3);
  EXPECT_EQ(chip.last(kMinTsdr), 60);
  EXPECT_EQ(chip.last(kWdBaudControl), kWdBaudControlReset);
  EXPECT_EQ(chip.last(kMode1S), kMode1EnChangeCfg);
  chip.writes.clear();
  config.change_cfg = false;
  config.min_tsdr = 0;
  config.baud_control = 44;
  ASSERT_EQ(initialise(), SPC3_OK);
  EXPECT_EQ(chip.last(kMode1R), kMode1EnChangeCfg) << "it stays through OFFLINE";
  EXPECT_EQ(chip.last(kMinTsdr), -1) << "the chip's own";
  EXPECT_EQ(chip.last(kWdBaudControl), 44);
}

TEST_F(Spc3DriverTest, EachModeBitHasItsMember) {
  const std::pair<bool spc3_config::*, int> bits[] = {
      {&spc3_config::sync, kMode0SyncSupported},       {&spc3_config::freeze, kMode0FreezeSupported},
      {&spc3_config::clear_by_empty, kMode0SpecClear}, {&spc3_config::combined, kMode0Combi},
      {&spc3_config::int_active_high, kMode0IntPol},   {&spc3_config::int_pause_1ms, kMode0EoiTimeBase}};
  for (const auto& [member, bit] : bits) {
    config.*member = true;
    ASSERT_EQ(initialise(), SPC3_OK);
    EXPECT_EQ(chip.last(kMode0) | chip.last(kMode0 + 1) << 8, bit | kMode0DpMode);
    config.*member = false;
  }
}

TEST_F(Spc3DriverTest, StartComesLastAndTheUserWatchdogIsServedBefore) {
  ASSERT_EQ(initialise(), SPC3_OK);
  EXPECT_THAT(chip.writes, testing::Each(testing::Truly([](const FakeSpc3::Write& each) {
                return each.address != kMode1S || (each.value & kMode1Start) == 0;
              })));
  chip.writes.clear();
  spc3_start(&device);
  ASSERT_EQ(chip.writes.size(), 2U);
  EXPECT_EQ(chip.writes[0].address, kMode1S);
  EXPECT_EQ(chip.writes[0].value, kMode1ResUserWd);
  EXPECT_EQ(chip.writes[1].address, kMode1S);
  EXPECT_EQ(chip.writes[1].value, kMode1Start);
}

TEST_F(Spc3DriverTest, InterruptsAreMaskedUntilTheOrganisationIsWritten) {
  config.interrupts = kEventNewPrm;
  ASSERT_EQ(initialise(), SPC3_OK);
  EXPECT_EQ(chip.writes[0].address, kImr);
  EXPECT_EQ(chip.writes[0].value, 0xFF);
  EXPECT_EQ(chip.writes.back().address, kImr + 1);
}

TEST_F(Spc3DriverTest, EventsOfAnEarlierOperationAreDropped) {
  ASSERT_EQ(initialise(), SPC3_OK);
  EXPECT_THAT(chip.commands, ElementsAre()) << "no answer without its event";
  chip.events = 0x3F0F;
  ASSERT_EQ(initialise(), SPC3_OK);
  EXPECT_EQ(chip.events, 0);
  EXPECT_THAT(chip.commands, ElementsAre(kPrmNotOk, kCfgNotOk));
  EXPECT_EQ(chip.last(kMode1S), kMode1Eoi) << "X/INT may still be active";
}

TEST_F(Spc3DriverTest, AChipThatWorksGoesOfflineFirst) {
  chip.answers[kStatus] = kStatusPassiveIdle;
  EXPECT_EQ(initialise(), SPC3_ERR_NOT_OFFLINE);
  EXPECT_EQ(chip.writes.back().address, kMode1S);
  EXPECT_EQ(chip.writes.back().value, kMode1GoOffline);
  chip.answers[kStatus] = 0;
  EXPECT_EQ(spc3_initialise(&device, &config), SPC3_OK);
}

TEST_F(Spc3DriverTest, AVpc3IsExpectedToHave2Kb) {
  EXPECT_EQ(initialise(), SPC3_OK);
  chip.ram_end = 0x600;
  EXPECT_EQ(initialise(), SPC3_OK);
  config.vpc3 = true;
  EXPECT_EQ(initialise(), SPC3_ERR_RAM);
  chip.ram_end = 0x800;
  EXPECT_EQ(initialise(), SPC3_OK);
}

TEST_F(Spc3DriverTest, AMotorolaBusHasTheHighByteFirst) {
  config.motorola = true;
  config.user_wd = 0x1234;
  start();
  EXPECT_EQ(chip.ram[kOrgUserWd], 0x12);
  EXPECT_EQ(chip.ram[kOrgUserWd + 1], 0x34);
  chip.answers[kStatus] = 0x0F;
  chip.answers[kStatus + 1] = 0x01;
  EXPECT_EQ(spc3_status(&device), 0x0F01);
}

// ------------------------------------------------------------------------------------------------------------ layout

/// [first, last + 1) of each buffer, by its pointer cell.
std::vector<std::pair<int, int>> buffers(const FakeSpc3& chip) {
  const auto at = [&chip](int cell) { return static_cast<int>(chip.ram.at(static_cast<std::size_t>(cell))); };
  const int select = at(kOrgAuxSelect);
  const int first = at(kOrgAuxLength);
  const int prm = (select & kOrgAuxSelectPrm) != 0 ? at(kOrgAuxLength + 1) : first;
  std::vector<std::pair<int, int>> found;
  const auto add = [&found, &at](int cell, int length) {
    if (at(cell) != 0) found.emplace_back(at(cell) * 8, at(cell) * 8 + length);
  };
  for (int i = 0; i < 3; ++i) add(kOrgDoutPointer + i, at(kOrgDoutLength));
  for (int i = 0; i < 3; ++i) add(kOrgDinPointer + i, at(kOrgDinLength));
  for (int i = 0; i < 2; ++i) add(kOrgDiagPointer + i, at(kOrgDiagLength + i));
  add(kOrgAuxPointer, first);
  add(kOrgAuxPointer + 1, at(kOrgAuxLength + 1));
  add(kOrgSsaPointer, first);
  add(kOrgPrmPointer, prm);
  add(kOrgCfgPointer, first);
  add(kOrgReadCfgPointer, first);
  std::sort(found.begin(), found.end());
  return found;
}

TEST_F(Spc3DriverTest, BuffersLieApartAndInsideOfTheRam) {
  for (const bool vpc3 : {false, true})
    for (const int prm : {7, 20, 100, 237, 244})
      for (const int other : {1, 4, 8, 9, 40, 64}) {
        config.vpc3 = vpc3;
        config.max_prm = static_cast<std::uint8_t>(prm);
        config.max_cfg = config.max_output = config.max_input = static_cast<std::uint8_t>(other);
        config.max_ssa = static_cast<std::uint8_t>(other >= 4 ? other : 0);
        config.cfg_length = 1;
        ASSERT_EQ(initialise(), SPC3_OK) << prm << " " << other;
        const auto found = buffers(chip);
        EXPECT_GE(found.front().first, kBuffers);
        EXPECT_LE(found.back().second, vpc3 ? 0x7F8 : 0x600);
        for (std::size_t i = 1; i < found.size(); ++i)
          EXPECT_LE(found[i - 1].second, found[i].first) << prm << " " << other;
      }
}

TEST_F(Spc3DriverTest, ASecondAuxIsTakenWhenItSavesRoom) {
  ASSERT_EQ(initialise(), SPC3_OK);
  EXPECT_EQ(chip.ram[kOrgAuxSelect], kOrgAuxSelectPrm);
  EXPECT_EQ(chip.ram[kOrgAuxLength], 3);
  EXPECT_EQ(chip.ram[kOrgAuxLength + 1], 20);
  config.max_prm = 7;
  config.max_cfg = 8;
  ASSERT_EQ(initialise(), SPC3_OK);
  EXPECT_EQ(chip.ram[kOrgAuxSelect], 0);
  EXPECT_EQ(chip.ram[kOrgAuxLength], 8);
  EXPECT_EQ(chip.ram[kOrgAuxPointer + 1], 0);
  EXPECT_NE(chip.ram[kOrgPrmPointer], 0);
  config.max_prm = 32;  // 4 x 32 are less than 3 x 24 + 2 x 32
  config.max_cfg = 24;
  ASSERT_EQ(initialise(), SPC3_OK);
  EXPECT_EQ(chip.ram[kOrgAuxSelect], 0);
  config.max_ssa = 4;  // 5 x 32 are 4 x 24 + 2 x 32: then two
  ASSERT_EQ(initialise(), SPC3_OK);
  EXPECT_EQ(chip.ram[kOrgAuxSelect], kOrgAuxSelectPrm);
  config.max_cfg = 32;
  ASSERT_EQ(initialise(), SPC3_OK);
  EXPECT_EQ(chip.ram[kOrgAuxSelect], 0);
}

TEST_F(Spc3DriverTest, TheLargestLengthsAreAccepted) {
  config.vpc3 = true;
  config.address = 126;
  const spc3_config others = config;
  for (std::uint8_t spc3_config::*member : {&spc3_config::max_output, &spc3_config::max_input, &spc3_config::max_prm,
                                            &spc3_config::max_cfg, &spc3_config::max_ssa}) {
    config = others;
    config.*member = 244;
    EXPECT_EQ(initialise(), SPC3_OK);
  }
  config = others;
  config.max_diag = 238;
  EXPECT_EQ(initialise(), SPC3_OK);
}

TEST_F(Spc3DriverTest, TheLastByteOfTheRamIsUsedAndNoMore) {
  config.max_output = config.max_input = 136;  // 6 x 136, 2 x 64, 2 x 248, 3 x 8, 8: 0x5C0 bytes
  config.max_diag = 58;
  config.max_prm = 244;
  config.max_ssa = 0;
  ASSERT_EQ(initialise(), SPC3_OK);
  EXPECT_EQ(0x600 - buffers(chip).back().second, 8 - 3 + 8);  // of Read_Cfg, then the list of SAPs
  config.max_diag = 59;
  EXPECT_EQ(initialise(), SPC3_ERR_CONFIG_FIT);
  config.vpc3 = true;
  EXPECT_EQ(initialise(), SPC3_OK);
}

TEST_F(Spc3DriverTest, WithoutInputsAndOutputsThereAreNoSuchBuffers) {
  config.max_output = config.max_input = 0;
  ASSERT_EQ(initialise(), SPC3_OK);
  EXPECT_EQ(chip.ram[kOrgDoutPointer] | chip.ram[kOrgDinPointer], 0);
  EXPECT_EQ(spc3_set_inputs(&device, nullptr, 0), SPC3_OK);
  EXPECT_EQ(chip.count(kNewDin), 0);
}

TEST_F(Spc3DriverTest, WrongConfigurationsAreRefusedBeforeAnythingIsWritten) {
  const std::pair<std::function<void(spc3_config&)>, spc3_error> cases[] = {
      {[](auto& c) { c.address = 127; }, SPC3_ERR_CONFIG_ADDRESS},
      {[](auto& c) { c.max_output = 245; }, SPC3_ERR_CONFIG_LENGTH},
      {[](auto& c) { c.max_input = 245; }, SPC3_ERR_CONFIG_LENGTH},
      {[](auto& c) { c.max_diag = 239; }, SPC3_ERR_CONFIG_LENGTH},
      {[](auto& c) { c.max_prm = 6; }, SPC3_ERR_CONFIG_LENGTH},
      {[](auto& c) { c.max_prm = 245; }, SPC3_ERR_CONFIG_LENGTH},
      {[](auto& c) { c.max_cfg = 0; }, SPC3_ERR_CONFIG_LENGTH},
      {[](auto& c) { c.max_cfg = 245; }, SPC3_ERR_CONFIG_LENGTH},
      {[](auto& c) { c.max_ssa = 3; }, SPC3_ERR_CONFIG_LENGTH},
      {[](auto& c) { c.max_ssa = 245; }, SPC3_ERR_CONFIG_LENGTH},
      {[](auto& c) { c.cfg = nullptr; }, SPC3_ERR_CONFIG_CFG},
      {[](auto& c) { c.cfg_length = 0; }, SPC3_ERR_CONFIG_CFG},
      {[](auto& c) { c.cfg_length = 4; }, SPC3_ERR_CONFIG_CFG},
      {[](auto& c) { c.max_input = c.max_output = 244; }, SPC3_ERR_CONFIG_FIT}};
  const spc3_config right = config;
  for (const auto& [spoil, error] : cases) {
    config = right;
    spoil(config);
    EXPECT_EQ(initialise(), error);
    EXPECT_THAT(chip.writes, IsEmpty());
  }
}

TEST_F(Spc3DriverTest, MissingArgumentsAreErrors) {
  const spc3_port port = chip.port();
  spc3_port no_read = port, no_write = port;
  no_read.read = nullptr;
  no_write.write = nullptr;
  EXPECT_EQ(spc3_open(nullptr, &port, nullptr), SPC3_ERR_ARGUMENT);
  EXPECT_EQ(spc3_open(&device, nullptr, nullptr), SPC3_ERR_ARGUMENT);
  EXPECT_EQ(spc3_open(&device, &no_read, nullptr), SPC3_ERR_ARGUMENT);
  EXPECT_EQ(spc3_open(&device, &no_write, nullptr), SPC3_ERR_ARGUMENT);
  EXPECT_EQ(spc3_initialise(&device, nullptr), SPC3_ERR_ARGUMENT);
  EXPECT_EQ(spc3_set_inputs(&device, nullptr, 1), SPC3_ERR_ARGUMENT);
  EXPECT_EQ(spc3_get_outputs(&device, nullptr), SPC3_ERR_ARGUMENT);
  EXPECT_EQ(spc3_set_diagnosis(&device, 0, nullptr, 1), SPC3_ERR_ARGUMENT);
}

// ------------------------------------------------------------------------------------------------------------ events

TEST_F(Spc3DriverTest, RightParametersAreAnsweredByOk) {
  start();
  const Bytes prm = {0x88, 1, 2, 11, 0x0C, 0xC9, 0, 0xAA};
  chip.telegram(kOrgPrmLength, kEventNewPrm, prm);
  EXPECT_EQ(spc3_service(&device), kEventNewPrm);
  EXPECT_THAT(prm_seen, ElementsAre(prm));
  EXPECT_THAT(chip.commands, ElementsAre(kPrmOk));
}

TEST_F(Spc3DriverTest, WrongParametersAreAnsweredByNotOk) {
  start();
  prm_right = false;
  chip.telegram(kOrgPrmLength, kEventNewPrm, {0x88, 1, 2, 11, 0x0C, 0xC9, 0, 0xAA});
  spc3_service(&device);
  EXPECT_THAT(chip.commands, ElementsAre(kPrmNotOk));
}

TEST_F(Spc3DriverTest, AfterAConflictTheNewerParametersAreJudgedInTheirBuffer) {
  start();
  chip.telegram(kOrgPrmLength, kEventNewPrm, {0x88, 1, 2, 11, 0x0C, 0xC9, 0, 1});
  chip.answers[kPrmOk] = kVerdictConflict;
  chip.on_command = [this](std::uint16_t) {
    if (prm_seen.size() > 1) return void(chip.answers[kPrmOk] = kVerdictFinished);
    std::swap(chip.ram[kOrgPrmPointer], chip.ram[kOrgAuxPointer + 1]);  // A22
    chip.telegram(kOrgPrmLength, kEventNewPrm, {0x88, 1, 2, 11, 0x0C, 0xC9, 0, 2, 3});
  };
  spc3_service(&device);
  ASSERT_EQ(prm_seen.size(), 2U);
  EXPECT_EQ(prm_seen[1].back(), 3);
  EXPECT_EQ(chip.count(kPrmOk), 2);
  EXPECT_EQ(chip.events, 0);
}

TEST_F(Spc3DriverTest, MoreThanTheLongestTelegramIsNotCopied) {
  start();
  chip.telegram(kOrgPrmLength, kEventNewPrm, {0x88, 1, 2, 11, 0x0C, 0xC9, 0, 1});
  chip.ram[kOrgPrmLength] = 0xFF;
  spc3_service(&device);
  ASSERT_EQ(prm_seen.size(), 1U);
  EXPECT_EQ(prm_seen[0].size(), 244U);
}

TEST_F(Spc3DriverTest, AnEndlessConflictDoesNotKeepTheCall) {
  start();
  chip.telegram(kOrgPrmLength, kEventNewPrm, {0x88, 1, 2, 11, 0x0C, 0xC9, 0, 1});
  chip.answers[kPrmOk] = kVerdictConflict;
  EXPECT_EQ(spc3_service(&device), kEventNewPrm);
  EXPECT_EQ(chip.count(kPrmOk), 4);
  EXPECT_EQ(chip.events, kEventNewPrm);
}

TEST_F(Spc3DriverTest, WithoutAJudgeTheConfigurationMustBeThatOfGetCfg) {
  for (const auto& [bytes, command] :
       {std::pair{cfg, kCfgOk}, {Bytes{0x13, 0x28}, kCfgNotOk}, {Bytes{0x13}, kCfgNotOk}}) {
    start();
    dp_state(kDpStateWaitCfg);
    chip.telegram(kOrgCfgLength, kEventNewCfg, bytes);
    chip.ram.at(chip.ram[kOrgCfgPointer] * 8U + bytes.size()) = 0xEE;  // what lies there after it is nobody's
    EXPECT_EQ(spc3_service(&device), kEventNewCfg);
    EXPECT_THAT(chip.commands, ElementsAre(command));
  }
}

TEST_F(Spc3DriverTest, LengthsOfTheConfigurationAreSetBeforeOk) {
  judge_cfg_by_test();
  start();
  dp_state(kDpStateWaitCfg);
  lengths = {2, 5};
  chip.on_command = [this](std::uint16_t) {
    EXPECT_EQ(chip.ram[kOrgDoutLength], 2);
    EXPECT_EQ(chip.ram[kOrgDinLength], 5);
  };
  chip.telegram(kOrgCfgLength, kEventNewCfg, {0x11, 0x24});
  spc3_service(&device);
  EXPECT_EQ(offered, (std::pair<int, int>{4, 10}));
  EXPECT_THAT(cfg_seen, ElementsAre(Bytes{0x11, 0x24}));
  EXPECT_THAT(chip.commands, ElementsAre(kCfgOk));
}

TEST_F(Spc3DriverTest, LongerLengthsThanTheBuffersAreRefused) {
  judge_cfg_by_test();
  for (const auto& wrong : {std::pair{5, 10}, {4, 11}}) {
    start();
    dp_state(kDpStateWaitCfg);
    lengths = wrong;
    chip.telegram(kOrgCfgLength, kEventNewCfg, cfg);
    spc3_service(&device);
    EXPECT_THAT(chip.commands, ElementsAre(kCfgNotOk));
    EXPECT_EQ(chip.ram[kOrgDoutLength], 4);
  }
}

TEST_F(Spc3DriverTest, InDataExchangeOnlyTheSameLengthsAreAccepted) {
  judge_cfg_by_test();
  start();
  dp_state(kDpStateDataEx);
  for (const auto& [now, command] : {std::pair{std::pair{4, 10}, kCfgOk}, {{3, 10}, kCfgNotOk}, {{4, 9}, kCfgNotOk}}) {
    chip.commands.clear();
    chip.writes.clear();
    lengths = now;
    chip.telegram(kOrgCfgLength, kEventNewCfg, cfg);
    spc3_service(&device);
    EXPECT_THAT(chip.commands, ElementsAre(command));
    EXPECT_EQ(chip.last(kOrgDoutLength), -1);
    EXPECT_EQ(chip.last(kOrgDinLength), -1);
  }
}

TEST_F(Spc3DriverTest, OutputsThatGrowBeginWithZeros) {
  judge_cfg_by_test();
  start();
  dp_state(kDpStateWaitCfg);
  for (const int length : {2, 4}) {
    for (int i = 0; i < 3; ++i) chip.put(static_cast<std::uint16_t>(kOrgDoutPointer + i), {1, 2, 3, 4, 5});
    lengths = {length, 10};
    chip.telegram(kOrgCfgLength, kEventNewCfg, cfg);
    chip.writes.clear();
    spc3_service(&device);
  }
  EXPECT_EQ(chip.writes.size(), 5U + 3U * 2U);
  chip.writes.clear();
  lengths = {4, 10};
  chip.telegram(kOrgCfgLength, kEventNewCfg, cfg);
  spc3_service(&device);
  EXPECT_EQ(chip.writes.size(), 5U) << "IAR, lengths, EOI: nothing has grown";
  for (int i = 0; i < 3; ++i)
    EXPECT_THAT(chip.buffer(static_cast<std::uint16_t>(kOrgDoutPointer + i), 5), ElementsAre(1, 2, 0, 0, 5));
}

TEST_F(Spc3DriverTest, GetCfgFollowsTheConfigurationWhenAsked) {
  judge_cfg_by_test();
  config.change_cfg = true;
  start();
  dp_state(kDpStateWaitCfg);
  chip.on_command = [this](std::uint16_t) { EXPECT_EQ(chip.ram[kOrgReadCfgLength], 3); };
  chip.telegram(kOrgCfgLength, kEventNewCfg, {1, 2, 3});
  spc3_service(&device);
  EXPECT_EQ(chip.ram[kOrgReadCfgLength], 3);
  chip.on_command = nullptr;
  chip.answers[kCfgOk] = kVerdictNotAllowed;  // the buffers stay, and so does the length
  chip.telegram(kOrgCfgLength, kEventNewCfg, {1});
  spc3_service(&device);
  EXPECT_EQ(chip.ram[kOrgReadCfgLength], 3);
}

TEST_F(Spc3DriverTest, ANewAddressIsToldBeforeTheBufferIsFree) {
  config.max_ssa = 6;
  start();
  chip.on_command = [this](std::uint16_t) { EXPECT_EQ(address.first, 9); };
  chip.telegram(kOrgSsaLength, kEventNewSsa, {9, 0x0C, 0xC9, 0xFF, 7, 8});
  EXPECT_EQ(spc3_service(&device), kEventNewSsa);
  EXPECT_EQ(address, (std::pair<int, int>{9, 1}));
  EXPECT_THAT(rest, ElementsAre(7, 8));
  EXPECT_THAT(chip.commands, ElementsAre(kSsaFree));
  chip.telegram(kOrgSsaLength, kEventNewSsa, {9, 0x0C, 0xC9, 0});
  spc3_service(&device);
  EXPECT_EQ(address, (std::pair<int, int>{9, 0}));
  EXPECT_THAT(rest, IsEmpty());
}

TEST_F(Spc3DriverTest, AnApplicationWithoutFunctionsIsNotCalled) {
  application = {};
  config.max_ssa = 4;
  start();
  dp_state(kDpStateWaitCfg);
  chip.telegram(kOrgSsaLength, kEventNewSsa, {9, 0x0C, 0xC9, 0xFF});
  chip.telegram(kOrgPrmLength, kEventNewPrm, {0x88, 1, 2, 11, 0x0C, 0xC9, 0, 0xAA});
  chip.telegram(kOrgCfgLength, kEventNewCfg, cfg);
  chip.events = static_cast<std::uint16_t>(chip.events | kEventNewGc);
  spc3_service(&device);
  EXPECT_THAT(chip.commands, ElementsAre(kPrmOk, kCfgOk, kSsaFree));
}

TEST_F(Spc3DriverTest, GlobalControlIsTold) {
  start();
  chip.ram[kOrgGcCommand] = kOrgGcCommandClearData;
  chip.events = kEventNewGc;
  EXPECT_EQ(spc3_service(&device), kEventNewGc);
  EXPECT_THAT(controls, ElementsAre(kOrgGcCommandClearData));
  chip.events = kEventDxOut;
  spc3_service(&device);
  EXPECT_EQ(controls.size(), 1U);
}

TEST_F(Spc3DriverTest, MinTsdrIsWrittenAgainWithTheBaudRate) {
  config.min_tsdr = 30;
  start();
  dp_state(kDpStateWaitPrm);
  chip.events = kEventBaudDetect;
  spc3_service(&device);
  EXPECT_EQ(chip.last(kMinTsdr), 30);
  dp_state(kDpStateWaitCfg);  // by a Set_Prm of seven bytes, which the driver does not see
  chip.events = kEventBaudDetect;
  spc3_service(&device);
  EXPECT_EQ(chip.last(kMinTsdr), 30);
  prm_right = false;
  chip.telegram(kOrgPrmLength, kEventNewPrm, {0x88, 1, 2, 90, 0x0C, 0xC9, 0, 1});
  spc3_service(&device);
  chip.writes.clear();
  chip.events = kEventBaudDetect;
  spc3_service(&device);
  EXPECT_EQ(chip.last(kMinTsdr), 30);
  prm_right = true;
  chip.telegram(kOrgPrmLength, kEventNewPrm, {0x88, 1, 2, 100, 0x0C, 0xC9, 0, 1});
  chip.writes.clear();
  spc3_service(&device);
  EXPECT_EQ(chip.last(kMinTsdr), -1);
  dp_state(kDpStateDataEx);
  chip.events = kEventBaudDetect;
  spc3_service(&device);
  EXPECT_EQ(chip.last(kMinTsdr), 100);
  dp_state(kDpStateWaitPrm);
  chip.events = kEventBaudDetect;
  spc3_service(&device);
  EXPECT_EQ(chip.last(kMinTsdr), 30);
}

TEST_F(Spc3DriverTest, WithoutAMinTsdrTheChipsHolds) {
  start();
  chip.events = kEventBaudDetect;
  spc3_service(&device);
  EXPECT_EQ(chip.last(kMinTsdr), -1);
}

TEST_F(Spc3DriverTest, EventsAreAcknowledgedBeforeTheWorkAndEoiIsLast) {
  start();
  chip.events = kEventDataEx | kEventDxOut | kEventNewSsa;
  chip.on_command = [this](std::uint16_t) { EXPECT_EQ(chip.events, 0); };
  EXPECT_EQ(spc3_service(&device), kEventDataEx | kEventDxOut | kEventNewSsa);
  EXPECT_EQ(chip.count(kSsaFree), 1);
  EXPECT_EQ(chip.writes.back().address, kMode1S);
  EXPECT_EQ(chip.writes.back().value, kMode1Eoi);
}

TEST_F(Spc3DriverTest, AnEventDuringTheWorkIsTakenInTheSameCall) {
  config.max_ssa = 4;
  start();
  chip.events = kEventNewSsa;
  chip.on_command = [this](std::uint16_t) { chip.events = kEventMacReset; };
  EXPECT_EQ(spc3_service(&device), kEventNewSsa | kEventMacReset);
  EXPECT_EQ(chip.events, 0);
}

// --------------------------------------------------------------------------------------------- inputs, outputs,
// diagnosis

TEST_F(Spc3DriverTest, InputsGoIntoTheUsersBuffer) {
  start();
  for (const int user : {1, 2, 3}) {
    chip.answers[kDinSm] = static_cast<std::uint8_t>(user << kSmUShift);
    const Bytes inputs(10, static_cast<std::uint8_t>(0x10 + user));
    chip.on_command = [&](std::uint16_t) {
      EXPECT_EQ(chip.buffer(static_cast<std::uint16_t>(kOrgDinPointer + user - 1), 10), inputs);
    };
    EXPECT_EQ(spc3_set_inputs(&device, inputs.data(), 10), SPC3_OK);
  }
  EXPECT_EQ(chip.count(kNewDin), 3);
  EXPECT_EQ(chip.writes.size(), 30U);
  EXPECT_EQ(spc3_set_inputs(&device, cfg.data(), 2), SPC3_ERR_INPUT_LENGTH);
  EXPECT_EQ(chip.count(kNewDin), 3);
}

TEST_F(Spc3DriverTest, OutputsAreThoseOfTheAnsweredBuffer) {
  start();
  std::array<std::uint8_t, 5> bytes{};
  spc3_outputs outputs{bytes.data(), 4, 0, false, false};
  chip.put(kOrgDoutPointer + 2, {1, 2, 3, 4, 5});
  chip.answers[kNextDout] = 3;
  EXPECT_EQ(spc3_get_outputs(&device, &outputs), SPC3_OK);
  EXPECT_FALSE(outputs.fresh);
  EXPECT_THAT(bytes, ElementsAre(0, 0, 0, 0, 0));
  chip.answers[kNextDout] = 3 | kNextDoutFresh;
  EXPECT_EQ(spc3_get_outputs(&device, &outputs), SPC3_OK);
  EXPECT_TRUE(outputs.fresh);
  EXPECT_FALSE(outputs.cleared);
  EXPECT_EQ(outputs.length, 4);
  EXPECT_THAT(bytes, ElementsAre(1, 2, 3, 4, 0));
  chip.answers[kNextDout] = 1 | kNextDoutFresh | kNextDoutCleared;
  EXPECT_EQ(spc3_get_outputs(&device, &outputs), SPC3_OK);
  EXPECT_TRUE(outputs.cleared);
  EXPECT_THAT(bytes, ElementsAre(0, 0, 0, 0, 0));
}

TEST_F(Spc3DriverTest, OutputsStayInTheChipWhenTheCallersBufferIsSmall) {
  start();
  Bytes bytes(3);
  spc3_outputs outputs{bytes.data(), 3, 0, true, false};
  EXPECT_EQ(spc3_get_outputs(&device, &outputs), SPC3_ERR_OUTPUT_LENGTH);
  EXPECT_FALSE(outputs.fresh);
  EXPECT_EQ(chip.count(kNextDout), 0);
}

TEST_F(Spc3DriverTest, DiagnosisGoesIntoTheUsersBuffer) {
  start();
  for (const int user : {0, 1}) {
    chip.answers[kDiagSm] = user == 0 ? 0x09 : 0x06;
    const Bytes bytes = {3, 0x42, static_cast<std::uint8_t>(user)};
    EXPECT_EQ(spc3_set_diagnosis(&device, SPC3_DIAG_EXT | SPC3_DIAG_OVERFLOW, bytes.data(), 3), SPC3_OK);
    EXPECT_EQ(chip.ram.at(static_cast<std::size_t>(kOrgDiagLength + user)), 9);
    const Bytes found = chip.buffer(static_cast<std::uint16_t>(kOrgDiagPointer + user), 9);
    EXPECT_EQ(found[0], 5);
    EXPECT_EQ(Bytes(found.begin() + 6, found.end()), bytes);
  }
  EXPECT_EQ(chip.count(kNewDiag), 2);
}

TEST_F(Spc3DriverTest, DiagnosisWaitsForABufferAndHasALargestLength) {
  start();
  const Bytes bytes(10);
  chip.answers[kDiagSm] = 0x0E;  // both the chip's
  EXPECT_EQ(spc3_set_diagnosis(&device, 0, bytes.data(), 1), SPC3_ERR_DIAG_BUSY);
  chip.answers[kDiagSm] = kDiagSmReset;
  EXPECT_EQ(spc3_set_diagnosis(&device, 0, bytes.data(), 10), SPC3_ERR_DIAG_LENGTH);
  EXPECT_EQ(chip.count(kNewDiag), 0);
  EXPECT_EQ(spc3_set_diagnosis(&device, 0, bytes.data(), 9), SPC3_OK);
}

TEST_F(Spc3DriverTest, SingleBitsAreSetInModeRegister1) {
  start();
  spc3_serve_watchdog(&device);
  spc3_leave_master(&device);
  spc3_go_offline(&device);
  ASSERT_EQ(chip.writes.size(), 3U);
  EXPECT_EQ(chip.writes[0].value | chip.writes[1].value << 8 | chip.writes[2].value << 16,
            kMode1ResUserWd | kMode1UserLeaveMaster << 8 | kMode1GoOffline << 16);
  for (const FakeSpc3::Write& each : chip.writes) EXPECT_EQ(each.address, kMode1S);
}

TEST(Spc3Errors, EachHasAText) {
#define TEXT(name, value, text) EXPECT_STREQ(spc3_error_text(name), text);
  SPC3_ERROR_TABLE(TEXT)
#undef TEXT
  EXPECT_STREQ(spc3_error_text(static_cast<spc3_error>(63)), "unknown error");
}

TEST(Spc3Errors, TheGuideSaysWhatToDo) {
  std::ifstream file(GUIDE);
  std::stringstream guide;
  guide << file.rdbuf();
#define ROW(name, value, text) \
  if ((value) != 0) EXPECT_THAT(guide.str(), testing::HasSubstr("| `" #name "` | " #value " |"));
  SPC3_ERROR_TABLE(ROW)
#undef ROW
}

}  // namespace
}  // namespace dsdpv1::spc3
