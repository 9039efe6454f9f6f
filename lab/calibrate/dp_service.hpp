#pragma once
// What Set_Prm and Slave_Diag say of the station's state.
#include "lab/calibrate/conversation.hpp"

namespace dsdpv1::calibrate {

constexpr std::size_t kPrmSize = 7;                       ///< bytes of Set_Prm without those of the user
constexpr std::uint8_t kPrmFault = 0x40, kPrmReq = 0x01;  ///< of status 1 and 2

/// What an acknowledged Set_Prm asks for (S14, S28).
enum class PrmKind : std::uint8_t {
  kNone,     ///< it is no Set_Prm, was not acknowledged, or was answered from memory
  kShort,    ///< a fault
  kMinTsdr,  ///< changes min_TSDR
  kUnlock,   ///< releases the master, or is a fault
  kLock,     ///< accepted, a fault, or judged by the user
};

/// What may repeat a request that was not read counts: the other one has asked for the same just before.
PrmKind prm_kind(const Exchange& exchange);
/// The request was not read, and the answer does not say that it was no Set_Prm that changed something.
bool may_be_prm(const Exchange& exchange);
/// Slave_Diag was answered, all of these bits set. From memory, too: nothing was executed since (S26).
bool diagnosis_has(const Exchange& exchange, std::uint8_t status1, std::uint8_t status2);

}  // namespace dsdpv1::calibrate
