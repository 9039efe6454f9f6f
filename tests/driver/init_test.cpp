#include "tests/driver/driver_fixture.hpp"

namespace dsdpv1 {
namespace {

using testing::ElementsAre;

class Init : public DriverTest {};

TEST_F(Init, WaitsForAChipThatStartsLate) {
  chip.at(0x004) = 0;
  chip.not_ready_accesses = 20;
  EXPECT_EQ(dsdpv1_wait_ready(&device), DSDPV1_OK);
  EXPECT_EQ(chip.holds, 22);
}

TEST_F(Init, ChipThatNeverStarts) {
  chip.present = false;
  chip.at(0x004) = 0;
  device.tuning.ready_polls = 30;
  EXPECT_EQ(dsdpv1_wait_ready(&device), DSDPV1_ERR_CHIP_NOT_READY);
  EXPECT_EQ(chip.holds, 30);
}

TEST_F(Init, SilenceBeforeTheStartIsForgotten) {
  chip.present = false;
  chip.at(0x004) = 0;
  device.tuning.ready_polls = 30;
  static_cast<void>(dsdpv1_wait_ready(&device));
  chip.present = true;
  EXPECT_EQ(dsdpv1_wait_ready(&device), DSDPV1_OK);
  EXPECT_EQ(dsdpv1_initialise(&device, &config), DSDPV1_OK);
}

TEST_F(Init, WritesTheAreaByteForByte) {
  config.address_change = true;
  config.fail_safe = true;
  config.dpv1 = true;
  config.prm_mode = 1;
  config.cfg_mode = 2;
  ASSERT_EQ(dsdpv1_initialise(&device, &config), DSDPV1_OK);
  const Bytes area = {16, 5, 0x0C, 0xC9, 0x0F, 0, 0, 8, 4, 9, 18, 1, 20, 2, 2, 0x17, 0x23};
  EXPECT_EQ(chip.bytes(0x020, area.size()), area);
  const std::uint16_t crc = dsdpv1_crc(DSDPV1_CRC_START, area.data(), area.size());
  EXPECT_EQ(chip.at(0x0F7), crc >> 8);
  EXPECT_EQ(chip.at(0x0F8), crc & 0xFF);
  EXPECT_EQ(chip.at(0x005), 0x1D);
  EXPECT_EQ(chip.at(0x00A), 0) << "B00A.0 is cleared after the success";
  EXPECT_EQ(chip.initialisations, 1);
}

TEST_F(Init, FlagsOfTable12) {
  const std::pair<bool dsdpv1_config::*, int> flags[] = {{&dsdpv1_config::address_change, 0x01},
                                                         {&dsdpv1_config::freeze, 0x02},
                                                         {&dsdpv1_config::sync, 0x04},
                                                         {&dsdpv1_config::fail_safe, 0x08}};
  config.sync = config.freeze = false;
  for (const auto& [flag, bit] : flags) {
    config.*flag = true;
    ASSERT_EQ(dsdpv1_initialise(&device, &config), DSDPV1_OK);
    EXPECT_EQ(chip.at(0x024), bit);
    config.*flag = false;
  }
}

TEST_F(Init, WithoutDpv1TheFlagIsTakenBack) {
  chip.at(0x005) = 0x1D;
  initialise();
  EXPECT_EQ(chip.at(0x005), 0);
}

TEST_F(Init, LargestConfigurationReachesTheLastByte) {
  const Bytes cfg(200, 0x10);
  config.max_cfg = 200;
  config.cfg = cfg.data();
  config.cfg_length = 200;
  ASSERT_EQ(dsdpv1_initialise(&device, &config), DSDPV1_OK);
  EXPECT_EQ(chip.at(0x020), 214);
  EXPECT_EQ(chip.at(0x0F6), 0x10);
}

struct Limit {
  const char* name;
  std::function<void(dsdpv1_config&)> spoil;
  dsdpv1_error error;
};

class InitLimit : public DriverTest, public testing::WithParamInterface<Limit> {};

TEST_P(InitLimit, IsCheckedBeforeAnythingIsWritten) {
  GetParam().spoil(config);
  EXPECT_EQ(dsdpv1_initialise(&device, &config), GetParam().error);
  EXPECT_EQ(chip.holds, 0);
}

INSTANTIATE_TEST_SUITE_P(
    All, InitLimit,
    testing::Values(Limit{"Address", [](auto& c) { c.address = 127; }, DSDPV1_ERR_CONFIG_ADDRESS},
                    Limit{"Input", [](auto& c) { c.max_input = 245; }, DSDPV1_ERR_CONFIG_INPUT},
                    Limit{"Output", [](auto& c) { c.max_output = 245; }, DSDPV1_ERR_CONFIG_OUTPUT},
                    Limit{"Diag", [](auto& c) { c.max_diag = 239; }, DSDPV1_ERR_CONFIG_DIAG},
                    Limit{"Prm", [](auto& c) { c.max_prm = 238; }, DSDPV1_ERR_CONFIG_PRM},
                    Limit{"Cfg", [](auto& c) { c.max_cfg = 201; }, DSDPV1_ERR_CONFIG_CFG},
                    Limit{"CfgZero", [](auto& c) { c.max_cfg = 0; }, DSDPV1_ERR_CONFIG_CFG},
                    Limit{"CfgLength", [](auto& c) { c.max_cfg = 1; }, DSDPV1_ERR_CONFIG_CFG_LENGTH},
                    Limit{"CfgEmpty", [](auto& c) { c.cfg_length = 0; }, DSDPV1_ERR_CONFIG_CFG_LENGTH},
                    Limit{"CfgMissing", [](auto& c) { c.cfg = nullptr; }, DSDPV1_ERR_CONFIG_CFG_LENGTH},
                    Limit{"PrmMode", [](auto& c) { c.prm_mode = 3; }, DSDPV1_ERR_CONFIG_PRM_MODE},
                    Limit{"CfgMode", [](auto& c) { c.cfg_mode = 3; }, DSDPV1_ERR_CONFIG_CFG_MODE}),
    [](const auto& limit) { return std::string(limit.param.name); });

TEST_F(Init, LimitsThemselvesAreAccepted) {
  config.address = 126;
  config.max_input = config.max_output = 244;
  config.max_diag = 238;
  config.max_prm = 237;
  config.max_cfg = 200;
  EXPECT_EQ(dsdpv1_initialise(&device, &config), DSDPV1_OK);
}

TEST_F(Init, ChipNotReadyGetsNothing) {
  chip.at(0x004) = 0;
  EXPECT_EQ(dsdpv1_initialise(&device, &config), DSDPV1_ERR_CHIP_NOT_READY);
  EXPECT_EQ(chip.at(0x010), 0);
  EXPECT_EQ(chip.at(0x020), 0);
}

TEST_F(Init, ChipThatDoesNotTakeIt) {
  chip.takes_commands = false;
  device.tuning.init_polls = 10;
  EXPECT_EQ(dsdpv1_initialise(&device, &config), DSDPV1_ERR_INIT_TIMEOUT);
  EXPECT_EQ(chip.holds, 11);
}

TEST_F(Init, RefusedForItsCrc) {
  bool once = true;
  chip.before_access = [&] {
    chip.at(0x0F8) = static_cast<std::uint8_t>(chip.at(0x0F8) ^ (std::exchange(once, false) ? 1 : 0));
  };
  EXPECT_EQ(dsdpv1_initialise(&device, &config), DSDPV1_ERR_INIT_CRC);
  EXPECT_EQ(dsdpv1_initialise(&device, &config), DSDPV1_OK) << "a repetition is possible";
}

TEST_F(Init, RefusedForALimit) {
  chip.before_access = [&] {  // as if the chip knew a limit that the driver does not
    if ((chip.at(0x010) & 0x04) != 0) {
      chip.at(0x021) = 127;
      const Bytes area = chip.bytes(0x020, chip.at(0x020) + 1U);
      const std::uint16_t crc = dsdpv1_crc(DSDPV1_CRC_START, area.data(), area.size());
      chip.at(0x0F7) = static_cast<std::uint8_t>(crc >> 8);
      chip.at(0x0F8) = static_cast<std::uint8_t>(crc & 0xFF);
    }
  };
  EXPECT_EQ(dsdpv1_initialise(&device, &config), DSDPV1_ERR_INIT_LIMIT);
}

TEST_F(Init, RefusedWithoutAReason) {
  chip.refuses_silently = true;
  EXPECT_EQ(dsdpv1_initialise(&device, &config), DSDPV1_ERR_INIT_REFUSED);
}

TEST_F(Init, OldSuccessFlagDoesNotPassForTheNewOne) {
  chip.at(0x00A) = 1;
  chip.refuses_silently = true;
  EXPECT_EQ(dsdpv1_initialise(&device, &config), DSDPV1_ERR_INIT_REFUSED);
}

TEST_F(Init, DropsFlagsOfTheEarlierOperation) {
  initialise();
  chip.put_outputs({1, 2});
  chip.at(0x010) = 0xC3;
  std::uint8_t announced = 0;
  chip.before_access = [&] { announced = announced == 0 ? chip.at(0x010) : announced; };
  initialise();
  EXPECT_EQ(announced, 0xC4) << "the chip itself discards verdicts that nobody awaits (H7)";
  EXPECT_EQ(chip.at(0x00E), 0);
}

/// A refused initialisation changes nothing (D11): waiting data in DPRAM and driver stay.
class RefusedInit : public Init {
 protected:
  void refuse_one(const std::function<void()>& meanwhile = [] {}) {
    chip.before_access = [this, meanwhile, once = true]() mutable {
      if ((chip.at(0x010) & 0x04) != 0 && std::exchange(once, false)) {
        chip.at(0x0F8) = static_cast<std::uint8_t>(chip.at(0x0F8) ^ 1);
        meanwhile();
      }
    };
    ASSERT_EQ(dsdpv1_initialise(&device, &config), DSDPV1_ERR_INIT_CRC);
  }
};

TEST_F(RefusedInit, KeepsBlocksThatWaitForJudgement) {
  initialise(2, 2);
  chip.put_prm({1});
  chip.put_cfg(4, 8, {0x17, 0x23});
  refuse_one();
  EXPECT_EQ(dsdpv1_service(&device), DSDPV1_OK);
  EXPECT_THAT(prm_seen, ElementsAre(Bytes{1}));
  EXPECT_THAT(chip.verdicts, ElementsAre("prm ok, cfg ok"));
}

TEST_F(RefusedInit, KeepsTheFlagOfABlockThatCameMeanwhile) {
  initialise(2, 0);
  refuse_one([&] { chip.put_prm({2}); });
  EXPECT_EQ(dsdpv1_service(&device), DSDPV1_OK);
  EXPECT_THAT(prm_seen, ElementsAre(Bytes{2}));
}

TEST_F(RefusedInit, KeepsALateVerdictDue) {
  initialise(2, 0);
  prm_verdict = DSDPV1_LATER;
  chip.put_prm({1});
  ASSERT_EQ(dsdpv1_service(&device), DSDPV1_OK);
  refuse_one();
  EXPECT_EQ(dsdpv1_send_verdict(&device, DSDPV1_VERDICT_PRM, 0), DSDPV1_OK);
  EXPECT_THAT(chip.verdicts, ElementsAre("prm ok"));
}

TEST_F(RefusedInit, KeepsAVerdictThatTheChipHasNotTaken) {
  initialise(2, 0);
  chip.put_prm({1});
  chip.takes_commands = false;
  ASSERT_EQ(dsdpv1_service(&device), DSDPV1_OK);
  chip.takes_commands = true;
  refuse_one();
  EXPECT_THAT(chip.verdicts, ElementsAre("prm ok"));
}

TEST_F(RefusedInit, KeepsOutputsAndInputs) {
  initialise();
  chip.put_outputs({7});
  chip.takes_commands = false;
  result.outputs = nullptr;
  ASSERT_EQ(exchange({9}), DSDPV1_OK);
  chip.takes_commands = true;
  refuse_one();
  result.outputs = outputs.data();
  ASSERT_EQ(dsdpv1_exchange(&device, DSDPV1_INPUT_NEWEST, nullptr, 0, &result), DSDPV1_OK);
  EXPECT_THAT(received(), ElementsAre(7));
  EXPECT_THAT(chip.inputs, ElementsAre(9));
}

TEST_F(RefusedInit, AfterOneThatTheChipDidNotTakeKeepsThemToo) {
  initialise(2, 0);
  chip.put_prm({1});
  chip.takes_commands = false;
  device.tuning.init_polls = 2;
  ASSERT_EQ(dsdpv1_initialise(&device, &config), DSDPV1_ERR_INIT_TIMEOUT);
  chip.takes_commands = true;
  refuse_one();
  EXPECT_EQ(dsdpv1_service(&device), DSDPV1_OK);
  EXPECT_THAT(chip.verdicts, ElementsAre("prm ok"));
}

TEST_F(RefusedInit, BringsBackABlockOnce) {
  initialise(2, 0);
  chip.put_prm({1});
  refuse_one();
  EXPECT_EQ(dsdpv1_service(&device), DSDPV1_OK);
  refuse_one();
  EXPECT_EQ(dsdpv1_service(&device), DSDPV1_OK);
  EXPECT_EQ(prm_seen.size(), 1U);
}

TEST_F(RefusedInit, AndThenAnAcceptedOneDropsWhatWaits) {
  initialise(2, 0);
  chip.put_prm({1});
  refuse_one();
  initialise(2, 0);
  EXPECT_EQ(dsdpv1_service(&device), DSDPV1_OK);
  EXPECT_TRUE(prm_seen.empty());
}

TEST_F(Init, SilentChipIsReported) {
  chip.present = false;
  EXPECT_EQ(dsdpv1_initialise(&device, &config), DSDPV1_ERR_CHIP_SILENT);
}

TEST_F(Init, ArgumentsMustBeThere) {
  dsdpv1_port port = chip.port();
  EXPECT_EQ(dsdpv1_open(nullptr, &port, nullptr), DSDPV1_ERR_ARGUMENT);
  EXPECT_EQ(dsdpv1_open(&device, nullptr, nullptr), DSDPV1_ERR_ARGUMENT);
  port.read = nullptr;
  EXPECT_EQ(dsdpv1_open(&device, &port, nullptr), DSDPV1_ERR_ARGUMENT);
  EXPECT_EQ(dsdpv1_initialise(&device, nullptr), DSDPV1_ERR_ARGUMENT);
  EXPECT_EQ(dsdpv1_wait_ready(nullptr), DSDPV1_ERR_ARGUMENT);
  EXPECT_EQ(dsdpv1_get_status(&device, nullptr), DSDPV1_ERR_ARGUMENT);
  EXPECT_EQ(dsdpv1_exchange(&device, DSDPV1_INPUT_NEWEST, nullptr, 0, nullptr), DSDPV1_ERR_ARGUMENT);
  EXPECT_EQ(dsdpv1_service(nullptr), DSDPV1_ERR_ARGUMENT);
  EXPECT_EQ(dsdpv1_set_diagnosis(&device, DSDPV1_DIAG_EXTENDED, nullptr, 1), DSDPV1_ERR_ARGUMENT);
}

TEST_F(Init, NothingWorksBeforeIt) {
  EXPECT_EQ(exchange({1}), DSDPV1_ERR_NOT_INITIALISED);
  EXPECT_EQ(dsdpv1_service(&device), DSDPV1_ERR_NOT_INITIALISED);
  EXPECT_EQ(dsdpv1_set_diagnosis(&device, DSDPV1_DIAG_EXTENDED, nullptr, 0), DSDPV1_ERR_NOT_INITIALISED);
  EXPECT_EQ(chip.holds, 0);
}

}  // namespace
}  // namespace dsdpv1
