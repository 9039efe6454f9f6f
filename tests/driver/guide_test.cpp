// The numbers of the timing budget in docs/programmers_guide.md: DPRAM accesses and holds of each call, counted.
#include <fstream>
#include <sstream>

#include "tests/driver/driver_fixture.hpp"

namespace {

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
  /// The guide has the row "| what | holds | accesses |" with the numbers just counted.
  void expect_row(const std::string& what) {
    std::ifstream file(GUIDE);
    std::stringstream guide;
    guide << file.rdbuf();
    const std::string row =
        "| " + what + " | " + std::to_string(chip.holds) + " | " + std::to_string(chip.accesses) + " |";
    EXPECT_NE(guide.str().find(row), std::string::npos) << "the guide should say: " << row;
  }
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

}  // namespace
