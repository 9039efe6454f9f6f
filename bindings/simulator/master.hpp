// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
// A master of the C API on the simulator's line: all other stations are one external station of its bus.
#include <array>
#include <cstdint>
#include <map>
#include <vector>

#include "bindings/simulator/object.hpp"

namespace dsdpv1::simulator {

/// The result of a request.
struct Answer {
  int32_t outcome = 0;
  uint32_t codes = 0;
  std::vector<uint8_t> data;
};

class Master final : public Object {
 public:
  explicit Master(const char* options);
  /// All masters of a scenario; commands are for the first one.
  Master(const char* scenario, const char* settings, bool verbose);
  ~Master() override { dpsim_bus_destroy(bus_); }
  Master(const Master&) = delete;
  Master& operator=(const Master&) = delete;

  /// Sets the other stations' driver at `tick`.
  void step(uint64_t tick, bool enabled, bool level);
  /// TXD + 2 RTS; of several masters, their combined levels.
  int32_t outputs() const;
  /// Absolute, in ps; -1: never.
  int64_t wake() const;

  dpsim_master* master() const { return master_; }
  dpsim_slave_status slave(int32_t address) const;
  /// Takes a kept answer. Returns false if it is not there yet.
  bool take_answer(uint32_t id, Answer& answer);

 private:
  struct Driver {
    int32_t txd = 1, rts = 0;
  };
  void make_bus(const dpsim_bus_options& options);
  void watch();
  static void changed(void* self, const dpsim_change* change);
  static void happened(void* self, const dpsim_event* event);
  void note_answer(const dpsim_event& event);
  void tell(const dpsim_event& event);

  dpsim_bus* bus_ = nullptr;
  dpsim_master* master_ = nullptr;
  uint16_t others_ = 0;
  uint64_t now_ = 0;
  std::map<uint16_t, Driver> drivers_;  ///< by station
  bool enabled_ = false, level_ = true, verbose_ = false;
  std::map<uint32_t, Answer> answers_;
};

}  // namespace dsdpv1::simulator
