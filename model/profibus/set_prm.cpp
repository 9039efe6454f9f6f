// Set_Prm (6.2.2, rulings S5 to S7, S12, S14, S15, S28, S33).
#include "model/profibus/station.hpp"
#include "model/profibus/user_side.hpp"

namespace dsdpv1::profibus {
namespace {

// Station_status, table 19
constexpr std::uint8_t kLock = 0x80, kUnlock = 0x40, kSyncReq = 0x20, kFreezeReq = 0x10, kWdOn = 0x08;
// Spec_User_Prm_Byte = DPV1_Status_1, tables 21 and 25
constexpr std::uint8_t kDpv1Enable = 0x80, kFailSafe = 0x40, kWdBase1ms = 0x04;
constexpr int kStandardSize = 7, kDpv1Size = 10;
constexpr std::uint8_t kDeliveryAddress = 126;

}  // namespace

Reply DpSlave::set_prm(Cycle now, const Request& request) {
  if (address_ == kDeliveryAddress) {  // S33
    log_.at_cycle(now, Reason::kPrmNoAddress, request.sa, config_.address_change);
    return Reply::status(fc::kRs);
  }
  if (held_by_other(request)) return refuse_master(now, request, sap::kSetPrm);
  if (!store_.has_room(now, request)) return Reply::status(fc::kRr);
  const std::uint8_t* data = request.data;
  if (request.size < kStandardSize) {
    refuse_prm(now, Reason::kPrmShort, false, static_cast<unsigned>(request.size), kStandardSize);
    return Reply::sc();
  }
  if ((data[0] & (kLock | kUnlock)) == 0) {  // S28
    take_min_tsdr(data[3]);
    log_.at_cycle(now, Reason::kPrmMinTsdr, request.sa, static_cast<unsigned>(min_tsdr_));
    return Reply::sc();
  }
  if (!check_ident(now, request)) return Reply::sc();
  if ((data[0] & kUnlock) != 0) {
    log_.at_cycle(now, Reason::kPrmUnlock, request.sa);
    leave_to_wait_prm(now);
    return Reply::sc();
  }
  PrmRequest prm;
  if (!check_prm(now, request, prm)) return Reply::sc();
  switch (store_.parameters(now, request)) {
    case Take::kAccepted: accept_prm(now, prm); break;
    case Take::kAwaited: await_prm(now, prm); break;
    case Take::kRefused: prm_fault(now, false); break;
    case Take::kNoRoom: return Reply::status(fc::kRr);
  }
  return Reply::sc();
}

void DpSlave::await_prm(Cycle now, const PrmRequest& prm) {
  enter(now, DpState::kWaitPrm);  // the holding master still holds the slave, and the watchdog keeps running (S15)
  judged_ = prm;
  prm_awaited_ = true;
  cfg_awaited_ = false;
}

bool DpSlave::check_ident(Cycle now, const Request& request) {
  const unsigned ident = static_cast<unsigned>(request.data[4]) << 8 | request.data[5];
  if (ident == config_.ident) return true;
  refuse_prm(now, Reason::kPrmIdent, false, ident, config_.ident);
  return false;
}

bool DpSlave::check_prm(Cycle now, const Request& request, PrmRequest& prm) {
  const std::uint8_t* data = request.data;
  const int user_size = request.size - kStandardSize;
  const std::uint8_t spec = user_size > 0 ? data[kStandardSize] : std::uint8_t{0};
  if (!check_options(now, data[0], spec, user_size)) return false;
  prm.watchdog = (data[0] & kWdOn) != 0;
  if (prm.watchdog && (data[1] == 0 || data[2] == 0)) {
    refuse_prm(now, Reason::kPrmWatchdog, false, data[1], data[2]);
    return false;
  }
  prm.master = request.sa;
  prm.watchdog_base_ms = (spec & kWdBase1ms) != 0 ? 1 : 10;
  prm.watchdog_factor = static_cast<unsigned>(data[1]) * data[2];
  prm.min_tsdr = data[3];
  prm.group = data[6];
  prm.sync = (data[0] & kSyncReq) != 0;
  prm.freeze = (data[0] & kFreezeReq) != 0;
  prm.fail_safe = (spec & kFailSafe) != 0;
  prm.dpv1 = rules_.dpv1_status && (spec & kDpv1Enable) != 0;
  prm.user_size = user_size;
  return true;
}

bool DpSlave::check_options(Cycle now, std::uint8_t status, std::uint8_t spec, int user_size) {
  const auto refuse = [&](Reason reason) {
    refuse_prm(now, reason, true);
    return false;
  };
  if ((status & kSyncReq) != 0 && !config_.sync_supported) return refuse(Reason::kPrmSync);
  if ((status & kFreezeReq) != 0 && !config_.freeze_supported) return refuse(Reason::kPrmFreeze);
  if (!rules_.dpv1_status) return true;
  if ((spec & kFailSafe) != 0 && !config_.fail_safe_supported) return refuse(Reason::kPrmFailSafe);
  if ((spec & kDpv1Enable) == 0) return true;
  if (!config_.dpv1) return refuse(Reason::kPrmDpv1);  // D17
  if (user_size + kStandardSize >= kDpv1Size) return true;
  refuse_prm(now, Reason::kPrmShort, false, static_cast<unsigned>(user_size + kStandardSize), kDpv1Size);
  return false;
}

void DpSlave::refuse_prm(Cycle now, Reason reason, bool not_supported, unsigned a, unsigned b) {
  log_.at_cycle(now, reason, a, b);
  prm_fault(now, not_supported);
}

void DpSlave::prm_fault(Cycle now, bool not_supported) {
  diagnosis_.prm_fault(not_supported);
  leave_to_wait_prm(now);
}

void DpSlave::accept_prm(Cycle now, const PrmRequest& prm) {
  log_.at_cycle(now, Reason::kPrmAccepted, prm.master, prm.min_tsdr, static_cast<unsigned>(prm.user_size));
  diagnosis_.prm_good();
  prm_awaited_ = cfg_awaited_ = false;
  prm_ = prm;
  master_ = prm.master;
  take_min_tsdr(prm.min_tsdr);
  if (prm.watchdog)
    watchdog_.dp_control(now, Watchdog::time_of(prm.watchdog_factor, prm.watchdog_base_ms));
  else
    watchdog_.baud_control(now);
  tell_watchdog(now);
  enter(now, DpState::kWaitCfg);
}

void DpSlave::rate_found(Cycle now) {
  watchdog_.rate_found(now);
  tell_watchdog(now);
}

void DpSlave::tell_watchdog(Cycle now) {
  if (watchdog_.state() == Watchdog::State::kDpControl)
    log_.at_cycle(now, Reason::kWatchdogOn, prm_.watchdog_factor, prm_.watchdog_base_ms);
}

void DpSlave::take_min_tsdr(std::uint8_t bits) {
  if (bits != 0) set_min_tsdr(bits);  // S6, S11
}

void DpSlave::prm_verdict(Cycle now, bool good) {
  if (!prm_awaited_)
    log_.at_cycle(now, Reason::kVerdictUnexpected, 0);
  else if (good)
    accept_prm(now, judged_);
  else
    refuse_prm(now);
}

void DpSlave::refuse_prm(Cycle now) { refuse_prm(now, Reason::kPrmUserRefused, false); }

// --- the user's side -------------------------------------------------------------------------------------------------

Take UserSide::parameters(Cycle now, const Request& request) {
  const int user_size = request.size - kStandardSize;
  if (!check_user_length(now, user_size)) return Take::kRefused;
  mail_.prm.block.assign(request.data + kStandardSize, user_size);
  mail_.prm.due.set(now);
  msac_.alarms.ask(request.data + kStandardSize, user_size);
  if (config().prm_mode != Judging::kUser) return Take::kAccepted;
  log_.at_cycle(now, Reason::kPrmJudged, request.sa, static_cast<unsigned>(user_size));
  return Take::kAwaited;
}

bool UserSide::check_user_length(Cycle now, int user_size) {
  const Judging mode = config().prm_mode;
  const int limit = mode == Judging::kUser ? capacities_.user_prm : config().max_prm;
  const bool good = mode == Judging::kExact ? user_size == limit : user_size <= limit;
  if (good) return true;
  log_.at_cycle(now, Reason::kPrmUserLength, static_cast<unsigned>(user_size), static_cast<unsigned>(limit),
                static_cast<unsigned>(mode));
  return false;
}

void UserSide::prm_verdict(Cycle now, bool good) {
  if (mail_.prm.due.waiting())
    log_.at_cycle(now, Reason::kVerdictSuperseded, 0);
  else
    station_.prm_verdict(now, good);
}

}  // namespace dsdpv1::profibus
