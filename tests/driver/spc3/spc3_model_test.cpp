// The driver of the SPC3 family with the model: a master's telegrams on one side, the driver's accesses on the other,
// polled and by X/INT, for each name of the chip. The checks of the user's side find no rule broken.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <tuple>
#include <vector>

#include "driver/spc3/spc3.h"
#include "tests/spc3/bench.hpp"
#include "tests/spc3/check_feed.hpp"

namespace dsdpv1::spc3_test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr unsigned kPrmFault = 0x40, kCfgFault = 0x04, kExtDiag = 0x08, kStatDiag = 0x02;
constexpr Cycle kAccess = 4;

enum class Mode { kPolled, kInterrupt };

class Spc3WithModel : public testing::TestWithParam<std::tuple<Variant, Mode>> {
 protected:
  Spc3WithModel() : bench(std::get<Variant>(GetParam())) {
    config.address = 5;
    config.ident = 0x0CC9;
    config.sync = config.freeze = true;
    config.max_output = 4;
    config.max_input = 3;
    config.max_diag = 9;
    config.max_prm = 20;
    config.max_cfg = 8;
    config.max_ssa = 8;
    config.cfg = cfg.data();
    config.cfg_length = 2;
    config.user_wd = 1000;
    config.vpc3 = std::get<Variant>(GetParam()) == Variant::kVpc3;
    if (std::get<Mode>(GetParam()) == Mode::kInterrupt)
      config.interrupts = regs::kEventMacReset | regs::kEventBaudDetect | regs::kEventNewGc | regs::kEventNewSsa |
                          regs::kEventNewCfg | regs::kEventNewPrm;
    application.ctx = this;
    application.prm = [](void* ctx, const std::uint8_t* bytes, std::uint8_t length) {
      auto& test = *static_cast<Spc3WithModel*>(ctx);
      test.prm_seen.emplace_back(bytes + 7, bytes + length);
      return test.judged();
    };
    application.address = [](void* ctx, std::uint8_t now, bool, const std::uint8_t*, std::uint8_t) {
      static_cast<Spc3WithModel*>(ctx)->bench.address = now;
    };
    application.control = [](void* ctx, std::uint8_t command) {
      static_cast<Spc3WithModel*>(ctx)->controls.push_back(command);
    };
  }

  void TearDown() override {
    checks.finish();
    EXPECT_EQ(checks.broken, breaks) << checks.texts;
    EXPECT_EQ(bench.count(spc3::Reason::kOrganisationOnline), 0);
  }

  void judge_cfg_by_test() {
    application.cfg = [](void* ctx, spc3_cfg* block) {
      auto& test = *static_cast<Spc3WithModel*>(ctx);
      test.cfg_seen.emplace_back(block->bytes, block->bytes + block->length);
      if (block->bytes[0] == 0x21) block->output_length = 2;
      return test.judged();
    };
  }

  /// Something may happen while the application judges.
  bool judged() {
    const auto once = std::exchange(while_judging, nullptr);
    if (once) once();
    return right;
  }

  /// From RESET, or OFFLINE, to the search.
  void begin() {
    while (spc3_initialise(&chip, &config) == SPC3_ERR_NOT_OFFLINE) bench.run_cycles(kMs);
    if (before_start) before_start();
    ASSERT_EQ(spc3_set_inputs(&chip, inputs.data(), static_cast<std::uint8_t>(inputs.size())), SPC3_OK);
    spc3_start(&chip);
  }

  void power_on() {
    spc3_port port{};
    port.ctx = this;
    port.read = [](void* ctx, std::uint16_t address) { return test_of(ctx).read(address); };
    port.write = [](void* ctx, std::uint16_t address, std::uint8_t value) { test_of(ctx).write(address, value); };
    bench.power_on();
    checks.released();
    ASSERT_EQ(spc3_open(&chip, &port, &application), SPC3_OK);
    begin();
    bench.find_baud();
    turn();
  }

  /// One of the firmware's main loop; by interrupt the events come only with X/INT.
  void turn() {
    const bool polled = std::get<Mode>(GetParam()) == Mode::kPolled;
    if (polled || bench.twins.chip().level(Pin::kXInt) == 0)
      events = static_cast<std::uint16_t>(events | spc3_service(&chip));
    const auto length = bench.twins.chip().peek(regs::kOrgDinLength);
    EXPECT_EQ(spc3_set_inputs(&chip, inputs.data(), length), SPC3_OK);
    outputs.resize(4);
    result = {outputs.data(), 4, 0, false, false};
    EXPECT_EQ(spc3_get_outputs(&chip, &result), SPC3_OK);
    outputs.resize(result.length);
    if (serves) spc3_serve_watchdog(&chip);
    bench.run_cycles(100);
  }

  void to_data_ex() {
    power_on();
    parameterise();
  }

  void parameterise() {
    ASSERT_EQ(kind_of(bench.set_prm({0, 7})), "SC");
    turn();
    ASSERT_EQ(kind_of(bench.check_cfg(cfg)), "SC");
    turn();
    ASSERT_EQ(bench.state(), DpState::kDataExch);
  }

  Bytes exchange(const Bytes& data) {
    const bus::Exchange exchange = bench.exchange(data);
    turn();
    return exchange.answered() ? exchange.answer().data : Bytes{};
  }

  static Spc3WithModel& test_of(void* ctx) { return *static_cast<Spc3WithModel*>(ctx); }
  std::uint8_t read(std::uint16_t address) {
    bench.run_cycles(kAccess);
    const std::uint8_t value = bench.load(address);
    checks.accessed(address, value, false);
    return value;
  }
  void write(std::uint16_t address, std::uint8_t value) {
    bench.run_cycles(kAccess);
    bench.store(address, value);
    checks.accessed(address, value, true);
  }

  Bench bench;
  CheckFeed checks{bench, std::get<Variant>(GetParam())};
  std::set<std::string> breaks;  ///< rules of the user's side
  spc3_device chip{};
  spc3_config config{};
  spc3_application application{};
  spc3_outputs result{};
  Bytes cfg = {0x23, 0x12}, inputs = {0xA1, 0xA2, 0xA3}, outputs, controls;
  std::vector<Bytes> prm_seen, cfg_seen;
  std::function<void()> while_judging, before_start;
  std::uint16_t events = 0;
  bool right = true, serves = true;
};

TEST_P(Spc3WithModel, PowerOnEndsInDataExchange) {
  power_on();
  EXPECT_EQ(events & regs::kEventBaudDetect, regs::kEventBaudDetect);
  ASSERT_EQ(bench.diag().size(), 6U);
  parameterise();
  EXPECT_THAT(prm_seen, ElementsAre(Bytes{0, 7}));
  EXPECT_EQ(kind_of(bench.exchange({1, 2, 3, 4})), "DL");
  turn();
  EXPECT_TRUE(result.fresh);
  EXPECT_THAT(outputs, ElementsAre(1, 2, 3, 4));
  inputs = {0xB1, 0xB2, 0xB3};
  exchange({5, 6, 7, 8});
  EXPECT_THAT(outputs, ElementsAre(5, 6, 7, 8));
  EXPECT_EQ(exchange({5, 6, 7, 8}), inputs);
  EXPECT_EQ(spc3_status(&chip) & regs::kStatusDpState, regs::kDpStateDataEx << regs::kStatusDpStateShift);
}

TEST_P(Spc3WithModel, TheFirstInputsAreThoseBeforeStart) {
  to_data_ex();
  EXPECT_EQ(exchange({1, 2, 3, 4}), (Bytes{0xA1, 0xA2, 0xA3}));
}

TEST_P(Spc3WithModel, ASetPrmOfSevenBytesIsTheChips) {
  power_on();
  ASSERT_EQ(kind_of(bench.set_prm()), "SC");
  turn();
  EXPECT_EQ(bench.state(), DpState::kWaitCfg);
  EXPECT_THAT(prm_seen, IsEmpty());
}

TEST_P(Spc3WithModel, WrongParametersAreAFault) {
  power_on();
  right = false;
  bench.set_prm({0, 7});
  turn();
  EXPECT_EQ(bench.state(), DpState::kWaitPrm);
  EXPECT_EQ(bench.diag()[0] & kPrmFault, kPrmFault);
}

TEST_P(Spc3WithModel, ParametersThatComeDuringTheJudgingAreJudgedToo) {
  power_on();
  while_judging = [this] { EXPECT_EQ(kind_of(bench.set_prm({0, 8, 9})), "SC"); };
  bench.set_prm({0, 7});
  turn();
  EXPECT_THAT(prm_seen, ElementsAre(Bytes{0, 7}, Bytes{0, 8, 9}));
  EXPECT_EQ(bench.state(), DpState::kWaitCfg);
  EXPECT_FALSE(bench.raised(regs::kEventNewPrm));
}

TEST_P(Spc3WithModel, WrongConfigurationsAreAFault) {
  power_on();
  bench.set_prm({0, 7});
  turn();
  bench.check_cfg({0x23, 0x11});
  turn();
  EXPECT_EQ(bench.state(), DpState::kWaitPrm);
  EXPECT_EQ(bench.diag()[0] & kCfgFault, kCfgFault);
  EXPECT_FALSE(bench.raised(regs::kEventNewCfg));
}

TEST_P(Spc3WithModel, AConfigurationThatComesDuringTheJudgingIsJudgedToo) {
  judge_cfg_by_test();
  config.change_cfg = true;
  power_on();
  bench.set_prm({0, 7});
  turn();
  while_judging = [this] { EXPECT_EQ(kind_of(bench.check_cfg({0x21, 0x12, 0})), "SC"); };
  bench.check_cfg(cfg);
  turn();
  EXPECT_THAT(cfg_seen, ElementsAre(cfg, Bytes{0x21, 0x12, 0}));
  EXPECT_EQ(bench.state(), DpState::kDataExch);
  EXPECT_EQ(bench.ask(59).answer().data, (Bytes{0x21, 0x12, 0}));
}

TEST_P(Spc3WithModel, LengthsAndGetCfgFollowTheConfiguration) {
  judge_cfg_by_test();
  config.change_cfg = true;
  power_on();
  EXPECT_EQ(bench.ask(59).answer().data, cfg);
  bench.set_prm({0, 7});
  turn();
  bench.check_cfg({0x21, 0x12});
  turn();
  ASSERT_EQ(bench.state(), DpState::kDataExch);
  EXPECT_EQ(bench.ask(59).answer().data, (Bytes{0x21, 0x12}));
  exchange({1, 2});
  EXPECT_THAT(outputs, ElementsAre(1, 2));
  EXPECT_EQ(bench.state(), DpState::kDataExch);
}

TEST_P(Spc3WithModel, OtherLengthsEndDataExchange) {
  judge_cfg_by_test();
  to_data_ex();
  bench.check_cfg(cfg);
  turn();
  EXPECT_EQ(bench.state(), DpState::kDataExch);
  bench.check_cfg({0x21, 0x12});
  turn();
  EXPECT_EQ(bench.state(), DpState::kWaitPrm);
}

TEST_P(Spc3WithModel, TheFirstDiagnosisIsThatBeforeStart) {
  before_start = [this] {
    const Bytes bytes = {3, 0x42, 0x43};
    EXPECT_EQ(spc3_set_diagnosis(&chip, SPC3_DIAG_EXT, bytes.data(), 3), SPC3_OK);
  };
  power_on();
  const Bytes diag = bench.diag();
  ASSERT_EQ(diag.size(), 9U);
  EXPECT_EQ(diag[0] & kExtDiag, kExtDiag);
  EXPECT_THAT(Bytes(diag.begin() + 6, diag.end()), ElementsAre(3, 0x42, 0x43));
}

TEST_P(Spc3WithModel, ADiagnosisIsAnnouncedFetchedAndGone) {
  to_data_ex();
  const Bytes bytes = {2, 0x55};
  ASSERT_EQ(spc3_set_diagnosis(&chip, SPC3_DIAG_EXT, bytes.data(), 2), SPC3_OK);
  EXPECT_EQ(kind_of(bench.exchange({1, 2, 3, 4})), "DH");
  const Bytes diag = bench.diag();
  ASSERT_EQ(diag.size(), 8U);
  EXPECT_EQ(diag[7], 0x55);
  EXPECT_EQ(kind_of(bench.exchange({1, 2, 3, 4})), "DL");
  ASSERT_EQ(spc3_set_diagnosis(&chip, 0, nullptr, 0), SPC3_OK);
  EXPECT_EQ(kind_of(bench.exchange({1, 2, 3, 4})), "DH");
  EXPECT_EQ(bench.diag().size(), 6U);
  EXPECT_EQ(kind_of(bench.exchange({1, 2, 3, 4})), "DL");
}

TEST_P(Spc3WithModel, StatDiagKeepsTheAnnouncement) {
  to_data_ex();
  ASSERT_EQ(spc3_set_diagnosis(&chip, SPC3_DIAG_STAT, nullptr, 0), SPC3_OK);
  EXPECT_EQ(bench.diag()[1] & kStatDiag, kStatDiag);
  EXPECT_EQ(kind_of(bench.exchange({1, 2, 3, 4})), "DH");
}

TEST_P(Spc3WithModel, ClearGivesZerosAndItsCommand) {
  to_data_ex();
  exchange({1, 2, 3, 4});
  bench.control(regs::kOrgGcCommandClearData);
  turn();
  EXPECT_THAT(controls, ElementsAre(regs::kOrgGcCommandClearData));
  EXPECT_TRUE(result.cleared);
  EXPECT_THAT(outputs, ElementsAre(0, 0, 0, 0));
}

TEST_P(Spc3WithModel, ANewAddressIsToldAndTheNextOneTaken) {
  power_on();
  for (const std::uint8_t address : Bytes{20, 21}) {
    EXPECT_EQ(kind_of(bench.ask(55, {address, 0x0C, 0xC9, 0})), "SC");
    turn();
    EXPECT_EQ(bench.address, address);
    EXPECT_EQ(bench.diag().size(), 6U);
  }
}

TEST_P(Spc3WithModel, TheUserWatchdogEndsDataExchangeUnlessServed) {
  config.user_wd = 5;
  breaks = {"LIVE_WATCHDOG"};
  to_data_ex();
  for (int i = 0; i < 20; ++i) exchange({1, 2, 3, 4});
  EXPECT_EQ(bench.state(), DpState::kDataExch);
  serves = false;
  exchange({1, 2, 3, 4});  // the last turn's service counts here
  for (int i = 0; i < 4; ++i) exchange({1, 2, 3, 4});
  EXPECT_EQ(bench.state(), DpState::kDataExch);
  exchange({1, 2, 3, 4});
  EXPECT_EQ(bench.state(), DpState::kWaitPrm);
  EXPECT_TRUE(result.cleared);
}

TEST_P(Spc3WithModel, AfterLeaveMasterDataExchangeComesAgain) {
  to_data_ex();
  exchange({1, 2, 3, 4});
  spc3_leave_master(&chip);
  bench.run_cycles(10);
  EXPECT_EQ(bench.state(), DpState::kWaitPrm);
  turn();
  EXPECT_TRUE(result.cleared);
  parameterise();
  exchange({9, 8, 7, 6});
  EXPECT_THAT(outputs, ElementsAre(9, 8, 7, 6));
}

TEST_P(Spc3WithModel, AfterGoOfflineTheChipIsInitialisedAgain) {
  to_data_ex();
  spc3_go_offline(&chip);
  bench.run_cycles(100);
  events = 0;
  turn();
  ASSERT_EQ(events & regs::kEventMacReset, regs::kEventMacReset);
  EXPECT_EQ(spc3_status(&chip) & regs::kStatusPassiveIdle, 0);
  inputs = {0xC1, 0xC2, 0xC3};
  begin();
  bench.find_baud();
  turn();
  parameterise();
  EXPECT_EQ(exchange({1, 2, 3, 4}), inputs);
}

TEST_P(Spc3WithModel, AChipInDataExchangeIsTakenOfflineByAnotherInitialisation) {
  to_data_ex();
  EXPECT_EQ(spc3_initialise(&chip, &config), SPC3_ERR_NOT_OFFLINE);
  begin();
  bench.find_baud();
  turn();
  parameterise();
}

TEST_P(Spc3WithModel, ALostRateComesBackWithTheMinTsdrOfTheLastSetPrm) {
  config.baud_control = 1;  // 10 ms
  power_on();
  bench.set_prm({0, 7}, 0x80, 0, 0, 100);
  turn();
  bench.check_cfg(cfg);
  turn();
  bench.run_ms(12);
  EXPECT_EQ(spc3_status(&chip) & regs::kStatusWdState, 0) << "it searches";
  events = 0;
  bench.find_baud();
  turn();
  EXPECT_EQ(events & regs::kEventBaudDetect, regs::kEventBaudDetect);
  const bus::Exchange exchange = bench.exchange({1, 2, 3, 4});
  ASSERT_TRUE(exchange.answered());
  EXPECT_GE(exchange.tsdr_bits(), 100);
  EXPECT_LT(exchange.tsdr_bits(), 110);
  EXPECT_EQ(bench.state(), DpState::kDataExch);
}

TEST_P(Spc3WithModel, OnlyAVpc3Has2Kb) {
  const bool vpc3 = config.vpc3;
  if (!vpc3) breaks = {"USE_RAM"};
  power_on();
  spc3_go_offline(&chip);
  bench.run_cycles(100);
  config.vpc3 = true;
  EXPECT_EQ(spc3_initialise(&chip, &config), vpc3 ? SPC3_OK : SPC3_ERR_RAM);
}

std::string name_of(const testing::TestParamInfo<std::tuple<Variant, Mode>>& info) {
  const char* names[] = {"Apc3", "Spc3", "Vpc3"};
  return std::string(names[static_cast<int>(std::get<Variant>(info.param))]) +
         (std::get<Mode>(info.param) == Mode::kPolled ? "Polled" : "ByInterrupt");
}
INSTANTIATE_TEST_SUITE_P(Each, Spc3WithModel,
                         testing::Combine(testing::Values(Variant::kApc3, Variant::kSpc3, Variant::kVpc3),
                                          testing::Values(Mode::kPolled, Mode::kInterrupt)),
                         name_of);

}  // namespace
}  // namespace dsdpv1::spc3_test
