#pragma once
// The driver's port on a simulated CPU: what a device maker writes for his MCU, with counters and, on request, faults.
#include <cstdint>
#include <map>

#include "tb/driver/dsdpv1.h"
#include "tb/user_cpu/cpu.hpp"

namespace user_cpu {

/// Times in ticks. A wait runs from R_REQ's rise to R_STA's, a hold from R_STA's rise to R_REQ's fall.
struct PortCounters {
  std::uint64_t holds = 0;
  std::uint64_t given_up = 0;  ///< R_REQ lowered without having had the DPRAM
  Tick longest_wait = 0;
  Tick longest_hold = 0;
};

/// Must not move while the driver uses it. Keeps the delays of rule H2 that `Cpu::timing` asks for.
class DriverPort {
 public:
  explicit DriverPort(Cpu& cpu) : cpu_(cpu) {}
  DriverPort(const DriverPort&) = delete;
  DriverPort& operator=(const DriverPort&) = delete;

  /// For dsdpv1_open.
  dsdpv1_port port();
  const PortCounters& counters() const { return counters_; }

  /// A fault: the next `times` writes to `address` have the bits of `mask` inverted.
  void corrupt_writes(std::uint16_t address, std::uint8_t mask, int times);

 private:
  struct Corruption {
    std::uint8_t mask = 0;
    int times = 0;
  };
  void write(std::uint16_t address, std::uint8_t value);
  void set_r_req(bool level);
  void set_r_sta(bool level);
  bool look(bool (Cpu::*pin)());
  void pause(std::uint32_t ns);

  Cpu& cpu_;
  PortCounters counters_;
  std::map<std::uint16_t, Corruption> corruptions_;
  Tick asked_at_ = 0;  ///< R_REQ rose
  Tick held_at_ = 0;   ///< R_STA rose
  bool held_ = false;
};

}  // namespace user_cpu
