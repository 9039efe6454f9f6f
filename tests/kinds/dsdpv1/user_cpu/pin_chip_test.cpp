// A host access on a chip of the bench: all of its edges in one turn, except those after an edge that is reported.
#include "kinds/dsdpv1/chip/dsdpv1_pin_chip.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <random>
#include <tuple>
#include <utility>
#include <vector>

#include "kinds/dsdpv1/chip/core_device.hpp"
#include "tests/bench/saturated_bus.hpp"

namespace dsdpv1 {
namespace {

using bus::Tick;
using user_cpu::Access;

constexpr Access kWrite = {true, 0x130, 0x5A};

/// A chip of the bench and its core.
struct WithCore {
  WithCore(const char* name, bus::Segment& segment)
      : device(std::make_unique<tb::CoreDevice>(dsdpv1::Config())),
        core(device->chip()),
        chip(name, std::move(device), Part::kDsdpv1, 0, segment) {}

  std::unique_ptr<tb::CoreDevice> device;  ///< until the chip takes it
  const dsdpv1::Chip& core;
  tb::Dsdpv1PinChip chip;
  user_cpu::HostBus& host = static_cast<user_cpu::HostBus&>(*chip.user_side());
};

/// Records the times of events.
struct Heard : tb::ChipListener {
  void event(std::size_t /*slave*/, const profibus::Event& event) override { events.push_back(event.at); }
  std::vector<Tick> events;
};

/// The user has the DPRAM.
struct PinChipTest : testing::Test {
  PinChipTest() {
    chip.listen(heard, 0);
    chip.set_reset(1000, true);
    chip.run(200 * bus::kTicksPerUs);
    host.set_r_req(200 * bus::kTicksPerUs, true);
    chip.run(202 * bus::kTicksPerUs);
    host.set_r_sta(202 * bus::kTicksPerUs, true);
    chip.run(kStart);
    events.clear();
  }
  static constexpr Tick kStart = 203 * bus::kTicksPerUs;

  bus::Segment segment;
  WithCore with_core{"chip", segment};
  tb::PinChip& chip = with_core.chip;
  const dsdpv1::Chip& core = with_core.core;
  user_cpu::HostBus& host = with_core.host;
  Heard heard;
  std::vector<Tick>& events = heard.events;
};

TEST_F(PinChipTest, AnAccessThatNobodyHearsOfIsOneTurn) {
  host.begin(kStart, kWrite, AccessTiming());
  host.run_edges(host.end());
  EXPECT_EQ(host.next_edge(), bus::kNever);
  EXPECT_TRUE(events.empty());
  EXPECT_LE(core.now(), host.end());
}

TEST_F(PinChipTest, EdgesBehindAViolationHaveTheirOwnTurn) {
  AccessTiming late;
  late.data_setup = 149;
  host.begin(kStart, kWrite, late);
  host.run_edges(host.end());
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(core.now(), events[0]);
  EXPECT_GT(host.next_edge(), events[0]);
  host.run_edges(host.end());
  EXPECT_EQ(host.next_edge(), bus::kNever);
}

TEST_F(PinChipTest, AReadInOneTurnBringsTheByte) {
  host.begin(kStart, kWrite, AccessTiming());
  host.run_edges(host.end());
  const Tick next = host.end() + 1000;
  host.begin(next, {false, kWrite.address, 0}, AccessTiming());
  host.run_edges(host.end());
  EXPECT_FALSE(host.last_read_was_bad());
  EXPECT_EQ(host.read_value(), kWrite.value);
}

// --- accesses that are put off ---------------------------------------------------------------------------------------

/// Two users with a chip each on one line make the same accesses; the second sets each edge at its time.
struct PutOffTest : testing::Test {
  struct User : WithCore {
    User(const char* name, bus::Segment& segment) : WithCore(name, segment) {
      chip.listen(heard, 0);
      chip.set_reset(1000, true);
      chip.run(200 * bus::kTicksPerUs);
      host.set_r_req(200 * bus::kTicksPerUs, true);
      chip.run(202 * bus::kTicksPerUs);
      host.set_r_sta(202 * bus::kTicksPerUs, true);
    }
    Heard heard;
    std::vector<Tick>& events = heard.events;
  };

  /// Chips act when they plan to, the line moves at `line_at`; up to the end of the access.
  void carry_out(Tick at, const Access& access, Tick line_at) {
    for (User* user : {&late, &exact}) user->host.begin(at, access, AccessTiming());
    const bool put_off = late.host.put_off();
    puts_off += put_off ? 1 : 0;
    bool line_moves = true;
    for (;;) {
      const Tick line = line_moves ? line_at : bus::kNever;
      const Tick chips = std::min(late.chip.next(), exact.chip.next());
      const Tick now = std::min({line, chips, exact.host.next_edge(), put_off ? bus::kNever : late.host.next_edge()});
      if (now > exact.host.end()) break;
      for (User* user : {&late, &exact})
        if (user->chip.next() <= now) user->chip.run(now);
      if (line <= now) {
        level = !level;
        segment.force(now, level);
        line_moves = false;
      }
      if (exact.host.next_edge() <= now) exact.host.run_edges(now);
      if (!put_off && late.host.next_edge() <= now) late.host.run_edges(now);
    }
    if (put_off) late.host.run_edges(late.host.end());
  }

  bus::Segment segment;
  User late{"late", segment}, exact{"exact", segment};
  int puts_off = 0;
  bool level = true;
};

TEST_F(PutOffTest, WhatTheUserAndTheChipDoIsTheSame) {
  std::mt19937 random(3);
  const auto draw = [&random](int most) { return std::uniform_int_distribution<int>(0, most)(random); };
  Tick now = 203 * bus::kTicksPerUs;
  for (int i = 0; i < 3000; ++i) {
    const Access access = {draw(2) == 0, static_cast<std::uint16_t>(0x12C + draw(3)),
                           static_cast<std::uint8_t>(draw(255))};
    carry_out(now, access, now + draw(4000));
    ASSERT_EQ(late.host.read_value(), exact.host.read_value()) << i;
    ASSERT_EQ(late.host.last_read_was_bad(), exact.host.last_read_was_bad()) << i;
    now = exact.host.end() + draw(3) * 700;
  }
  for (User* user : {&late, &exact}) user->chip.run(now);
  EXPECT_EQ(late.events, exact.events);
  EXPECT_EQ(late.chip.status().accesses, exact.chip.status().accesses);
  EXPECT_GT(puts_off, 2000) << "most are right accesses of the owner";
}

TEST_F(PutOffTest, AnAccessThatSomebodyHearsOfIsNot) {
  const Tick at = 203 * bus::kTicksPerUs;
  AccessTiming late_data;
  late_data.data_setup = 149;
  late.host.begin(at, kWrite, late_data);
  EXPECT_FALSE(late.host.put_off()) << "Td is violated";
  late.host.run_edges(late.host.end());
  late.host.run_edges(late.host.end());
  late.host.set_r_sta(at + 10'000, false);
  late.host.begin(at + 20'000, kWrite, AccessTiming());
  EXPECT_FALSE(late.host.put_off()) << "the user does not own the DPRAM";
}

TEST_F(PutOffTest, AResetInTheMiddleForgetsTheRest) {
  const Tick at = 203 * bus::kTicksPerUs;
  late.host.begin(at, kWrite, AccessTiming());
  ASSERT_TRUE(late.host.put_off());
  late.chip.reset_host(at + 400);
  EXPECT_EQ(late.chip.level(number(Pin::kWr)), 1);
  EXPECT_EQ(late.core.now(), at + 400);
}

// --- pins that are reported late -------------------------------------------------------------------------------------

/// The owner's accesses to two chips whose pins are all watched; the second reports each at its time.
struct LateReportTest : testing::Test {
  struct User : tb::ChipListener {
    User(const char* name, bus::Segment& segment, bool late)
        : chip(name, std::make_unique<tb::CoreDevice>(dsdpv1::Config()), Part::kDsdpv1, ~0U, segment, late) {
      chip.listen(*this, 0);
      chip.set_reset(1000, true);
      chip.run(200 * bus::kTicksPerUs);
      host.set_r_req(200 * bus::kTicksPerUs, true);
      chip.run(202 * bus::kTicksPerUs);
      host.set_r_sta(202 * bus::kTicksPerUs, true);
      chip.run(203 * bus::kTicksPerUs);
      changes.clear();
    }
    void pin(std::size_t /*slave*/, Tick at, tb::PinNumber pin, tb::Level level) override {
      changes.push_back({at, pin, level});
    }
    void edges(std::size_t slave, const tb::PinEdge* first, const tb::PinEdge* last) override {
      EXPECT_TRUE(std::is_sorted(first, last, [](const auto& a, const auto& b) { return a.at < b.at; }));
      ++whole;
      ChipListener::edges(slave, first, last);
    }
    bool acts_on_events() const override { return false; }
    /// By time; at one tick pins come in any order.
    std::vector<std::tuple<Tick, tb::PinNumber, tb::Level>> take() {
      std::sort(changes.begin(), changes.end());
      return std::exchange(changes, {});
    }

    tb::Dsdpv1PinChip chip;
    user_cpu::HostBus& host = static_cast<user_cpu::HostBus&>(*chip.user_side());
    std::vector<std::tuple<Tick, tb::PinNumber, tb::Level>> changes;
    int whole = 0;
  };

  bus::Segment segment;
  User late{"late", segment, true}, exact{"exact", segment, false};
};

TEST_F(LateReportTest, AWholeAccessHasTheEdgesOfEach) {
  std::mt19937 random(5);
  const auto draw = [&random](Tick least, Tick most) {
    return std::uniform_int_distribution<Tick>(least, most)(random);
  };
  Tick now = 203 * bus::kTicksPerUs;
  for (int i = 0; i < 3000; ++i) {
    const Access access = {draw(0, 1) == 0, static_cast<std::uint16_t>(draw(0, 9) == 0 ? 0x7FF : draw(0x130, 0x133)),
                           static_cast<std::uint8_t>(draw(0, 255))};
    AccessTiming timing;
    timing.address_setup = draw(-20, 400);
    timing.cs_lead = draw(-100, 400);
    timing.rd_sample = draw(370, 700) + std::max<Tick>(-timing.cs_lead, 0);
    timing.rd_low = timing.rd_sample + draw(0, 100);
    timing.address_hold = draw(-200, 300);
    timing.cs_trail = draw(-50, 200);
    for (User* user : {&late, &exact}) {
      user->host.begin(now, access, timing);
      while (user->host.next_edge() != bus::kNever) user->host.run_edges(user->host.end());
    }
    ASSERT_EQ(late.take(), exact.take()) << i;
    ASSERT_EQ(late.host.read_value(), exact.host.read_value()) << i;
    now = exact.host.end() + draw(0, 3) * 700;
  }
  EXPECT_GT(late.whole, 1000);
  EXPECT_EQ(exact.whole, 0);
}

// --- telegrams of others ---------------------------------------------------------------------------------------------

/// A chip that has found its rate, at 12 Mbit/s, and another sender.
struct ForeignTelegramsTest : PinChipTest, bus::Listener {
  ForeignTelegramsTest() {
    Tick at = kStart;
    for (const speed::Cell& cell : speed::initialisation(2)) {
      host.begin(at, {true, cell.address, cell.value}, AccessTiming());
      host.run_edges(host.end());
      at = host.end() + 1000;
    }
    host.set_r_sta(at, false);
    host.set_r_req(at, false);
    segment.drive(sender, at, true, true);
    find_baud(bus::kTicksPerMs);
    run_to(bus::kTicksPerMs + kPeriod);
  }
  void line_changed(Tick /*at*/, bool /*level*/) override {}
  bool run_begins(const bus::CharacterRun& /*run*/) override { return true; }
  void run_to(Tick until) {
    while (chip.next() <= until) chip.run(chip.next());
  }
  void find_baud(Tick at) {
    for (const auto& edge : speed::wave_of(kTelegram).edges) {
      run_to(at + edge.at - 1);
      segment.drive(sender, at + edge.at, true, edge.level);
    }
  }
  static Tick begin_of(int telegram) { return 2 * bus::kTicksPerMs + telegram * kPeriod; }
  void send_to_others(int telegram) {
    ASSERT_TRUE(segment.send_run(sender, {begin_of(telegram), speed::kBit, kTelegram.data(), kTelegram.size()}));
  }
  static constexpr Tick kPeriod = 200 * speed::kBit;
  const bus::Bytes kTelegram = {0x10, 0x63, 0x02, 0x49, 0xAE, 0x16};  // FDL status of station 99
  bus::StationId sender = segment.attach("sender", this);
};

TEST_F(ForeignTelegramsTest, AreCountedThoughTheChipHasNoTurn) {
  ASSERT_TRUE(core.status().baud_index.known());
  const auto before = core.status().telegrams_received;
  for (int i = 0; i < 3; ++i) send_to_others(i);
  EXPECT_EQ(core.status().telegrams_received, before);  // not passed to it
  chip.sync(begin_of(3));
  EXPECT_EQ(core.status().telegrams_received, before + 3);
}

TEST_F(ForeignTelegramsTest, AskedInTheMiddleOfOneTheChipHasThoseBefore) {
  const auto before = chip.status().telegrams_received;
  for (int i = 0; i < 3; ++i) send_to_others(i);
  EXPECT_EQ(chip.status().telegrams_received, before + 2);
  chip.sync(begin_of(2) + 30 * speed::kBit);
  EXPECT_EQ(chip.status().telegrams_received, before + 2);
  chip.sync(begin_of(3));
  EXPECT_EQ(chip.status().telegrams_received, before + 3);
}

}  // namespace
}  // namespace dsdpv1
