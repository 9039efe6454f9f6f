// Global_Control, Set_Slave_Address and process data (tables 21 to 23).
#include <fmt/format.h>

#include "bus/telegram/explain_data.hpp"

namespace dsdpv1::bus::detail {

DataWords plain_words(const std::string& what, const Bytes& data) {
  DataWords words;
  words.summary = data.empty() ? fmt::format("no {}", what) : fmt::format("{} {}", what, hex(data));
  for (std::size_t i = 0; i < data.size(); ++i) words.bytes.push_back(fmt::format("{} {}", what, i));
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

std::string group_words(const char* name, std::uint8_t byte, const char* zero) {
  if (byte == 0) return fmt::format("{}: {}", name, zero);
  std::string groups;
  for (int bit = 0; bit < 8; ++bit)
    if (((byte >> bit) & 1) != 0) groups += fmt::format("{}{}", groups.empty() ? "" : ", ", bit + 1);
  return fmt::format("{}: group {}", name, groups);
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

}  // namespace dsdpv1::bus::detail
