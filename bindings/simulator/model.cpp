// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0
#include "bindings/simulator/model.hpp"

#include <algorithm>

#include "bindings/simulator/options.hpp"
#include "bindings/simulator/simulator.h"

namespace dsdpv1::simulator {
namespace {

dpsim_chip* make_chip(const char* text) {
  const std::vector<Option> options = options_of(text);
  std::vector<dpsim_parameter> parameters;
  parameters.reserve(options.size());
  for (const Option& each : options) parameters.push_back({each.name.c_str(), number_of(each, INT32_MIN, INT32_MAX)});
  dpsim_chip_options chosen{};
  chosen.size = sizeof chosen;
  chosen.parameters = parameters.data();
  chosen.parameter_count = parameters.size();
  dpsim_chip* chip = nullptr;
  check(dpsim_chip_create(&chosen, &chip));
  return chip;
}

/// Place of an output by its pin's number; L_REQ is the first.
const PinPlace& output_place(uint16_t pin) { return kOutputs[static_cast<std::size_t>(pin - DPSIM_DSDPV1_L_REQ)]; }

}  // namespace

Model::Model(const char* options) : chip_(make_chip(options)) {
  uint64_t pins = 0;
  for (const PinPlace& place : kOutputs) {
    dpsim_level level = 0;
    check(dpsim_chip_level(chip_, place.pin, &level));
    outputs_ = with_output(outputs_, place, level);
    pins |= DPSIM_PIN(place.pin);
  }
  check(dpsim_chip_watch(chip_, pins, changed, this));
}

void Model::changed(void* self, const dpsim_change* change) {
  auto* model = static_cast<Model*>(self);
  model->outputs_ = with_output(model->outputs_, output_place(change->pin), change->level);
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
    check(dpsim_chip_event_text(nullptr, &event, text, sizeof text));
    texts.push_back(time_text(event.tick) + "  " + text);
  }
  return texts;
}

void Model::step(uint64_t tick, uint32_t inputs) {
  now_ = std::max(now_, tick);
  const uint32_t different = inputs ^ inputs_;
  if (different == 0) {
    check(dpsim_chip_advance(chip_, now_));
    return;
  }
  inputs_ = inputs;
  for (const PinPlace& place : kInputs)
    if ((different & place.mask) != 0) check(dpsim_chip_set(chip_, now_, place.pin, input_level(place, inputs)));
}

uint64_t Model::next_tick() const {
  uint64_t tick = 0;
  check(dpsim_chip_next(chip_, &tick));
  return tick;
}

}  // namespace dsdpv1::simulator

int32_t dsdpv1_model_create(const char* options) {
  return dsdpv1::simulator::created([&] { return std::make_unique<dsdpv1::simulator::Model>(options); });
}

int32_t dsdpv1_model_step(int32_t handle, int64_t half, int64_t ps, int32_t inputs, int64_t* next) {
  return dsdpv1::simulator::guarded([&] {
    auto& model = dsdpv1::simulator::get<dsdpv1::simulator::Model>(handle);
    const bool clocked = half >= 0;
    model.step(
        clocked ? dsdpv1::simulator::tick_of(half, ps) : dsdpv1::simulator::tick_of_ps(static_cast<uint64_t>(ps)),
        static_cast<uint32_t>(inputs));
    *next = clocked ? dsdpv1::simulator::half_of(model.next_tick()) : dsdpv1::simulator::ps_of(model.next_tick());
    return static_cast<int32_t>(model.outputs());
  });
}
