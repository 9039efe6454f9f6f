#pragma once
// The initialisation data of a station, owning its bytes.
#include <cstdint>
#include <vector>

namespace dsdpv1::user_cpu {

/// The user CPU's initialisation data for its chip. Defaults: a station with one byte in, one byte out.
struct StationConfig {
  std::uint8_t address = 3;  ///< 0..126
  std::uint16_t ident = 0x0CC9;
  bool address_change = false, freeze = true, sync = true, fail_safe = true;
  bool dpv1 = false;
  std::uint8_t max_input = 244, max_output = 244;  ///< bytes of cyclic data, 0..244
  std::uint8_t max_diag = 238;                     ///< user diagnosis, 0..238
  std::uint8_t max_prm = 237;                      ///< user parameters, 0..237
  std::uint8_t max_cfg = 244;                      ///< 1..244; many chips hold less
  std::uint8_t prm_mode = 0, cfg_mode = 0;         ///< who judges: 0 length, 1 equality, 2 the user
  std::vector<std::uint8_t> cfg = {0x10, 0x20};    ///< at most max_cfg bytes
};

}  // namespace dsdpv1::user_cpu
