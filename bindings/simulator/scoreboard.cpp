// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0
#include "bindings/simulator/scoreboard.hpp"

#include <fmt/format.h>

#include "bindings/simulator/simulator.h"

namespace dsdpv1::simulator {
namespace {

constexpr uint64_t kWarmUp = 4 * DPSIM_TICKS_PER_CYCLE;  // RTL without initial values has come out of X by then

bool matches(dpsim_level model, dpsim_level rtl, uint16_t pin) {
  return model == rtl || (pin == DPSIM_DSDPV1_D_OUT && model == DPSIM_X);  // P5
}

}  // namespace

Scoreboard::Scoreboard(const char* options, int64_t tolerance_ps)
    : model_(options),
      tolerance_(dpsim_ticks_from(static_cast<uint64_t>(std::max<int64_t>(tolerance_ps, 0)), DPSIM_PS)) {
  model_.remember_events();
  since_.fill(DPSIM_NEVER);
}

void Scoreboard::arm(uint64_t tick) {
  if (armed_ || (model_.inputs() & 1U) != 0 || tick < reset_since_ + kWarmUp) return;
  armed_ = true;
  changes_before_ = model_.changes();
}

void Scoreboard::note_input(uint64_t tick, uint32_t inputs) {
  const uint32_t different = inputs ^ model_.inputs();
  if ((different & 1U) != 0 || !began_) reset_since_ = tick;
  began_ = true;
  for (const PinPlace& place : kInputs)
    if ((different & place.mask) != 0) {
      last_input_ = &place;
      input_changed_ = tick;
    }
}

void Scoreboard::step(uint64_t tick, uint32_t inputs, uint32_t outputs) {
  tick = std::max(tick, now_);
  if (tick > now_) settle(tick);
  note_input(tick, inputs);
  model_.step(tick, inputs);
  outputs_ = outputs;
  now_ = tick;
  if (armed_ && !differs_) compare();
}

/// What the outputs are at now_, which may change until the time moves on.
void Scoreboard::compare() {
  waiting_ = false;
  for (std::size_t i = 0; i < kOutputs.size(); ++i) {
    const PinPlace& place = kOutputs[i];
    const bool same = matches(output_level(place, model_.outputs()), output_level(place, outputs_), place.pin);
    since_[i] = same ? DPSIM_NEVER : std::min(since_[i], now_);
    waiting_ = waiting_ || !same;
  }
}

void Scoreboard::settle(uint64_t tick) {
  if (!armed_) {
    arm(tick);
    return;
  }
  if (!waiting_ || differs_) return;
  for (std::size_t i = 0; i < kOutputs.size() && !differs_; ++i)
    if (since_[i] != DPSIM_NEVER && tick > since_[i] + tolerance_) report(i, since_[i]);
}

void Scoreboard::report(std::size_t index, uint64_t tick) {
  const PinPlace& place = kOutputs[index];
  std::string text = fmt::format("first difference at {}: {} is {}, the model's is {}", time_text(tick), place.name,
                                 level_text(place, output_level(place, outputs_)),
                                 level_text(place, output_level(place, model_.outputs())));
  if (last_input_ != nullptr)
    text +=
        fmt::format("\n  last input  {}={} at {}", last_input_->name,
                    level_text(*last_input_, input_level(*last_input_, model_.inputs())), time_text(input_changed_));
  for (const std::string& event : model_.last_events()) text += "\n  event       " + event;
  say(text);
  differs_ = true;
  waiting_ = false;
}

}  // namespace dsdpv1::simulator

int32_t dsdpv1_scoreboard_create(const char* options, int64_t tolerance_ps) {
  return dsdpv1::simulator::created(
      [&] { return std::make_unique<dsdpv1::simulator::Scoreboard>(options, tolerance_ps); });
}

int32_t dsdpv1_scoreboard_step(int32_t handle, int64_t half, int64_t ps, int32_t inputs, int32_t outputs,
                               int64_t* next) {
  return dsdpv1::simulator::guarded([&] {
    auto& scoreboard = dsdpv1::simulator::get<dsdpv1::simulator::Scoreboard>(handle);
    scoreboard.step(dsdpv1::simulator::tick_of(half, ps), static_cast<uint32_t>(inputs),
                    static_cast<uint32_t>(outputs));
    *next = scoreboard.next(half);
    return scoreboard.differs() ? 1 : 0;
  });
}

int32_t dsdpv1_scoreboard_matched(int32_t handle) {
  return dsdpv1::simulator::guarded([&] {
    const uint64_t matched = dsdpv1::simulator::get<dsdpv1::simulator::Scoreboard>(handle).matched();
    return static_cast<int32_t>(std::min<uint64_t>(matched, INT32_MAX));
  });
}
