#include "model/profibus/dp_slave.hpp"

#include "model/profibus/alarm_reasons.hpp"

namespace dsdpv1::profibus {

void DpSlave::reset() {
  config_ = SlaveConfig();
  state_ = DpState::kOffline;
  address_ = 0;
  address_locked_ = false;
  master_ = kNoMaster;
  prm_awaited_ = cfg_awaited_ = false;
  min_tsdr_ = kMinTsdr;
  diagnosis_.reset();
}

void DpSlave::start(Cycle now, const SlaveConfig& config) {
  reset();
  config_ = config;
  config_.dpv1 = config.dpv1 && msac_ != nullptr;
  address_ = config.address;
  enter(now, DpState::kWaitPrm);
}

// --- states ----------------------------------------------------------------------------------------------------------

void DpSlave::enter(Cycle now, DpState state) {
  if (state == state_) return;
  log_.at_cycle(now, Reason::kDpState, static_cast<unsigned>(state_), static_cast<unsigned>(state));
  const DpState from = state_;
  state_ = state;
  store_.entered(now, from, state);
}

void DpSlave::leave_to_wait_prm(Cycle now, bool by_watchdog) {
  store_.left(now, by_watchdog);
  enter(now, DpState::kWaitPrm);
  master_ = kNoMaster;
  prm_awaited_ = cfg_awaited_ = false;
  if (watchdog_.state() == Watchdog::State::kDpControl) watchdog_.baud_control(now);
}

void DpSlave::watchdog_expired(Cycle now) {
  log_.at_cycle(now, Reason::kWatchdogExpired, master_, prm_.watchdog_factor, prm_.watchdog_base_ms);
  leave_to_wait_prm(now, true);
}

// --- services --------------------------------------------------------------------------------------------------------

Reply DpSlave::handle(Cycle now, const Request& request) {
  if (request.code == fc::kFdlStatus) return Reply::status(fc::kOk);
  if (!rules_.has_saps) return Reply::nothing();
  if (request.sdn()) {
    unanswered(now, request);
    return Reply::nothing();
  }
  if (!request.srd()) {
    log_.at_cycle(now, Reason::kFunction, request.code, request.sa);
    return Reply::status(fc::kRs);  // S20: SDA, MSRD, identify, LSAP status
  }
  return dispatch(now, request);
}

void DpSlave::unanswered(Cycle now, const Request& request) {
  if (request.dsap == sap::kGlobalControl) return global_control(now, request);
  if (c2_channel(request.dsap) && msac_->c2.abort_unanswered(now, request)) return;
  log_.at_cycle(now, Reason::kSdnIgnored, static_cast<unsigned>(request.dsap), request.sa);
}

Reply DpSlave::dispatch(Cycle now, const Request& request) {
  switch (request.dsap) {
    case kNoSap: return data_exchange(now, request);
    case sap::kSetSlaveAddress: return set_slave_address(now, request);
    case sap::kReadInputs:
    case sap::kReadOutputs:
    case sap::kGetCfg:
    case sap::kSlaveDiag: return read_only(now, request);
    case sap::kSetPrm: return set_prm(now, request);
    case sap::kCheckCfg: return check_cfg(now, request);
    case sap::kGlobalControl: return refuse_state(now, request, sap::kGlobalControl);  // an SRD: only SDN is supported
    case sap::kC1:
    case sap::kAlarm: return ms1(now, request);
    case Msac2::kManagerSap: return c2_initiate(now, request);
    default:
      if (c2_channel(request.dsap)) return msac_->c2.handle(now, request);
      return unknown_sap(now, request);
  }
}

bool DpSlave::answers_afresh(const Request& request) const {
  if (!request.srd()) return false;
  return (rules_.fresh_inputs && request.dsap == sap::kReadInputs) ||
         (rules_.fresh_outputs && request.dsap == sap::kReadOutputs);
}

bool DpSlave::c2_channel(int dsap) const {
  return msac_ != nullptr && dsap <= kC2FirstSap && dsap > kC2FirstSap - kC2Channels;
}

Reply DpSlave::unknown_sap(Cycle now, const Request& request) {
  log_.at_cycle(now, Reason::kSapUnknown, static_cast<unsigned>(request.dsap), request.sa);
  return Reply::status(fc::kRs);
}

Reply DpSlave::refuse_state(Cycle now, const Request& request, int sap) {
  log_.at_cycle(now, Reason::kSapState, static_cast<unsigned>(sap), static_cast<unsigned>(state_), request.sa);
  return Reply::status(fc::kRs);
}

Reply DpSlave::refuse_master(Cycle now, const Request& request, int sap) {
  log_.at_cycle(now, Reason::kSapMaster, static_cast<unsigned>(sap), request.sa, master_);
  return Reply::status(fc::kRs);
}

/// SAP 51, and SAP 50 of a slave that has alarms.
Reply DpSlave::ms1(Cycle now, const Request& request) {
  const bool alarms = request.dsap == sap::kAlarm;
  if (alarms && (msac_ == nullptr || !msac_->alarms.on())) return unknown_sap(now, request);
  if (state_ != DpState::kDataExch) return refuse_state(now, request, request.dsap);
  if (held_by_other(request)) return refuse_master(now, request, request.dsap);
  if (!prm_.dpv1) {
    log_.at_cycle(now, alarms ? AlarmReason::kAlarmSapOff : Reason::kC1Disabled, request.sa);
    return Reply::status(fc::kRs);
  }
  return alarms ? msac_->alarms.handle(now, request) : msac_->c1.handle(now, request);
}

Reply DpSlave::c2_initiate(Cycle now, const Request& request) {
  if (!config_.dpv1) {
    log_.at_cycle(now, Reason::kC2Disabled, request.sa);
    return Reply::status(fc::kRs);
  }
  return msac_->c2.initiate(now, request);
}

}  // namespace dsdpv1::profibus
