// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0
#include "bindings/simulator/model.hpp"

#include <algorithm>

#include "bindings/simulator/options.hpp"
#include "bindings/simulator/simulator.h"

namespace dsdpv1::simulator {
namespace {

dpsim_chip* make_chip(const ChipOptions& options) {
  std::vector<dpsim_parameter> parameters;
  parameters.reserve(options.parameters.size());
  for (const Option& each : options.parameters)
    parameters.push_back({each.name.c_str(), number_of(each, INT32_MIN, INT32_MAX)});
  dpsim_chip_options chosen{};
  chosen.size = sizeof chosen;
  chosen.kind = options.kind.c_str();
  chosen.parameters = parameters.data();
  chosen.parameter_count = parameters.size();
  dpsim_chip* chip = nullptr;
  check(dpsim_chip_create(&chosen, &chip));
  return chip;
}

}  // namespace

Model::Model(const ChipOptions& options)
    : pins_(pins_of_kind(options.kind)), chip_(make_chip(options)), inputs_(pins_.inputs.at_reset()) {
  uint64_t pins = 0;
  for (const PinPlace& place : pins_.outputs.places()) {
    dpsim_level level = 0;
    check(dpsim_chip_level(chip_, place.pin, &level));
    outputs_ = with_level(outputs_, place, level);
    pins |= DPSIM_PIN(place.pin);
  }
  check(dpsim_chip_watch(chip_, pins, changed, this));
}

void Model::changed(void* self, const dpsim_change* change) {
  auto* model = static_cast<Model*>(self);
  model->outputs_ = with_level(model->outputs_, model->pins_.outputs.of_pin(change->pin), change->level);
  ++model->changes_;
}

void Model::happened(void* self, const dpsim_chip_event* event) {
  auto* model = static_cast<Model*>(self);
  model->events_[model->event_count_++ % kRemembered] = *event;
}

void Model::remember_events() { check(dpsim_chip_on_event(chip_, happened, this)); }

std::vector<std::string> Model::last_events() const {
  std::vector<std::string> texts;
  for (std::size_t i = event_count_ - std::min(event_count_, kRemembered); i < event_count_; ++i) {
    char text[256];
    const dpsim_chip_event& event = events_[i % kRemembered];
    check(dpsim_chip_event_text(pins_.kind.c_str(), &event, text, sizeof text));
    texts.push_back(time_text(event.tick) + "  " + text);
  }
  return texts;
}

void Model::step(uint64_t tick, uint64_t inputs) {
  now_ = std::max(now_, tick);
  uint64_t different = inputs ^ inputs_;
  if (different == 0) {
    check(dpsim_chip_advance(chip_, now_));
    return;
  }
  inputs_ = inputs;
  while (different != 0) {
    const PinPlace& place = pins_.inputs.first_of(different);
    check(dpsim_chip_set(chip_, now_, place.pin, level_of(place, inputs)));
    different &= ~place.all();
  }
}

uint64_t Model::next_tick() const {
  uint64_t tick = 0;
  check(dpsim_chip_next(chip_, &tick));
  return tick;
}

}  // namespace dsdpv1::simulator

int32_t dsdpv1_model_create(const char* options) {
  return dsdpv1::simulator::created(
      [&] { return std::make_unique<dsdpv1::simulator::Model>(dsdpv1::simulator::chip_options(options)); });
}

int64_t dsdpv1_model_step(int32_t handle, int64_t half, int64_t ps, int64_t inputs, int64_t* next) {
  namespace simulator = dsdpv1::simulator;
  return simulator::guarded([&] {
    auto& model = simulator::get<simulator::Model>(handle);
    const bool clocked = half >= 0;
    model.step(clocked ? simulator::tick_of(half, ps) : simulator::tick_of_ps(static_cast<uint64_t>(ps)),
               static_cast<uint64_t>(inputs));
    *next = clocked ? simulator::wake_of(model.next_tick(), half) : simulator::ps_of(model.next_tick());
    return static_cast<int64_t>(model.outputs());
  });
}
