// Chip::carry_out against the same access edge by edge: two chips, the same user, the same bus.
#include <gtest/gtest.h>

#include <array>
#include <random>

#include "model/dsdpv1/chip.hpp"
#include "model/dsdpv1/reasons.hpp"
#include "registers/dsdpv1_regs.hpp"
#include "tests/core/event_recorder.hpp"

namespace dsdpv1 {
namespace {

using profibus::Tick;

constexpr Tick kUs = 12'000;
constexpr Level kNothing = -3;

struct Recorded {
  Recorded() {
    chip.on_event(
        {[](void* self, const profibus::Event& event) { static_cast<Recorded*>(self)->events.push_back(event); },
         this});
  }
  Level edge_by_edge(Tick begin, const HostAccess& access) {
    Level sampled = kNothing;
    for (const HostAccess::Edge& edge : access)
      if (edge.pin == Pin::kDOut)
        sampled = chip.sample(begin + edge.at);
      else
        chip.set(begin + edge.at, edge.pin, edge.level);
    return sampled;
  }

  dsdpv1::Chip chip;
  std::vector<profibus::Event> events;
};

/// Two chips with a random user.
class WholeAccess : public testing::TestWithParam<unsigned> {
 protected:
  WholeAccess() {
    both([](dsdpv1::Chip& chip) { chip.set(1000, Pin::kReset, 1); });
  }
  template <class Action>
  void both(const Action& action) {
    action(edges.chip);
    action(whole.chip);
  }
  Tick choose(Tick from, Tick to) { return std::uniform_int_distribution<Tick>(from, to)(random); }
  bool one_in(int many) { return choose(1, many) == 1; }

  /// The default, with limits kept exactly, or random values near them.
  AccessTiming timing() {
    AccessTiming timing;
    if (one_in(3)) return timing;
    const bool near = one_in(2);
    const auto limit = [&](Tick least) { return near ? least + choose(-2, 2) : least; };
    timing.address_setup = choose(0, 400);
    timing.cs_lead = choose(near ? -100 : 0, 400);
    timing.rd_sample = limit(dsdpv1::kTw) + std::max<Tick>(-timing.cs_lead, 0);
    timing.rd_low = timing.rd_sample + choose(0, 300);
    timing.wr_low = limit(dsdpv1::kTs) + choose(0, 1) * 300;
    timing.data_setup = limit(dsdpv1::kTd);
    timing.data_hold = limit(dsdpv1::kTd);
    timing.address_hold = limit(dsdpv1::kTd);
    timing.cs_trail = choose(near ? -50 : 0, 200);
    timing.recovery = choose(0, 500);
    return timing;
  }
  HostAccess access() {
    const Tick anywhere = one_in(2) ? choose(0, 0x7FF) : HostAccess::kIdleAddress;
    const auto address = static_cast<std::uint16_t>(one_in(8) ? anywhere : choose(0x130, 0x137));
    if (one_in(2)) return HostAccess::read(address, timing());
    return HostAccess::write(address, static_cast<std::uint8_t>(choose(0, 255)), timing());
  }
  void set_handshake(Pin pin) {
    const Level level = one_in(4) ? 0 : 1;
    both([&](dsdpv1::Chip& chip) { chip.set(now, pin, level); });
    now += choose(0, 2 * kUs);
  }
  void expect_same(const char* where) {
    ASSERT_EQ(edges.events.size(), whole.events.size()) << where << " at " << now;
    for (std::size_t i = seen; i < edges.events.size(); ++i)
      ASSERT_TRUE(core_test::same(edges.events[i], whole.events[i])) << dsdpv1::describe(edges.events[i]);
    seen = edges.events.size();
    if (!may_report) ASSERT_EQ(edges.chip.next_event(), whole.chip.next_event()) << where << " at " << now;
    for (unsigned pin = 0; pin < dsdpv1::kPinCount; ++pin)
      ASSERT_EQ(edges.chip.level(static_cast<Pin>(pin)), whole.chip.level(static_cast<Pin>(pin))) << where << pin;
  }

  /// 10 000 accesses, and how many were carried out, without a hold, and how many of those found D unreadable.
  void play() {
    for (int i = 0; i < 10'000; ++i) {
      if (one_in(40)) set_handshake(Pin::kRReq);
      if (one_in(40)) set_handshake(Pin::kRSta);
      now += one_in(3) ? choose(0, 3000) : 0;
      const HostAccess one = access();
      const Level of_edges = edges.edge_by_edge(now, one);
      Level sampled = kNothing;
      const bool done = whole.chip.carry_out(now, one, sampled, may_report);
      if (!done) sampled = whole.edge_by_edge(now, one);
      ++(done ? carried_out : refused);
      if (done && whole.events.size() > seen) ++(sampled < 0 ? unreadable : unheld);
      if (!one.is_write()) ASSERT_EQ(of_edges, sampled) << "at " << now;
      expect_same("behind an access");
      now += one.duration();
      if (one_in(2)) both([&](dsdpv1::Chip& chip) { chip.advance(now); });
    }
    both([&](dsdpv1::Chip& chip) { chip.advance(now + 10 * kUs); });
    expect_same("at the end");
    for (std::uint16_t address = 0; address < 0x800; ++address)
      ASSERT_EQ(edges.chip.peek(address), whole.chip.peek(address)) << address;
    EXPECT_GT(carried_out, 1000);
    EXPECT_GT(refused, 1000);
  }

  bool may_report = false;  ///< it dozes on then, and plans something else
  int carried_out = 0, refused = 0, unheld = 0, unreadable = 0;
  Recorded edges, whole;
  std::mt19937 random{GetParam()};
  Tick now = 200 * kUs;  // the start-up is over
  std::size_t seen = 0;
};
INSTANTIATE_TEST_SUITE_P(Seeds, WholeAccess, testing::Range(1U, 5U));

TEST_P(WholeAccess, ComesToWhatItsEdgesComeTo) {
  play();
  EXPECT_EQ(unheld + unreadable, 0);
}

TEST_P(WholeAccess, WithoutAHoldReadsAndReportsWhatItsEdgesDo) {
  may_report = true;
  play();
  EXPECT_GT(unheld, 500);
  EXPECT_GT(unreadable, 3);
}

TEST(RightAccess, IsThatOfTheDefaultsAndOfTheLimits) {
  AccessTiming limits;
  limits.rd_sample = limits.rd_low = dsdpv1::kTw;
  limits.wr_low = limits.data_setup = limits.data_hold = limits.address_hold = 150;
  for (const AccessTiming& timing : {AccessTiming(), limits}) {
    EXPECT_TRUE(HostAccess::read(0x130, timing).is_right());
    EXPECT_TRUE(HostAccess::write(0x130, 1, timing).is_right());
  }
}

TEST(RightAccess, IsNoneThatMissesALimitByATick) {
  const std::array<Tick AccessTiming::*, 5> of_writes = {&AccessTiming::wr_low, &AccessTiming::data_setup,
                                                         &AccessTiming::data_hold, &AccessTiming::address_hold,
                                                         &AccessTiming::rd_sample};
  for (const auto field : of_writes) {
    AccessTiming timing;
    timing.*field = (field == &AccessTiming::rd_sample ? dsdpv1::kTw : 150) - 1;
    const bool of_read = field == &AccessTiming::rd_sample;
    EXPECT_FALSE((of_read ? HostAccess::read(0x130, timing) : HostAccess::write(0x130, 1, timing)).is_right());
  }
}

}  // namespace
}  // namespace dsdpv1
