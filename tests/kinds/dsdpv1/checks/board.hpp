#pragma once
// A user CPU and a chip as plain levels: the test sets every pin of a chip's user side, so that each rule can be kept
// by a tick and violated by a tick, including those that no program on the native CPU can violate.
#include <algorithm>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "kinds/dsdpv1/checks/checks.hpp"

namespace dsdpv1::checks_test {

using bus::Tick;
using checks::Check;

/// Table 15 with margin; a test changes the times that it needs. Ticks of 1/12 ns.
struct Timing {
  Tick address_setup = 300, low = 600, data_setup = 500, data_hold = 200, address_hold = 200, cs_trail = 100;
  std::optional<Tick> sample = {};  ///< of D, after the fall of RD, by a user who reports it
};

/// Cells to be read, and their values.
using Cells = std::vector<std::pair<unsigned, unsigned>>;
/// Without user bytes, with the CRC.
inline const Cells kEmptyParameters = {{0x410, 0x00}, {0x4FE, 0x40}, {0x4FF, 0xBF}};

class Board {
 public:
  /// `from_start`: the test has the user's start, too (READY_UNSEEN).
  explicit Board(const checks::Limits& limits = checks::Limits(checks::rules()), bool from_start = false)
      : checks_(with_start(limits, from_start)) {
    checks_.on_violation([this](const checks::Violation& violation) { violations.push_back(violation); });
    set(Pin::kA, 0x7FF);
    wait(5000);
    set(Pin::kReset, 1);
    wait(2'000'000);
  }

  checks::Checks& checks() { return checks_; }
  Tick now() const { return now_; }
  void wait(Tick ticks) { now_ += ticks; }
  void set(Pin pin, Level level) { checks_.pin(now_, pin, level); }

  /// By a user who tells his looks (hears_looks).
  void look(Pin pin) { checks_.looked(number(pin), now_); }
  /// The handshake of figure 4, R_STA `window` after R_REQ.
  void ask(Tick window = 2040) {
    set(Pin::kRReq, 1);
    wait(window);
    set(Pin::kRSta, 1);
    wait(500);
  }
  void release() {
    set(Pin::kRSta, 0);
    wait(100);
    set(Pin::kRReq, 0);
    wait(5000);
  }
  void chip_owns(bool owns) {
    set(Pin::kLReq, owns ? 1 : 0);
    set(Pin::kLSta, owns ? 1 : 0);
  }

  void write(unsigned address, unsigned value, const Timing& t = {}) {
    const Tick fall = now_ + t.address_setup, rise = fall + t.low;
    plan(now_, Pin::kA, address);
    plan(now_, Pin::kCsr, 0);
    plan(fall, Pin::kWr, 0);
    plan(rise - t.data_setup, Pin::kDIn, value);
    plan(rise, Pin::kWr, 1);
    plan(rise + t.data_hold, Pin::kDIn, static_cast<unsigned>(dsdpv1::kLevelZ));
    plan(rise + t.cs_trail, Pin::kCsr, 1);
    plan(rise + t.address_hold, Pin::kA, 0x7FF);
    carry_out();
  }
  /// The chip answers with `value`, driven a cycle after RD's fall and released with its rise.
  void read(unsigned address, unsigned value, const Timing& t = {}) {
    const Tick fall = now_ + std::max<Tick>(t.address_setup, 0);
    if (t.sample) checks_.read(fall + *t.sample);
    plan(fall - t.address_setup, Pin::kA, address);
    plan(now_, Pin::kCsr, 0);
    plan(fall, Pin::kDOut, static_cast<unsigned>(dsdpv1::kLevelX));
    plan(fall, Pin::kRd, 0);
    if (t.low > 250) plan(fall + 250, Pin::kDOut, value);
    plan(fall + t.low, Pin::kDOut, static_cast<unsigned>(dsdpv1::kLevelZ));
    plan(fall + t.low, Pin::kRd, 1);
    plan(fall + t.low + t.cs_trail, Pin::kCsr, 1);
    plan(fall + t.low + t.address_hold, Pin::kA, 0x7FF);
    carry_out();
  }
  /// Counts B006 by the rule, after an access of the chip.
  void count(unsigned left = 1) {
    read(0x006, left);
    write(0x006, left + 1);
  }
  /// Reads flags and cells, and clears flag `set`; `others` stay set.
  void fetch(unsigned flags, unsigned set, const Cells& cells, unsigned others = 0) {
    read(flags, set | others);
    for (const auto& [cell, value] : cells) read(cell, value);
    write(flags, others);
  }

  std::vector<checks::Violation> violations;

 private:
  static checks::Limits with_start(checks::Limits limits, bool judged) {
    limits[Check::kReadyUnseen].on = judged;
    return limits;
  }
  void plan(Tick at, Pin pin, unsigned level) { plan_.emplace(at, std::pair(pin, static_cast<Level>(level))); }
  void carry_out() {
    for (const auto& [at, change] : plan_) {
      now_ = at;
      set(change.first, change.second);
    }
    plan_.clear();
    wait(1000);
  }

  checks::Checks checks_;
  std::multimap<Tick, std::pair<Pin, Level>> plan_;
  Tick now_ = 0;
};

}  // namespace dsdpv1::checks_test
