#pragma once
// The seam between a DP slave, which decides, and the store of a chip, which holds the bytes and knows how its user
// judges. DpSlave makes one call a telegram, further ones when its state changes, none a character. UserSide is the
// store with fixed buffers and mail.
#include "model/profibus/baud.hpp"
#include "model/profibus/dp_state.hpp"
#include "model/profibus/request.hpp"
#include "model/profibus/sap_buffers.hpp"
#include "model/profibus/time.hpp"

namespace dsdpv1::profibus {

/// The judge of parameters or a configuration: the chip by length (tables 13 and 14) or by comparison, or the user.
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

/// Bytes of a store, valid until its next call.
struct View {
  const std::uint8_t* bytes = nullptr;
  int size = 0;  ///< kNoBuffer: the store has no buffer for them, as it has reported: RR, and nothing changes

  static constexpr int kNoBuffer = -1;
};

/// The store's decision on a block of the master.
enum class Take : std::uint8_t {
  kAccepted,  ///< it is right
  kAwaited,   ///< the user judges it: Station::prm_verdict or cfg_verdict follows
  kRefused,   ///< it is wrong; the store has reported why
  kNoRoom,    ///< it is longer than the store's buffer, as the store has reported: RR, and nothing changes
};

/// The store's part in a Data_Exchange.
struct Exchanged {
  bool taken = false;  ///< false: the outputs have another length than `expected`, and nothing has changed
  int expected = 0;
  bool high = false;  ///< a diagnosis waits: the answer has high priority
  View inputs;
  bool leaves = false;  ///< the user gives up the master after this telegram
};

/// The gate that Sync (outputs) or Freeze (inputs) closes between the two sides of a buffer.
enum class Gate : std::uint8_t { kStays, kCloses, kOpens };

/// A Global_Control that is carried out: first `clears`, then the gates.
struct Control {
  std::uint8_t command = 0, group = 0, master = 0;
  bool clears = false;  ///< the outputs
  Gate outputs{}, inputs{};
};

/// The store's part of Slave_Diag.
struct StoredDiagnosis {
  View user;  ///< at most kMaxDiag bytes
  bool ext_diag = false, stat_diag = false;
  bool freeze = false, sync = false;  ///< the gates are closed
  bool overflow = false;              ///< the user has more than fits
  std::uint8_t* standard = nullptr;   ///< gets the six standard bytes, unless null
};

/// Lengths of the data in bytes.
struct IoLengths {
  int input = 0, output = 0;
};

class SlaveStore {
 public:
  /// Data_Exchange of the master that holds the slave. `fail_safe`: a request without data clears the outputs (S19).
  virtual Exchanged exchange(Cycle now, const Request& request, bool fail_safe) = 0;
  /// Before a Set_Prm is judged. False: it does not fit, as the store has reported: RR, and nothing changes.
  virtual bool has_room(Cycle /*now*/, const Request& /*request*/) { return true; }
  /// A Set_Prm whose standard bytes are right. kRefused is Prm_Fault.
  virtual Take parameters(Cycle now, const Request& request) = 0;
  /// A Check_Cfg in WAIT_CFG or, `exchanging`, in DATA_EXCH. kRefused is Cfg_Fault.
  virtual Take configuration(Cycle now, const Request& request, bool exchanging) = 0;
  /// The configuration is accepted: the lengths of the coming data exchange.
  virtual IoLengths configured() = 0;
  /// A Set_Slave_Address that the slave carries out if `right` and not kNoRoom.
  virtual Take address(Cycle now, const Request& request, bool right) = 0;
  virtual void control(Cycle now, const Control& control) = 0;

  // For the answers of services that only read.
  virtual View read_inputs(Cycle now) = 0;
  virtual View read_outputs(Cycle now) = 0;
  virtual View read_cfg(Cycle now, bool exchanging) = 0;
  /// `to_holder`: the master that holds the slave reads it.
  virtual StoredDiagnosis diagnosis(Cycle now, bool to_holder) = 0;

  /// The slave gives up its master: it enters or keeps WAIT_PRM. `by_watchdog`: the master was silent.
  virtual void left(Cycle /*now*/, bool /*by_watchdog*/) {}
  /// The slave's state has changed. Leaving DATA_EXCH clears the outputs and opens the gates (S18).
  virtual void entered(Cycle now, DpState from, DpState to) = 0;
  /// The baud rate was found, or is in search: kBaudUnknown.
  virtual void baud(Cycle now, BaudIndex index) = 0;

 protected:
  ~SlaveStore() = default;
};

}  // namespace dsdpv1::profibus
