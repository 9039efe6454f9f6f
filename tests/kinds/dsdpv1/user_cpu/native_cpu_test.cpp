#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "driver/dsdpv1.h"
#include "kinds/dsdpv1/user_cpu/driver_port.hpp"
#include "kinds/user_cpu/native_cpu.hpp"
#include "tests/kinds/dsdpv1/user_cpu/recording_bus.hpp"

namespace dsdpv1 {
namespace {

using bus::Tick;
using testing::ElementsAre;
using user_cpu::Cpu;
using user_cpu::CpuTiming;

class NativeCpu : public testing::Test {
 protected:
  NativeCpu() {
    timing.overhead = 50;
    timing.pin_sample = 20;
    timing.pin_write = 10;
    timing.interrupt_latency = 300;
  }

  void start(user_cpu::NativeCpu::Program program, Tick at = 0) {
    cpu = std::make_unique<user_cpu::NativeCpu>(bus, timing, std::move(program), at);
    timeline.check_announcements();
    timeline.add(*cpu);
  }

  void let_it_ask() { cpu->others = &others; }

  /// As reported by a bench.
  struct OnTimeline final : user_cpu::Others {
    explicit OnTimeline(NativeCpu& of) : test(of) {}
    Tick quiet_until() override { return test.timeline.quiet_until(*test.cpu); }
    bool go_on(Tick tick) override { return test.timeline.go_on(*test.cpu, tick); }
    NativeCpu& test;
  };

  RecordingBus bus;
  CpuTiming timing;
  OnTimeline others{*this};
  bus::Timeline timeline;
  std::unique_ptr<user_cpu::NativeCpu> cpu;
};

TEST_F(NativeCpu, AccessesTakeTheirTime) {
  std::vector<Tick> times;
  start(
      [&](Cpu& c) {
        times.push_back(c.now());
        EXPECT_EQ(c.read(0x012), 0x12);
        times.push_back(c.now());
        c.write(0x020, 0x55);
        times.push_back(c.now());
      },
      500);
  timeline.run_until(10'000);
  EXPECT_THAT(times, ElementsAre(500, 1650, 2800));  // 1000 + 100 recovery + 50 overhead each
  EXPECT_THAT(bus.log, ElementsAre("500 read", "1500 edge 2", "1650 write", "2650 edge 2"));
  EXPECT_EQ(cpu->counters().accesses, 2U);
  EXPECT_TRUE(cpu->ended());
  EXPECT_EQ(cpu->next(), bus::kNever);
}

TEST_F(NativeCpu, LastLooksAreToldBeforeRStaRises) {
  start([](Cpu& c) {
    c.set_r_sta(true);
    c.set_r_sta(false);
    for (int i = 0; i < 3; ++i) c.l_req();
    c.l_sta();
    c.l_req();
    c.set_r_sta(true);
    c.looked({7, 8});
    c.set_r_sta(true);
  });
  timeline.run_until(10'000);
  ASSERT_EQ(bus.looks.size(), 3U);
  EXPECT_EQ(bus.looks[0].l_req, -1);
  EXPECT_EQ(bus.looks[1].l_req, 20 + 4 * 20);
  EXPECT_EQ(bus.looks[1].l_sta, 20 + 3 * 20);
  EXPECT_EQ(bus.looks[2].l_sta, 8);
}

TEST_F(NativeCpu, OthersActBetweenTheEdges) {
  struct Other : bus::Agent {
    Tick next() const override { return acted ? bus::kNever : 700; }
    void run(Tick) override {
      acted = true;
      log->emplace_back("other");
    }
    bool acted = false;
    std::vector<std::string>* log = nullptr;
  } other;
  other.log = &bus.log;
  timeline.add(other);
  start([](Cpu& c) { c.read(0); });
  let_it_ask();
  timeline.run_until(2000);
  EXPECT_THAT(bus.log, ElementsAre("0 read", "other", "1000 edge 2"));
}

TEST_F(NativeCpu, AllThatItDoesIsOneTurnAsLongAsNobodyElseHasOne) {
  int turns = 0;
  std::vector<Tick> times;
  start([&](Cpu& c) {
    c.read(0);
    times.push_back(timeline.now());
    c.write(1, 2);
    times.push_back(timeline.now());
    c.wait_until(4000);
    times.push_back(timeline.now());
  });
  let_it_ask();
  while (timeline.step(5000)) ++turns;
  EXPECT_EQ(turns, 1);
  EXPECT_THAT(bus.log, ElementsAre("0 read", "1000 edge 2", "1150 write", "2150 edge 2"));
  EXPECT_THAT(times, ElementsAre(1150, 2300, 4000));
  EXPECT_TRUE(cpu->ended());
}

TEST_F(NativeCpu, AnAccessIsOneTurnWhenSomebodyElseHasOneAtItsEnd) {
  struct Other : bus::Agent {
    Tick next() const override { return acted < 0 ? 1150 : bus::kNever; }
    void run(Tick now) override { acted = now; }
    Tick acted = -1;
  } other;
  int turns = 0;
  start([](Cpu& c) {
    c.read(0);
    c.read(1);
  });
  timeline.add(other);
  let_it_ask();
  while (timeline.step(1150)) ++turns;
  EXPECT_EQ(turns, 2);
  EXPECT_EQ(other.acted, 1150);
  EXPECT_THAT(bus.log, ElementsAre("0 read", "1000 edge 2", "1150 read"));
}

TEST_F(NativeCpu, AnAccessThatIsPutOffIsDoneAtItsEnd) {
  struct Other : bus::Agent {
    Tick next() const override { return acted ? bus::kNever : 700; }
    void run(Tick) override {
      acted = true;
      log->emplace_back("other");
    }
    bool acted = false;
    std::vector<std::string>* log = nullptr;
  } other;
  other.log = &bus.log;
  bus.puts_off = true;
  timeline.add(other);
  start([](Cpu& c) {
    c.read(0);
    c.read(1);
  });
  let_it_ask();
  timeline.run_until(5000);
  EXPECT_THAT(bus.log, ElementsAre("other", "0 read", "1000 edge 2", "1150 read", "2150 edge 2"));
  EXPECT_EQ(cpu->counters().accesses, 2U);
}

TEST_F(NativeCpu, AnAccessGoesNotBeyondTheEndOfTheRun) {
  start([](Cpu& c) { c.read(0); });
  let_it_ask();
  timeline.run_until(999);
  EXPECT_THAT(bus.log, ElementsAre("0 read"));
  timeline.run_until(1000);
  EXPECT_THAT(bus.log, ElementsAre("0 read", "1000 edge 2"));
}

TEST_F(NativeCpu, PinsAreMovedAndSampledAtOnce) {
  start([](Cpu& c) {
    c.set_r_req(true);
    EXPECT_FALSE(c.l_req());
    EXPECT_FALSE(c.l_sta());
    c.set_r_sta(true);
  });
  timeline.run_until(1000);
  EXPECT_THAT(bus.log, ElementsAre("0 R_REQ up", "10 L_REQ?", "30 L_STA?", "50 R_STA up"));
}

TEST_F(NativeCpu, BadReadsAreCountedAndReadAsFF) {
  bus.bad = true;
  start([](Cpu& c) {
    EXPECT_EQ(c.read(0x12), 0xFF);
    c.write(0x12, 0);
  });
  timeline.run_until(10'000);
  EXPECT_EQ(cpu->counters().bad_reads, 1U);
}

TEST_F(NativeCpu, WaitsEndAtTheirTick) {
  std::vector<Tick> times;
  start([&](Cpu& c) {
    c.wait(123);
    times.push_back(c.now());
    c.wait_until(1000);
    times.push_back(c.now());
    c.wait_until(500);
    times.push_back(c.now());
  });
  timeline.run_until(5000);
  EXPECT_THAT(times, ElementsAre(123, 1000, 1000));
}

TEST_F(NativeCpu, HandlerRunsAfterTheLatencyBetweenTwoAccesses) {
  std::vector<Tick> handler, program;
  start([&](Cpu& c) {
    c.on_intr0([&] {
      handler.push_back(c.now());
      c.read(0x10);
    });
    c.read(0x20);
    program.push_back(c.now());
    c.read(0x30);
  });
  timeline.run_until(100);
  cpu->intr0_changed(100, false);
  timeline.run_until(5000);
  EXPECT_THAT(handler, ElementsAre(1150)) << "400 is in the middle of an access";
  EXPECT_THAT(program, ElementsAre(2300));
  EXPECT_EQ(cpu->counters().interrupts, 1U);
}

TEST_F(NativeCpu, ReadThatIsInterruptedKeepsItsValue) {
  int value = 0;
  start([&](Cpu& c) {
    c.on_intr0([&] { c.read(0x99); });
    value = c.read(0x20);
  });
  timeline.run_until(100);
  cpu->intr0_changed(100, false);
  timeline.run_until(5000);
  EXPECT_EQ(value, 0x20);
}

TEST_F(NativeCpu, HandlerInterruptsAWaitExactlyAfterTheLatency) {
  std::vector<Tick> handler;
  Tick end = 0;
  start([&](Cpu& c) {
    c.on_intr0([&] {
      handler.push_back(c.now());
      c.wait(50);
    });
    c.wait_until(10'000);
    end = c.now();
  });
  timeline.run_until(2000);
  cpu->intr0_changed(2000, false);
  timeline.run_until(2000 + 64 * 250);
  cpu->intr0_changed(2000 + 64 * 250, true);
  timeline.run_until(20'000);
  EXPECT_THAT(handler, ElementsAre(2300));
  EXPECT_EQ(end, 10'000);
}

TEST_F(NativeCpu, DisabledInterruptsWait) {
  std::vector<Tick> handler;
  start([&](Cpu& c) {
    c.on_intr0([&] { handler.push_back(c.now()); });
    c.enable_interrupts(false);
    c.wait_until(5000);
    c.enable_interrupts(true);
  });
  timeline.run_until(100);
  cpu->intr0_changed(100, false);
  timeline.run_until(10'000);
  EXPECT_THAT(handler, ElementsAre(5000));
}

TEST_F(NativeCpu, EdgeDuringTheHandlerRunsItAgainAfterwards) {
  std::vector<Tick> handler;
  start([&](Cpu& c) {
    c.on_intr0([&] {
      handler.push_back(c.now());
      c.wait(1000);
    });
    c.wait_until(10'000);
  });
  timeline.run_until(100);
  cpu->intr0_changed(100, false);
  timeline.run_until(600);
  cpu->intr0_changed(600, false);
  timeline.run_until(20'000);
  EXPECT_THAT(handler, ElementsAre(400, 1400));
}

TEST_F(NativeCpu, WithoutAHandlerNothingHappens) {
  start([](Cpu& c) { c.wait_until(1000); });
  cpu->intr0_changed(0, false);
  timeline.run_until(2000);
  EXPECT_TRUE(cpu->ended());
}

TEST_F(NativeCpu, WaitForIntr0) {
  std::vector<std::pair<Tick, bool>> seen;
  start([&](Cpu& c) {
    for (const Tick until : {1000, 5000, 6000}) {
      const bool fell = c.wait_intr0(until);
      seen.emplace_back(c.now(), fell);
    }
  });
  timeline.run_until(2500);
  cpu->intr0_changed(2500, false);
  timeline.run_until(10'000);
  EXPECT_THAT(seen, ElementsAre(std::make_pair(1000, false), std::make_pair(2500, true), std::make_pair(6000, false)));
}

TEST_F(NativeCpu, WakeEndsOnlyAWaitForIt) {
  std::vector<std::pair<Tick, bool>> seen;
  start([&](Cpu& c) {
    seen.emplace_back(c.now(), c.wait_for_wake(1000));
    c.wait_until(3000);
    seen.emplace_back(c.now(), c.wait_for_wake(4000));
    seen.emplace_back(c.now(), c.wait_for_wake(4000));
  });
  timeline.run_until(400);
  cpu->wake(400);
  timeline.run_until(2000);
  cpu->wake(2000);
  timeline.run_until(10'000);
  ASSERT_EQ(seen.size(), 3U);
  EXPECT_TRUE(seen[0].second);
  EXPECT_TRUE(seen[1].second) << "woken while it did something else";
  EXPECT_FALSE(seen[2].second);
}

TEST_F(NativeCpu, ExceptionOfTheProgramLeavesThroughTheBench) {
  start([](Cpu& c) {
    c.wait(10);
    throw std::runtime_error("firmware bug");
  });
  EXPECT_THROW(timeline.run_until(100), std::runtime_error);
}

TEST_F(NativeCpu, MayBeDestroyedInsideTheDriver) {
  start([](Cpu& c) {
    user_cpu::DriverPort port(c);
    const dsdpv1_port functions = port.port();
    dsdpv1_device device;
    dsdpv1_open(&device, &functions, nullptr);
    dsdpv1_wait_ready(&device);
  });
  timeline.run_until(3000);
  EXPECT_FALSE(cpu->ended());
  cpu.reset();
}

TEST_F(NativeCpu, DriverKeepsTheTimesOfRuleH2) {
  timing = CpuTiming{};
  timing.pin_write = 0;
  start([](Cpu& c) {
    user_cpu::DriverPort port(c);
    const dsdpv1_port functions = port.port();
    dsdpv1_device device;
    dsdpv1_open(&device, &functions, nullptr);
    dsdpv1_wait_ready(&device);
  });
  timeline.run_until(2900);  // H6: R_REQ does not rise before the chip has begun, 63 ns
  EXPECT_THAT(bus.log, testing::ElementsAre("756 R_REQ up", "1956 L_REQ?", "2166 L_STA?", "2376 L_REQ?", "2586 L_STA?",
                                            "2796 R_STA up", "2796 read"));
}

TEST(HandshakeCounters, HoldEndsWithTheLaterFallOfTheTwoInEitherOrder) {
  for (const bool r_req_first : {false, true}) {
    user_cpu::HandshakeCounters counters;
    const auto lower = [&](bool r_req, Tick at) { r_req ? counters.r_req(at, false) : counters.r_sta(at, false); };
    counters.r_req(100, true);
    counters.r_sta(350, true);
    lower(r_req_first, 1000);
    lower(!r_req_first, 1350);
    EXPECT_EQ(counters.counters().longest_wait, 250);
    EXPECT_EQ(counters.counters().longest_hold, 1000);
    EXPECT_EQ(counters.counters().holds, 1U);
    EXPECT_EQ(counters.counters().given_up, 0U);
  }
}

TEST(HandshakeCounters, RequestWithoutAHoldIsGivenUpWhateverIsLoweredWithIt) {
  user_cpu::HandshakeCounters counters;
  counters.r_sta(0, false);
  counters.r_req(0, false);
  EXPECT_EQ(counters.counters().given_up, 0U) << "they were low";
  counters.r_req(100, true);
  counters.r_sta(200, false);
  counters.r_req(200, false);
  EXPECT_EQ(counters.counters().given_up, 1U);
  EXPECT_EQ(counters.counters().holds, 0U);
}

}  // namespace
}  // namespace dsdpv1
