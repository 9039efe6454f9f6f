#pragma once
// A master of the C API on a line that the simulator has: all other stations are one outside station of its bus.
#include <array>
#include <cstdint>
#include <map>
#include <vector>

#include "bindings/simulator/object.hpp"

namespace dsdpv1::simulator {

/// What came of a request.
struct Answer {
  int32_t outcome = 0;
  uint32_t codes = 0;
  std::vector<uint8_t> data;
};

class Master final : public Object {
 public:
  explicit Master(const char* options);
  ~Master() override { dpsim_bus_destroy(bus_); }
  Master(const Master&) = delete;
  Master& operator=(const Master&) = delete;

  /// The other stations' driver at `tick`.
  void step(uint64_t tick, bool enabled, bool level);
  /// TXD + 2 RTS.
  int32_t outputs() const { return txd_ + 2 * rts_; }
  /// Absolute, in ps; -1: never.
  int64_t wake() const;

  dpsim_master* master() const { return master_; }
  uint8_t address() const { return address_; }
  dpsim_slave_status slave(int32_t address) const;
  /// Takes it out of what is kept. False: not done yet.
  bool take_answer(uint32_t id, Answer& answer);

 private:
  static void changed(void* self, const dpsim_change* change);
  static void happened(void* self, const dpsim_event* event);
  void note_answer(const dpsim_event& event);
  void tell(const dpsim_event& event);

  dpsim_bus* bus_ = nullptr;
  dpsim_master* master_ = nullptr;
  uint16_t station_ = 0, others_ = 0;
  uint64_t now_ = 0;
  int32_t txd_ = 1, rts_ = 0;
  uint8_t address_ = 0;
  bool enabled_ = false, level_ = true, verbose_ = false;
  std::map<uint32_t, Answer> answers_;
};

}  // namespace dsdpv1::simulator
