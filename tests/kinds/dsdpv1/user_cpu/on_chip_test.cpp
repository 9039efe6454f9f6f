// The native CPU with the driver on the pins of the core itself.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "kinds/dsdpv1/user_cpu/pin_host_bus.hpp"
#include "kinds/dsdpv1/user_cpu/programs.hpp"
#include "model/dsdpv1/chip.hpp"
#include "model/dsdpv1/reasons.hpp"
#include "tests/kinds/dsdpv1/user_cpu/chip_agent.hpp"

namespace dsdpv1 {
namespace {

using bus::Tick;
using testing::IsEmpty;
using testing::Not;
namespace command = user_cpu::command;

class OnChip : public testing::TestWithParam<dsdpv1::Engine> {
 protected:
  static constexpr Tick kUs = bus::kTicksPerUs;
  static constexpr Tick kReleaseReset = 10 * kUs;

  OnChip() : chip(config()), host(chip, &chip.chip()) {
    chip.chip().watch({[](void* self, Tick at, Pin, dsdpv1::Level level) {
                         auto& test = *static_cast<OnChip*>(self);
                         if (test.cpu) test.cpu->intr0_changed(at, level == 1);
                       },
                       this},
                      mask(Pin::kIntr0));
    chip.chip().on_event({[](void* self, const profibus::Event& event) {
                            if (profibus::severity(event.reason) != profibus::Severity::kInfo) {
                              static_cast<OnChip*>(self)->complaints.push_back(dsdpv1::describe(event));
                            }
                          },
                          this});
    timeline.check_announcements();
    timeline.add(chip);
    options.station.max_cfg = DSDPV1_MAX_CFG;
  }

  void start() {
    options.start_delay = 2 * kReleaseReset;  // a chip in reset does not drive D
    program = std::make_unique<user_cpu::UserProgram>(options);
    cpu = std::make_unique<user_cpu::NativeCpu>(host, timing, program->entry());
    timeline.add(*cpu);
    chip.set(kReleaseReset, number(Pin::kReset), 1);
  }
  void run_for(Tick ticks) { timeline.run_until(timeline.now() + ticks); }
  void post(const user_cpu::DriverCommand& what) {
    program->post(what);
    cpu->wake(timeline.now());
  }

  static dsdpv1::Config config() {
    dsdpv1::Config config;
    config.engine = GetParam();
    return config;
  }

  ChipAgent chip;
  user_cpu::PinHostBus host;
  user_cpu::CpuTiming timing;
  user_cpu::ProgramOptions options;
  bus::Timeline timeline;
  std::unique_ptr<user_cpu::UserProgram> program;
  std::unique_ptr<user_cpu::NativeCpu> cpu;
  std::vector<std::string> complaints;
};

INSTANTIATE_TEST_SUITE_P(Engines, OnChip, testing::Values(dsdpv1::Engine::kStep, dsdpv1::Engine::kSkip),
                         [](const auto& engine) { return engine.param == dsdpv1::Engine::kStep ? "Step" : "Skip"; });

TEST_P(OnChip, DriverBringsTheChipUpFromReset) {
  start();
  run_for(600 * kUs);
  EXPECT_TRUE(program->initialised());
  EXPECT_EQ(chip.level(number(Pin::kReady)), 1);
  EXPECT_EQ(chip.status().address, options.station.address);
  EXPECT_EQ(cpu->counters().bad_reads, 0U);
  EXPECT_THAT(program->errors(), IsEmpty());
  EXPECT_THAT(complaints, IsEmpty());
}

TEST_P(OnChip, RefusalIsReportedWithItsReason) {
  start();
  run_for(600 * kUs);
  post(command::WrongCrc{command::Area::kInit, 1});
  post(command::Reinitialise{options.station});
  run_for(300 * kUs);
  ASSERT_THAT(program->errors(), Not(IsEmpty()));
  EXPECT_EQ(program->errors()[0].error, DSDPV1_ERR_INIT_CRC);
}

TEST_P(OnChip, LimitThatTheDriverCannotSeeIsRefusedByTheChip) {
  options.station.max_input = 1;
  options.station.cfg = {0x1F};  // 16 bytes of inputs: more than B027 (D11)
  options.init_attempts = 1;
  start();
  run_for(600 * kUs);
  ASSERT_THAT(program->errors(), Not(IsEmpty()));
  EXPECT_EQ(program->errors()[0].error, DSDPV1_ERR_INIT_LIMIT);
}

TEST_P(OnChip, ShortestHoldsStillLetTheChipIn) {
  options.period = 3 * kUs;
  start();
  run_for(1000 * kUs);
  const auto before = chip.status().accesses;
  run_for(300 * kUs);
  EXPECT_GT(chip.status().accesses, before + 50);
  EXPECT_THAT(program->errors(), IsEmpty());
}

TEST_P(OnChip, LongHoldKeepsTheChipWaiting) {
  start();
  run_for(600 * kUs);
  post(command::Hold{100 * kUs});
  run_for(300 * kUs);
  EXPECT_GE(chip.status().longest_wait, 99 * kUs);
  EXPECT_GE(program->port_counters().longest_hold, 100 * kUs);
  EXPECT_THAT(complaints, IsEmpty());
}

TEST_P(OnChip, SamplingBeforeTheDataAreCertainIsABadRead) {
  timing.access.rd_sample = 100;
  options.init_attempts = 1;
  start();
  run_for(600 * kUs);
  EXPECT_GT(cpu->counters().bad_reads, 0U);
}

TEST_P(OnChip, WriteStrobeTooShortIsReported) {
  timing.access.wr_low = 140;
  timing.access.data_setup = 140;
  options.init_attempts = 1;
  start();
  run_for(600 * kUs);
  EXPECT_THAT(complaints, Not(IsEmpty()));
}

TEST_P(OnChip, EarlyRStaMeetsTheChipSoonerOrLater) {
  start();
  run_for(600 * kUs);
  for (int i = 0; i < 40 && complaints.empty(); ++i) {
    post(command::EarlyRSta{50, 2 * kUs});
    run_for(10 * kUs + i * 250);
  }
  EXPECT_THAT(complaints, Not(IsEmpty()));
}

}  // namespace
}  // namespace dsdpv1
