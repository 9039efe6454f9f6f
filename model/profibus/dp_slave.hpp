#pragma once
// The DP slave state machine (chapter 6, rulings S4 to S33): OFFLINE, WAIT_PRM, WAIT_CFG, DATA_EXCH. It decides; a
// SlaveStore has the bytes. Each service is in the file of its name; dp_slave.cpp has the states and the dispatch.
#include <algorithm>

#include "model/profibus/diagnosis.hpp"
#include "model/profibus/dp_state.hpp"
#include "model/profibus/event_log.hpp"
#include "model/profibus/fdl_times.hpp"
#include "model/profibus/msac.hpp"
#include "model/profibus/request.hpp"
#include "model/profibus/slave_rules.hpp"
#include "model/profibus/slave_store.hpp"
#include "model/profibus/watchdog.hpp"

namespace dsdpv1::profibus {

namespace sap {
constexpr int kAlarm = 50, kC1 = 51, kSetSlaveAddress = 55, kReadInputs = 56, kReadOutputs = 57, kGlobalControl = 58,
              kGetCfg = 59, kSlaveDiag = 60, kSetPrm = 61, kCheckCfg = 62;
}

constexpr std::uint8_t kNoMaster = 255;

class DpSlave {
 public:
  /// `msac`: null without DPV1, whatever the configuration says.
  DpSlave(EventLog& log, Watchdog& watchdog, SlaveStore& store, Msac* msac, const SlaveRules& rules)
      : log_(log), watchdog_(watchdog), store_(store), msac_(msac), rules_(rules) {}

  // --- from the bus -------------------------------------------------------------------------------------------------
  /// Executes a request at `now`. The reply's data are valid until the next call.
  Reply handle(Cycle now, const Request& request);
  /// Evaluates the C2 timers at `now` (V12); the next end of one of them.
  void eval_timers(Cycle now) {
    if (msac_ != nullptr) msac_->c2.eval(now);
  }
  Cycle next_timer() const { return msac_ != nullptr ? msac_->c2.next() : kNever; }
  /// The search has ended: a watchdog that waited runs now (S29).
  void rate_found(Cycle now);
  /// The watchdog of the holding master has expired (S1).
  void watchdog_expired(Cycle now);

  // --- from the user's side: see Station ----------------------------------------------------------------------------
  void reset();
  void stop(Cycle now) { enter(now, DpState::kOffline); }
  void start(Cycle now, const SlaveConfig& config);
  void configure(const SlaveConfig& config) { config_ = config; }
  void set_address(std::uint8_t address) { address_ = address; }
  void set_min_tsdr(int bits) { min_tsdr_ = std::max(bits, kMinTsdr); }
  void leave_master(Cycle now) { leave_to_wait_prm(now); }
  void prm_verdict(Cycle now, bool good);
  void refuse_prm(Cycle now);
  void cfg_is_right() { diagnosis_.cfg_good(); }
  void cfg_verdict(Cycle now, bool good);

  // --- for others ----------------------------------------------------------------------------------------------------
  DpState state() const { return state_; }
  std::uint8_t address() const { return address_; }
  std::uint8_t master() const { return master_; }
  bool prm_awaited() const { return prm_awaited_; }  ///< a verdict of the user
  bool cfg_awaited() const { return cfg_awaited_; }
  /// Whether the answer to a repetition is composed again, not repeated (SlaveRules).
  bool answers_afresh(const Request& request) const;
  int min_tsdr() const { return min_tsdr_; }
  const SlaveConfig& config() const { return config_; }

  /// All but the faults, which stand beside the user's diagnosis.
  template <class Archive>
  void store(Archive& archive) {
    auto& [log, watchdog, bytes, msac, rules, config, state, address, address_locked, master, prm, judged, prm_awaited,
           cfg_awaited, min_tsdr, faults] = *this;
    archive.given(log, watchdog, bytes, msac, rules, faults);
    archive.within(DpState::kOffline, DpState::kDataExch, state);
    archive.within(0, 0xFF, min_tsdr);
    archive(config, address, address_locked, master, prm, judged, prm_awaited, cfg_awaited);
  }
  template <class Archive>
  void store_faults(Archive& archive) {
    archive(diagnosis_);
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
  Reply ms1(Cycle now, const Request& request);
  Reply c2_initiate(Cycle now, const Request& request);
  bool c2_channel(int dsap) const;
  Reply unknown_sap(Cycle now, const Request& request);
  Reply refuse_state(Cycle now, const Request& request, int sap);
  Reply refuse_master(Cycle now, const Request& request, int sap);
  bool held_by_other(const Request& request) const { return master_ != kNoMaster && master_ != request.sa; }
  void enter(Cycle now, DpState state);
  void leave_to_wait_prm(Cycle now, bool by_watchdog = false);
  // data_exchange.cpp, diagnosis.cpp, read_services.cpp, set_slave_address.cpp
  Reply data_exchange(Cycle now, const Request& request);
  Reply slave_diag(Cycle now, const Request& request);
  Reply read_only(Cycle now, const Request& request);
  static Reply reply_data(const View& view);
  Reply set_slave_address(Cycle now, const Request& request);
  // set_prm.cpp
  Reply set_prm(Cycle now, const Request& request);
  bool check_ident(Cycle now, const Request& request);
  bool check_prm(Cycle now, const Request& request, PrmRequest& prm);
  bool check_options(Cycle now, std::uint8_t status, std::uint8_t spec, int user_size);
  void refuse_prm(Cycle now, Reason reason, bool not_supported, unsigned a = 0, unsigned b = 0);
  void prm_fault(Cycle now, bool not_supported);
  void await_prm(Cycle now, const PrmRequest& prm);
  void accept_prm(Cycle now, const PrmRequest& prm);
  void take_min_tsdr(std::uint8_t bits);
  void tell_watchdog(Cycle now);
  // check_cfg.cpp
  Reply check_cfg(Cycle now, const Request& request);
  void cfg_fault(Cycle now);
  void accept_cfg(Cycle now);
  // global_control.cpp
  void global_control(Cycle now, const Request& request);
  Gate sync_command(Cycle now, unsigned command);
  Gate freeze_command(Cycle now, unsigned command);

  EventLog& log_;
  Watchdog& watchdog_;
  SlaveStore& store_;
  Msac* const msac_;
  const SlaveRules& rules_;
  SlaveConfig config_;

  DpState state_ = DpState::kOffline;
  std::uint8_t address_ = 0;
  bool address_locked_ = false;
  std::uint8_t master_ = kNoMaster;
  PrmRequest prm_;     // in force
  PrmRequest judged_;  // awaiting the user's verdict (S15)
  bool prm_awaited_ = false, cfg_awaited_ = false;
  int min_tsdr_ = kMinTsdr;
  Diagnosis diagnosis_;
};

}  // namespace dsdpv1::profibus
