// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
// A model beside somebody's RTL on the same inputs: the first difference of their outputs.
#include <cstdint>
#include <deque>
#include <vector>

#include "bindings/simulator/model.hpp"

namespace dsdpv1::simulator {

/// MISO of RTL is the pin's register, which SCK clocks: from one level to the other it follows `spi_miso_delay` later,
/// as in lockstep (docs/microarchitecture_rsu.md, 5.1); when it is driven and released, at once.
class PadDelay {
 public:
  /// Does nothing for a kind without such a pin.
  explicit PadDelay(const ChipOptions& options, const KindPins& pins);

  /// The outputs as pins, of RTL that has these at `tick`; of those of one tick the last ones count.
  uint64_t pins_of(uint64_t tick, uint64_t outputs);
  /// When the pin changes by itself.
  uint64_t next_tick() const { return coming_.empty() ? DPSIM_NEVER : coming_.front().tick; }

 private:
  struct Change {
    uint64_t tick, level;
  };
  const PinPlace* place_ = nullptr;
  uint64_t delay_ = 0;               ///< ticks
  uint64_t tick_ = 0, settled_ = 0;  ///< what the register was before this tick, in which it may still change
  uint64_t register_ = 0, pin_ = 0;
  std::deque<Change> coming_;
};

class Scoreboard final : public Object {
 public:
  Scoreboard(const ChipOptions& options, int64_t tolerance_ps);

  /// The pins at `tick`. What was different until now is judged first.
  void step(uint64_t tick, uint64_t inputs, uint64_t outputs);
  bool differs() const { return differs_; }
  /// As of the model; while a difference is waiting for its judgement, the very next half cycle.
  int64_t next(int64_t half) const {
    const int64_t wake = wake_of(std::min(model_.next_tick(), pad_.next_tick()), half);
    return waiting_ && wake >= 0 ? half + 1 : wake;
  }
  uint64_t matched() const { return armed_ ? model_.changes() - changes_before_ : 0; }

 private:
  void arm(uint64_t tick);
  void settle(uint64_t tick);
  void compare();
  void report(std::size_t index, uint64_t tick);
  void note_input(uint64_t tick, uint64_t inputs);
  /// Which outputs of `pins` are not the model's.
  uint64_t different(uint64_t pins) const;

  Model model_;
  PadDelay pad_;
  const uint64_t reset_;      ///< its bit of the inputs
  const uint64_t tolerance_;  ///< ticks
  uint64_t now_ = 0, reset_since_ = 0, changes_before_ = 0;
  uint64_t input_changed_ = 0;  ///< tick of last_input_
  const PinPlace* last_input_ = nullptr;
  uint64_t outputs_ = 0;
  bool began_ = false, armed_ = false, waiting_ = false, differs_ = false;
  std::vector<uint64_t> since_;  ///< since when an output is different; DPSIM_NEVER: it is not
};

}  // namespace dsdpv1::simulator
