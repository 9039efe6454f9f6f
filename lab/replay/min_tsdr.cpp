#include "lab/replay/min_tsdr.hpp"

#include <algorithm>

#include "lab/replay/services.hpp"

namespace dsdpv1::tb::replay {
namespace {

constexpr std::size_t kMinTsdrByte = 3;  // of Set_Prm

}  // namespace

void MinTsdr::take(const bus::Telegram& request, const RecordedTelegram* answer) {
  if (is_service(request, bus::sap::kSetPrm)) return set_prm(request, answer);
  const bus::Bytes* diagnosis = diagnosis_of(request, answer);
  if (diagnosis != nullptr && ((*diagnosis)[1] & kPrmReq) != 0)
    possible_.insert(bus::kMinTsdrBits);  // the slave may have restarted
  if (!asked_ || !exchanged(request, answer)) return;
  possible_ = {*asked_};  // a slave in data exchange has accepted the last Set_Prm
  asked_.reset();
}

/// SC does not say that it was accepted (S14), and a user judges later (S11): until data are exchanged the earlier
/// value may be in force as well. RS (S12, S33), an Unlock (S17), a short one (S14) and 0 (S6) leave it.
void MinTsdr::set_prm(const bus::Telegram& request, const RecordedTelegram* answer) {
  const bool heard = answer != nullptr && answer->right();
  if (heard && !acknowledged(answer)) return;
  if (request.data.size() < kPrmHead || (request.data[0] & kUnlockReq) != 0) return;
  const std::uint8_t bits = request.data[kMinTsdrByte];
  const bool parameterises = (request.data[0] & kLockReq) != 0;
  if (bits == 0) {
    if (parameterises) asked_.reset();
    return;
  }
  const int value = within_limits(bits);
  if (!parameterises && heard) possible_.clear();  // always accepted (S28)
  if (asked_) possible_.insert(*asked_);
  possible_.insert(value);
  asked_ = parameterises && heard ? std::optional<int>(value) : std::nullopt;
}

int MinTsdr::within_limits(std::uint8_t bits) const {
  return std::clamp<int>(bits, bus::kMinTsdrBits, bus::baud(baud_).max_tsdr_bits);
}

}  // namespace dsdpv1::tb::replay
