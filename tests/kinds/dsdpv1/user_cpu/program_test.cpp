// The standard program on the driver tests' fake chip, which makes an access at every release.
#include "kinds/dsdpv1/user_cpu/programs.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>

#include "tests/driver/fake_chip.hpp"

namespace dsdpv1 {
namespace {

using bus::Tick;
using testing::ElementsAre;
using testing::IsEmpty;
using user_cpu::InputSource;
using user_cpu::Judgement;
using user_cpu::ProgramOptions;
namespace command = user_cpu::command;

/// The fake chip as a HostBus: one edge an access, 100 ns each.
class FakeChipBus : public user_cpu::HostBus {
 public:
  explicit FakeChipBus(FakeChip& chip) : port_(chip.port()) {}
  void set_r_req(Tick, bool level) override { port_.set_r_req(port_.ctx, level); }
  void set_r_sta(Tick, bool level) override { port_.set_r_sta(port_.ctx, level); }
  bool l_req(Tick) override { return port_.get_l_req(port_.ctx); }
  bool l_sta(Tick) override { return port_.get_l_sta(port_.ctx); }
  bool intr0(Tick) override { return true; }
  void begin(Tick at, const user_cpu::Access& access, const AccessTiming&) override {
    access_ = access;
    edge_ = at + 100 * bus::kTicksPerNs;
    end_ = edge_;
  }
  Tick next_edge() const override { return edge_; }
  void run_edges(Tick) override {
    edge_ = bus::kNever;
    if (access_.write)
      port_.write(port_.ctx, access_.address, access_.value);
    else
      value_ = port_.read(port_.ctx, access_.address);
  }
  Tick end() const override { return end_; }
  std::uint8_t read_value() const override { return value_; }
  bool last_read_was_bad() const override { return false; }

 private:
  dsdpv1_port port_;
  user_cpu::Access access_;
  Tick edge_ = bus::kNever, end_ = 0;
  std::uint8_t value_ = 0;
};

class Program : public testing::Test {
 protected:
  using Bytes = std::vector<std::uint8_t>;
  static constexpr Tick kMs = bus::kTicksPerMs;

  Program() { options.station.max_cfg = DSDPV1_MAX_CFG; }
  void start() {
    program = std::make_unique<user_cpu::UserProgram>(options);
    cpu = std::make_unique<user_cpu::NativeCpu>(host, user_cpu::CpuTiming{}, program->entry());
    timeline.add(*cpu);
  }
  void run_for(Tick ticks) { timeline.run_until(timeline.now() + ticks); }
  void intr0() { cpu->intr0_changed(timeline.now(), false); }
  void post(const user_cpu::DriverCommand& what) {
    program->post(what);
    cpu->wake(timeline.now());
  }
  /// Brought up and configured for `inputs` bytes in, `outputs` out.
  void bring_up(std::uint8_t inputs, std::uint8_t outputs) {
    start();
    run_for(2 * kMs);
    chip.put_cfg(outputs, inputs, {0x10});
    intr0();
    run_for(kMs);
  }
  void TearDown() override {
    cpu.reset();
    EXPECT_THAT(chip.violations, IsEmpty());
  }

  bool prm_due = false;
  FakeChip chip;
  FakeChipBus host{chip};
  ProgramOptions options;
  bus::Timeline timeline;
  std::unique_ptr<user_cpu::UserProgram> program;
  std::unique_ptr<user_cpu::NativeCpu> cpu;
};

TEST_F(Program, InitialisesAfterTheStartDelay) {
  options.start_delay = 5 * kMs;
  start();
  run_for(4 * kMs);
  EXPECT_EQ(chip.initialisations, 0);
  run_for(2 * kMs);
  EXPECT_EQ(chip.initialisations, 1);
  EXPECT_TRUE(program->initialised());
  EXPECT_THAT(program->errors(), IsEmpty());
}

TEST_F(Program, RepeatsAFailedInitialisation) {
  chip.present = false;
  chip.at(0x004) = 0;
  start();
  run_for(50 * kMs);
  ASSERT_FALSE(program->errors().empty());
  EXPECT_EQ(program->errors()[0].error, DSDPV1_ERR_CHIP_NOT_READY);
  chip.present = true;
  run_for(20 * kMs);
  EXPECT_EQ(chip.initialisations, 1);
}

TEST_F(Program, InitialisationWithAWrongCrcIsReported) {
  bring_up(1, 1);
  post(command::WrongCrc{command::Area::kInit, 1});
  post(command::Reinitialise{options.station});
  run_for(kMs);
  ASSERT_EQ(program->errors().size(), 1U);
  EXPECT_EQ(program->errors()[0].error, DSDPV1_ERR_INIT_CRC);
  EXPECT_STREQ(program->errors()[0].during, "initialise");
}

TEST_F(Program, GivesUpAfterTheAllowedAttempts) {
  options.station.address = 127;
  options.init_attempts = 3;
  start();
  run_for(10 * kMs);
  EXPECT_TRUE(cpu->ended());
  EXPECT_EQ(program->counters().driver_errors, 3U);
}

TEST_F(Program, ExchangesAtItsPeriod) {
  options.period = kMs;
  bring_up(1, 1);
  const auto before = program->counters().exchanges;
  run_for(20 * kMs);
  EXPECT_EQ(program->counters().exchanges, before + 20);
}

TEST_F(Program, WritesNoInputsBeforeTheConfigurationIsKnown) {
  start();
  run_for(2 * kMs);
  EXPECT_EQ(program->counters().inputs_written, 0U);
  EXPECT_GT(program->counters().exchanges, 0U);
}

TEST_F(Program, LoopsOutputsBack) {
  bring_up(3, 2);
  chip.put_outputs({0x11, 0x22});
  run_for(kMs);
  EXPECT_EQ(program->outputs(), (Bytes{0x11, 0x22}));
  EXPECT_EQ(chip.inputs, (Bytes{0x11, 0x22, 0x00}));
  EXPECT_EQ(program->counters().outputs_received, 1U);
}

TEST_F(Program, CountsInTheInputs) {
  options.inputs = InputSource::kCount;
  options.period = kMs;
  bring_up(2, 0);
  const Bytes first = chip.inputs;
  run_for(kMs);
  ASSERT_EQ(first.size(), 2U);
  EXPECT_EQ(chip.inputs[0], first[0] + 1);
  EXPECT_EQ(chip.inputs[0], chip.inputs[1]);
}

TEST_F(Program, ConstantInputs) {
  options.inputs = InputSource::kConstant;
  options.constant = {9, 8, 7};
  bring_up(2, 0);
  EXPECT_EQ(chip.inputs, (Bytes{9, 8}));
}

TEST_F(Program, SetInputsOverridesTheSource) {
  options.inputs = InputSource::kIdle;
  bring_up(2, 0);
  EXPECT_EQ(program->counters().inputs_written, 0U);
  post(command::SetInputs{{1, 2}});
  run_for(kMs);
  EXPECT_EQ(chip.inputs, (Bytes{1, 2}));
  EXPECT_EQ(program->inputs(), (Bytes{1, 2}));
}

TEST_F(Program, SetDiagnosis) {
  bring_up(1, 1);
  post(command::SetDiagnosis{user_cpu::DiagnosisKind::kExternal, {0x02, 0x55}});
  run_for(kMs);
  EXPECT_EQ(chip.diagnosis, (Bytes{0x81, 2, 0x02, 0x55}));
}

TEST_F(Program, ReinitialisesWithOtherValues) {
  bring_up(1, 1);
  auto station = options.station;
  station.address = 44;
  post(command::Reinitialise{station});
  run_for(kMs);
  EXPECT_EQ(chip.initialisations, 2);
  EXPECT_EQ(chip.at(0x021), 44);
}

TEST_F(Program, HoldsTheDpramForAsLongAsAsked) {
  bring_up(1, 1);
  chip.violations.clear();
  post(command::Hold{3 * kMs});
  const int holds = chip.holds;
  run_for(2 * kMs);
  EXPECT_LE(chip.holds, holds + 2);
  run_for(2 * kMs);
  EXPECT_GT(chip.holds, holds + 10);
  EXPECT_GE(program->port_counters().longest_hold, 3 * kMs);
  EXPECT_THAT(chip.violations,
              ElementsAre(testing::HasSubstr("R_STA rose after less"), testing::HasSubstr("B006 was counted 0 times")));
  chip.violations.clear();
}

TEST_F(Program, StopsAnsweringUntilResumed) {
  options.station.prm_mode = 2;
  start();
  run_for(2 * kMs);
  post(command::Stop{});
  run_for(kMs);
  const int holds = chip.holds;
  chip.put_prm({1});
  intr0();
  run_for(10 * kMs);
  EXPECT_EQ(chip.holds, holds);
  post(command::Resume{});
  run_for(kMs);
  EXPECT_THAT(chip.verdicts, ElementsAre("prm ok"));
}

TEST_F(Program, EarlyRStaBreaksTheRule) {
  bring_up(1, 1);
  post(command::EarlyRSta{});
  run_for(kMs);
  EXPECT_THAT(chip.violations, testing::Contains(testing::HasSubstr("R_STA rose after less than two looks")));
  chip.violations.clear();
}

TEST_F(Program, WrongCrcOfInputsOnceIsReportedByTheNextExchange) {
  bring_up(1, 1);
  post(command::WrongCrc{command::Area::kInputs, 1});
  run_for(kMs);
  ASSERT_EQ(program->errors().size(), 1U);
  EXPECT_EQ(program->errors()[0].error, DSDPV1_ERR_INPUT_CRC);
}

TEST_F(Program, WrongLengthOnce) {
  options.period = kMs;
  bring_up(2, 0);
  post(command::WrongLength{});
  run_for(kMs);
  EXPECT_EQ(chip.inputs.size(), 3U);
  run_for(kMs);
  EXPECT_EQ(chip.inputs.size(), 2U);
}

TEST_F(Program, JudgesInTheHandlerAfterTheDelay) {
  options.station.prm_mode = 2;
  options.prm = Judgement::kRefuse;
  options.judge_delay = 2 * kMs;
  start();
  run_for(2 * kMs);
  chip.put_prm({1});
  intr0();
  run_for(kMs);
  EXPECT_THAT(chip.verdicts, IsEmpty());
  run_for(2 * kMs);
  EXPECT_THAT(chip.verdicts, ElementsAre("prm wrong"));
  EXPECT_EQ(program->counters().judgements, 1U);
  EXPECT_EQ(cpu->counters().interrupts, 1U);
}

TEST_F(Program, JudgesInTheMainLoop) {
  options.station.cfg_mode = 2;
  options.judge_in_handler = false;
  bring_up(1, 1);
  EXPECT_THAT(chip.verdicts, ElementsAre("cfg ok"));
}

TEST_F(Program, NeverJudgesUntilTheVerdictIsPosted) {
  options.station.cfg_mode = 2;
  options.cfg = Judgement::kNever;
  bring_up(1, 1);
  EXPECT_THAT(chip.verdicts, IsEmpty());
  post(command::SendVerdict{true, true});
  run_for(kMs);
  EXPECT_THAT(chip.verdicts, ElementsAre("cfg wrong"));
}

TEST_F(Program, ErrorsAreToldAsTheyHappen) {
  int told = 0;
  start();
  program->on_error = [&](const user_cpu::DriverError& error) {
    ++told;
    EXPECT_EQ(error.error, DSDPV1_ERR_NO_VERDICT_DUE);
    EXPECT_GE(error.at, kMs);
  };
  run_for(kMs);
  post(command::SendVerdict{});
  run_for(kMs);
  EXPECT_EQ(told, 1);
}

TEST_F(Program, Intr0DuringAHoldIsServedAfterTheExchange) {
  options.station.prm_mode = 2;
  options.period = 10 * kMs;
  bring_up(1, 1);
  // The handler's moment falls into a hold: at once after R_REQ rose.
  chip.on_r_req = [&](bool level) {
    if (level && chip.verdicts.empty() && prm_due) {
      prm_due = false;
      chip.put_prm({1});
      cpu->intr0_changed(timeline.now(), false);
    }
  };
  prm_due = true;
  run_for(10 * kMs + kMs);
  EXPECT_THAT(chip.verdicts, ElementsAre("prm ok"));
  EXPECT_THAT(program->errors(), IsEmpty());
}

}  // namespace
}  // namespace dsdpv1
