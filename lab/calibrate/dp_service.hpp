#pragma once
// Conclusions from Set_Prm and Slave_Diag about the station's state.
#include "lab/calibrate/conversation.hpp"

namespace dsdpv1::calibrate {

constexpr std::size_t kPrmSize = 7;                       ///< bytes of Set_Prm without those of the user
constexpr std::uint8_t kPrmFault = 0x40, kPrmReq = 0x01;  ///< of status 1 and 2

/// The effect that an acknowledged Set_Prm asks for (S14, S28).
enum class PrmKind : std::uint8_t {
  kNone,     ///< not a Set_Prm, not acknowledged, or answered from memory
  kShort,    ///< a fault
  kMinTsdr,  ///< changes min_TSDR
  kUnlock,   ///< releases the master, or is a fault
  kLock,     ///< accepted, a fault, or judged by the user
};

/// A possible repetition of an unread request counts: that request asked for the same just before.
PrmKind prm_kind(const Exchange& exchange);
/// The request was not read, and the answer does not rule out a Set_Prm that changed something.
bool may_be_prm(const Exchange& exchange);
/// Slave_Diag was answered, all of these bits set. From memory, too: nothing was executed since (S26).
bool diagnosis_has(const Exchange& exchange, std::uint8_t status1, std::uint8_t status2);

}  // namespace dsdpv1::calibrate
