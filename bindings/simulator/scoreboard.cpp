// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0
#include "bindings/simulator/scoreboard.hpp"

#include <fmt/format.h>

#include "bindings/simulator/simulator.h"

namespace dsdpv1::simulator {
namespace {

constexpr uint64_t kWarmUp = 4 * DPSIM_TICKS_PER_CYCLE;  // RTL without initial values has come out of X by then

/// The usual value of a parameter, 0 where the kind has none of this name.
int64_t usual(const std::string& kind, const std::string& name) {
  for (std::size_t i = 0; i < dpsim_parameter_count(kind.c_str()); ++i) {
    dpsim_parameter_info info{};
    info.size = sizeof info;
    check(dpsim_parameter_get(kind.c_str(), i, &info));
    if (info.name == name) return info.default_value;
  }
  return 0;
}

}  // namespace

PadDelay::PadDelay(const ChipOptions& options, const KindPins& pins) {
  int64_t delay = usual(options.kind, "spi_miso_delay");
  if (delay == 0) return;
  for (const Option& each : options.parameters)
    if (each.name == "spi_miso_delay") delay = number_of(each, 0, INT32_MAX);
  delay_ = static_cast<uint64_t>(delay);
  place_ = &pins.outputs.first_of(pins.outputs.mask("MISO"));
}

uint64_t PadDelay::pins_of(uint64_t tick, uint64_t outputs) {
  if (place_ == nullptr) return outputs;
  for (; !coming_.empty() && coming_.front().tick <= tick; coming_.pop_front()) pin_ = coming_.front().level;
  if (tick != tick_) {
    settled_ = register_;
    tick_ = tick;
  }
  register_ = outputs & place_->all();
  if (!coming_.empty() && coming_.back().tick == tick + delay_) coming_.pop_back();
  const bool driven = ((register_ | settled_) & ~place_->level) == 0;
  if (driven && register_ != settled_) coming_.push_back({tick + delay_, register_});
  if (!driven && register_ != settled_) coming_.clear();
  if (!driven) pin_ = register_;
  return (outputs & ~place_->all()) | pin_;
}

Scoreboard::Scoreboard(const ChipOptions& options, int64_t tolerance_ps)
    : model_(options),
      pad_(options, model_.pins()),
      reset_(model_.pins().inputs.mask("RESET")),
      tolerance_(dpsim_ticks_from(static_cast<uint64_t>(std::max<int64_t>(tolerance_ps, 0)), DPSIM_PS)),
      since_(model_.pins().outputs.places().size(), DPSIM_NEVER) {
  model_.remember_events();
}

void Scoreboard::arm(uint64_t tick) {
  if (armed_ || (model_.inputs() & reset_) != 0 || tick < reset_since_ + kWarmUp) return;
  armed_ = true;
  changes_before_ = model_.changes();
}

void Scoreboard::note_input(uint64_t tick, uint64_t inputs) {
  uint64_t different = inputs ^ model_.inputs();
  if ((different & reset_) != 0 || !began_) reset_since_ = tick;
  began_ = true;
  while (different != 0) {
    last_input_ = &model_.pins().inputs.first_of(different);
    input_changed_ = tick;
    different &= ~last_input_->all();
  }
}

void Scoreboard::step(uint64_t tick, uint64_t inputs, uint64_t outputs) {
  tick = std::max(tick, now_);
  if (tick > now_) settle(tick);
  note_input(tick, inputs);
  model_.step(tick, inputs);
  outputs_ = pad_.pins_of(tick, outputs);
  now_ = tick;
  if (armed_ && !differs_) compare();
}

uint64_t Scoreboard::different(uint64_t pins) const {
  uint64_t different = pins ^ model_.outputs();
  for (uint64_t rest = different; rest != 0;) {
    const PinPlace& place = model_.pins().outputs.first_of(rest);
    if ((model_.outputs() & place.unknown) != 0) different &= ~place.all();  // P5
    rest &= ~place.all();
  }
  return different;
}

/// What the outputs are at now_, which may change until the time moves on.
void Scoreboard::compare() {
  const uint64_t found = different(outputs_);
  if (found == 0 && !waiting_) return;
  const std::vector<PinPlace>& places = model_.pins().outputs.places();
  for (std::size_t i = 0; i < places.size(); ++i)
    since_[i] = (found & places[i].all()) == 0 ? DPSIM_NEVER : std::min(since_[i], now_);
  waiting_ = found != 0;
}

void Scoreboard::settle(uint64_t tick) {
  if (!armed_) {
    arm(tick);
    return;
  }
  if (!waiting_ || differs_) return;
  for (std::size_t i = 0; i < since_.size() && !differs_; ++i)
    if (since_[i] != DPSIM_NEVER && tick > since_[i] + tolerance_) report(i, since_[i]);
}

void Scoreboard::report(std::size_t index, uint64_t tick) {
  const PinPlace& place = model_.pins().outputs.places()[index];
  std::string text =
      fmt::format("first difference at {}: {} is {}, the model's is {}", time_text(tick), place.name,
                  level_text(place, level_of(place, outputs_)), level_text(place, level_of(place, model_.outputs())));
  if (last_input_ != nullptr)
    text += fmt::format("\n  last input  {}={} at {}", last_input_->name,
                        level_text(*last_input_, level_of(*last_input_, model_.inputs())), time_text(input_changed_));
  for (const std::string& event : model_.last_events()) text += "\n  event       " + event;
  say(text);
  differs_ = true;
  waiting_ = false;
}

}  // namespace dsdpv1::simulator

int32_t dsdpv1_scoreboard_create(const char* options, int64_t tolerance_ps) {
  namespace simulator = dsdpv1::simulator;
  return simulator::created(
      [&] { return std::make_unique<simulator::Scoreboard>(simulator::chip_options(options), tolerance_ps); });
}

int32_t dsdpv1_scoreboard_step(int32_t handle, int64_t half, int64_t ps, int64_t inputs, int64_t outputs,
                               int64_t* next) {
  return dsdpv1::simulator::guarded([&] {
    auto& scoreboard = dsdpv1::simulator::get<dsdpv1::simulator::Scoreboard>(handle);
    scoreboard.step(dsdpv1::simulator::tick_of(half, ps), static_cast<uint64_t>(inputs),
                    static_cast<uint64_t>(outputs));
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
