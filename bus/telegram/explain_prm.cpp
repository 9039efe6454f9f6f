// Set_Prm (tables 18 to 20): the seven standard bytes, the three DPV1 bytes, and user parameters, in blocks if
// DPV1_Status_3 says so (Prm_Structure; EN 50170 with its DPV1 extensions, IEC 61158-6).
#include <fmt/format.h>

#include "bus/telegram/dpv1_words.hpp"
#include "bus/telegram/explain_data.hpp"

namespace dsdpv1::bus::detail {

namespace {

constexpr std::size_t kStandard = 7, kStatus1 = 7, kStatus2 = 8, kStatus3 = 9, kUserDpv1 = 10, kUser = 8;
constexpr std::uint8_t kDpv1Enable = 0x80, kPrmStructure = 0x08;

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

std::string status_1_words(std::uint8_t byte, bool dpv1) {
  static constexpr const char* kNames[8] = {"Dis_Startbit",     "Dis_Stopbit", "WD_Base_1ms", "", "",
                                            "Publisher_Enable", "Fail_Safe",   "DPV1_Enable"};
  return fmt::format("{}: {}", dpv1 ? "DPV1_Status_1" : "Spec_User_Prm_Byte", bit_names(byte, kNames));
}

std::string status_2_words(std::uint8_t byte) {
  static constexpr const char* kNames[8] = {"Check_Cfg_Mode",
                                            "",
                                            "Enable_Update_Alarm",
                                            "Enable_Status_Alarm",
                                            "Enable_Manufacturer_Specific_Alarm",
                                            "Enable_Diagnostic_Alarm",
                                            "Enable_Process_Alarm",
                                            "Enable_Pull_Plug_Alarm"};
  return "DPV1_Status_2: " + bit_names(byte, kNames);
}

std::string status_3_words(std::uint8_t byte) {
  static constexpr const char* kNames[8] = {"", "", "", "Prm_Structure", "IsoM_Req", "", "", "PrmCmd"};
  const int mode = byte & 0x07;
  const std::string alarms =
      mode == 0 ? "one alarm of each type" : fmt::format("{} alarms in all", alarms_in_mode(mode));
  const auto others = static_cast<std::uint8_t>(byte & 0xF8U);
  return fmt::format("DPV1_Status_3: Alarm_Mode {} ({} at a time){}{}", mode, alarms, others == 0 ? "" : ", ",
                     others == 0 ? "" : bit_names(others, kNames));
}

/// The fields of a block after its four header bytes: names used once, then names that repeat.
struct BlockFields {
  const char* name;
  std::vector<const char*> once, again;
};

BlockFields block_fields(std::uint8_t type) {
  switch (type) {
    case 2: return {"PrmCmd", {"Function", "Properties", "Output_Hold_Time high", "Output_Hold_Time low"}, {}};
    case 3:
      return {"DXB_Linktable", {"Version"}, {"Publisher_Addr", "Publisher_Length", "Sample_Offset", "Sample_Length"}};
    case 4:
      return {"IsoM_Parameter",
              {"Version",  "T_BASE_DP 3", "T_BASE_DP 2",  "T_BASE_DP 1", "T_BASE_DP 0",  "T_DP high",
               "T_DP low", "T_MAPC",      "T_BASE_IO 3",  "T_BASE_IO 2", "T_BASE_IO 1",  "T_BASE_IO 0",
               "T_I high", "T_I low",     "T_O high",     "T_O low",     "T_DX 3",       "T_DX 2",
               "T_DX 1",   "T_DX 0",      "T_PLL_W high", "T_PLL_W low", "T_PLL_D high", "T_PLL_D low"},
              {}};
    case 5:
      return {"F_Parameter",
              {"F_Prm_Flag1", "F_Prm_Flag2", "F_Source_Add high", "F_Source_Add low", "F_Dest_Add high",
               "F_Dest_Add low", "F_WD_Time high", "F_WD_Time low"},
              {}};
    case 7:
      return {"DXB_Subscribertable",
              {"Version"},
              {"Publisher_Addr", "Publisher_Length", "Sample_Offset", "Dest_Slot_Number", "Offset_Data_Area",
               "Sample_Length"}};
    case 8: return {"Time_AR_Parameter", {}, {}};
    case 129: return {"User_Prm_Data", {}, {}};
    default: return {type >= 32 && type <= 128 ? "manufacturer specific" : "reserved", {}, {}};
  }
}

/// Iterates over the blocks of structured user parameters.
class BlockReader {
 public:
  BlockReader(const Bytes& data, DataWords& words) : data_(data), words_(words) {}

  void read() {
    while (at_ < data_.size() && read_block()) {
    }
    for (std::size_t i = 0; at_ < data_.size(); ++i) say(fmt::format("no block: byte {}", i));
  }

 private:
  static constexpr std::size_t kHeader = 4;

  /// Returns false if the length does not give the begin of the next block.
  bool read_block() {
    const std::size_t length = data_[at_], left = data_.size() - at_;
    const char* wrong = length < kHeader ? " (at least 4 are right)"
                        : length > left  ? " (does not fit the telegram)"
                                         : "";
    say(fmt::format("Structure_Length: {}{}", length, wrong));
    if (length < kHeader) return false;
    const std::size_t end = std::min(data_.size(), at_ - 1 + length);
    read_header(end);
    return true;
  }

  void read_header(std::size_t end) {
    if (at_ == end) return;
    const BlockFields fields = block_fields(data_[at_]);
    say(fmt::format("Structure_Type: {} ({})", data_[at_], fields.name));
    if (at_ < end) say(fmt::format("Slot_Number: {}", data_[at_]));
    if (at_ < end) say(fmt::format("Specifier: 0x{:02X}", data_[at_]));
    for (std::size_t i = 0; at_ < end; ++i) say(fmt::format("  {}: 0x{:02X}", field_name(fields, i), data_[at_]));
  }

  static std::string field_name(const BlockFields& fields, std::size_t i) {
    if (i < fields.once.size()) return fields.once[i];
    const std::size_t rest = i - fields.once.size();
    if (fields.again.empty()) return fmt::format("data {}", i);
    return fmt::format("{} {}", fields.again[rest % fields.again.size()], rest / fields.again.size() + 1);
  }

  void say(std::string text) {
    words_.bytes.push_back(std::move(text));
    ++at_;
  }

  const Bytes& data_;
  DataWords& words_;
  std::size_t at_ = kUserDpv1;
};

void read_user(const Bytes& data, DataWords& words) {
  const bool dpv1 = (data[kStatus1] & kDpv1Enable) != 0;
  words.bytes.push_back(status_1_words(data[kStatus1], dpv1));
  if (dpv1 && data.size() > kStatus2) words.bytes.push_back(status_2_words(data[kStatus2]));
  if (dpv1 && data.size() > kStatus3) words.bytes.push_back(status_3_words(data[kStatus3]));
  if (dpv1 && data.size() > kUserDpv1 && (data[kStatus3] & kPrmStructure) != 0) return BlockReader(data, words).read();
  const std::size_t first = dpv1 ? kUserDpv1 : kUser;
  for (std::size_t i = first; i < data.size(); ++i) words.bytes.push_back(fmt::format("User_Prm_Data {}", i - first));
}

std::string watchdog_words(const Bytes& data) {
  if ((data[0] & 0x08U) == 0) return "WD off";
  const int base = data.size() > kStatus1 && (data[kStatus1] & 0x04U) != 0 ? 1 : 10;
  return fmt::format("WD {} ms", data[1] * data[2] * base);
}

}  // namespace

DataWords set_prm_words(const Bytes& data) {
  DataWords words;
  for (std::size_t i = 0; i < std::min(data.size(), kStandard); ++i) words.bytes.push_back(prm_header_words(data, i));
  if (data.size() > kStatus1) read_user(data, words);
  if (data.size() < kStandard) {
    words.summary = fmt::format("{} bytes, at least 7 are needed", data.size());
    return words;
  }
  words.summary = fmt::format("ident 0x{:02X}{:02X}, {}, {}, {}, user bytes {}", data[4], data[5], lock_words(data[0]),
                              watchdog_words(data), min_tsdr_words(data[3]), data.size() - kStandard);
  return words;
}

std::optional<bool> dpv1_enabled(const Telegram& t) {
  constexpr unsigned kLock = 2;
  const bool set_prm = t.is_request() && t.dsap == sap::kSetPrm && t.data.size() >= kStandard;
  if (!set_prm || (t.data[0] >> 6U) != kLock) return std::nullopt;
  return t.data.size() > kStatus1 && (t.data[kStatus1] & kDpv1Enable) != 0;
}

}  // namespace dsdpv1::bus::detail
