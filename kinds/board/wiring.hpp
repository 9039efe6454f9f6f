#pragma once
// The lines between a chip and the processor of its board, beside those of the memory bus at NE1. By kind of chip.
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tb/chip/pins/pins.hpp"

namespace dsdpv1::arm {

enum Port : unsigned { kA, kB, kC, kD, kE, kF, kG };
struct PortPin {
  unsigned port, pin;
};
/// "PD4".
std::string pin_name(const PortPin& at);

/// Numbers of pins are those of the kind's table.
struct Wiring {
  PortPin interrupt = {kG, 6};
  const char* interrupt_name = "";
  PortPin reset = {kE, 4};
  bool reset_high = false;               ///< RESET is high-active; the board pulls it to the other level (p)
  bool wait = false;                     ///< the chip's ready is at PD6, NWAIT
  std::vector<tb::PinNumber> handshake;  ///< L_REQ and L_STA, at PC8 and PC9, with R_REQ and R_STA at PC6 and PC7
  std::vector<tb::PinNumber> lamps;      ///< outputs at PG12 and the pins after it, as user_cpu::HostBus::lamps
  std::optional<tb::PinNumber> miso;
};

}  // namespace dsdpv1::arm
