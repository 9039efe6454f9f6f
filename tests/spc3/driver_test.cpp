// The driver for products (driver/spc3) on the chip: both are written from docs/spc3.md, neither with sight of the
// other.
#include "driver/spc3/spc3.h"
#include "tests/spc3/bench.hpp"

namespace dsdpv1::spc3_test {
namespace {

class Spc3Driver : public testing::TestWithParam<Variant> {
 protected:
  void SetUp() override {
    const spc3_port port = {
        &bench, [](void* ctx, std::uint16_t address) { return static_cast<Bench*>(ctx)->load(address); },
        [](void* ctx, std::uint16_t address, std::uint8_t value) { static_cast<Bench*>(ctx)->store(address, value); }};
    spc3_application application = {};
    application.ctx = this;
    application.prm = [](void* ctx, const std::uint8_t* bytes, std::uint8_t length) {
      auto& test = *static_cast<Spc3Driver*>(ctx);
      test.prm.assign(bytes, bytes + length);
      return test.accepts;
    };
    application.address = [](void* ctx, std::uint8_t address, bool, const std::uint8_t*, std::uint8_t) {
      static_cast<Spc3Driver*>(ctx)->given = address;
    };
    application.control = [](void* ctx, std::uint8_t command) { static_cast<Spc3Driver*>(ctx)->control = command; };
    ASSERT_EQ(spc3_open(&device, &port, &application), SPC3_OK);
    config.address = 5;
    config.ident = 0x0CC9;
    config.max_output = 2;
    config.max_input = 3;
    config.max_diag = 10;
    config.max_prm = 30;
    config.max_cfg = 10;
    config.max_ssa = 10;
    config.cfg = kCfg;
    config.cfg_length = sizeof kCfg;
    config.sync = config.freeze = true;
    config.user_wd = 10;
    config.interrupts = 0xFFFF;
    config.vpc3 = GetParam() == Variant::kVpc3;
    bench.power_on();
  }
  void bring_up() {
    ASSERT_EQ(spc3_initialise(&device, &config), SPC3_OK);
    bench.run_cycles(2);
    spc3_start(&device);
    bench.run_cycles(2);
    bench.find_baud();
    spc3_service(&device);
  }
  void to_data_ex() {
    bring_up();
    bench.set_prm({0, 0x42});
    spc3_service(&device);
    bench.check_cfg({0x12, 0x21});
    spc3_service(&device);
    ASSERT_EQ(give({1, 2, 3}), SPC3_OK);
    bench.run_cycles(2);
    ASSERT_EQ(bench.state(), DpState::kDataExch);
  }
  spc3_error give(const Bytes& inputs) {
    return spc3_set_inputs(&device, inputs.data(), static_cast<std::uint8_t>(inputs.size()));
  }
  Bytes fetch() {
    Bytes bytes(2);
    spc3_outputs outputs = {bytes.data(), 2, 0, false, false};
    EXPECT_EQ(spc3_get_outputs(&device, &outputs), SPC3_OK);
    EXPECT_TRUE(outputs.fresh);
    cleared = outputs.cleared;
    return bytes;
  }

  static constexpr std::uint8_t kCfg[] = {0x12, 0x21};
  Bench bench{GetParam()};
  spc3_device device = {};
  spc3_config config = {};
  Bytes prm;
  bool accepts = true, cleared = false;
  int given = 0, control = 0;
};
INSTANTIATE_TEST_SUITE_P(Names, Spc3Driver, testing::Values(Variant::kApc3, Variant::kSpc3, Variant::kVpc3),
                         [](const auto& tested) { return std::string(spc3::row(tested.param).name); });

TEST_P(Spc3Driver, BringsTheChipToDataExchange) {
  to_data_ex();
  EXPECT_EQ(prm, (Bytes{0x80, 0, 0, 0, 0x0C, 0xC9, 0, 0, 0x42}));
  EXPECT_EQ(bench.exchange({7, 8}).answer().data, (Bytes{1, 2, 3}));
  bench.run_cycles(3);
  EXPECT_EQ(bench.twins.chip().level(Pin::kXInt), 0);
  EXPECT_NE(spc3_service(&device) & regs::kEventDxOut, 0);
  bench.run_cycles(1);
  EXPECT_EQ(bench.twins.chip().level(Pin::kXInt), 1) << "EOI";
  EXPECT_EQ(fetch(), (Bytes{7, 8}));
  EXPECT_EQ(bench.ask(59).answer().data, (Bytes{0x12, 0x21}));
}

TEST_P(Spc3Driver, AnswersConflictsUntilTheNewestIsJudged) {
  bring_up();
  bench.set_prm({0, 1});
  bench.set_prm({0, 2, 2});
  spc3_service(&device);
  EXPECT_EQ(prm.back(), 2);
  EXPECT_EQ(prm.size(), 10U);
  EXPECT_EQ(bench.irr() & regs::kEventNewPrm, 0);
  accepts = false;
  bench.set_prm({0, 3});
  spc3_service(&device);
  bench.run_cycles(2);
  EXPECT_EQ(bench.state(), DpState::kWaitPrm);
  EXPECT_EQ(bench.diag()[0], 0x42);
}

TEST_P(Spc3Driver, GivesDiagnosesAndServesTheWatchdog) {
  to_data_ex();
  const std::uint8_t user[] = {3, 0xAA, 0xBB};
  EXPECT_EQ(spc3_set_diagnosis(&device, SPC3_DIAG_EXT, user, 3), SPC3_OK);
  EXPECT_EQ(kind_of(bench.exchange({1, 1})), "DH");
  EXPECT_EQ(bench.diag(), (Bytes{0x08, 0x0C & 0x04, 0x00, 0x02, 0x0C, 0xC9, 3, 0xAA, 0xBB}));
  for (int i = 0; i < 30; ++i) {
    EXPECT_EQ(kind_of(bench.exchange({1, 1})), "DL");
    if (i % 8 == 0) spc3_serve_watchdog(&device);
    spc3_service(&device);
  }
  EXPECT_EQ(bench.state(), DpState::kDataExch);
  for (int i = 0; i < 11; ++i) bench.exchange({1, 1});
  EXPECT_EQ(bench.state(), DpState::kWaitPrm) << "never served";
  fetch();
  EXPECT_TRUE(cleared);
}

TEST_P(Spc3Driver, HearsOfAddressesAndControls) {
  bring_up();
  bench.ask(55, {77, 0x0C, 0xC9, 0});
  spc3_service(&device);
  EXPECT_EQ(given, 77);
  bench.address = 77;
  bench.set_prm({}, 0xB0);
  bench.check_cfg();
  spc3_service(&device);
  give({1, 2, 3});
  bench.run_cycles(2);
  bench.control(0x20);
  spc3_service(&device);
  EXPECT_EQ(control, 0x20);
}

TEST_P(Spc3Driver, ComesBackFromOffline) {
  to_data_ex();
  spc3_go_offline(&device);
  bench.run_cycles(2);
  EXPECT_NE(spc3_service(&device) & regs::kEventMacReset, 0);
  to_data_ex();
}

}  // namespace
}  // namespace dsdpv1::spc3_test
