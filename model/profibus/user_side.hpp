#pragma once
// The only interface between a DP slave and its user's side (a shared RAM, registers, a serial port). The slave
// communicates by mail: items for the user, each with the cycle since which it waits. The user's side reads the mail
// when it gets to it, takes a block by copying it and clearing its `due`, and replies by commands. Mail that is not
// taken is replaced by newer mail.
#include "model/profibus/baud.hpp"
#include "model/profibus/cfg_identifier.hpp"
#include "model/profibus/dp_state.hpp"
#include "model/profibus/dpv1_pdu.hpp"
#include "model/profibus/sap_buffers.hpp"
#include "model/profibus/time.hpp"

namespace dsdpv1::profibus {

class Station;

/// Capacities of the chip's user side for each block; at most those of the protocol (sap_buffers.hpp).
struct Capacities {
  int user_prm = kMaxUserPrm;  ///< Set_Prm after its 7 standard bytes
  int cfg = kMaxCfg;           ///< Check_Cfg; more is answered with RR
  int io = kMaxIo;             ///< inputs, and outputs
  int acyclic = kMaxAcyclic;   ///< data of a C1 or C2 request or answer
};

/// Who judges parameters or a configuration: the slave by length (tables 13 and 14) or by comparison, or the user.
enum class Judging : std::uint8_t { kMaximum = 0, kExact = 1, kUser = 2 };

/// The initialisation of the slave, already checked: every number within the chip's capacities.
struct SlaveConfig {
  std::uint8_t address = 0;
  std::uint16_t ident = 0;
  bool fail_safe_supported = false, sync_supported = false, freeze_supported = false, address_change = false;
  bool dpv1 = false;  ///< D17: the slave has DPV1
  int max_input = 0, max_output = 0, max_diag = 0, max_prm = 0, max_cfg = 0;
  Judging prm_mode{}, cfg_mode{};
  Block<kMaxCfg> cfg;

  template <class Archive>
  void store(Archive& archive) {
    auto& [own, number, fail_safe, sync, freeze, change, has_dpv1, input, output, diag, prm, most_cfg, by_prm, by_cfg,
           first] = *this;
    archive(own, number, fail_safe, sync, freeze, change, has_dpv1, first);
    archive.within(0, kMaxIo, input, output);
    archive.within(0, kMaxDiag, diag);
    archive.within(0, kMaxUserPrm, prm);
    archive.within(0, kMaxCfg, most_cfg);
    archive.within(Judging::kMaximum, Judging::kUser, by_prm, by_cfg);
  }
};

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

class UserSide {
 public:
  explicit UserSide(Station& station) : station_(station) {}

  // --- mail ---------------------------------------------------------------------------------------------------------
  UserMail& mail() { return mail_; }
  const UserMail& mail() const { return mail_; }
  /// The outputs that the user may see (buffer 2), at present.
  const IoBlock& outputs() const;
  int input_size() const;  ///< configured, from the initialisation or Check_Cfg

  // --- commands -----------------------------------------------------------------------------------------------------
  /// Through OFFLINE to WAIT_PRM and baud search (D7, S1).
  void initialise(Cycle now, const SlaveConfig& config);
  /// `good`: the user accepts the parameters (configuration). See ruling H7.
  void prm_verdict(Cycle now, bool good);
  void cfg_verdict(Cycle now, bool good);
  /// Returns false, with an event, if refused (D10).
  bool new_inputs(Cycle now, const std::uint8_t* bytes, int size);
  bool new_diagnosis(Cycle now, std::uint8_t type, const std::uint8_t* bytes, int size);
  /// The answer to a C1 (C2) request, at most 4 + Capacities::acyclic bytes; refused with an event if it does not fit
  /// the request (V14).
  void c1_answer(Cycle now, const std::uint8_t* pdu, int size);
  void c2_answer(Cycle now, const std::uint8_t* pdu, int size);

  template <class Archive>
  void store(Archive& archive) {
    auto& [station, mail] = *this;
    archive.given(station);
    archive(mail);
  }

 private:
  Station& station_;
  UserMail mail_;
};

}  // namespace dsdpv1::profibus
