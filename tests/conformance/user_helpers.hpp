#pragma once
// Shared by the tests of the user's side: times of edges, accesses as they are seen at the pins, scripted pins, and a
// separate CRC-16 (steps 1 to 7 of chapter 4.2).
#include <gtest/gtest.h>

#include <algorithm>
#include <deque>
#include <functional>
#include <vector>

#include "tests/conformance/slave_bench.hpp"

namespace dsdpv1::conformance {

using profibus::Cycle;
using profibus::Reason;

/// The first edge that samples a change made at `t`, and the one at which the logic sees it (P9).
constexpr Cycle sampled_at(Tick t) { return t / kCycleTicks + 1; }
constexpr Cycle seen_at(Tick t) { return sampled_at(t) + 2; }

/// Chapter 4.2 literally, bit by bit.
inline std::uint16_t document_crc(const Bytes& bytes) {
  unsigned crc = 0xFFFF;
  for (const std::uint8_t byte : bytes) {
    crc ^= byte;
    for (int shift = 0; shift < 8; ++shift) {
      const bool lsb = (crc & 1U) != 0;
      crc >>= 1;
      if (lsb) crc ^= 0xA001U;
    }
  }
  return static_cast<std::uint16_t>(crc);
}

/// One ownership of the DPRAM by the chip, in cycles: L_REQ and L_STA are high from `rise` and low from `fall`.
struct Access {
  Cycle rise, fall;
  Cycle length() const { return fall - rise; }
};

/// All finished accesses so far. Fails when L_REQ and L_STA are not the same at all times, or change off a rising edge
/// (H1).
inline std::vector<Access> accesses(const SlaveBench& bench) {
  const std::vector<PinChange> request = bench.changes(Pin::kLReq), state = bench.changes(Pin::kLSta);
  EXPECT_EQ(request.size(), state.size());
  std::vector<Access> found;
  for (std::size_t i = 0; i < std::min(request.size(), state.size()); ++i) {
    EXPECT_EQ(request[i].at, state[i].at) << "L_REQ and L_STA apart";
    EXPECT_EQ(request[i].level, state[i].level);
    if (state[i].level == 0 && i > 0) found.push_back({state[i - 1].at / kCycleTicks, state[i].at / kCycleTicks});
  }
  return found;
}

/// The cycle of the last rise of L_STA.
inline Cycle last_rise(const SlaveBench& bench) {
  const std::vector<PinChange> state = bench.changes(Pin::kLSta);
  for (auto change = state.rbegin(); change != state.rend(); ++change)
    if (change->level != 0) return change->at / kCycleTicks;
  ADD_FAILURE() << "L_STA never rose";
  return 0;
}

/// Runs to the tick of a cycle's rising edge, that edge included.
inline void run_to_cycle(SlaveBench& bench, Cycle cycle) { bench.run_until(cycle * kCycleTicks); }

/// Runs, edge by edge, to the next change of L_STA to `level`; its cycle.
inline Cycle run_to_l_sta(SlaveBench& bench, Level level, Cycle limit = 200'000) {
  bool before = bench.chip.level(Pin::kLSta) == level;
  for (Cycle i = 0; i < limit; ++i) {
    run_to_cycle(bench, bench.now() / kCycleTicks + 1);
    const bool now = bench.chip.level(Pin::kLSta) == level;
    if (now && !before) return bench.now() / kCycleTicks;
    before = now;
  }
  ADD_FAILURE() << "L_STA never becomes " << level;
  return 0;
}

/// No rule of the user's bus was violated.
inline void expect_no_violation(const SlaveBench& bench) {
  for (const profibus::Event& event : bench.chip.events())
    EXPECT_NE(profibus::severity(event.reason), profibus::Severity::kViolation) << dsdpv1::describe(event);
}

/// Pins (or anything else) at planned ticks while others run the timeline.
class Script : public bus::Agent {
 public:
  explicit Script(SlaveBench& bench) : bench_(bench) { bench.timeline.add(*this); }

  void at(Tick tick, std::function<void(Tick)> action) {
    actions_.push_back({tick, std::move(action)});
    announce();
  }
  void set(Tick tick, Pin pin, Level level) {
    at(
        tick, [this, pin, level](Tick now) { bench_.chip.set(now, pin, level); });
  }
  bool done() const { return actions_.empty(); }

  Tick next() const override { return actions_.empty() ? bus::kNever : actions_.front().tick; }
  void run(Tick now) override {
    while (!actions_.empty() && actions_.front().tick <= now) {
      const auto action = std::move(actions_.front().call);
      actions_.pop_front();
      action(now);
    }
  }

 private:
  struct Action {
    Tick tick;
    std::function<void(Tick)> call;
  };
  SlaveBench& bench_;
  std::deque<Action> actions_;
};

}  // namespace dsdpv1::conformance
