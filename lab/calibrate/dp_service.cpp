#include "lab/calibrate/dp_service.hpp"

namespace dsdpv1::calibrate {

PrmKind prm_kind(const Exchange& exchange) {
  constexpr std::uint8_t kLock = 0x80, kUnlock = 0x40;
  if (!exchange.is_srd(bus::sap::kSetPrm) || !exchange.acknowledged() || exchange.same) return PrmKind::kNone;
  const bus::Bytes& data = exchange.request->telegram.data;
  if (data.size() < kPrmSize) return PrmKind::kShort;
  if ((data[0] & kUnlock) != 0) return PrmKind::kUnlock;
  return (data[0] & kLock) != 0 ? PrmKind::kLock : PrmKind::kMinTsdr;
}

bool may_be_prm(const Exchange& exchange) {
  const LineTelegram* answer = exchange.answer;
  return !exchange.request->right && answer != nullptr &&
         (!answer->right || answer->telegram.kind == bus::TelegramKind::kSc);
}

bool diagnosis_has(const Exchange& exchange, std::uint8_t status1, std::uint8_t status2) {
  if (!exchange.is_srd(bus::sap::kSlaveDiag) || exchange.answer == nullptr) return false;
  const bus::Bytes& data = exchange.answer->telegram.data;
  return exchange.answer->right && data.size() > 1 && (data[0] & status1) == status1 && (data[1] & status2) == status2;
}

}  // namespace dsdpv1::calibrate
