#pragma once
// The only interface between a DP slave and its user's side (a shared RAM, registers, a serial port): the store with
// fixed buffers (figure 8), with DPV1. The slave communicates by mail: items for the user. The user's side reads the
// mail when it gets to it, takes a block by copying it and clearing its `due`, and replies by commands.
#include "model/profibus/cfg_identifier.hpp"
#include "model/profibus/diagnosis.hpp"
#include "model/profibus/event_log.hpp"
#include "model/profibus/msac.hpp"
#include "model/profibus/slave_store.hpp"
#include "model/profibus/user_mail.hpp"

namespace dsdpv1::profibus {

class Station;

/// Capacities of the chip's user side for each block; at most those of the protocol (sap_buffers.hpp).
struct Capacities {
  int user_prm = kMaxUserPrm;  ///< Set_Prm after its 7 standard bytes
  int cfg = kMaxCfg;           ///< Check_Cfg; more is answered with RR
  int io = kMaxIo;             ///< inputs, and outputs
  int acyclic = kMaxAcyclic;   ///< data of a C1 or C2 request or answer
  int alarms = 0;              ///< open at once, at most 32; 0: the chip has none
};

class UserSide final : public SlaveStore {
 public:
  /// `station` has this store and msac().
  UserSide(EventLog& log, const Capacities& capacities, Station& station)
      : log_(log),
        capacities_(capacities),
        station_(station),
        msac_{{log, capacities.alarms},
              {log, capacities.acyclic, mail_.c1, msac_.alarms},
              {log, capacities.acyclic, mail_.c2}} {}
  UserSide(const UserSide&) = delete;  // its parts refer to each other
  UserSide& operator=(const UserSide&) = delete;

  /// Everything as at power-on, the station too.
  void reset();

  // --- mail ---------------------------------------------------------------------------------------------------------
  UserMail& mail() { return mail_; }
  const UserMail& mail() const { return mail_; }
  /// The outputs that the user may see (buffer 2), at present.
  const IoBlock& outputs() const { return outputs_.shown(); }
  int input_size() const { return inputs_.size(); }  ///< configured, from the initialisation or Check_Cfg

  // --- commands -----------------------------------------------------------------------------------------------------
  /// Through OFFLINE to WAIT_PRM and baud search (D7, S1).
  void initialise(Cycle now, const SlaveConfig& config);
  /// `good`: the user accepts the parameters (configuration). See ruling H7.
  void prm_verdict(Cycle now, bool good);
  void cfg_verdict(Cycle now, bool good);
  /// Returns false, with an event, if refused (D10).
  bool new_inputs(Cycle now, const std::uint8_t* bytes, int size);
  bool new_diagnosis(Cycle now, std::uint8_t type, const std::uint8_t* bytes, int size);
  /// A diagnosis whose first block is an alarm: it is open until the master acknowledges it, as msac().alarms.mail()
  /// tells. Returns false, with an event, if refused (docs/alarms.md).
  bool new_alarm(Cycle now, const std::uint8_t* bytes, int size);
  /// The answer to a C1 (C2) request, at most 4 + Capacities::acyclic bytes; refused with an event if it does not fit
  /// the request (V14).
  void c1_answer(Cycle now, const std::uint8_t* pdu, int size) { msac_.c1.answer(now, pdu, size); }
  void c2_answer(Cycle now, const std::uint8_t* pdu, int size);

  // --- for others ---------------------------------------------------------------------------------------------------
  Msac& msac() { return msac_; }
  const Msac& msac() const { return msac_; }
  std::uint64_t data_exchanges() const { return data_exchanges_; }
  std::uint64_t outputs_replaced() const { return outputs_replaced_; }  ///< before the user's side took them

  /// With the slave's state in its place: see Station::store.
  template <class Archive, class Slave>
  void store(Archive& archive, Slave& slave) {
    auto& [log, capacities, station, mail, cfg, outputs, inputs, diagnosis, msac, data_exchanges, outputs_replaced] =
        *this;
    archive.given(log, capacities, station);
    archive(mail, slave, cfg, outputs, inputs);
    slave.store_faults(archive);
    archive(diagnosis, msac.alarms, msac.c1, msac.c2, data_exchanges, outputs_replaced);
  }

 private:
  // The store, each service in the file of its name.
  Exchanged exchange(Cycle now, const Request& request, bool fail_safe) override;
  Take parameters(Cycle now, const Request& request) override;
  Take configuration(Cycle now, const Request& request, bool exchanging) override;
  IoLengths configured() override;
  Take address(Cycle now, const Request& request, bool right) override;
  void control(Cycle now, const Control& control) override;
  View read_inputs(Cycle now) override;
  View read_outputs(Cycle now) override;
  View read_cfg(Cycle now, bool exchanging) override;
  StoredDiagnosis diagnosis(Cycle now, bool to_holder) override;
  void entered(Cycle now, DpState from, DpState to) override;
  void baud(Cycle now, BaudIndex index) override { mail_.baud = {{now}, index}; }

  const SlaveConfig& config() const;
  void forget();
  bool fail_safe_clear(Cycle now, const Request& request, bool fail_safe);
  void clear_outputs(Cycle now);
  void hand_outputs(Cycle now);
  void sync(Cycle now, Gate gate);
  void freeze(Gate gate);
  bool alarm_unread(Cycle now, int size);
  bool check_user_length(Cycle now, int user_size);
  bool check_cfg_bytes(Cycle now, const Request& request, const CfgLengths& lengths);
  bool check_cfg_equal(Cycle now, const Request& request, const Block<kMaxCfg>& expected);
  void mail_cfg(Cycle now, const Request& request, const CfgLengths& lengths);

  EventLog& log_;
  const Capacities capacities_;
  Station& station_;
  UserMail mail_;
  Block<kMaxCfg> cfg_;  // the configuration in use, or awaiting the verdict
  DoubleBuffer outputs_, inputs_;
  UserDiagnosis diagnosis_;
  Msac msac_;
  std::uint64_t data_exchanges_ = 0, outputs_replaced_ = 0;
};

}  // namespace dsdpv1::profibus
