// Slave_Diag: the six standard bytes and the device, identifier and channel related blocks behind them.
#include <fmt/format.h>

#include "bus/explain_data.hpp"

namespace bus::detail {

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
  for (std::size_t bit = 0; bit < 8; ++bit) {
    if (((bits >> bit) & 1U) != 0) text += fmt::format("{}{}", text.empty() ? "" : ", ", first + bit);
  }
  return text.empty() ? fmt::format("modules {} to {}: no diagnosis", first, first + 7) : "diagnosis of module " + text;
}

/// Walks over the blocks behind the standard diagnosis.
class ExtDiagReader {
 public:
  ExtDiagReader(const Bytes& data, DataWords& words) : data_(data), words_(words) {}

  void read() {
    while (at_ < data_.size()) read_block();
  }

 private:
  void read_block() {
    switch (data_[at_] >> 6) {
      case 0: return read_sized("device related");
      case 1: return read_sized("identifier related");
      case 2: return read_channel();
      default: say(fmt::format("revision number {}", data_[at_] & 0x3F));
    }
  }

  void read_sized(const char* kind) {
    const std::size_t length = data_[at_] & 0x3FU;
    const bool identifiers = (data_[at_] & 0x40U) != 0;
    const bool fits = length > 0 && at_ + length <= data_.size();
    say(fmt::format("{} diagnosis, block of {} bytes{}", kind, length, fits ? "" : " (does not fit the telegram)"));
    for (std::size_t i = 1; i < length && at_ < data_.size(); ++i) {
      say(identifiers ? modules_words(data_[at_], (i - 1) * 8)
                      : fmt::format("device related byte {}: 0x{:02X}", i, data_[at_]));
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
  DataWords& words_;
  std::size_t at_ = 6;
};

std::string master_words(std::uint8_t address) {
  return address == 255 ? "Master_Add: none" : fmt::format("Master_Add: {}", address);
}

}  // namespace

DataWords diag_words(const Bytes& data) {
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
  ExtDiagReader(data, words).read();
  const auto status2 = static_cast<std::uint8_t>(data[1] & ~0x04U);  // bit 2 is always set: it says nothing
  words.summary =
      fmt::format("[{}] [{}]{}, {}, ident 0x{:02X}{:02X}", bit_names(data[0], kStatus1), bit_names(status2, kStatus2),
                  (data[2] & 0x80U) != 0 ? " [Ext_Diag_Overflow]" : "", master_words(data[3]), data[4], data[5]);
  if (data.size() > 6) words.summary += fmt::format(", {} bytes of Ext_Diag_Data", data.size() - 6);
  return words;
}

}  // namespace bus::detail
