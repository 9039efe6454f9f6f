// Set_Prm, Global_Control, Set_Slave_Address and process data (tables 18 to 23).
#include <fmt/format.h>

#include "bus/explain_data.hpp"

namespace bus::detail {

namespace {

const char* lock_words(std::uint8_t station_status) {
  switch (station_status >> 6) {
    case 0: return "only min_TSDR changes";
    case 2: return "locked for this master";
    default: return "released for other masters";
  }
}

std::string station_status_words(std::uint8_t byte) {
  static constexpr const char* kNames[8] = {"", "", "", "WD_On", "Freeze_Req", "Sync_Req", "Unlock_Req", "Lock_Req"};
  return fmt::format("Station_status: {} ({})", bit_names(byte, kNames), lock_words(byte));
}

std::string min_tsdr_words(std::uint8_t byte) {
  return byte == 0 ? "min_TSDR: 0 = unchanged" : fmt::format("min_TSDR: {} bit times", byte);
}

std::string group_words(const char* name, std::uint8_t byte, const char* zero) {
  if (byte == 0) return fmt::format("{}: {}", name, zero);
  std::string groups;
  for (int bit = 0; bit < 8; ++bit) {
    if (((byte >> bit) & 1) != 0) groups += fmt::format("{}{}", groups.empty() ? "" : ", ", bit + 1);
  }
  return fmt::format("{}: group {}", name, groups);
}

std::string prm_header_words(const Bytes& data, std::size_t i) {
  switch (i) {
    case 0: return station_status_words(data[i]);
    case 1: return fmt::format("WD_Fact_1: {}", data[i]);
    case 2: return fmt::format("WD_Fact_2: {}", data[i]);
    case 3: return min_tsdr_words(data[i]);
    case 4: return fmt::format("Ident_Number high: 0x{:02X}", data[i]);
    case 5: return fmt::format("Ident_Number low: 0x{:02X}", data[i]);
    default: return group_words("Group_Ident", data[i], "none");
  }
}

std::string prm_user_words(const Bytes& data, std::size_t i) {
  static constexpr const char* kStatus1[8] = {"Dis_Startbit", "Dis_Stopbit", "WD_Base_1ms", "", "", "",
                                              "Fail_Safe",    "DPV1_Enable"};
  const bool dpv1 = (data[7] & 0x80U) != 0;
  if (i == 7) return fmt::format("{}: {}", dpv1 ? "DPV1_Status_1" : "Spec_User_Prm_Byte", bit_names(data[i], kStatus1));
  if (dpv1 && i < 10) return fmt::format("DPV1_Status_{}: 0x{:02X}", i - 6, data[i]);
  return fmt::format("User_Prm_Data {}", i - (dpv1 ? 10 : 8));
}

std::string watchdog_words(const Bytes& data) {
  if ((data[0] & 0x08U) == 0) return "WD off";
  const int base = data.size() > 7 && (data[7] & 0x04U) != 0 ? 1 : 10;
  return fmt::format("WD {} ms", data[1] * data[2] * base);
}

}  // namespace

DataWords plain_words(const std::string& what, const Bytes& data) {
  DataWords words;
  words.summary = data.empty() ? fmt::format("no {}", what) : fmt::format("{} {}", what, hex(data));
  for (std::size_t i = 0; i < data.size(); ++i) words.bytes.push_back(fmt::format("{} {}", what, i));
  return words;
}

DataWords set_prm_words(const Bytes& data) {
  DataWords words;
  for (std::size_t i = 0; i < data.size(); ++i) {
    words.bytes.push_back(i < 7 ? prm_header_words(data, i) : prm_user_words(data, i));
  }
  if (data.size() < 7) {
    words.summary = fmt::format("{} bytes, at least 7 are needed", data.size());
    return words;
  }
  words.summary = fmt::format("ident 0x{:02X}{:02X}, {}, {}, {}, user bytes {}", data[4], data[5], lock_words(data[0]),
                              watchdog_words(data), min_tsdr_words(data[3]), data.size() - 7);
  return words;
}

DataWords global_control_words(const Bytes& data) {
  static constexpr const char* kNames[8] = {"", "Clear_Data", "Unfreeze", "Freeze", "Unsync", "Sync", "", ""};
  DataWords words = plain_words("surplus byte", data);
  if (data.size() != 2) {
    words.summary = fmt::format("{} bytes instead of 2", data.size());
    return words;
  }
  const std::string command = data[0] == 0 ? "operate" : bit_names(data[0], kNames);
  words.bytes[0] = "Control_Command: " + command;
  words.bytes[1] = group_words("Group_Select", data[1], "all groups");
  words.summary = command + ", " + words.bytes[1];
  return words;
}

DataWords set_slave_address_words(const Bytes& data) {
  DataWords words = plain_words("Rem_Slave_Data", data);
  if (data.size() < 4) {
    words.summary = fmt::format("{} bytes, at least 4 are needed", data.size());
    return words;
  }
  words.bytes[0] = fmt::format("New_Slave_Address: {}", data[0]);
  words.bytes[1] = fmt::format("Ident_Number high: 0x{:02X}", data[1]);
  words.bytes[2] = fmt::format("Ident_Number low: 0x{:02X}", data[2]);
  words.bytes[3] = data[3] == 0 ? "No_Add_Chg: later changes allowed" : "No_Add_Chg: no later change";
  for (std::size_t i = 4; i < data.size(); ++i) words.bytes[i] = fmt::format("Rem_Slave_Data {}", i - 4);
  words.summary = fmt::format("new address {}, ident 0x{:02X}{:02X}, {}", data[0], data[1], data[2],
                              data[3] == 0 ? "later changes allowed" : "no later change");
  return words;
}

std::string bit_names(std::uint8_t byte, const char* const (&names)[8]) {
  std::string text;
  for (unsigned bit = 0; bit < 8; ++bit) {
    if (((byte >> bit) & 1U) == 0) continue;
    if (!text.empty()) text += ", ";
    text += *names[bit] != '\0' ? std::string(names[bit]) : fmt::format("bit {}", bit);
  }
  return text.empty() ? "none" : text;
}

std::string hex(const Bytes& bytes) {
  std::string text;
  for (const std::uint8_t byte : bytes) text += fmt::format("{}{:02X}", text.empty() ? "" : " ", byte);
  return text;
}

}  // namespace bus::detail
