#include "tests/driver/driver_fixture.hpp"

namespace dsdpv1 {
namespace {

using testing::ElementsAre;

class Hold : public DriverTest {};

TEST(DriverCrc, ExampleOfTheDatasheet) {
  const std::uint8_t bytes[] = {0x02, 0x07};
  EXPECT_EQ(dsdpv1_crc(DSDPV1_CRC_START, bytes, 2), 0x1241);
}

TEST(DriverCrc, ContinuesOverSeveralPieces) {
  const std::uint8_t bytes[] = {0x02, 0x07, 0xFF, 0x00, 0x55};
  const std::uint16_t first = dsdpv1_crc(DSDPV1_CRC_START, bytes, 3);
  EXPECT_EQ(dsdpv1_crc(first, bytes + 3, 2), dsdpv1_crc(DSDPV1_CRC_START, bytes, 5));
  EXPECT_EQ(dsdpv1_crc(DSDPV1_CRC_START, nullptr, 0), 0xFFFF);
}

TEST_F(Hold, WaitsWhileTheChipOwnsTheDpram) {
  chip.busy_samples = 100;
  EXPECT_EQ(dsdpv1_wait_ready(&device), DSDPV1_OK);
  EXPECT_EQ(chip.holds, 1);
}

TEST_F(Hold, FirstOneLeavesTheChipTheTimeToBeginAfterItsReset) {
  int pauses_before = -1;
  chip.on_r_req = [&](bool level) {
    if (level && pauses_before < 0) pauses_before = chip.pauses;
  };
  EXPECT_EQ(dsdpv1_wait_ready(&device), DSDPV1_OK);
  EXPECT_EQ(pauses_before, 1) << "H6";
}

TEST_F(Hold, GivesUpAndReleasesWhenTheChipKeepsTheDpram) {
  chip.busy_samples = 1'000'000;
  device.tuning.acquire_polls = 50;
  bool r_req = false;
  chip.on_r_req = [&](bool level) { r_req = level; };
  EXPECT_EQ(dsdpv1_wait_ready(&device), DSDPV1_ERR_DPRAM_BUSY);
  EXPECT_FALSE(r_req);
  EXPECT_EQ(chip.holds, 0);
  chip.busy_samples = 0;
  EXPECT_EQ(dsdpv1_wait_ready(&device), DSDPV1_OK);
}

/// A port may lower R_REQ with R_STA, or before it (a port that writes both with one store to a slow expander): H1.
TEST_F(Hold, PortThatLowersRReqFirstIsAsGood) {
  dsdpv1_port port = chip.port();
  static decltype(port.set_r_req) set_r_req;
  set_r_req = port.set_r_req;
  static decltype(port.set_r_sta) set_r_sta;
  set_r_sta = port.set_r_sta;
  port.set_r_sta = [](void* ctx, bool level) { level ? set_r_sta(ctx, true) : set_r_req(ctx, false); };
  port.set_r_req = [](void* ctx, bool level) { level ? set_r_req(ctx, true) : set_r_sta(ctx, false); };
  ASSERT_EQ(dsdpv1_open(&device, &port, nullptr), DSDPV1_OK);
  initialise();
  EXPECT_EQ(exchange({1}), DSDPV1_OK);
  EXPECT_EQ(chip.initialisations, 1);
  EXPECT_TRUE(chip.violations.empty()) << chip.violations.front();
}

TEST_F(Hold, CallFromAnInterruptDuringAHoldIsRefused) {
  initialise();
  dsdpv1_error nested = DSDPV1_OK;
  chip.on_r_req = [&](bool level) {
    if (level) nested = dsdpv1_service(&device);
  };
  EXPECT_EQ(exchange({1}), DSDPV1_OK);
  EXPECT_EQ(nested, DSDPV1_ERR_NESTED);
  EXPECT_TRUE(dsdpv1_intr0_pending(&device));
}

TEST_F(Hold, ChipThatStaysAwayIsReported) {
  initialise();
  chip.present = false;
  int good = 0;
  while (good < 100 && exchange({1}) == DSDPV1_OK) ++good;
  EXPECT_EQ(good, device.tuning.silent_holds + 1);  // the first hold still finds the chip's 1
  EXPECT_EQ(exchange({1}), DSDPV1_ERR_CHIP_SILENT);
  chip.present = true;
  EXPECT_EQ(exchange({1}), DSDPV1_ERR_CHIP_SILENT);  // it comes after this hold
  EXPECT_EQ(exchange({1}), DSDPV1_OK);
}

TEST_F(Hold, SilenceIsNotHiddenByTheCountWrappingRound) {
  initialise();
  chip.present = false;
  for (int i = 0; i < 20; ++i) static_cast<void>(exchange({1}));
  for (int i = 0; i < 600; ++i) EXPECT_EQ(exchange({1}), DSDPV1_ERR_CHIP_SILENT) << i;
}

TEST_F(Hold, FloatingBusLooksLikeASilentChip) {
  initialise();
  for (int i = 0; i < 20; ++i) {
    chip.at(0x006) = 0xFF;
    chip.present = false;
    static_cast<void>(exchange({1}));
  }
  EXPECT_EQ(exchange({1}), DSDPV1_ERR_CHIP_SILENT);
}

TEST_F(Hold, WorksWithoutAPauseFunction) {
  dsdpv1_port port = chip.port();
  port.pause = nullptr;
  ASSERT_EQ(dsdpv1_open(&device, &port, nullptr), DSDPV1_OK);
  initialise();
  EXPECT_EQ(exchange({1}), DSDPV1_OK);
  EXPECT_EQ(chip.pauses, 0);
}

TEST_F(Hold, StatusIsReadInOneHold) {
  const Bytes version = {0x01, 0x0D, 0x07, 0x01};
  std::copy(version.begin(), version.end(), chip.memory.begin());
  chip.at(0x008) = 0x12;
  chip.at(0x009) = 0x34;
  chip.at(0x00B) = 0x0C;
  chip.at(0x012) = 0x3C;  // 1.5 M, DATA_EXCHANGE
  dsdpv1_status status{};
  ASSERT_EQ(dsdpv1_get_status(&device, &status), DSDPV1_OK);
  EXPECT_THAT(status.version, ElementsAre(0x01, 0x0D, 0x07, 0x01));
  EXPECT_EQ(status.offline_count, 0x1234);
  EXPECT_EQ(status.crc_errors, 0x0C);
  EXPECT_EQ(status.state, DSDPV1_STATE_DATA_EXCHANGE);
  EXPECT_EQ(status.baud, 1'500'000U);
  EXPECT_EQ(chip.holds, 1);
}

TEST_F(Hold, BaudRatesOfTable5) {
  const std::uint32_t rates[] = {12'000'000, 6'000'000, 3'000'000, 1'500'000, 500'000, 187'500, 93'750, 45'450,
                                 19'200,     9'600,     0,         0,         0,       0,       0,      0};
  for (unsigned code = 0; code < 16; ++code) {
    chip.at(0x012) = static_cast<std::uint8_t>(code << 4);
    dsdpv1_status status{};
    ASSERT_EQ(dsdpv1_get_status(&device, &status), DSDPV1_OK);
    EXPECT_EQ(status.baud, rates[code]) << code;
  }
}

}  // namespace
}  // namespace dsdpv1
