#pragma once
// The initialisation data of a station, owning its bytes.
#include <cstdint>
#include <vector>

#include "driver/dsdpv1.h"

namespace user_cpu {

/// The members mean what those of dsdpv1_config mean, with the same limits. Defaults: a station with one byte in, one
/// byte out.
struct StationConfig {
  std::uint8_t address = 3;
  std::uint16_t ident = 0x0CC9;
  bool address_change = false, freeze = true, sync = true, fail_safe = true;
  bool dpv1 = false;
  std::uint8_t max_input = 244, max_output = 244, max_diag = 238, max_prm = 237, max_cfg = 200;
  std::uint8_t prm_mode = 0, cfg_mode = 0;
  std::vector<std::uint8_t> cfg = {0x10, 0x20};  ///< at most 200 bytes

  /// Valid as long as this object lives unchanged.
  dsdpv1_config for_driver() const;
};

}  // namespace user_cpu
