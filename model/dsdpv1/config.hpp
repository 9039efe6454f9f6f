#pragma once
// What a chip is told when it is made: which one it is, and the parameters of the rulings marked (p).
#include <array>
#include <cstdint>

#include "model/dsdpv1/pins.hpp"

namespace dsdpv1 {

enum class Engine : std::uint8_t {
  kStep,  ///< every cycle of every block is evaluated
  kSkip,  ///< sleeps until the next cycle at which a block does something; the same pin trace
};

/// The host port that is live, as MODE codes it (R11).
enum class HostMode : std::uint8_t { kParallel, kSpi, kUart };

/// UA1: cycles of a bit of the UART, by the strap UBR.
constexpr std::array<int, 8> kUbrCycles = {5000, 2500, 1250, 833, 417, 208, 104, 26};

/// The parameters of the rulings marked (p), with their defaults.
struct Config {
  Engine engine = Engine::kSkip;
  Part part = Part::kDsdpv1;
  std::uint32_t access_interval = 48;       ///< H1: cycles from the start of one DPRAM access to the next
  std::uint32_t ready_cycles = 4096;        ///< D1: cycles from the release of RESET to B004 = 0xC5
  std::uint32_t rts_lead = 4;               ///< P2: cycles from PBRTS high to the first start bit, 0..32
  std::uint32_t rts_trail = 4;              ///< P2: cycles from the end of the last stop bit to PBRTS low, 0..32
  std::uint32_t intr_low = 64;              ///< P7: cycles that INTR0 stays low
  std::uint32_t intr_gap = 64;              ///< P7: least cycles that INTR0 stays high between two pulses
  std::uint32_t search_window_ms = 50;      ///< S1: least time at one baud rate while searching
  std::uint32_t search_window_bits = 4000;  ///< S1: ... and least bit times
  std::uint32_t baud_control_ms = 600;      ///< S1: silence after which the baud rate is searched again
  // DSDPV1-RSU
  std::uint32_t spi_strobe = 600;      ///< SP2: least ticks of SCK high, SCK low, XSS lead, lag, high; 0..12000
  std::uint32_t spi_data = 150;        ///< SP2: least ticks of MOSI's setup and hold, 0..600
  std::uint32_t spi_miso_delay = 120;  ///< SP2: ticks from SCK's fall to MISO's change, 1..600
  std::uint32_t spi_reply_gap = 0;     ///< SP6: bytes of FF before a reply, 0..16
  std::uint32_t spi_write_gap = 128;   ///< SP9: cycles after a write in which no frame is heard, 0..4800
  std::uint32_t serial_block_crc = 0;  ///< SP15: 1: block CRCs are judged in SPI and UART mode, too
  std::uint32_t u_timer = 0;           ///< SP17: cycles, 48..4800000; 0: not open
  std::array<std::uint32_t, 8> uart_gaps = {7, 2, 4, 10, 20, 40, 100, 200};  ///< UA3: half characters, 1..1000
  std::uint32_t uart_min_tsdr = 11;   ///< UA4: least bit times from a request to its reply, 1..255
  std::uint32_t uart_cfg_length = 0;  ///< UA12: 1: the length of a configuration's reply is B502 + 1
};

}  // namespace dsdpv1
