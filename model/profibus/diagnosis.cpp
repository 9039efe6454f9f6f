#include "model/profibus/diagnosis.hpp"

#include "model/profibus/dp_slave.hpp"

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

bool Diagnosis::known_type(std::uint8_t type) {
  return type == kExtended || type == kExtGone || type == kExtPresent || type == kStatGone || type == kStatPresent;
}

void Diagnosis::set_user(std::uint8_t type, const std::uint8_t* bytes, int size) {
  user_.assign(bytes, size);
  const bool is_static = type == kStatGone || type == kStatPresent;
  if (is_static)
    stat_diag_ = type == kStatPresent;
  else
    ext_diag_ = type == kExtPresent;  // 00 takes external diagnosis back, too (D9)
  if (type != kExtended) unread_ = true;
}

const std::uint8_t* Diagnosis::bytes(const DiagnosisView& view) {
  constexpr unsigned kAlwaysOne = 1U << 2;
  answer_[0] = static_cast<std::uint8_t>(bit(!view.ready, 1) | bit(cfg_fault_, 2) | bit(ext_diag_, 3) |
                                         bit(not_supported_, 4) | bit(prm_fault_, 6));
  answer_[1] = static_cast<std::uint8_t>(bit(view.prm_req, 0) | bit(stat_diag_, 1) | kAlwaysOne |
                                         bit(view.watchdog, 3) | bit(view.freeze, 4) | bit(view.sync, 5));
  answer_[2] = 0;  // Ext_Diag_Overflow cannot happen: 6 + 238 bytes fit
  answer_[3] = view.master;
  answer_[4] = static_cast<std::uint8_t>(view.ident >> 8);
  answer_[5] = static_cast<std::uint8_t>(view.ident & 0xFF);
  std::memcpy(&answer_[kStandard], user_.bytes.data(), static_cast<std::size_t>(user_.size));
  return answer_.data();
}

// --- Slave_Diag, and the user's block -------------------------------------------------------------------------------

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
