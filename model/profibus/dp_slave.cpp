#include "model/profibus/dp_slave.hpp"

namespace dsdpv1::profibus {
namespace {

constexpr int kMaxAddress = 125;  // EN 50170: 126 is the delivery address, 127 broadcast

bool c2_channel(int dsap) { return dsap <= kC2FirstSap && dsap > kC2FirstSap - kC2Channels; }

}  // namespace

void DpSlave::reset() {
  config_ = SlaveConfig();
  state_ = DpState::kOffline;
  address_ = 0;
  address_locked_ = false;
  master_ = kNoMaster;
  prm_awaited_ = cfg_awaited_ = false;
  min_tsdr_ = kMinTsdr;
  outputs_.reset(0);
  inputs_.reset(0);
  diagnosis_.reset();
  mail_ = UserMail();
  msac1_.reset();
  msac2_.reset();
  data_exchanges_ = outputs_replaced_ = 0;
}

void DpSlave::initialise(Cycle now, const SlaveConfig& config) {
  const bool left_exchange = state_ == DpState::kDataExch;
  enter(now, DpState::kOffline);
  const std::uint16_t exchanges_left = mail_.state.exchanges_left;
  const std::uint64_t data_exchanges = data_exchanges_, outputs_replaced = outputs_replaced_;
  reset();
  mail_.state.exchanges_left = exchanges_left;
  data_exchanges_ = data_exchanges;
  outputs_replaced_ = outputs_replaced;
  config_ = config;
  address_ = config.address;
  const CfgLengths lengths = cfg_lengths(config.cfg.bytes.data(), config.cfg.size);
  inputs_.reset(lengths.input());
  outputs_.reset(lengths.output());
  if (left_exchange) hand_outputs(now);  // S18
  enter(now, DpState::kWaitPrm);
}

// --- states ----------------------------------------------------------------------------------------------------------

void DpSlave::enter(Cycle now, DpState state) {
  if (state == state_) return;
  log_.at_cycle(now, Reason::kDpState, static_cast<unsigned>(state_), static_cast<unsigned>(state));
  const bool left_exchange = state_ == DpState::kDataExch;
  state_ = mail_.state.state = state;
  mail_.state.due.set(now);
  if (!left_exchange) return;
  ++mail_.state.exchanges_left;  // S18
  inputs_.release();
  outputs_.release();
  clear_outputs(now);
  msac1_.close(now);
}

void DpSlave::leave_to_wait_prm(Cycle now) {
  enter(now, DpState::kWaitPrm);
  master_ = kNoMaster;
  prm_awaited_ = cfg_awaited_ = false;
  if (watchdog_.state() == Watchdog::State::kDpControl) watchdog_.baud_control(now);
}

void DpSlave::watchdog_expired(Cycle now) {
  log_.at_cycle(now, Reason::kWatchdogExpired, master_, prm_.watchdog_factor, prm_.watchdog_base_ms);
  leave_to_wait_prm(now);
}

void DpSlave::hand_outputs(Cycle now) {
  if (mail_.output.due.waiting()) ++outputs_replaced_;
  if (outputs_.size() > 0) mail_.output.due.set(now);
}

void DpSlave::clear_outputs(Cycle now) {
  outputs_.clear();
  hand_outputs(now);
}

// --- services --------------------------------------------------------------------------------------------------------

Reply DpSlave::handle(Cycle now, const Request& request) {
  if (request.code == fc::kFdlStatus) return Reply::status(fc::kOk);
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
  if (c2_channel(request.dsap) && msac2_.abort_unanswered(now, request)) return;
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
    case sap::kGlobalControl: return refuse_state(now, request, sap::kGlobalControl);  // an SRD: only SDN is served
    case sap::kC1: return c1(now, request);
    case Msac2::kManagerSap: return c2_initiate(now, request);
    default:
      if (c2_channel(request.dsap)) return msac2_.handle(now, request);
      log_.at_cycle(now, Reason::kSapUnknown, static_cast<unsigned>(request.dsap), request.sa);
      return Reply::status(fc::kRs);
  }
}

// Requests without data (S13).
Reply DpSlave::read_only(Cycle now, const Request& request) {
  if (request.dsap == sap::kReadInputs && state_ != DpState::kDataExch) return refuse_state(now, request, request.dsap);
  if (request.size > 0) {
    log_.at_cycle(now, Reason::kSapData, static_cast<unsigned>(request.dsap), static_cast<unsigned>(request.size),
                  request.sa);
    return Reply::status(fc::kRr);
  }
  switch (request.dsap) {
    case sap::kReadInputs: return reply_data(inputs_.shown().bytes.data(), inputs_.size());
    case sap::kReadOutputs: return reply_data(outputs_.shown().bytes.data(), outputs_.size());
    case sap::kGetCfg: return get_cfg();
    default: return slave_diag(request);
  }
}

Reply DpSlave::reply_data(const std::uint8_t* data, int size) const {
  return size == 0 ? Reply::sc() : Reply::with_data(fc::kDl, data, size);
}

Reply DpSlave::refuse_state(Cycle now, const Request& request, int sap) {
  log_.at_cycle(now, Reason::kSapState, static_cast<unsigned>(sap), static_cast<unsigned>(state_), request.sa);
  return Reply::status(fc::kRs);
}

Reply DpSlave::refuse_master(Cycle now, const Request& request, int sap) {
  log_.at_cycle(now, Reason::kSapMaster, static_cast<unsigned>(sap), request.sa, master_);
  return Reply::status(fc::kRs);
}

Reply DpSlave::c1(Cycle now, const Request& request) {
  if (state_ != DpState::kDataExch) return refuse_state(now, request, sap::kC1);
  if (held_by_other(request)) return refuse_master(now, request, sap::kC1);
  if (!prm_.dpv1) {
    log_.at_cycle(now, Reason::kC1Disabled, request.sa);
    return Reply::status(fc::kRs);
  }
  return msac1_.handle(now, request);
}

Reply DpSlave::c2_initiate(Cycle now, const Request& request) {
  if (!config_.dpv1) {
    log_.at_cycle(now, Reason::kC2Disabled, request.sa);
    return Reply::status(fc::kRs);
  }
  return msac2_.initiate(now, request);
}

Reply DpSlave::data_exchange(Cycle now, const Request& request) {
  constexpr int kDefaultSap = 0;
  if (state_ != DpState::kDataExch) return refuse_state(now, request, kDefaultSap);
  if (held_by_other(request)) return refuse_master(now, request, kDefaultSap);
  if (request.size == outputs_.size()) {
    if (request.size > 0) outputs_.write(request.data);
    if (!outputs_.held()) hand_outputs(now);
  } else if (request.size == 0 && prm_.fail_safe) {
    log_.at_cycle(now, Reason::kFailSafeClear);
    clear_outputs(now);
  } else {
    log_.at_cycle(now, Reason::kOutputLength, static_cast<unsigned>(request.size),
                  static_cast<unsigned>(outputs_.size()));
    diagnosis_.cfg_fault();
    leave_to_wait_prm(now);
    return Reply::status(fc::kRr);  // S19
  }
  ++data_exchanges_;
  return input_reply();
}

Reply DpSlave::input_reply() const {
  const bool high = diagnosis_.high_priority();
  if (inputs_.size() > 0)
    return Reply::with_data(high ? fc::kDh : fc::kDl, inputs_.shown().bytes.data(), inputs_.size());
  return high ? Reply::status(fc::kDh) : Reply::sc();
}

Reply DpSlave::slave_diag(const Request& request) {
  DiagnosisView view;
  view.ready = state_ == DpState::kDataExch;
  view.prm_req = state_ == DpState::kWaitPrm && !prm_awaited_;
  view.watchdog = watchdog_.state() == Watchdog::State::kDpControl;
  view.freeze = inputs_.held();
  view.sync = outputs_.held();
  view.master = master_;
  view.ident = config_.ident;
  const Reply reply = Reply::with_data(fc::kDl, diagnosis_.bytes(view), diagnosis_.size());
  if (master_ == request.sa) diagnosis_.read_by_holder();
  return reply;
}

Reply DpSlave::get_cfg() const {
  const Block<kMaxCfg>& cfg = state_ == DpState::kDataExch ? cfg_ : config_.cfg;  // 6.2.9
  return reply_data(cfg.bytes.data(), cfg.size);
}

Reply DpSlave::set_slave_address(Cycle now, const Request& request) {
  constexpr int kSize = 4;
  if (state_ != DpState::kWaitPrm) return refuse_state(now, request, sap::kSetSlaveAddress);
  if (!config_.address_change || address_locked_) {
    log_.at_cycle(now, Reason::kAddressDisabled, config_.address_change, address_locked_);
    return Reply::status(fc::kRs);
  }
  if (request.size > kSize) {
    log_.at_cycle(now, Reason::kAddressTooLong, static_cast<unsigned>(request.size));
    return Reply::status(fc::kRr);
  }
  const std::uint8_t* data = request.data;
  const unsigned ident = request.size == kSize ? static_cast<unsigned>(data[1]) << 8 | data[2] : 0;
  if (request.size < kSize || data[0] > kMaxAddress || ident != config_.ident) {
    log_.at_cycle(now, Reason::kAddressRefused, static_cast<unsigned>(request.size), request.size > 0 ? data[0] : 0U,
                  ident);
    return Reply::sc();
  }
  log_.at_cycle(now, Reason::kAddressChanged, address_, data[0], data[3]);
  address_ = data[0];
  address_locked_ = data[3] != 0;
  mail_.address = {{now}, address_, address_locked_};
  return Reply::sc();
}

// --- the user's side -------------------------------------------------------------------------------------------------

bool DpSlave::new_inputs(Cycle now, const std::uint8_t* bytes, int size) {
  if (size != inputs_.size()) {
    log_.at_cycle(now, Reason::kInputLength, static_cast<unsigned>(size), static_cast<unsigned>(inputs_.size()));
    return false;
  }
  inputs_.write(bytes);
  return true;
}

bool DpSlave::new_diagnosis(Cycle now, std::uint8_t type, const std::uint8_t* bytes, int size) {
  if (!Diagnosis::known_type(type)) {
    log_.at_cycle(now, Reason::kDiagType, type);
    return false;
  }
  if (size > config_.max_diag) {
    log_.at_cycle(now, Reason::kDiagLength, static_cast<unsigned>(size), static_cast<unsigned>(config_.max_diag));
    return false;
  }
  log_.at_cycle(now, Reason::kDiagAccepted, type, static_cast<unsigned>(size));
  diagnosis_.set_user(type, bytes, size);
  return true;
}

}  // namespace dsdpv1::profibus
