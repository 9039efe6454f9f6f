// A host access on a chip of the bench: all of its edges in one turn, but for those behind one that somebody hears of.
#include "tb/dsdpv1/pin_chip.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace {

using bus::Tick;
using user_cpu::Access;
using user_cpu::AccessTiming;

constexpr Access kWrite = {true, 0x130, 0x5A};

/// The user has the DPRAM.
struct PinChipTest : testing::Test {
  PinChipTest() {
    chip.on_event = [this](const profibus::Event& event) { events.push_back(event.at); };
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
  tb::PinChip chip{"chip", dsdpv1::Config(), 0, segment};
  user_cpu::HostBus& host = chip.host_bus();
  std::vector<Tick> events;
};

TEST_F(PinChipTest, AnAccessThatNobodyHearsOfIsOneTurn) {
  host.begin(kStart, kWrite, AccessTiming());
  host.run_edges(host.end());
  EXPECT_EQ(host.next_edge(), bus::kNever);
  EXPECT_TRUE(events.empty());
  EXPECT_LE(chip.core().now(), host.end());
}

TEST_F(PinChipTest, EdgesBehindAViolationHaveTheirOwnTurn) {
  AccessTiming late;
  late.data_setup = 149;
  host.begin(kStart, kWrite, late);
  host.run_edges(host.end());
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(chip.core().now(), events[0]);
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

}  // namespace
