#pragma once
// The lines between FSMC and chip, as the firmware has set them up: FSMC_BCR1 and the modes of the pins.
//
//   PD14 PD15 PD0 PD1 PE7 to PE10     D0 to D7
//   PF0 to PF5, PF12 to PF15, PG0     A0 to A10
//   PD7 NE1, PD4 NOE, PD5 NWE         CSR, RD, WR
//   PC6, PC7                          R_REQ, R_STA: push-pull outputs, while the chip is accessed
//   PC8, PC9                          L_REQ, L_STA: not analog
//   PD6                               NWAIT: an input that is not analog, while the FSMC waits for it
#include <array>
#include <cstdint>
#include <string>

#include "board/stm32/fsmc.hpp"
#include "board/stm32/gpio.hpp"
#include "kinds/board/wiring.hpp"

namespace dsdpv1::arm {

constexpr PortPin kRReq = {kC, 6}, kRSta = {kC, 7}, kLReq = {kC, 8}, kLSta = {kC, 9};
struct MemoryBus {
  bool wide = false, multiplexed = false;  ///< MWID is not 8 bits; MUXEN
  bool reads = true, writes = true;        ///< NE1 and NOE, NE1 and NWE are driven
  std::uint16_t address = 0x7FF;           ///< lines that are driven
  std::uint8_t data = 0xFF;                ///< lines that are driven when the chip is written
  std::string wrong_pins;                  ///< "PD4 (NOE), PF3 (A3)"; empty: none

  bool is_right() const { return !wide && !multiplexed && wrong_pins.empty(); }
  /// What the chip sees of an address. 16 bits wide: without its lowest bit (21.4.1). Multiplexed: the address is on
  /// the data lines, A10 to A0 stay low (p).
  std::uint16_t cell(std::uint32_t at) const {
    return static_cast<std::uint16_t>(multiplexed ? 0 : (wide ? at >> 1U : at) & address);
  }
};

/// `ports`: A to G. `handshake`: R_REQ and R_STA are in use; `wait`: NWAIT is.
MemoryBus memory_bus(const std::array<Gpio, 7>& ports, const Fsmc& fsmc, bool handshake, bool wait);

}  // namespace dsdpv1::arm
