#pragma once
// The one narrow interface between a DP slave and its user's side (DPRAM sequencer here, SPI or registers in sister
// chips): what the user tells the slave (calls of DpSlave), and what the slave has for the user (UserMail).
#include "model/profibus/cfg_identifier.hpp"
#include "model/profibus/sap_buffers.hpp"
#include "model/profibus/time.hpp"

namespace profibus {

enum class Judging : std::uint8_t { kMaximum = 0, kExact = 1, kUser = 2 };  // B02B, B02D: tables 13 and 14

/// The initialisation of the slave, already checked (D7, D11).
struct SlaveConfig {
  std::uint8_t address = 0;
  std::uint16_t ident = 0;
  bool fail_safe_supported = false, sync_supported = false, freeze_supported = false, address_change = false;
  bool dpv1 = false;  ///< D17: the slave has DPV1
  int max_input = 0, max_output = 0, max_diag = 0, max_prm = 0, max_cfg = 0;
  Judging prm_mode{}, cfg_mode{};
  Block<kMaxCfg> cfg;
};

/// Something that waits to be handed to the user since a cycle; kNever: nothing waits.
struct Due {
  Cycle since = kNever;

  void set(Cycle now) { since = now; }
  void clear() { since = kNever; }
  bool waiting() const { return since != kNever; }
  /// Set before the cycle `now`: whoever acts at `now` sees what was there before its edge.
  bool before(Cycle now) const { return since < now; }
};

/// A C1 or C2 request for the user. It stays in `pdu` after it was taken, until the next one.
struct AcyclicMail {
  Due due;
  Pdu pdu;
};

/// What the slave has for the user. The user's side takes a block by copying it and clearing its `due`.
struct UserMail {
  Due prm_due, cfg_due, output_due;
  Block<kMaxUserPrm> prm;
  Block<kMaxCfg> cfg;
  int cfg_output = 0, cfg_input = 0;  ///< lengths that `cfg` describes
  AcyclicMail c1, c2;
};

}  // namespace profibus
