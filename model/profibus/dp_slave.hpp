#pragma once
// The DP slave state machine (chapter 6, rulings S4 to S33): OFFLINE, WAIT_PRM, WAIT_CFG, DATA_EXCH. Each service is in
// the file of its name; dp_slave.cpp has the states and the dispatch to the services.
#include "model/profibus/diagnosis.hpp"
#include "model/profibus/dp_state.hpp"
#include "model/profibus/event_log.hpp"
#include "model/profibus/fdl_times.hpp"
#include "model/profibus/msac1.hpp"
#include "model/profibus/msac2.hpp"
#include "model/profibus/request.hpp"
#include "model/profibus/user_side.hpp"
#include "model/profibus/watchdog.hpp"

namespace dsdpv1::profibus {

namespace sap {
constexpr int kC1 = 51, kSetSlaveAddress = 55, kReadInputs = 56, kReadOutputs = 57, kGlobalControl = 58, kGetCfg = 59,
              kSlaveDiag = 60, kSetPrm = 61, kCheckCfg = 62;
}

constexpr std::uint8_t kNoMaster = 255;

class DpSlave {
 public:
  DpSlave(EventLog& log, Watchdog& watchdog, const Capacities& capacities, UserMail& mail)
      : log_(log),
        watchdog_(watchdog),
        capacities_(capacities),
        mail_(mail),
        msac1_(log, capacities.acyclic, mail.c1),
        msac2_(log, capacities.acyclic, mail.c2) {}

  // --- from the bus -------------------------------------------------------------------------------------------------
  /// Executes a request at `now`. The reply's data are valid until the next call.
  Reply handle(Cycle now, const Request& request);
  /// Evaluates the C2 timers at `now` (V12); the next end of one of them.
  void eval_timers(Cycle now) { msac2_.eval(now); }
  Cycle next_timer() const { return msac2_.next(); }
  /// The search has ended: a watchdog that waited runs now (S29).
  void rate_found(Cycle now);
  /// The watchdog of the holding master has expired (S1).
  void watchdog_expired(Cycle now);

  // --- from the user's side: see UserSide ----------------------------------------------------------------------------
  void reset();
  void initialise(Cycle now, const SlaveConfig& config);
  void prm_verdict(Cycle now, bool good);
  void cfg_verdict(Cycle now, bool good);
  bool new_inputs(Cycle now, const std::uint8_t* bytes, int size);
  bool new_diagnosis(Cycle now, std::uint8_t type, const std::uint8_t* bytes, int size);
  void c1_answer(Cycle now, const std::uint8_t* pdu, int size) { msac1_.answer(now, pdu, size); }
  void c2_answer(Cycle now, const std::uint8_t* pdu, int size) { msac2_.answer(now, pdu, size); }
  const IoBlock& outputs() const { return outputs_.shown(); }

  // --- for others ----------------------------------------------------------------------------------------------------
  DpState state() const { return state_; }
  std::uint8_t address() const { return address_; }
  std::uint8_t master() const { return master_; }
  int input_size() const { return inputs_.size(); }
  int min_tsdr() const { return min_tsdr_; }
  std::uint64_t data_exchanges() const { return data_exchanges_; }
  std::uint64_t outputs_replaced() const { return outputs_replaced_; }  ///< before the user's side took them
  const SlaveConfig& config() const { return config_; }
  RmRegistry rm_registry() const { return msac2_.registry(); }

  template <class Archive>
  void store(Archive& archive) {
    auto& [log, watchdog, capacities, mail, config, state, address, address_locked, master, prm, judged, prm_awaited,
           cfg_awaited, min_tsdr, cfg, outputs, inputs, diagnosis, msac1, msac2, data_exchanges, outputs_replaced] =
        *this;
    archive.given(log, watchdog, capacities, mail);
    archive.within(DpState::kOffline, DpState::kDataExch, state);
    archive.within(0, 0xFF, min_tsdr);
    archive(config, address, address_locked, master, prm, judged, prm_awaited, cfg_awaited, cfg, outputs, inputs,
            diagnosis);
    archive(msac1, msac2, data_exchanges, outputs_replaced);
  }

 private:
  struct PrmRequest {  // a Set_Prm that passed the checks of its standard bytes
    std::uint8_t master = kNoMaster, min_tsdr = 0, group = 0;
    bool watchdog = false, sync = false, freeze = false, fail_safe = false, dpv1 = false;
    unsigned watchdog_factor = 0, watchdog_base_ms = 0;  ///< WD_Fact_1 x WD_Fact_2, WD_Base
    int user_size = 0;

    template <class Archive>
    void store(Archive& archive) {
      auto& [sender, tsdr, groups, watches, syncs, freezes, fails_safe, has_dpv1, factor, base_ms, size] = *this;
      archive(sender, tsdr, groups, watches, syncs, freezes, fails_safe, has_dpv1);
      archive.within(0U, 0xFFU * 0xFFU, factor);
      archive.within(0U, 10U, base_ms);
      archive.within(0, kMaxUserPrm, size);
    }
  };

  // dp_slave.cpp
  Reply dispatch(Cycle now, const Request& request);
  void unanswered(Cycle now, const Request& request);
  Reply c1(Cycle now, const Request& request);
  Reply c2_initiate(Cycle now, const Request& request);
  Reply refuse_state(Cycle now, const Request& request, int sap);
  Reply refuse_master(Cycle now, const Request& request, int sap);
  bool held_by_other(const Request& request) const { return master_ != kNoMaster && master_ != request.sa; }
  void enter(Cycle now, DpState state);
  void leave_to_wait_prm(Cycle now);
  // data_exchange.cpp
  Reply data_exchange(Cycle now, const Request& request);
  Reply input_reply() const;
  // fail_safe.cpp
  bool fail_safe_clear(Cycle now, const Request& request);
  void clear_outputs(Cycle now);
  void hand_outputs(Cycle now);
  // diagnosis.cpp, read_services.cpp, set_slave_address.cpp
  Reply slave_diag(const Request& request);
  Reply read_only(Cycle now, const Request& request);
  Reply get_cfg() const;
  Reply reply_data(const std::uint8_t* data, int size) const;
  Reply set_slave_address(Cycle now, const Request& request);
  // set_prm.cpp
  Reply set_prm(Cycle now, const Request& request);
  bool check_ident(Cycle now, const Request& request);
  bool check_prm(Cycle now, const Request& request, PrmRequest& prm);
  bool check_options(Cycle now, std::uint8_t status, std::uint8_t spec, int user_size);
  bool check_user_length(Cycle now, int user_size);
  void refuse_prm(Cycle now, Reason reason, bool not_supported, unsigned a = 0, unsigned b = 0, unsigned c = 0);
  void accept_prm(Cycle now, const PrmRequest& prm);
  void set_min_tsdr(std::uint8_t bits);
  void tell_watchdog(Cycle now);
  // check_cfg.cpp
  Reply check_cfg(Cycle now, const Request& request);
  bool check_cfg_bytes(Cycle now, const Request& request, const CfgLengths& lengths);
  bool check_cfg_equal(Cycle now, const Request& request, const Block<kMaxCfg>& expected);
  void mail_cfg(Cycle now, const Request& request, const CfgLengths& lengths);
  void refuse_cfg(Cycle now, Reason reason, unsigned a = 0, unsigned b = 0, unsigned c = 0);
  void accept_cfg(Cycle now);
  // global_control.cpp
  void global_control(Cycle now, const Request& request);
  void sync_command(Cycle now, std::uint8_t command);
  void freeze_command(Cycle now, std::uint8_t command);

  EventLog& log_;
  Watchdog& watchdog_;
  const Capacities capacities_;
  UserMail& mail_;
  SlaveConfig config_;

  DpState state_ = DpState::kOffline;
  std::uint8_t address_ = 0;
  bool address_locked_ = false;
  std::uint8_t master_ = kNoMaster;
  PrmRequest prm_;     // in force
  PrmRequest judged_;  // awaiting the user's verdict (S15)
  bool prm_awaited_ = false, cfg_awaited_ = false;
  int min_tsdr_ = kMinTsdr;
  Block<kMaxCfg> cfg_;  // the configuration in use, or awaiting the verdict

  DoubleBuffer outputs_, inputs_;
  Diagnosis diagnosis_;
  Msac1 msac1_;
  Msac2 msac2_;
  std::uint64_t data_exchanges_ = 0, outputs_replaced_ = 0;
};

}  // namespace dsdpv1::profibus
