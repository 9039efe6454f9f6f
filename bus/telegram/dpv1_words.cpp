#include "bus/telegram/dpv1_words.hpp"

#include <fmt/format.h>

#include <array>
#include <cstddef>

namespace dsdpv1::bus {

namespace {

/// One row of table 29: sixteen codes of a class; nullptr is reserved, codes from `user_from` on belong to the user.
struct ErrorClass {
  const char* name;
  std::array<const char*, 10> codes;
  unsigned user_from;
};

constexpr ErrorClass kApplication = {"application",
                                     {"read error", "write error", "module failure", nullptr, nullptr, nullptr, nullptr,
                                      nullptr, "version conflict", "feature not supported"},
                                     10};
constexpr ErrorClass kAccess = {
    "access",
    {"invalid index", "write length error", "invalid slot", "type conflict", "invalid area", "state conflict",
     "access denied", "invalid range", "invalid parameter", "invalid type"},
    10};
constexpr ErrorClass kResource = {"resource",
                                  {"read constrain conflict", "write constrain conflict", "resource busy",
                                   "resource unavailable", nullptr, nullptr, nullptr, nullptr, nullptr, nullptr},
                                  8};

std::string class_words(const ErrorClass& row, unsigned code) {
  if (code >= row.user_from) return fmt::format("{}: user specific {}", row.name, code);
  const char* words = row.codes.at(code);
  return words != nullptr ? fmt::format("{}: {}", row.name, words) : fmt::format("{}: reserved {}", row.name, code);
}

constexpr std::array<const char*, 16> kMsac2Reasons = {nullptr,
                                                       "ABT_SE (sequence error)",
                                                       "ABT_FE (invalid request PDU)",
                                                       "ABT_TO (timeout of the connection)",
                                                       "ABT_RE (invalid response PDU)",
                                                       "ABT_IV (invalid service from the user)",
                                                       "ABT_STO (Send_Timeout too small)",
                                                       "ABT_IA (invalid additional address)",
                                                       "ABT_OC (waiting for FDL_DATA_REPLY.con)",
                                                       nullptr,
                                                       nullptr,
                                                       nullptr,
                                                       nullptr,
                                                       nullptr,
                                                       nullptr,
                                                       "ABT_RES (resource error)"};
constexpr std::array<const char*, 16> kFdlReasons = {nullptr,
                                                     "UE",
                                                     "RR",
                                                     "RS",
                                                     nullptr,
                                                     nullptr,
                                                     nullptr,
                                                     nullptr,
                                                     nullptr,
                                                     "NR",
                                                     "DH",
                                                     "LR",
                                                     "RDL",
                                                     "RDH",
                                                     "DS (master is not in the ring)",
                                                     "NA (no answer)"};

}  // namespace

const char* function_name(std::uint8_t function) {
  switch (function & ~function_num::kError) {
    case function_num::kIdle: return "Idle";
    case function_num::kTransport: return "DS_Transport";
    case function_num::kImmediate: return "Immediate answer";
    case function_num::kInitiate: return "Initiate";
    case function_num::kAbort: return "Abort";
    case function_num::kAlarmAck: return "Alarm_Ack";
    case function_num::kRead: return "DS_Read";
    case function_num::kWrite: return "DS_Write";
    default: return "unknown function";
  }
}

int alarms_in_mode(int mode) {
  constexpr std::array<int, 8> kAlarms = {0, 2, 4, 8, 12, 16, 24, 32};
  return kAlarms.at(static_cast<std::size_t>(mode));
}

std::string error_code_words(std::uint8_t error_code_1) {
  const unsigned row = error_code_1 >> 4, code = error_code_1 & 0x0FU;
  switch (row) {
    case 10: return class_words(kApplication, code);
    case 11: return class_words(kAccess, code);
    case 12: return class_words(kResource, code);
    default: return fmt::format("{} 0x{:02X}", row < 10 ? "reserved" : "user specific", error_code_1);
  }
}

const char* error_decode_name(std::uint8_t error_decode) {
  switch (error_decode) {
    case kDpv1Decode: return "DPV1";
    case 0xFE: return "PROFIBUS FMS";
    case 0xFF: return "HART";
    default: return "";
  }
}

std::string error_words(std::uint8_t error_decode, std::uint8_t error_code_1, std::uint8_t error_code_2) {
  const std::string other = error_decode == kDpv1Decode ? "" : error_decode_name(error_decode);
  if (!other.empty()) return fmt::format("error of {} 0x{:02X} 0x{:02X}", other, error_code_1, error_code_2);
  std::string words = error_code_words(error_code_1);
  if (error_code_2 != 0) words += fmt::format(", Error_Code_2 0x{:02X}", error_code_2);
  if (error_decode != kDpv1Decode) words += fmt::format(" (Error_Decode 0x{:02X}, 0x80 is right)", error_decode);
  return words;
}

std::string abort_reason_words(std::uint8_t instance_and_reason) {
  const unsigned instance = (instance_and_reason >> 4) & 3U;
  const std::size_t reason = instance_and_reason & 0x0FU;
  if (instance == abort_instance::kUser) return fmt::format("user: reason {}", reason);
  if (instance > abort_instance::kUser) return fmt::format("reserved instance, reason {}", reason);
  const bool fdl = instance == abort_instance::kFdl;
  const char* words = (fdl ? kFdlReasons : kMsac2Reasons).at(reason);
  const char* who = fdl ? "FDL" : "MSAC_C2";
  return words != nullptr ? fmt::format("{}: {}", who, words) : fmt::format("{}: reserved reason {}", who, reason);
}

std::string subnet_words(std::uint8_t subnet) {
  switch (subnet) {
    case 0: return "no subnet";
    case 1: return "local subnet";
    case 2: return "remote subnet";
    default: return fmt::format("subnet {} (reserved)", subnet);
  }
}

}  // namespace dsdpv1::bus
