#include "lab/replay/user_verdicts.hpp"

#include <algorithm>

#include "lab/replay/services.hpp"

namespace dsdpv1::tb::replay {
namespace {

/// The chip judges others alone (S6, S14, S28).
bool is_judged_by_user(const bus::Bytes& prm) {
  if (prm.size() < kPrmHead || (prm[0] & (kLockReq | kUnlockReq)) != kLockReq) return false;
  return (prm[0] & kWdOn) == 0 || (prm[1] != 0 && prm[2] != 0);
}

}  // namespace

void VerdictReader::take(const bus::Telegram& request, const RecordedTelegram* answer) {
  if (is_service(request, bus::sap::kSetPrm) && acknowledged(answer)) take_set_prm(request);
  if (is_service(request, bus::sap::kChkCfg)) take_chk_cfg(request, answer);
  if (const bus::Bytes* diagnosis = diagnosis_of(request, answer)) take_diagnosis(*diagnosis);
  if (exchanged(request, answer)) {
    accept();
    exchanging_ = true;
  }
  if (answer != nullptr) before_ = answer->end;
}

void VerdictReader::take_set_prm(const bus::Telegram& request) {
  prm_.reset();
  cfg_.reset();
  exchanging_ = cfg_refused_ = false;
  was_held_ = held_;
  if (!is_judged_by_user(request.data)) return;
  prm_ = UserVerdict{};
  prm_->ident = request.data[4] << 8U | request.data[5];
}

/// S13: it is taken once the parameters are accepted. S16: in data exchange the chip judges it.
void VerdictReader::take_chk_cfg(const bus::Telegram& request, const RecordedTelegram* answer) {
  if (!acknowledged(answer)) {
    cfg_refused_ = cfg_refused_ || right_answer(answer) != nullptr;
    return;
  }
  if (exchanging_) return;
  if (!cfg_early_ && prm_) {
    prm_waits_ = prm_waits_ || cfg_refused_;
    decide(prm_, false);
  }
  cfg_ = UserVerdict{};
  cfg_->cfg = true;
  cfg_->block = request.data;
}

void VerdictReader::take_diagnosis(const bus::Bytes& diagnosis) {
  held_ = diagnosis[3] != kNoMaster;
  const bool by_chip = (diagnosis[0] & kNotSupported) != 0;  // S6
  if ((diagnosis[0] & kPrmFault) != 0 && prm_ && !by_chip) {
    decide(prm_, true);
    return cfg_.reset();
  }
  if ((diagnosis[0] & kCfgFault) != 0 && cfg_) {
    decide(prm_, false);
    return decide(cfg_, true);
  }
  if (by_chip || (diagnosis[1] & kPrmReq) != 0) {
    prm_.reset();
    return cfg_.reset();
  }
  if ((diagnosis[0] & kStationNotReady) == 0) return accept();
  take_not_ready(held_);
}

/// S7. The slave has its master from the verdict on (S15).
void VerdictReader::take_not_ready(bool held) {
  if (cfg_) cfg_waits_ = true;
  if (cfg_ || !prm_) return;
  if (held && !was_held_ && !cfg_early_) return decide(prm_, false);
  prm_waits_ = prm_waits_ || cfg_refused_;
}

void VerdictReader::accept() {
  decide(prm_, false);
  decide(cfg_, false);
}

void VerdictReader::decide(std::optional<UserVerdict>& open, bool refuse) {
  if (!open) return;
  open->at = before_;
  open->refuse = refuse;
  verdicts_.push_back(std::move(*open));
  open.reset();
}

bool VerdictReader::judges_prm(std::optional<int> ident) const {
  return prm_waits_ ||
         std::any_of(
             verdicts_.begin(), verdicts_.end(),
             [ident](const UserVerdict& each) { return !each.cfg && each.refuse && each.ident == ident; });
}

bool VerdictReader::judges_cfg(const std::optional<bus::Bytes>& own) const {
  return cfg_waits_ || std::any_of(
                           verdicts_.begin(), verdicts_.end(),
                           [&own](const UserVerdict& each) { return each.cfg && each.refuse && each.block == own; });
}

}  // namespace dsdpv1::tb::replay
