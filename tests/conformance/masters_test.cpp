// The chip brought up by the two kinds of master that are in the field (chip.md, last fact: "Real masters differ").
#include <gtest/gtest.h>

#include "bus/master/master1.hpp"
#include "bus/monitor/monitor.hpp"
#include "tests/conformance/master_side.hpp"

namespace dsdpv1::conformance {
namespace {

bus::SlaveParameters parameters() {
  bus::SlaveParameters slave;
  slave.name = "slave";
  slave.address = 5;
  slave.ident = 0x0CC9;
  slave.cfg = {0x17, 0x27};  // 8 bytes in, 8 bytes out: SD3 fits
  slave.input_length = slave.output_length = 8;
  slave.wd_fact_1 = 10;
  slave.wd_fact_2 = 1;
  slave.group_ident = 0x01;
  slave.sync = slave.freeze = true;
  return slave;
}

class RealMaster : public testing::TestWithParam<bus::Personality> {
 protected:
  void SetUp() override {
    bench.power_on();
    Init init;
    init.cfg = parameters().cfg;
    ASSERT_TRUE(bench.initialise(init));
    config.address = 2;
    config.personality = GetParam();
  }
  void start(bus::Master1& master) {
    bench.timeline.add(master);
    master.add_slave(parameters());
    master.set_outputs(5, Bytes(8, 0x5A));
    monitor.on_flag = [this](const bus::Flag& flag) {
      if (flag.kind != bus::FlagKind::kUnanswered) flags.push_back(flag.text);
    };
    bench.timeline.add(monitor);
    master.start();
    for (int i = 0; i < 200 && bench.dp_state() != DpState::kDataExch; ++i) bench.run_ms(1);
    ASSERT_EQ(bench.dp_state(), DpState::kDataExch) << master.slave(5).reason;
  }

  SlaveBench bench{quick_search()};
  bus::MasterConfig config;
  bus::Monitor monitor{bench.segment};
  std::vector<std::string> flags;
};

TEST_P(RealMaster, BringsTheChipUpAndExchangesData) {
  bus::Master1 master(bench.segment, config);
  start(master);
  const Bytes inputs = {1, 2, 3, 4, 5, 6, 7, 8};
  bench.give_inputs(inputs);
  bench.run_ms(2);
  EXPECT_EQ(master.slave(5).state, bus::SlaveState::kDataExchange);
  EXPECT_EQ(master.slave(5).inputs, inputs);
  EXPECT_EQ(bench.fetch_outputs(), Bytes(8, 0x5A));
  EXPECT_GT(bench.chip.status().data_exchanges, 10U);
  EXPECT_EQ(bench.count(Reason::kPrmAccepted), 1) << "parameters go once";
  EXPECT_EQ(flags, std::vector<std::string>{});
}

TEST_P(RealMaster, ReadsADiagnosisThatIsAnnounced) {
  bus::Master1 master(bench.segment, config);
  start(master);
  bench.give_diag(0x81, {0x03, 0x11, 0x22});
  bench.run_ms(2);
  ASSERT_EQ(master.slave(5).diagnosis.size(), 9U);
  EXPECT_EQ(master.slave(5).diagnosis[0] & 0x08, 0x08);
}

TEST_P(RealMaster, FindsTheChipAgainBehindItsWatchdog) {
  bus::Master1 master(bench.segment, config);
  start(master);
  master.stop();
  bench.run_ms(110);
  EXPECT_EQ(bench.count(Reason::kWatchdogExpired), 1);
  EXPECT_EQ(bench.dp_state(), DpState::kWaitPrm);
  master.start();
  bench.run_ms(20);
  EXPECT_EQ(bench.dp_state(), DpState::kDataExch);
  EXPECT_EQ(flags, std::vector<std::string>{});
}

INSTANTIATE_TEST_SUITE_P(Masters, RealMaster,
                         testing::Values(bus::Personality::kHighAlways, bus::Personality::kClassic),
                         [](const auto& at) {
                           return at.param == bus::Personality::kClassic ? "Classic" : "HighAlways";
                         });

}  // namespace
}  // namespace dsdpv1::conformance
