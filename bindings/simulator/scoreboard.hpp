// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
// A model beside somebody's RTL on the same inputs: the first difference of their outputs.
#include <array>
#include <cstdint>

#include "bindings/simulator/model.hpp"

namespace dsdpv1::simulator {

class Scoreboard final : public Object {
 public:
  Scoreboard(const char* options, int64_t tolerance_ps);

  /// The pins at `tick`. What was different until now is judged first.
  void step(uint64_t tick, uint32_t inputs, uint32_t outputs);
  bool differs() const { return differs_; }
  /// As of the model; while a difference is waiting for its judgement, the very next half cycle.
  int64_t next(int64_t half) const { return waiting_ ? half + 1 : half_of(model_.next_tick()); }
  uint64_t matched() const { return armed_ ? model_.changes() - changes_before_ : 0; }

 private:
  void arm(uint64_t tick);
  void settle(uint64_t tick);
  void compare();
  void report(std::size_t index, uint64_t tick);
  void note_input(uint64_t tick, uint32_t inputs);

  Model model_;
  const uint64_t tolerance_;  ///< ticks
  uint64_t now_ = 0, reset_since_ = 0, changes_before_ = 0;
  uint64_t input_changed_ = 0;  ///< tick of last_input_
  const PinPlace* last_input_ = nullptr;
  uint32_t outputs_ = 0;
  bool began_ = false, armed_ = false, waiting_ = false, differs_ = false;
  std::array<uint64_t, kOutputs.size()> since_{};  ///< since when an output is different; DPSIM_NEVER: it is not
};

}  // namespace dsdpv1::simulator
