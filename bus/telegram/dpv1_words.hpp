#pragma once
// Texts of DPV1: services, error codes (tables 28 and 29), abort reasons (EN 50170 part 8, as listed in vendors'
// manuals).
#include <cstdint>
#include <string>

namespace dsdpv1::bus {

/// Function_Num (tables 26 and 31, ruling V2).
namespace function_num {
constexpr std::uint8_t kIdle = 0x48, kTransport = 0x51, kImmediate = 0x56, kInitiate = 0x57, kAbort = 0x58,
                       kAlarmAck = 0x5C, kRead = 0x5E, kWrite = 0x5F, kError = 0x80;
}

/// "DS_Read", "Initiate", ...; ignores bit 7; "unknown function" for others.
const char* function_name(std::uint8_t function);

/// Alarms open at once in all in Alarm_Mode 1 to 7 (DPV1_Status_3); 0 in mode 0, which allows one of each type.
int alarms_in_mode(int mode);

/// Error_Code_1: "access: invalid index"; "user specific ..." and "reserved ..." according to the table.
std::string error_code_words(std::uint8_t error_code_1);
constexpr std::uint8_t kDpv1Decode = 0x80;  ///< table 28: the only Error_Decode there; IEC 61158 has FE and FF too
/// "DPV1", "PROFIBUS FMS", "HART"; empty for a reserved one.
const char* error_decode_name(std::uint8_t error_decode);
/// A negative answer: "access: invalid index"; names Error_Decode if it is not 0x80, Error_Code_2 if it is not 0.
std::string error_words(std::uint8_t error_decode, std::uint8_t error_code_1, std::uint8_t error_code_2);

/// The instance that aborts a connection, and its reason (byte 2 of the abort PDU: instance in bits 5 and 4, reason in
/// bits 3 to 0).
namespace abort_instance {
constexpr std::uint8_t kFdl = 0, kMsac2 = 1, kUser = 2;
}
/// Reasons of instance MSAC_C2.
namespace abort_reason {
constexpr std::uint8_t kSequence = 1;        ///< ABT_SE: service not allowed in this state
constexpr std::uint8_t kFormat = 2;          ///< ABT_FE: invalid request PDU
constexpr std::uint8_t kTimeout = 3;         ///< ABT_TO
constexpr std::uint8_t kResponse = 4;        ///< ABT_RE: invalid response PDU
constexpr std::uint8_t kInvalidService = 5;  ///< ABT_IV: invalid service from the user
constexpr std::uint8_t kSendTimeout = 6;     ///< ABT_STO: Send_Timeout too small
constexpr std::uint8_t kInvalidAddress = 7;  ///< ABT_IA: invalid additional address
constexpr std::uint8_t kReplyPending = 8;    ///< ABT_OC: waiting for FDL_DATA_REPLY.con
constexpr std::uint8_t kResource = 15;       ///< ABT_RES
}  // namespace abort_reason

/// "MSAC_C2: ABT_TO (timeout of the connection)".
std::string abort_reason_words(std::uint8_t instance_and_reason);
/// "no subnet", "local subnet", "remote subnet", "subnet 7 (reserved)".
std::string subnet_words(std::uint8_t subnet);

}  // namespace dsdpv1::bus
