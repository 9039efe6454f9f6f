#include "model/profibus/diagnosis.hpp"

#include <algorithm>

#include "model/profibus/alarm_reasons.hpp"
#include "model/profibus/dp_slave.hpp"
#include "model/profibus/user_side.hpp"

namespace dsdpv1::profibus {
namespace {

enum DiagType : std::uint8_t {
  kExtended = 0x00,
  kExtGone = 0x01,
  kExtPresent = 0x81,
  kStatGone = 0x02,
  kStatPresent = 0x82
};

constexpr unsigned bit(bool set, int position) { return set ? 1U << position : 0U; }

}  // namespace

bool UserDiagnosis::known_type(std::uint8_t type) {
  return type == kExtended || type == kExtGone || type == kExtPresent || type == kStatGone || type == kStatPresent;
}

void UserDiagnosis::set_user(std::uint8_t type, const std::uint8_t* bytes, int size) {
  user_.assign(bytes, size);
  const bool is_static = type == kStatGone || type == kStatPresent;
  if (is_static)
    stat_diag_ = type == kStatPresent;
  else
    ext_diag_ = type == kExtPresent;  // 00 takes external diagnosis back, too (D9)
  if (type != kExtended) unread_ = true;
}

View Diagnosis::bytes(const DiagnosisView& view, const StoredDiagnosis& stored) {
  constexpr unsigned kAlwaysOne = 1U << 2;
  answer_[0] = static_cast<std::uint8_t>(bit(!view.ready, 1) | bit(cfg_fault_, 2) | bit(stored.ext_diag, 3) |
                                         bit(not_supported_, 4) | bit(prm_fault_, 6));
  answer_[1] = static_cast<std::uint8_t>(bit(view.prm_req, 0) | bit(stored.stat_diag, 1) | kAlwaysOne |
                                         bit(view.watchdog, 3) | bit(stored.freeze, 4) | bit(stored.sync, 5));
  answer_[2] = static_cast<std::uint8_t>(bit(stored.overflow, 7));
  answer_[3] = view.master;
  answer_[4] = static_cast<std::uint8_t>(view.ident >> 8);
  answer_[5] = static_cast<std::uint8_t>(view.ident & 0xFF);
  if (stored.standard != nullptr) std::copy_n(answer_.data(), kStandard, stored.standard);
  std::copy_n(stored.user.bytes, stored.user.size, &answer_[kStandard]);
  return {answer_.data(), kStandard + stored.user.size};
}

// --- Slave_Diag, and the user's block -------------------------------------------------------------------------------

Reply DpSlave::slave_diag(Cycle now, const Request& request) {
  DiagnosisView view;
  view.ready = state_ == DpState::kDataExch;
  view.prm_req = state_ == DpState::kWaitPrm && !prm_awaited_;
  view.watchdog = watchdog_.state() == Watchdog::State::kDpControl;
  view.master = master_;
  view.ident = config_.ident;
  const StoredDiagnosis stored = store_.diagnosis(now, master_ == request.sa);
  if (stored.user.size == View::kNoBuffer) return Reply::status(fc::kRr);
  const View answer = diagnosis_.bytes(view, stored);
  return Reply::with_data(fc::kDl, answer.bytes, answer.size);
}

StoredDiagnosis UserSide::diagnosis(Cycle /*now*/, bool to_holder) {
  if (to_holder) diagnosis_.read_by_holder();
  return {diagnosis_.bytes(), diagnosis_.ext_diag(), diagnosis_.stat_diag(), inputs_.held(), outputs_.held()};
}

bool UserSide::alarm_unread(Cycle now, int size) {
  const int open = msac_.alarms.open();
  if (open == 0 || !diagnosis_.unread()) return false;
  log_.at_cycle(now, AlarmReason::kAlarmUnread, static_cast<unsigned>(size), static_cast<unsigned>(open));
  return true;
}

bool UserSide::new_alarm(Cycle now, const std::uint8_t* bytes, int size) {
  const DpSlave& slave = station_.slave();
  if (slave.state() != DpState::kDataExch) {
    log_.at_cycle(now, AlarmReason::kAlarmState, static_cast<unsigned>(slave.state()));
    return false;
  }
  if (alarm_unread(now, size)) return false;
  if (!msac_.alarms.raise(now, bytes, size, config().max_diag)) return false;
  diagnosis_.set_user(kExtPresent, bytes, size);
  return true;
}

bool UserSide::new_diagnosis(Cycle now, std::uint8_t type, const std::uint8_t* bytes, int size) {
  if (!UserDiagnosis::known_type(type)) {
    log_.at_cycle(now, Reason::kDiagType, type);
    return false;
  }
  if (size > config().max_diag) {
    log_.at_cycle(now, Reason::kDiagLength, static_cast<unsigned>(size), static_cast<unsigned>(config().max_diag));
    return false;
  }
  if (alarm_unread(now, size)) return false;
  log_.at_cycle(now, Reason::kDiagAccepted, type, static_cast<unsigned>(size));
  diagnosis_.set_user(type, bytes, size);
  return true;
}

}  // namespace dsdpv1::profibus
