#pragma once
// The mail of a DP slave to its user's side: items for the user, each with the cycle since which it waits. Mail that is
// not taken is replaced by newer mail.
#include "model/profibus/baud.hpp"
#include "model/profibus/dp_state.hpp"
#include "model/profibus/sap_buffers.hpp"
#include "model/profibus/time.hpp"

namespace dsdpv1::profibus {

/// The cycle since which an item waits for the user; kNever: none waits.
struct Due {
  Cycle since = kNever;

  void set(Cycle now) { since = now; }
  void clear() { since = kNever; }
  bool waiting() const { return since != kNever; }
  /// Set before the cycle `now`: an action at `now` uses the state before its edge.
  bool before(Cycle now) const { return since < now; }
  template <class Archive>
  void store(Archive& archive) {
    auto& [at] = *this;
    archive.cycles(at);
  }
};

/// The user parameters of a Set_Prm.
struct PrmMail {
  Due due;
  Block<kMaxUserPrm> block;

  template <class Archive>
  void store(Archive& archive) {
    auto& [waits, prm] = *this;
    archive(waits, prm);
  }
};
/// The identifiers of a Check_Cfg, and the lengths that they describe.
struct CfgMail {
  Due due;
  Block<kMaxCfg> block;
  int output = 0, input = 0;

  template <class Archive>
  void store(Archive& archive) {
    auto& [waits, cfg, outputs, inputs] = *this;
    archive(waits, cfg, outputs, inputs);
  }
};
/// New outputs; UserSide::outputs() has their present value.
struct OutputMail {
  Due due;

  template <class Archive>
  void store(Archive& archive) {
    auto& [waits] = *this;
    archive(waits);
  }
};
/// A Global_Control that was executed.
struct ControlMail {
  Due due;
  std::uint8_t command = 0, group = 0, master = 0;

  template <class Archive>
  void store(Archive& archive) {
    auto& [waits, control, groups, sender] = *this;
    archive(waits, control, groups, sender);
  }
};
/// A Set_Slave_Address that was executed.
struct AddressMail {
  Due due;
  std::uint8_t address = 0;
  bool locked = false;  ///< No_Add_Chg: no further change

  template <class Archive>
  void store(Archive& archive) {
    auto& [waits, given, stays] = *this;
    archive(waits, given, stays);
  }
};
/// The state of the slave, due when it changes, and how often data exchange was left since reset.
struct StateMail {
  Due due;
  DpState state = DpState::kOffline;
  std::uint16_t exchanges_left = 0;

  template <class Archive>
  void store(Archive& archive) {
    auto& [waits, present, left] = *this;
    archive(waits, left);
    archive.within(DpState::kOffline, DpState::kDataExch, present);
  }
};
/// The baud rate: found, or in search again.
struct BaudMail {
  Due due;
  BaudIndex index;

  template <class Archive>
  void store(Archive& archive) {
    auto& [waits, found] = *this;
    archive(waits, found);
  }
};
/// A C1 or C2 request for the user. It stays in `pdu` after it was taken, until the next one.
struct AcyclicMail {
  Due due;
  Pdu pdu;

  template <class Archive>
  void store(Archive& archive) {
    auto& [waits, request] = *this;
    archive(waits, request);
    archive.check(!due.waiting() || pdu.size > 0);
  }
};

/// The mail to the user's side.
struct UserMail {
  PrmMail prm;
  CfgMail cfg;
  OutputMail output;
  ControlMail control;
  AddressMail address;
  StateMail state;
  BaudMail baud;
  AcyclicMail c1, c2;

  template <class Archive>
  void store(Archive& archive) {
    auto& [to_prm, to_cfg, to_output, to_control, to_address, to_state, to_baud, to_c1, to_c2] = *this;
    archive(to_prm, to_cfg, to_output, to_control, to_address, to_state, to_baud, to_c1, to_c2);
  }
};

}  // namespace dsdpv1::profibus
