// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0
// One chip of the C API on packed pins.
#include <algorithm>
#include <utility>

#include "bindings/simulator/object.hpp"
#include "bindings/simulator/options.hpp"
#include "bindings/simulator/pins.hpp"
#include "bindings/simulator/simulator.h"

namespace dsdpv1::simulator {
namespace {

class Model final : public Object {
 public:
  explicit Model(const ChipOptions& options)
      : pins_(pins_of_kind(options.kind)), inputs_(pins_.inputs.at_reset()), outputs_(pins_.outputs.at_reset()) {
    const NativeOptions native(options);
    check(dpsim_chip_create(&native.chosen, &chip_));
    uint64_t pins = 0;
    for (const PinPlace& place : pins_.outputs.places()) pins |= DPSIM_PIN(place.pin);
    check(dpsim_chip_watch(chip_, pins, changed, this));
  }
  ~Model() override { dpsim_chip_destroy(chip_); }
  Model(const Model&) = delete;
  Model& operator=(const Model&) = delete;

  /// Runs up to `tick` and sets the inputs there; a time before the present one counts as the present one.
  void step(uint64_t tick, uint64_t inputs) {
    now_ = std::max(now_, tick);
    if (inputs == inputs_) return check(dpsim_chip_advance(chip_, now_));
    for_each_change(
        pins_.inputs, std::exchange(inputs_, inputs), inputs,
        [this](const PinPlace& place, dpsim_level level) { check(dpsim_chip_set(chip_, now_, place.pin, level)); });
  }
  uint64_t outputs() const { return outputs_; }
  /// When an output may next change without a change of an input.
  uint64_t next_tick() const {
    uint64_t tick = 0;
    check(dpsim_chip_next(chip_, &tick));
    return tick;
  }

 private:
  static void changed(void* self, const dpsim_change* change) {
    auto* model = static_cast<Model*>(self);
    model->outputs_ = with_level(model->outputs_, model->pins_.outputs.of_pin(change->pin), change->level);
  }

  const KindPins& pins_;
  dpsim_chip* chip_ = nullptr;
  uint64_t inputs_, outputs_, now_ = 0;
};

}  // namespace
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
