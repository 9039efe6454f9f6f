#include "kinds/dsdpv1/user_cpu/pin_host_bus.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <functional>
#include <sstream>
#include <string>
#include <vector>

#include "kinds/user_cpu/cpu.hpp"
#include "tests/kinds/quiet_device.hpp"

namespace dsdpv1 {
namespace {

using bus::Tick;
using testing::ElementsAre;

struct PinChange {
  Tick at;
  Pin pin;
  Level level;
  bool operator==(const PinChange& other) const { return at == other.at && pin == other.pin && level == other.level; }
};

/// Records its inputs and drives D as set.
struct FakePins : QuietDevice {
  void set(Tick at, tb::PinNumber pin, Level level) override { changes.push_back({at, static_cast<Pin>(pin), level}); }
  void advance(Tick to) override { reached = to; }
  Level level(tb::PinNumber pin) const override { return pin == number(Pin::kDOut) ? data(reached) : high; }
  Level sample(Tick at) override {
    advance(at);
    return level(number(Pin::kDOut));
  }

  std::vector<PinChange> changes;
  Tick reached = 0;
  Level high = 0;  ///< level of every single pin
  std::function<Level(Tick)> data = [](Tick) { return Level{0x5A}; };
};

class PinHostBus : public testing::Test {
 protected:
  PinHostBus() {
    timing.address_setup = 30;
    timing.cs_lead = 20;
    timing.rd_low = 500;
    timing.rd_sample = 400;
    timing.wr_low = 300;
    timing.data_setup = 200;
    timing.data_hold = 150;
    timing.address_hold = 160;
    timing.cs_trail = 10;
    timing.recovery = 70;
  }

  void run(bool write, Tick at = 1000) {
    host.begin(at, {write, 0x123, 0xA5}, timing);
    while (host.next_edge() != bus::kNever) host.run_edges(host.next_edge());
  }

  FakePins pins;
  user_cpu::PinHostBus host{pins};
  AccessTiming timing;
};

TEST_F(PinHostBus, ReadHasItsEdgesAtTheirTicks) {
  Tick sampled = 0;
  pins.data = [&](Tick at) {
    sampled = at;
    return Level{0x5A};
  };
  run(false);
  EXPECT_THAT(pins.changes, ElementsAre(PinChange{1000, Pin::kA, 0x123}, PinChange{1010, Pin::kCsr, 0},
                                        PinChange{1030, Pin::kRd, 0}, PinChange{1530, Pin::kRd, 1},
                                        PinChange{1540, Pin::kCsr, 1}, PinChange{1690, Pin::kA, 0x7FF}));
  EXPECT_EQ(sampled, 1430);
  EXPECT_EQ(host.sample_tick(), sampled);
  EXPECT_EQ(host.read_value(), 0x5A);
  EXPECT_FALSE(host.last_read_was_bad());
  EXPECT_EQ(host.end(), 1760);
}

TEST_F(PinHostBus, NothingIsSampledBeforeTheReadBegins) {
  Tick sampled = 0;
  pins.data = [&](Tick at) {
    sampled = at;
    return dsdpv1::kLevelX;
  };
  timing.rd_sample = -5;
  run(false);
  EXPECT_EQ(sampled, 1030);  // the fall of RD
  timing.cs_lead = -20;
  run(false, 2000);
  EXPECT_EQ(sampled, 2050);  // that of CSR
  EXPECT_EQ(host.sample_tick(), sampled);
}

TEST_F(PinHostBus, WriteHasItsEdgesAtTheirTicks) {
  run(true);
  EXPECT_THAT(pins.changes,
              ElementsAre(PinChange{1000, Pin::kA, 0x123}, PinChange{1010, Pin::kCsr, 0}, PinChange{1030, Pin::kWr, 0},
                          PinChange{1130, Pin::kDIn, 0xA5}, PinChange{1330, Pin::kWr, 1}, PinChange{1340, Pin::kCsr, 1},
                          PinChange{1480, Pin::kDIn, dsdpv1::kLevelZ}, PinChange{1490, Pin::kA, 0x7FF}));
  EXPECT_EQ(host.end(), 1560);
}

TEST_F(PinHostBus, AddressMayComeTooLate) {
  timing.address_setup = -5;
  run(false);
  EXPECT_THAT(pins.changes[0], (PinChange{1000, Pin::kCsr, 0}));
  EXPECT_THAT(pins.changes[1], (PinChange{1020, Pin::kRd, 0}));
  EXPECT_THAT(pins.changes[2], (PinChange{1025, Pin::kA, 0x123}));
}

TEST_F(PinHostBus, DataMayComeTooLateAndGoTooEarly) {
  timing.data_setup = -10;
  timing.data_hold = 20;
  run(true);
  EXPECT_THAT(pins.changes[3], (PinChange{1330, Pin::kWr, 1}));
  EXPECT_THAT(pins.changes[4], (PinChange{1340, Pin::kDIn, 0xA5}));
}

TEST_F(PinHostBus, UnknownAndFloatingDataAreBadReads) {
  for (const Level level : {dsdpv1::kLevelX, dsdpv1::kLevelZ}) {
    pins.data = [level](Tick) { return level; };
    run(false);
    EXPECT_TRUE(host.last_read_was_bad());
    EXPECT_EQ(host.read_value(), 0xFF);
  }
  pins.data = [](Tick) { return Level{0}; };
  run(false);
  EXPECT_FALSE(host.last_read_was_bad());
  EXPECT_EQ(host.read_value(), 0);
}

TEST_F(PinHostBus, SampledFFIsNotBad) {
  pins.data = [](Tick) { return Level{0xFF}; };
  run(false);
  EXPECT_FALSE(host.last_read_was_bad());
}

TEST_F(PinHostBus, PinsAreLookedAtAtTheirTick) {
  pins.high = 1;
  EXPECT_TRUE(host.l_req(77));
  EXPECT_EQ(pins.reached, 77);
  EXPECT_TRUE(host.l_sta(78));
  EXPECT_TRUE(host.intr0(79));
  host.set_r_req(80, true);
  host.set_r_sta(81, true);
  EXPECT_THAT(pins.changes, ElementsAre(PinChange{80, Pin::kRReq, 1}, PinChange{81, Pin::kRSta, 1}));
}

TEST_F(PinHostBus, DefaultsKeepTable15) {
  const AccessTiming defaults;
  EXPECT_GE(defaults.address_setup, 0);
  EXPECT_GE(defaults.rd_sample, 375);
  EXPECT_GE(defaults.rd_low, defaults.rd_sample);
  EXPECT_GE(defaults.wr_low, 150);
  EXPECT_GE(defaults.data_setup, 150);
  EXPECT_GE(defaults.data_hold, 150);
  EXPECT_GE(defaults.address_hold, 150);
  EXPECT_GE(defaults.cs_trail, 0);
}

TEST_F(PinHostBus, GuideNamesTheTimesOfTheDefaults) {
  std::ifstream file(GUIDE);
  std::stringstream guide;
  guide << file.rdbuf();
  timing = AccessTiming{};
  const Tick overhead = user_cpu::CpuTiming{}.overhead;
  run(false, 0);
  const auto read_ns = (host.end() + overhead) / bus::kTicksPerNs;
  run(true, 0);
  const auto write_ns = (host.end() + overhead) / bus::kTicksPerNs;
  const std::string expected = std::to_string(read_ns) + " ns and a write " + std::to_string(write_ns) + " ns";
  EXPECT_NE(guide.str().find(expected), std::string::npos) << expected;
}

}  // namespace
}  // namespace dsdpv1
