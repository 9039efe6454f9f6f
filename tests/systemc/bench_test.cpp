// A user CPU with the C driver brings two chips up: one by its pins in a plain timeline, one through the TLM socket in
// SystemC. Both must behave identically at the same ticks. A CPU that runs ahead of simulation time then repeats it.
// Another CPU is reset in the middle of an access.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <optional>

#include "bus/timeline.hpp"
#include "kinds/dsdpv1/tlm/tlm_chip.hpp"
#include "kinds/dsdpv1/tlm/tlm_host_bus.hpp"
#include "kinds/dsdpv1/user_cpu/pin_host_bus.hpp"
#include "kinds/dsdpv1/user_cpu/programs.hpp"
#include "kinds/user_cpu/native_cpu.hpp"
#include "tb/systemc/timeline_module.hpp"
#include "tests/kinds/dsdpv1/user_cpu/chip_agent.hpp"
#include "tests/systemc/bench.hpp"

namespace dsdpv1 {

using dsdpv1::systemc::TlmOptions;
using user_cpu::NativeCpu;
using user_cpu::UserProgram;

namespace {

constexpr Tick kReset = 1'007, kEnd = 2000 * kUs, kAbortAt = 200 * kUs, kAbort = kAbortAt + 700;

const user_cpu::ProgramOptions& options() {
  static const user_cpu::ProgramOptions shared = [] {
    user_cpu::ProgramOptions options;
    options.station.max_cfg = DSDPV1_MAX_CFG;
    options.inputs = user_cpu::InputSource::kCount;
    options.start_delay = 2 * kReset;  // if earlier, the user delays the chip's start-up (H6)
    return options;
  }();
  return shared;
}

/// An action at one tick.
class Once : public bus::Agent {
 public:
  Once(Tick at, std::function<void()> action) : at_(at), action_(std::move(action)) {}
  Tick next() const override { return at_; }
  void run(Tick) override {
    at_ = bus::kNever;
    action_();
  }

 private:
  Tick at_;
  std::function<void()> action_;
};

/// The core; its output changes are recorded.
class RecordedCore : public ChipAgent {
 public:
  RecordedCore() {
    chip().watch({[](void* self, Tick at, Pin pin, Level level) {
                    static_cast<Changes*>(self)->push_back({at, pin, level});
                  },
                  &changes},
                 dsdpv1::kOutputPins);
  }
  Changes changes;
};

struct PinRun {
  bus::Timeline timeline;
  RecordedCore core;
  Once reset{kReset, [this] { core.set(kReset, number(Pin::kReset), 1); }};
  user_cpu::PinHostBus host{core, &core.chip()};
  UserProgram program{options()};
  NativeCpu cpu{host, {}, program.entry()};

  PinRun() {
    timeline.check_announcements();
    timeline.add(core);
    timeline.add(reset);
    timeline.add(cpu);
    timeline.run_until(kEnd);
  }
};

/// An observer of the host's pins needs each edge of an access at its time.
TlmOptions without_host_pins() {
  TlmOptions options;
  options.observed = dsdpv1::kOutputPins & ~dsdpv1::mask(Pin::kDOut);
  return options;
}

Changes without_data(const Changes& all) {
  Changes some;
  for (const Change& change : all)
    if (change.pin != Pin::kDOut) some.push_back(change);
  return some;
}

/// Runs from kEnd on, when no other agent acts any more.
struct DecoupledRun : private user_cpu::Others {
  bus::Timeline& timeline;
  systemc_bench::TimelineModule& timeline_module;
  systemc_bench::TlmChip chip;
  user_cpu::TlmHostBus host{"decoupled_host", chip};
  Once reset{kEnd + kReset, [this] { chip.set_reset(true); }};
  UserProgram program{options()};
  NativeCpu cpu{host, {}, program.entry(), kEnd};
  Changes changes;
  std::size_t begun_ahead = 0;

  DecoupledRun(bus::Timeline& time, systemc_bench::TimelineModule& module, bus::Segment& segment)
      : timeline(time), timeline_module(module), chip("decoupled", without_host_pins(), segment, module) {
    cpu.others = this;
    host.on_begin = [this](Tick at, const user_cpu::Access&, Tick) {
      if (at > dsdpv1::systemc::current_tick()) ++begun_ahead;
    };
    chip.on_pin = [this](Tick at, Pin pin, Level level) {
      if (!is_input(pin)) changes.push_back({at - kEnd, pin, level});
    };
  }

 private:
  Tick quiet_until() override { return timeline_module.quiet_until(cpu); }
  bool go_on(Tick tick) override { return timeline_module.go_on(cpu, tick); }
};

struct TlmRun {
  bus::Timeline timeline;
  bus::Segment segment;
  systemc_bench::TimelineModule timeline_module{"timeline", timeline};
  systemc_bench::TlmChip chip{"slave", TlmOptions(), segment, timeline_module},
      aborted{"aborted", TlmOptions(), segment, timeline_module};
  user_cpu::TlmHostBus host{"host", chip}, aborted_host{"aborted_host", aborted};
  Once reset{kReset, [this] { chip.set_reset(true), aborted.set_reset(true); }};
  Once begin{kAbortAt, [this] { begin_access(kAbortAt, 0x000); }};
  Once abort{kAbort, [this] { aborted_host.reset(); }};
  Once again{kAbort + 5000, [this] { begin_access(kAbort + 5000, 0x001); }};
  UserProgram program{options()};
  std::optional<NativeCpu> cpu{std::in_place, host, user_cpu::CpuTiming(), program.entry()};
  Once stop{kEnd + 1, [this] {
              counters = cpu->counters();
              cpu.reset();
              chip.set_reset(false), aborted.set_reset(false);
            }};
  user_cpu::CpuCounters counters;
  Changes changes, aborted_changes;
  DecoupledRun decoupled{timeline, timeline_module, segment};

  TlmRun() {
    timeline.check_announcements();
    for (bus::Agent* agent : std::initializer_list<bus::Agent*>{&reset, &begin, &abort, &again, &stop, &*cpu,
                                                                &decoupled.reset, &decoupled.cpu})
      timeline.add(*agent);
    chip.on_pin = [this](Tick at, Pin pin, Level level) {
      if (!is_input(pin) && at <= kEnd) changes.push_back({at, pin, level});
    };
    aborted.on_pin = [this](Tick at, Pin pin, Level level) { aborted_changes.push_back({at, pin, level}); };
  }
  void begin_access(Tick at, std::uint16_t address) {
    aborted_host.begin(at, {false, address, 0}, {});
    aborted_host.run_edges(at);
  }
};

std::unique_ptr<TlmRun> tlm_run;

}  // namespace

void simulate() {
  set_resolution();
  collect_reports();
  tlm_run = std::make_unique<TlmRun>();
  sc_core::sc_start(dsdpv1::systemc::to_time(2 * kEnd));
}

namespace {

TEST(SystemcBench, TheUserCpuBehindTheSocketDoesWhatTheOneAtThePinsDoes) {
  const PinRun pins;
  EXPECT_TRUE(pins.program.initialised());
  EXPECT_TRUE(tlm_run->program.initialised());
  EXPECT_EQ(tlm_run->counters.accesses, pins.cpu.counters().accesses);
  EXPECT_EQ(tlm_run->counters.bad_reads, 0U);
  EXPECT_EQ(tlm_run->program.counters().exchanges, pins.program.counters().exchanges);
  EXPECT_GT(pins.core.changes.size(), 1000U);
  EXPECT_EQ(tlm_run->changes, pins.core.changes);
}

TEST(SystemcBench, AUserCpuThatRunsAheadOfSimulationTimeDoesTheSame) {
  const PinRun pins;
  const DecoupledRun& decoupled = tlm_run->decoupled;
  EXPECT_TRUE(decoupled.program.initialised());
  EXPECT_GT(decoupled.begun_ahead, decoupled.cpu.counters().accesses / 2);
  EXPECT_EQ(decoupled.cpu.counters().accesses, pins.cpu.counters().accesses);
  EXPECT_EQ(decoupled.cpu.counters().bad_reads, 0U);
  EXPECT_EQ(decoupled.program.counters().exchanges, pins.program.counters().exchanges);
  EXPECT_EQ(decoupled.changes, without_data(pins.core.changes));
}

TEST(SystemcBench, AResetOfTheUserCpuReleasesThePinsAtOnce) {
  EXPECT_THAT(only(tlm_run->aborted_changes, Pin::kRd),
              testing::ElementsAre(Change{kAbortAt + 333, Pin::kRd, 0}, Change{kAbort, Pin::kRd, 1},
                                   Change{kAbort + 5333, Pin::kRd, 0}, Change{kAbort + 6333, Pin::kRd, 1}));
  EXPECT_EQ(tlm_run->aborted_host.read_value(), 0x0D);
}

}  // namespace
}  // namespace dsdpv1
