// Chapter 12 of the micro-architecture; table 15 at the pins of the whole chip is in
// tests/conformance/user_port_test.cpp.
#include "model/dsdpv1/host_port.hpp"

#include <gtest/gtest.h>

#include <random>

#include "model/dsdpv1/reasons.hpp"
#include "tests/core/event_recorder.hpp"

namespace dsdpv1 {
namespace {

/// A port with its RAM; run() makes the edges and the driving half edges up to a tick, all of them or only the
/// announced ones.
struct Bench {
  explicit Bench(bool evaluate_sparsely) : port(recorder.log, dpram), sparse(evaluate_sparsely) {
    port.reset();
    port.release();
  }
  void run(Tick until) {
    for (; half_ * 125 <= until; ++half_) {
      const Tick now = half_ * 125;
      if (half_ % 2 == 0) {
        const Cycle cycle = now / 250;
        if (!sparse || cycle >= port.next()) port.eval(cycle, chip_owns, true);
      } else if (port.drive_at() <= now) {
        port.drive();
      }
    }
  }
  void set(Tick at, Pin pin, Level level) {
    run(at);
    port.set(at, pin, level);
  }

  core_test::EventRecorder recorder;
  Ram dpram;
  HostPort port;
  bool sparse, chip_owns = false;

 private:
  Tick half_ = 0;
};

TEST(HostPortBlock, InResetItNeitherWritesNorReads) {
  core_test::EventRecorder recorder;
  Ram dpram;
  HostPort port(recorder.log, dpram);
  port.reset();
  port.set(1000, Pin::kA, 0x130);
  port.set(1000, Pin::kDIn, 0x55);
  port.set(1000, Pin::kCsr, 0);
  port.set(1200, Pin::kWr, 0);
  port.set(1600, Pin::kWr, 1);
  port.set(2000, Pin::kRd, 0);
  for (Cycle now = 4; now < 20; ++now) port.eval(now, false, true);
  EXPECT_EQ(dpram.read(0x130), 0);
  EXPECT_EQ(port.d_out(), kLevelZ);
  EXPECT_TRUE(recorder.events.empty());
}

TEST(HostPortBlock, FourWritesAreBufferedAndAFifthIsReported) {
  // Faster than table 15 allows: WR low for 20 ticks each. Only then can the buffer fill.
  Bench bench(false);
  bench.port.set_handshake(true, true);
  bench.set(1000, Pin::kCsr, 0);
  Tick now = 1010;
  for (Level i = 0; i < 5; ++i) {
    bench.set(now, Pin::kA, static_cast<Level>(0x130 + i));
    bench.set(now, Pin::kDIn, static_cast<Level>(0x10 + i));
    bench.set(now + 1, Pin::kWr, 0);
    bench.set(now + 21, Pin::kWr, 1);
    now += 42;
  }
  EXPECT_EQ(bench.recorder.count(Reason::kWriteOverrun), 1);
  bench.run(5000);
  for (regs::Address i = 0; i < 4; ++i) EXPECT_EQ(bench.dpram.read(static_cast<regs::Address>(0x130 + i)), 0x10 + i);
  EXPECT_EQ(bench.dpram.read(0x134), 0);
}

TEST(HostPortBlock, AfterOutputsAreIdleNothingIsAnnounced) {
  Bench bench(false);
  bench.port.set_handshake(true, true);
  EXPECT_EQ(bench.port.next(), profibus::kNever);
  bench.set(1000, Pin::kCsr, 0);
  bench.set(1010, Pin::kRd, 0);
  EXPECT_EQ(bench.port.next(), 5);
  bench.run(2000);
  EXPECT_EQ(bench.port.next(), profibus::kNever);
  bench.set(2010, Pin::kRd, 1);
  EXPECT_EQ(bench.port.next(), profibus::kNever);
  EXPECT_EQ(bench.port.drive_at(), profibus::kNever);
}

TEST(HostPortBlock, EvaluatedOnlyAtNextItIsTheSame) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    std::mt19937 random(seed);
    Bench every(false), sparse(true);
    Tick now = 1000;
    for (int i = 0; i < 5000; ++i) {
      now += static_cast<Tick>(random() % 260);
      constexpr Pin kPins[] = {Pin::kCsr, Pin::kRd, Pin::kWr, Pin::kRd, Pin::kWr, Pin::kA, Pin::kDIn};
      const Pin pin = kPins[random() % 7];
      const auto level = static_cast<Level>(pin == Pin::kA     ? 0x140 + static_cast<int>(random() % 4)
                                            : pin == Pin::kDIn ? static_cast<int>(random() % 257) - 1
                                            : pin == Pin::kCsr ? static_cast<int>(random() % 8 == 0)
                                                               : 1 - every.port.level(pin));
      const bool request = random() % 8 != 0, state = random() % 8 != 0, owns = random() % 16 == 0;
      for (Bench* bench : {&every, &sparse}) {
        bench->run(now);
        bench->port.set_handshake(request, state);
        bench->chip_owns = owns;
        bench->set(now, pin, level);
      }
      ASSERT_EQ(every.port.d_out(), sparse.port.d_out()) << "seed " << seed << ", tick " << now;
      ASSERT_EQ(every.recorder.events.size(), sparse.recorder.events.size()) << "seed " << seed << ", tick " << now;
    }
    every.run(now + 5000);
    sparse.run(now + 5000);
    for (regs::Address cell = 0x140; cell < 0x144; ++cell) {
      EXPECT_EQ(every.dpram.read(cell), sparse.dpram.read(cell));
      EXPECT_EQ(every.dpram.unknown(cell), sparse.dpram.unknown(cell));
    }
    for (std::size_t i = 0; i < every.recorder.events.size(); ++i)
      ASSERT_TRUE(core_test::same(every.recorder.events[i], sparse.recorder.events[i])) << "seed " << seed;
  }
}

}  // namespace
}  // namespace dsdpv1
