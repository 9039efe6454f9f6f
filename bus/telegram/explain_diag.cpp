// Slave_Diag: the six standard bytes and the device, identifier and channel related blocks after them; device related
// ones are a status or an alarm of a slot in DPV1.
#include <fmt/format.h>

#include <algorithm>

#include "bus/telegram/explain_data.hpp"

namespace dsdpv1::bus::detail {

namespace {

const char* const kStatus1[8] = {"Station_Non_Existent", "Station_Not_Ready",      "Cfg_Fault", "Ext_Diag",
                                 "Not_Supported",        "Invalid_Slave_Response", "Prm_Fault", "Master_Lock"};
const char* const kStatus2[8] = {"Prm_Req",     "Stat_Diag", "DP slave", "WD_On",
                                 "Freeze_Mode", "Sync_Mode", "",         "Deactivated"};
const char* const kStatus3[8] = {"", "", "", "", "", "", "", "Ext_Diag_Overflow"};

const char* channel_kind(std::uint8_t byte) {
  switch (byte >> 6) {
    case 1: return "input ";
    case 2: return "output ";
    case 3: return "input/output ";
    default: return "";
  }
}

const char* channel_type(std::uint8_t byte) {
  static constexpr const char* kTypes[8] = {"unspecified", "bit",  "2 bits",  "4 bits",
                                            "byte",        "word", "2 words", "reserved type"};
  return kTypes[byte >> 5];
}

std::string channel_error(std::uint8_t byte) {
  static constexpr const char* kErrors[] = {
      "reserved error",  "short circuit", "undervoltage",         "overvoltage",          "overload",
      "overtemperature", "line break",    "upper limit exceeded", "lower limit exceeded", "error"};
  const unsigned error = byte & 0x1FU;
  if (error < 10) return kErrors[error];
  return error < 16 ? fmt::format("reserved error {}", error) : fmt::format("manufacturer's error {}", error);
}

std::string modules_words(std::uint8_t bits, std::size_t first) {
  std::string text;
  for (std::size_t bit = 0; bit < 8; ++bit)
    if (((bits >> bit) & 1U) != 0) text += fmt::format("{}{}", text.empty() ? "" : ", ", first + bit);
  return text.empty() ? fmt::format("modules {} to {}: no diagnosis", first, first + 7) : "diagnosis of module " + text;
}

const char* alarm_type(unsigned type) {
  static constexpr const char* kTypes[] = {"reserved", "diagnosis", "process", "pull", "plug", "status", "update"};
  if (type < 7) return kTypes[type];
  return type >= 32 && type < 127 ? "manufacturer specific" : "reserved";
}

const char* status_type(unsigned type) {
  switch (type) {
    case 1: return "status message";
    case 2: return "Module_Status";
    case 3: return "DXB_Link_Status";
    case 30: return "PrmCmdAck";
    case 31: return "Red_State";
    default: return type >= 32 && type < 127 ? "manufacturer specific" : "reserved";
  }
}

const char* specifier_words(std::uint8_t byte) {
  static constexpr const char* kWords[4] = {"no further differentiation", "appears", "disappears, slot all right",
                                            "disappears, slot still disturbed"};
  return kWords[byte & 3U];
}

/// Two bits per module, the first module lowest.
std::string module_status_words(std::uint8_t byte, std::size_t first) {
  static constexpr const char* kWords[4] = {"valid data", "invalid data (error)", "wrong module", "no module"};
  std::string text = "module status:";
  for (std::size_t i = 0; i < 4; ++i)
    text += fmt::format("{} {} {}", i == 0 ? "" : ",", first + i, kWords[(byte >> (2 * i)) & 3U]);
  return text;
}

/// Byte `i` of a device related block in DPV1: a status or an alarm of a slot. `type` is that of byte 1.
std::string dpv1_block_words(std::uint8_t type, std::size_t i, std::uint8_t byte) {
  const bool status = (type & 0x80U) != 0;
  const unsigned number = type & 0x7FU;
  switch (i) {
    case 1: return status ? fmt::format("Status_Type: {}", status_type(number)) : alarm_type_words(type);
    case 2: return fmt::format("Slot_Number: {}", byte);
    case 3: return status ? fmt::format("Status_Specifier: {}", specifier_words(byte)) : alarm_specifier_words(byte);
    default:
      if (status && number == 2) return module_status_words(byte, 4 * (i - 4) + 1);
      return fmt::format("Diagnosis_User_Data {}", i - 4);
  }
}

/// Iterates over the blocks after the standard diagnosis.
class ExtDiagReader {
 public:
  ExtDiagReader(const Bytes& data, std::optional<bool> dpv1, DataWords& words)
      : data_(data), dpv1_(dpv1), words_(words) {}

  void read() {
    while (at_ < data_.size()) read_block();
  }

 private:
  void read_block() {
    switch (data_[at_] >> 6) {
      case 0: return read_device();
      case 1: return read_identifiers();
      case 2: return read_channel();
      default: say(fmt::format("revision number {}", data_[at_] & 0x3F));
    }
  }

  /// Explains the header of a block; returns the end of the block.
  std::size_t read_header(const char* kind) {
    const std::size_t length = data_[at_] & 0x3FU, begin = at_;
    const bool fits = length > 0 && begin + length <= data_.size();
    say(fmt::format("{} diagnosis, block of {} bytes{}", kind, length, fits ? "" : " (does not fit the telegram)"));
    return std::min(begin + length, data_.size());
  }

  void read_identifiers() {
    const std::size_t begin = at_, end = read_header("identifier related");
    while (at_ < end) say(modules_words(data_[at_], (at_ - begin - 1) * 8));
  }

  /// In DPV1 a block of at least four bytes is a status or an alarm; without DPV1 its content is manufacturer specific.
  void read_device() {
    constexpr std::size_t kLeastDpv1 = 4;
    const std::size_t begin = at_, end = read_header("device related");
    const bool may_be_dpv1 = end - begin >= kLeastDpv1 && dpv1_.value_or(true);
    while (at_ < end) {
      const std::size_t i = at_ - begin;
      const std::string plain = fmt::format("device related byte {}: 0x{:02X}", i, data_[at_]);
      const std::string words = may_be_dpv1 ? dpv1_block_words(data_[begin + 1], i, data_[at_]) : "";
      say(!may_be_dpv1 ? plain : dpv1_ ? words : fmt::format("{}, in DPV1 {}", plain, words));
    }
  }

  void read_channel() {
    say(fmt::format("channel related diagnosis, module {}", data_[at_] & 0x3F));
    if (at_ < data_.size()) say(fmt::format("{}channel {}", channel_kind(data_[at_]), data_[at_] & 0x3F));
    if (at_ < data_.size()) say(fmt::format("{}, {}", channel_type(data_[at_]), channel_error(data_[at_])));
  }

  void say(std::string text) {
    words_.bytes.push_back(std::move(text));
    ++at_;
  }

  const Bytes& data_;
  std::optional<bool> dpv1_;
  DataWords& words_;
  std::size_t at_ = 6;
};

std::string master_words(std::uint8_t address) {
  return address == 255 ? "Master_Add: none" : fmt::format("Master_Add: {}", address);
}

}  // namespace

DataWords diag_words(const Bytes& data, std::optional<bool> dpv1) {
  if (data.size() < 6) {
    DataWords words = plain_words("diagnosis byte", data);
    words.summary = fmt::format("{} bytes, at least 6 are needed", data.size());
    return words;
  }
  DataWords words;
  words.bytes = {
      "Station_status_1: " + bit_names(data[0], kStatus1), "Station_status_2: " + bit_names(data[1], kStatus2),
      "Station_status_3: " + bit_names(data[2], kStatus3), master_words(data[3]),
      fmt::format("Ident_Number high: 0x{:02X}", data[4]), fmt::format("Ident_Number low: 0x{:02X}", data[5])};
  ExtDiagReader(data, dpv1, words).read();
  const auto status2 = static_cast<std::uint8_t>(data[1] & ~0x04U);  // bit 2 is always set and has no meaning
  words.summary =
      fmt::format("[{}] [{}]{}, {}, ident 0x{:02X}{:02X}", bit_names(data[0], kStatus1), bit_names(status2, kStatus2),
                  (data[2] & 0x80U) != 0 ? " [Ext_Diag_Overflow]" : "", master_words(data[3]), data[4], data[5]);
  if (data.size() > 6) words.summary += fmt::format(", {} bytes of Ext_Diag_Data", data.size() - 6);
  return words;
}

std::string alarm_type_words(std::uint8_t byte) {
  return fmt::format("Alarm_Type: {} alarm", alarm_type(byte & 0x7FU));
}

std::string alarm_specifier_words(std::uint8_t byte) {
  return fmt::format("Alarm_Specifier: {}{}, sequence number {}", specifier_words(byte),
                     (byte & 4U) != 0 ? ", Add_Ack" : "", byte >> 3);
}

}  // namespace dsdpv1::bus::detail
