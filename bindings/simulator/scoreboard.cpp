// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0
// A scoreboard of the C API on packed pins.
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "bindings/simulator/object.hpp"
#include "bindings/simulator/options.hpp"
#include "bindings/simulator/pins.hpp"
#include "bindings/simulator/simulator.h"

namespace dsdpv1::simulator {
namespace {

class Scoreboard final : public Object {
 public:
  Scoreboard(const ChipOptions& options, int64_t tolerance_ps)
      : pins_(pins_of_kind(options.kind)), inputs_(pins_.inputs.at_reset()), outputs_(pins_.outputs.at_reset()) {
    const NativeOptions native(options);
    const uint64_t tolerance = dpsim_ticks_from(static_cast<uint64_t>(std::max<int64_t>(tolerance_ps, 0)), DPSIM_PS);
    const dpsim_scoreboard_options chosen = {sizeof chosen, 0, static_cast<int64_t>(tolerance),
                                             4 * DPSIM_TICKS_PER_CYCLE};
    check(dpsim_scoreboard_create(&native.chosen, &chosen, &scoreboard_));
    result_.size = sizeof result_;
    result_.tick = DPSIM_NEVER;
  }
  ~Scoreboard() override { dpsim_scoreboard_destroy(scoreboard_); }
  Scoreboard(const Scoreboard&) = delete;
  Scoreboard& operator=(const Scoreboard&) = delete;

  /// Feeds the pins at `tick`; a time before the present one counts as the present one.
  void step(uint64_t tick, uint64_t inputs, uint64_t outputs) {
    if (differs()) return;
    now_ = std::max(now_, tick);
    changes_.clear();
    const auto add = [this](const PinPlace& pin, dpsim_level level) {
      changes_.push_back({now_, 0, pin.pin, level, 0});
    };
    for_each_change(pins_.inputs, std::exchange(inputs_, inputs), inputs, add);
    for_each_change(pins_.outputs, std::exchange(outputs_, outputs), outputs, add);
    check(dpsim_scoreboard_compare(scoreboard_, changes_.data(), changes_.size(), now_, &result_));
    if (differs()) say(text());
  }
  const dpsim_scoreboard_result& result() const { return result_; }
  bool differs() const { return result_.tick != DPSIM_NEVER; }

 private:
  std::string text() const;

  const KindPins& pins_;
  dpsim_scoreboard* scoreboard_ = nullptr;
  uint64_t inputs_, outputs_, now_ = 0;
  std::vector<dpsim_change> changes_;
  dpsim_scoreboard_result result_{};
};

std::string Scoreboard::text() const {
  const PinPlace& pin = pins_.outputs.of_pin(result_.pin);
  std::string text = fmt::format("first difference at {}: {} is {}, the model's is {}", time_text(result_.tick),
                                 pin.name, level_text(pin, result_.dut), level_text(pin, result_.model));
  if (result_.input_tick != DPSIM_NEVER) {
    const PinPlace& input = pins_.inputs.of_pin(result_.input);
    text += fmt::format("\n  last input  {}={} at {}", input.name, level_text(input, result_.input_level),
                        time_text(result_.input_tick));
  }
  for (std::size_t i = result_.event_count; i-- > 0;) {
    char words[256];
    check(dpsim_chip_event_text(pins_.kind.c_str(), &result_.events[i], words, sizeof words));
    text += fmt::format("\n  event       {}  {}", time_text(result_.events[i].tick), words);
  }
  return text;
}

}  // namespace
}  // namespace dsdpv1::simulator

using dsdpv1::simulator::Scoreboard;

int32_t dsdpv1_scoreboard_create(const char* options, int64_t tolerance_ps) {
  return dsdpv1::simulator::created(
      [&] { return std::make_unique<Scoreboard>(dsdpv1::simulator::chip_options(options), tolerance_ps); });
}

int32_t dsdpv1_scoreboard_step(int32_t handle, int64_t half, int64_t ps, int64_t inputs, int64_t outputs,
                               int64_t* next) {
  return dsdpv1::simulator::guarded([&] {
    auto& scoreboard = dsdpv1::simulator::get<Scoreboard>(handle);
    scoreboard.step(dsdpv1::simulator::tick_of(half, ps), static_cast<uint64_t>(inputs),
                    static_cast<uint64_t>(outputs));
    *next = dsdpv1::simulator::wake_of(scoreboard.result().next, half);
    return scoreboard.differs() ? 1 : 0;
  });
}

int32_t dsdpv1_scoreboard_matched(int32_t handle) {
  return dsdpv1::simulator::guarded([&] {
    const uint64_t matched = dsdpv1::simulator::get<Scoreboard>(handle).result().matched;
    return static_cast<int32_t>(std::min<uint64_t>(matched, INT32_MAX));
  });
}
