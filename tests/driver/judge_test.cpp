#include "tests/driver/driver_fixture.hpp"

namespace dsdpv1 {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

class Judge : public DriverTest {};

TEST_F(Judge, NothingNewIsNoError) {
  initialise(2, 2);
  EXPECT_EQ(dsdpv1_service(&device), DSDPV1_OK);
  EXPECT_EQ(chip.holds, 1);
  EXPECT_THAT(chip.verdicts, IsEmpty());
}

TEST_F(Judge, ParametersAcceptedInMode2) {
  initialise(2, 0);
  chip.put_prm({0x80, 0x01});
  EXPECT_EQ(dsdpv1_service(&device), DSDPV1_OK);
  EXPECT_THAT(prm_seen, ElementsAre(Bytes{0x80, 0x01}));
  EXPECT_THAT(chip.verdicts, ElementsAre("prm ok"));
  EXPECT_EQ(chip.at(0x00E), 0);
  EXPECT_EQ(chip.holds, 2) << "one to fetch, one for the verdict";
}

TEST_F(Judge, ConfigurationRefusedInMode2) {
  initialise(0, 2);
  cfg_verdict = DSDPV1_REFUSE;
  chip.put_cfg(4, 8, {0x17, 0x23});
  EXPECT_EQ(dsdpv1_service(&device), DSDPV1_OK);
  EXPECT_THAT(cfg_seen, ElementsAre(Bytes{0x17, 0x23}));
  EXPECT_EQ(cfg_lengths, std::make_pair(8, 4));
  EXPECT_THAT(chip.verdicts, ElementsAre("cfg wrong"));
}

TEST_F(Judge, BothVerdictsInOneHold) {
  initialise(2, 2);
  prm_verdict = DSDPV1_REFUSE;
  chip.put_prm({});
  chip.put_cfg(0, 1, {0x10});
  EXPECT_EQ(dsdpv1_service(&device), DSDPV1_OK);
  EXPECT_THAT(chip.verdicts, ElementsAre("prm wrong, cfg ok"));
  EXPECT_EQ(chip.holds, 2);
}

TEST_F(Judge, InModes0And1TheApplicationIsToldButNotAsked) {
  initialise(0, 1);
  prm_verdict = cfg_verdict = DSDPV1_REFUSE;
  chip.put_prm({1});
  chip.put_cfg(0, 1, {0x10});
  EXPECT_EQ(dsdpv1_service(&device), DSDPV1_OK);
  EXPECT_EQ(prm_seen.size(), 1U);
  EXPECT_EQ(cfg_seen.size(), 1U);
  EXPECT_THAT(chip.verdicts, IsEmpty());
}

TEST_F(Judge, WithoutAJudgeEverythingIsAccepted) {
  const dsdpv1_port port = chip.port();
  ASSERT_EQ(dsdpv1_open(&device, &port, nullptr), DSDPV1_OK);
  initialise(2, 2);
  chip.put_prm({1});
  chip.put_cfg(0, 1, {0x10});
  EXPECT_EQ(dsdpv1_service(&device), DSDPV1_OK);
  EXPECT_THAT(chip.verdicts, ElementsAre("prm ok, cfg ok"));
}

TEST_F(Judge, LaterVerdictIsSentByTheApplication) {
  initialise(2, 2);
  prm_verdict = DSDPV1_LATER;
  chip.put_prm({1});
  EXPECT_EQ(dsdpv1_service(&device), DSDPV1_OK);
  EXPECT_THAT(chip.verdicts, IsEmpty());
  EXPECT_EQ(dsdpv1_send_verdict(&device, DSDPV1_VERDICT_CFG, 0), DSDPV1_ERR_NO_VERDICT_DUE);
  EXPECT_EQ(dsdpv1_send_verdict(&device, DSDPV1_VERDICT_PRM, DSDPV1_VERDICT_PRM), DSDPV1_OK);
  EXPECT_THAT(chip.verdicts, ElementsAre("prm wrong"));
  EXPECT_EQ(dsdpv1_send_verdict(&device, DSDPV1_VERDICT_PRM, 0), DSDPV1_ERR_NO_VERDICT_DUE);
}

TEST_F(Judge, LaterVerdictOnAReplacedBlockIsNotSent) {
  initialise(2, 0);
  prm_verdict = DSDPV1_LATER;
  chip.put_prm({1});
  static_cast<void>(dsdpv1_service(&device));
  chip.put_prm({2});
  EXPECT_EQ(dsdpv1_send_verdict(&device, DSDPV1_VERDICT_PRM, 0), DSDPV1_ERR_VERDICT_STALE);
  EXPECT_THAT(chip.verdicts, IsEmpty());
}

TEST_F(Judge, BadVerdictArguments) {
  initialise(2, 2);
  EXPECT_EQ(dsdpv1_send_verdict(&device, 0, 0), DSDPV1_ERR_ARGUMENT);
  EXPECT_EQ(dsdpv1_send_verdict(&device, 4, 0), DSDPV1_ERR_ARGUMENT);
  EXPECT_EQ(dsdpv1_send_verdict(&device, DSDPV1_VERDICT_PRM, DSDPV1_VERDICT_CFG), DSDPV1_ERR_ARGUMENT);
}

TEST_F(Judge, BlockReplacedWhileItIsJudgedIsJudgedAnew) {
  initialise(2, 0);
  while_judging = [&] {
    if (prm_seen.size() == 1) chip.put_prm({2});
  };
  chip.put_prm({1});
  EXPECT_EQ(dsdpv1_service(&device), DSDPV1_OK);
  EXPECT_THAT(prm_seen, ElementsAre(Bytes{1}, Bytes{2}));
  EXPECT_THAT(chip.verdicts, ElementsAre("prm ok")) << "one verdict, on the second";
}

TEST_F(Judge, MasterThatNeverRestsIsLeftToTheNextCall) {
  initialise(2, 0);
  while_judging = [&] { chip.put_prm({2}); };
  chip.put_prm({1});
  EXPECT_EQ(dsdpv1_service(&device), DSDPV1_OK);
  EXPECT_EQ(prm_seen.size(), 3U);
  EXPECT_TRUE(dsdpv1_intr0_pending(&device));
}

TEST_F(Judge, Intr0IsRememberedUntilServed) {
  initialise(2, 0);
  EXPECT_FALSE(dsdpv1_intr0_pending(&device));
  dsdpv1_on_intr0(&device);
  EXPECT_TRUE(dsdpv1_intr0_pending(&device));
  EXPECT_EQ(dsdpv1_service(&device), DSDPV1_OK);
  EXPECT_FALSE(dsdpv1_intr0_pending(&device));
}

TEST_F(Judge, HandlerDuringAJudgementIsRefused) {
  initialise(2, 0);
  dsdpv1_error nested = DSDPV1_OK;
  while_judging = [&] { nested = dsdpv1_service(&device); };
  chip.put_prm({1});
  EXPECT_EQ(dsdpv1_service(&device), DSDPV1_OK);
  EXPECT_EQ(nested, DSDPV1_ERR_NESTED);
  EXPECT_TRUE(dsdpv1_intr0_pending(&device));
}

TEST_F(Judge, FailedHoldKeepsTheRequest) {
  initialise(2, 0);
  dsdpv1_on_intr0(&device);
  chip.busy_samples = 1000;
  device.tuning.acquire_polls = 10;
  EXPECT_EQ(dsdpv1_service(&device), DSDPV1_ERR_DPRAM_BUSY);
  EXPECT_TRUE(dsdpv1_intr0_pending(&device));
}

class FailedHoldWhileReadingAgain : public Judge {
 protected:
  void fail_while_reading(std::uint16_t address) {
    chip.bad_reads[address] = 1;
    device.tuning.acquire_polls = 10;
    chip.before_access = [&, once = true]() mutable { chip.busy_samples = std::exchange(once, false) ? 20 : 0; };
    EXPECT_EQ(dsdpv1_service(&device), DSDPV1_ERR_DPRAM_BUSY);
    EXPECT_THAT(chip.verdicts, IsEmpty());
    EXPECT_TRUE(dsdpv1_intr0_pending(&device));
  }
};

TEST_F(FailedHoldWhileReadingAgain, LosesNoParameters) {
  initialise(2, 2);
  chip.put_prm({0x55});
  fail_while_reading(0x411);
  EXPECT_EQ(dsdpv1_service(&device), DSDPV1_OK);
  EXPECT_THAT(chip.verdicts, ElementsAre("prm ok"));
  EXPECT_EQ(dsdpv1_service(&device), DSDPV1_OK);
  EXPECT_EQ(prm_seen.size(), 1U) << "judged once";
}

TEST_F(FailedHoldWhileReadingAgain, LosesNoConfiguration) {
  initialise(2, 2);
  chip.put_cfg(0, 1, {0x10});
  fail_while_reading(0x503);
  EXPECT_EQ(dsdpv1_service(&device), DSDPV1_OK);
  EXPECT_THAT(chip.verdicts, ElementsAre("cfg ok"));
}

TEST_F(FailedHoldWhileReadingAgain, IsForgottenByAnInitialisation) {
  initialise(2, 2);
  chip.put_prm({0x55});
  fail_while_reading(0x411);
  initialise(2, 2);
  EXPECT_EQ(dsdpv1_service(&device), DSDPV1_OK);
  EXPECT_THAT(prm_seen, IsEmpty());
}

TEST_F(Judge, ParametersReadWronglyAreReadAgain) {
  initialise(2, 0);
  chip.put_prm({0x55});
  chip.bad_reads[0x411] = 2;
  EXPECT_EQ(dsdpv1_service(&device), DSDPV1_OK);
  EXPECT_THAT(prm_seen, ElementsAre(Bytes{0x55}));
  EXPECT_EQ(chip.at(0x00D), 0);
}

TEST_F(Judge, WrongCrcGetsNoVerdict) {
  initialise(2, 2);
  chip.put_prm({1});
  chip.put_cfg(0, 1, {0x10});
  chip.at(0x4FE) = static_cast<std::uint8_t>(chip.at(0x4FE) ^ 1);
  EXPECT_EQ(dsdpv1_service(&device), DSDPV1_ERR_PRM_CRC);
  EXPECT_THAT(chip.verdicts, ElementsAre("cfg ok"));
  EXPECT_EQ(chip.at(0x00D), 0x02);
  chip.put_cfg(0, 1, {0x10});
  chip.at(0x5CB) = static_cast<std::uint8_t>(chip.at(0x5CB) ^ 1);
  EXPECT_EQ(dsdpv1_service(&device), DSDPV1_ERR_CFG_CRC);
  EXPECT_EQ(chip.at(0x00D), 0x03);
}

TEST_F(Judge, ImpossibleLengths) {
  initialise(2, 2);
  chip.put_prm({1});
  chip.at(0x410) = 238;
  EXPECT_EQ(dsdpv1_service(&device), DSDPV1_ERR_PRM_LENGTH);
  chip.put_cfg(0, 1, {0x10});
  chip.at(0x502) = 201;
  EXPECT_EQ(dsdpv1_service(&device), DSDPV1_ERR_CFG_LENGTH);
  EXPECT_THAT(chip.verdicts, IsEmpty());
}

TEST_F(Judge, LargestBlocks) {
  initialise(2, 2);
  chip.put_prm(Bytes(237, 0x11));
  chip.put_cfg(244, 244, Bytes(200, 0x22));
  EXPECT_EQ(dsdpv1_service(&device), DSDPV1_OK);
  EXPECT_THAT(prm_seen, ElementsAre(Bytes(237, 0x11)));
  EXPECT_THAT(cfg_seen, ElementsAre(Bytes(200, 0x22)));
  EXPECT_THAT(chip.verdicts, ElementsAre("prm ok, cfg ok"));
}

}  // namespace
}  // namespace dsdpv1
