#pragma once
// Requests and answers of a capture by their meaning.
#include "bus/telegram/explain.hpp"
#include "lab/replay/recording.hpp"

namespace dsdpv1::tb::replay {

// Set_Prm: bytes before those of the user, and bits of the first one (table 19).
constexpr std::size_t kPrmHead = 7;
constexpr std::uint8_t kLockReq = 0x80, kUnlockReq = 0x40, kWdOn = 0x08;
// Bits of the first two bytes of Slave_Diag (table 22).
constexpr std::uint8_t kStationNotReady = 0x02, kCfgFault = 0x04, kExtDiag = 0x08, kNotSupported = 0x10,
                       kPrmFault = 0x40;
constexpr std::uint8_t kPrmReq = 0x01, kStatDiag = 0x02, kWatchdogOn = 0x08;
constexpr std::uint8_t kNoMaster = 0xFF;  ///< Master_Add of Slave_Diag
constexpr std::size_t kDiagHead = 6;      ///< bytes before those of the user

/// SRD to this SAP; SDA to it is refused, and SDN not answered (S20).
inline bool is_service(const bus::Telegram& request, std::uint8_t dsap) {
  const std::uint8_t function = request.function();
  return request.dsap == dsap && (function == bus::fc::kSrdLow || function == bus::fc::kSrdHigh);
}

inline bool is_data_exchange(const bus::Telegram& request) {
  return !request.dsap && bus::explain_service(request) == "Data_Exchange";
}

/// Null for a missing or wrong one.
inline const bus::Telegram* right_answer(const RecordedTelegram* answer) {
  return answer != nullptr && answer->right() ? &answer->decoded.telegram : nullptr;
}

inline bool acknowledged(const RecordedTelegram* answer) {
  const bus::Telegram* telegram = right_answer(answer);
  return telegram != nullptr && telegram->kind == bus::TelegramKind::kSc;
}

inline bool refused(const bus::Telegram& answer) {
  return answer.kind == bus::TelegramKind::kSd1 &&
         (answer.function() == bus::fc::kRs || answer.function() == bus::fc::kRr);
}

/// Data were exchanged.
inline bool exchanged(const bus::Telegram& request, const RecordedTelegram* answer) {
  const bus::Telegram* telegram = right_answer(answer);
  return is_data_exchange(request) && telegram != nullptr && !refused(*telegram);
}

/// The bytes of a Slave_Diag answer; null for any other.
inline const bus::Bytes* diagnosis_of(const bus::Telegram& request, const RecordedTelegram* answer) {
  const bus::Telegram* telegram = right_answer(answer);
  if (!is_service(request, bus::sap::kSlaveDiag) || telegram == nullptr || telegram->data.size() < kDiagHead)
    return nullptr;
  return &telegram->data;
}

/// Walks over the requests with their answers, in order.
template <class Take>
void for_each_request(const Recording& recording, const Take& take) {
  for (const RecordedRequest& each : recording.requests)
    take(recording.request(each).decoded.telegram, recording.answer(each));
}

}  // namespace dsdpv1::tb::replay
