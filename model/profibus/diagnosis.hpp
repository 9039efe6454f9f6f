#pragma once
// Slave_Diagnosis (6.2.4, APC3 A.4, ruling D9): the six standard bytes, and the user's diagnosis of three kinds.
#include "model/profibus/slave_store.hpp"

namespace dsdpv1::profibus {

/// Inputs of the standard bytes besides the diagnosis block's own flags.
struct DiagnosisView {
  bool ready = false;  ///< DATA_EXCH
  bool prm_req = false;
  bool watchdog = false;
  std::uint8_t master = 255;
  std::uint16_t ident = 0;
};

/// The slave's part: its faults.
class Diagnosis {
 public:
  /// After an initialisation: no faults.
  void reset() { *this = Diagnosis(); }

  /// The 6 standard bytes and the user's, at most 244; valid until the next call.
  View bytes(const DiagnosisView& view, const StoredDiagnosis& stored);

  void prm_fault(bool not_supported) {
    prm_fault_ = true;
    not_supported_ = not_supported_ || not_supported;
  }
  void not_supported() { not_supported_ = true; }
  void prm_good() { prm_fault_ = not_supported_ = false; }
  void cfg_fault() { cfg_fault_ = true; }
  void cfg_good() { cfg_fault_ = false; }

  template <class Archive>
  void store(Archive& archive) {
    auto& [prm_fault, not_supported, cfg_fault, answer] = *this;
    archive(prm_fault, not_supported, cfg_fault);
    archive.scratch(answer);
  }

 private:
  static constexpr int kStandard = 6;
  bool prm_fault_ = false, not_supported_ = false, cfg_fault_ = false;
  std::array<std::uint8_t, kMaxIo> answer_{};
};

/// The user's part.
class UserDiagnosis {
 public:
  /// After an initialisation: none.
  void reset() { *this = UserDiagnosis(); }

  bool unread() const { return unread_; }

  static bool known_type(std::uint8_t type);
  /// Sets a valid block of the user (type checked before). All types except 00 are high priority until read.
  void set_user(std::uint8_t type, const std::uint8_t* bytes, int size);

  View bytes() const { return {user_.bytes.data(), user_.size}; }
  bool ext_diag() const { return ext_diag_; }
  bool stat_diag() const { return stat_diag_; }
  bool high_priority() const { return unread_ || stat_diag_; }
  void read_by_holder() { unread_ = false; }

  template <class Archive>
  void store(Archive& archive) {
    auto& [ext_diag, stat_diag, unread, user] = *this;
    archive(ext_diag, stat_diag, unread, user);
  }

 private:
  bool ext_diag_ = false, stat_diag_ = false, unread_ = false;
  Block<kMaxDiag> user_;
};

}  // namespace dsdpv1::profibus
