// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
// One chip of the C API on packed pins.
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "bindings/simulator/object.hpp"
#include "bindings/simulator/options.hpp"
#include "bindings/simulator/pins.hpp"

namespace dsdpv1::simulator {

class Model final : public Object {
 public:
  explicit Model(const ChipOptions& options);
  ~Model() override { dpsim_chip_destroy(chip_); }
  Model(const Model&) = delete;
  Model& operator=(const Model&) = delete;

  /// Runs up to `tick`, a time before the present one counting as that, and gives the inputs their levels then.
  void step(uint64_t tick, uint64_t inputs);
  uint64_t outputs() const { return outputs_; }
  uint64_t inputs() const { return inputs_; }
  const KindPins& pins() const { return pins_; }
  /// When an output may change by itself.
  uint64_t next_tick() const;
  /// Outputs that have changed so far.
  uint64_t changes() const { return changes_; }
  /// From now on the last events are remembered; in words, oldest first.
  void remember_events();
  std::vector<std::string> last_events() const;

 private:
  static void changed(void* self, const dpsim_change* change);
  static void happened(void* self, const dpsim_chip_event* event);

  static constexpr std::size_t kRemembered = 3;
  const KindPins& pins_;
  dpsim_chip* chip_ = nullptr;
  uint64_t inputs_, outputs_ = 0;
  uint64_t now_ = 0, changes_ = 0;
  std::array<dpsim_chip_event, kRemembered> events_{};
  std::size_t event_count_ = 0;
};

}  // namespace dsdpv1::simulator
