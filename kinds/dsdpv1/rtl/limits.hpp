#pragma once
// What the program hands to the reference RTL's library when it makes a design (RtlStart::parameters).
#include <array>
#include <cstdint>

namespace dsdpv1::cosim {

/// The parameters of the rulings, as in dsdpv1::Config, with its units.
struct RtlLimits {
  std::uint32_t access_interval, ready_cycles, rts_lead, rts_trail, intr_low, intr_gap, search_window_ms,
      search_window_bits, baud_control_ms;
  // of the DSDPV1-RSU
  std::uint32_t spi_reply_gap, spi_write_gap, serial_block_crc, u_timer, uart_min_tsdr, uart_cfg_length;
  std::array<std::uint32_t, 8> uart_gaps;
};

}  // namespace dsdpv1::cosim
