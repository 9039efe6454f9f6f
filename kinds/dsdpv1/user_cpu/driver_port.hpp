#pragma once
// The driver's port on a simulated CPU, which a device maker writes for their MCU; with counters and optional faults.
#include <cstdint>
#include <map>

#include "driver/dsdpv1.h"
#include "kinds/user_cpu/cpu.hpp"
#include "kinds/user_cpu/handshake_counters.hpp"

namespace dsdpv1::user_cpu {

/// Must not move while the driver uses it. Keeps the delays of ruling H2 from `Cpu::timing`.
class DriverPort {
 public:
  explicit DriverPort(Cpu& cpu) : cpu_(cpu) {}
  DriverPort(const DriverPort&) = delete;
  DriverPort& operator=(const DriverPort&) = delete;

  /// For dsdpv1_open.
  dsdpv1_port port();
  const HoldCounters& counters() const { return handshake_.counters(); }

  /// Injects a fault: the next `times` writes to `address` have the bits of `mask` inverted.
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
  HandshakeCounters handshake_;
  std::map<std::uint16_t, Corruption> corruptions_;
};

}  // namespace dsdpv1::user_cpu
