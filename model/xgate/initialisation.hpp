#pragma once
// Command 04: what the host gives before the module appears on PROFIBUS (4.2, 4.5.1, X5).
#include "model/profibus/slave_store.hpp"
#include "model/xgate/frame.hpp"

namespace dsdpv1::xgate {

constexpr int kDpv1Bytes = 12;

struct Initialisation {
  std::uint8_t address = 0;
  std::uint16_t ident = 0;
  bool any_cfg = true;        ///< the master's configuration is taken
  bool any_prm = true;        ///< the form of 4 bytes: user parameters of any length
  std::uint8_t prm_size = 0;  ///< user parameters with the three of DPV1; 0: none
  std::array<std::uint8_t, kDpv1Bytes> dpv1{};
  profibus::Block<profibus::kMaxCfg> cfg;

  /// 4.2.2, in its order.
  bool reads_and_writes() const { return (dpv1[0] & 0x01) != 0; }
  int c2_timeout() const { return dpv1[6]; }
  int c1_size() const { return dpv1[7]; }
  int c2_size() const { return dpv1[8]; }
  bool dpv1_on() const { return (dpv1[9] & 0x80) != 0; }
  bool fail_safe() const { return (dpv1[9] & 0x02) != 0; }
  bool cfg_may_differ() const { return (dpv1[9] & 0x01) != 0; }
  std::uint8_t alarms() const { return dpv1[10]; }
  int most_alarms() const { return 1 << dpv1[11]; }
  /// The host has enabled this type of alarm.
  bool alarm_enabled(unsigned type) const;
  /// User parameters of `size` bytes are right (X9).
  bool prm_fits(int size) const;

  profibus::SlaveConfig slave() const;

  template <class Archive>
  void store(Archive& archive) {
    auto& [own, number, all_cfg, all_prm, prm, features, bytes] = *this;
    archive(own, number, all_cfg, all_prm, prm, features, bytes);
    archive.within(0, 7, features[kDpv1Bytes - 1]);
  }
};

/// Reads the data of command 04; `read` is complete without an error only.
Error read_initialisation(const Frame& frame, const Config& config, Initialisation& read);

}  // namespace dsdpv1::xgate
