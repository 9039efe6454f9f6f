// docs/programmers_guide.md: the numbers of the timing budget (DPRAM accesses and holds of each call, counted) and the
// example of the DPV1 chapter, which is compiled unchanged.
#include <fstream>
#include <sstream>

#include "tests/driver/acyclic_fixture.hpp"

extern "C" {
dsdpv1_error drive_open(dsdpv1_device* chip);
dsdpv1_error drive_poll(void);
std::uint16_t measure_speed(void);
void flash_start(const std::uint8_t* bytes, std::uint8_t length);
bool flash_busy(void);
bool flash_failed(void);
}

namespace dsdpv1::board {

// Used by the example's board functions; the example is C and has no objects.
std::vector<std::uint8_t> flash;  // NOLINT(cppcoreguidelines-avoid-non-const-global-variables)
bool busy = false, failed = false;

}  // namespace dsdpv1::board

namespace board = dsdpv1::board;

std::uint16_t measure_speed() { return 1500; }
void flash_start(const std::uint8_t* bytes, std::uint8_t length) {
  board::flash.assign(bytes, bytes + length);
  board::busy = true;
}
bool flash_busy() { return board::busy; }
bool flash_failed() { return board::failed; }

namespace dsdpv1 {
namespace {

/// The guide must have the row "| what | holds | accesses |" with the present counts.
void expect_row_of(const FakeChip& chip, const std::string& what) {
  std::ifstream file(GUIDE);
  std::stringstream guide;
  guide << file.rdbuf();
  const std::string row =
      "| " + what + " | " + std::to_string(chip.holds) + " | " + std::to_string(chip.accesses) + " |";
  EXPECT_NE(guide.str().find(row), std::string::npos) << "the guide should say: " << row;
}

class GuideBudget : public DriverTest {
 protected:
  void SetUp() override {
    DriverTest::SetUp();
    config.max_input = config.max_output = 244;
    config.max_diag = 238;
    config.max_prm = 237;
    config.max_cfg = 200;
  }
  void begin() { chip.holds = chip.accesses = 0; }
  void expect_row(const std::string& what) { expect_row_of(chip, what); }
};

TEST_F(GuideBudget, Initialisation) {
  const Bytes cfg(200, 0x10);
  begin();
  ASSERT_EQ(dsdpv1_initialise(&device, &config), DSDPV1_OK);
  expect_row("initialise, 2 configuration bytes");
  config.cfg = cfg.data();
  config.cfg_length = 200;
  begin();
  ASSERT_EQ(dsdpv1_initialise(&device, &config), DSDPV1_OK);
  expect_row("initialise, 200 configuration bytes");
}

TEST_F(GuideBudget, Exchange) {
  initialise();
  begin();
  ASSERT_EQ(exchange(Bytes(8)), DSDPV1_OK);
  expect_row("exchange, 8 inputs, no new outputs");
  for (const std::size_t length : {8U, 64U, 244U}) {
    chip.put_outputs(Bytes(length));
    begin();
    ASSERT_EQ(exchange(Bytes(length)), DSDPV1_OK);
    const std::string number = std::to_string(length);
    expect_row("exchange, " + number + " inputs, " + number + " outputs");
  }
}

TEST_F(GuideBudget, Judging) {
  initialise(2, 2);
  chip.put_prm(Bytes(18));
  begin();
  ASSERT_EQ(dsdpv1_service(&device), DSDPV1_OK);
  expect_row("service, 18 parameter bytes, verdict");
  chip.put_cfg(8, 8, Bytes(2));
  begin();
  ASSERT_EQ(dsdpv1_service(&device), DSDPV1_OK);
  expect_row("service, 2 configuration bytes, verdict");
  chip.put_prm(Bytes(237));
  chip.put_cfg(8, 8, Bytes(200));
  begin();
  ASSERT_EQ(dsdpv1_service(&device), DSDPV1_OK);
  expect_row("service, 237 parameter and 200 configuration bytes, verdicts");
}

TEST_F(GuideBudget, DiagnosisAndStatus) {
  initialise();
  const Bytes data(238);
  begin();
  ASSERT_EQ(dsdpv1_set_diagnosis(&device, DSDPV1_DIAG_EXTERNAL, data.data(), 9), DSDPV1_OK);
  expect_row("set_diagnosis, 9 bytes");
  begin();
  ASSERT_EQ(dsdpv1_set_diagnosis(&device, DSDPV1_DIAG_EXTERNAL, data.data(), 238), DSDPV1_OK);
  expect_row("set_diagnosis, 238 bytes");
  dsdpv1_status status{};
  begin();
  ASSERT_EQ(dsdpv1_get_status(&device, &status), DSDPV1_OK);
  expect_row("get_status");
}

class GuideAcyclicBudget : public AcyclicTest {
 protected:
  /// One poll with that request, after everything earlier has settled.
  void expect_row(const std::string& what, const Bytes& request) {
    EXPECT_EQ(poll(), DSDPV1_OK);
    chip.holds = chip.accesses = 0;
    EXPECT_FALSE(ask(1, request).empty());
    expect_row_of(chip, what);
  }
};

TEST_F(GuideAcyclicBudget, Polls) {
  dsdpv1_im0 im0{};
  im0.order_id = im0.serial_number = "1";
  table.im0 = &im0;
  open();
  chip.holds = chip.accesses = 0;
  EXPECT_EQ(poll(), DSDPV1_OK);
  expect_row_of(chip, "acyclic_poll, no request");
  expect_row("acyclic_poll, read answered with 4 bytes", {0x5E, 1, 1, 4});
  chip.holds = chip.accesses = 0;
  EXPECT_EQ(poll(), DSDPV1_OK);
  expect_row_of(chip, "acyclic_poll, no request, first after an answer");
  expect_row("acyclic_poll, write of 4 bytes", {0x5F, 1, 1, 4, 1, 2, 3, 4});
  expect_row("acyclic_poll, read answered with 240 bytes", {0x5E, 1, 5, 240});
  expect_row("acyclic_poll, write of 240 bytes", with_data({0x5F, 1, 5, 240}, Bytes(240)));
  static_cast<void>(ask(1, {0x5F, 0, 255, 4, 0x08, 0x00, 0xFD, 0xE8}));
  expect_row("acyclic_poll, I&M0 read", {0x5E, 0, 255, 68});
}

/// The example, run on the fake chip.
class GuideExample : public AcyclicTest {
 protected:
  void SetUp() override {
    AcyclicTest::SetUp();
    board::flash.clear();
    board::busy = board::failed = false;
    ASSERT_EQ(drive_open(&device), DSDPV1_OK);
    initialise();
  }
  Bytes answer_to(int master_class, const Bytes& request) {
    chip.answers[master_class - 1].clear();
    chip.put_request(master_class, request);
    EXPECT_EQ(drive_poll(), DSDPV1_OK);
    return chip.answers[master_class - 1];
  }
};

using testing::ElementsAre;
using testing::IsEmpty;

TEST_F(GuideExample, LimitsAreWrittenAndReadBack) {
  EXPECT_THAT(answer_to(1, {0x5F, 1, 10, 4, 1, 2, 3, 4}), ElementsAre(0x5F, 1, 10, 4));
  EXPECT_THAT(answer_to(2, {0x5E, 1, 10, 4}), ElementsAre(0x5E, 1, 10, 4, 1, 2, 3, 4));
  EXPECT_THAT(answer_to(1, {0x5F, 1, 10, 3, 1, 2, 3}), ElementsAre(0xDF, 0x80, 0xB1, 0));
}

TEST_F(GuideExample, SpeedIsMeasured) {
  EXPECT_THAT(answer_to(1, {0x5E, 1, 11, 2}), ElementsAre(0x5E, 1, 11, 2, 0x05, 0xDC));
  EXPECT_THAT(answer_to(1, {0x5F, 1, 11, 2, 0, 0}), ElementsAre(0xDF, 0x80, 0xB6, 0));
}

TEST_F(GuideExample, StoreIsAnsweredWhenTheFlashIsReady) {
  EXPECT_THAT(answer_to(1, {0x5F, 2, 1, 1, 7}), ElementsAre(0xDF, 0x80, 0xB6, 0)) << "class 2 only";
  EXPECT_THAT(answer_to(2, {0x5F, 2, 1, 2, 7, 8}), IsEmpty());
  EXPECT_THAT(board::flash, ElementsAre(7, 8));
  EXPECT_EQ(drive_poll(), DSDPV1_OK);
  EXPECT_THAT(last_answer(2), IsEmpty());
  board::busy = false;
  EXPECT_EQ(drive_poll(), DSDPV1_OK);
  EXPECT_THAT(last_answer(2), ElementsAre(0x5F, 2, 1, 2));
}

TEST_F(GuideExample, FailedStoreIsRefused) {
  EXPECT_THAT(answer_to(2, {0x5F, 2, 1, 1, 7}), IsEmpty());
  board::busy = false;
  board::failed = true;
  EXPECT_EQ(drive_poll(), DSDPV1_OK);
  EXPECT_THAT(last_answer(2), ElementsAre(0xDF, 0x80, 0xA1, 0));
}

TEST_F(GuideExample, MasterThatAsksAnewDuringAStoreIsToldBusy) {
  EXPECT_THAT(answer_to(2, {0x5F, 2, 1, 1, 7}), IsEmpty());
  EXPECT_THAT(answer_to(2, {0x5F, 2, 1, 1, 9}), ElementsAre(0xDF, 0x80, 0xC2, 0));
  EXPECT_THAT(board::flash, ElementsAre(7));
  board::busy = false;
  EXPECT_EQ(drive_poll(), DSDPV1_OK) << "the first one's answer is stale, which is no error";
  EXPECT_THAT(last_answer(2), ElementsAre(0xDF, 0x80, 0xC2, 0));
}

TEST_F(GuideExample, Nameplate) {
  EXPECT_THAT(answer_to(2, {0x5F, 0, 255, 4, 0x08, 0x00, 0xFD, 0xE8}), ElementsAre(0x5F, 0, 255, 4));
  const Bytes answer = answer_to(2, {0x5E, 0, 255, 68});
  ASSERT_EQ(answer.size(), 72U);
  EXPECT_EQ(std::string(answer.begin() + 20, answer.begin() + 27), "DRIVE-1");
}

}  // namespace
}  // namespace dsdpv1
