#include "bus/gsd/keywords.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <unordered_map>

#include "bus/gsd/text.hpp"

namespace dsdpv1::bus::gsd {
namespace {

constexpr std::int64_t kU8 = 0xFF, kU16 = 0xFFFF, kU32 = 0xFFFFFFFF;

constexpr Keyword flag(std::string_view name) { return {name, Kind::kNumber, 0, 1}; }
constexpr Keyword number(std::string_view name, std::int64_t high, std::int64_t low = 0) {
  return {name, Kind::kNumber, low, high};
}
constexpr Keyword text(std::string_view name, std::int64_t length = 32) { return {name, Kind::kText, 0, length}; }
constexpr Keyword any(std::string_view name) { return {name, Kind::kAny, 0, 0}; }

const Keyword kKeywords[] = {
    // general
    number("GSD_Revision", kU8),
    text("Vendor_Name"),
    text("Model_Name"),
    text("Revision"),
    number("Revision_Number", 63),
    number("Ident_Number", kU16),
    number("Protocol_Ident", kU8),
    number("Station_Type", kU8),
    flag("FMS_supp"),
    text("Hardware_Release"),
    text("Software_Release"),
    flag("Redundancy"),
    number("Repeater_Ctrl_Sig", 2),
    number("24V_Pins", 2),
    text("Implementation_Type"),
    text("Bitmap_Device", 255),
    text("Bitmap_Diag", 255),
    text("Bitmap_SF", 255),
    text("OrderNumber"),
    text("Info_Text", 256),
    text("Periphery"),
    any("Slave_Family"),
    text("Family_Name"),
    // DP slave
    flag("Freeze_Mode_supp"),
    flag("Sync_Mode_supp"),
    flag("Auto_Baud_supp"),
    flag("Set_Slave_Add_supp"),
    flag("Fail_Safe"),
    flag("Fail_Safe_required"),
    number("Min_Slave_Intervall", kU16),
    flag("Modular_Station"),
    number("Max_Module", kU8),
    flag("FixPresetModules"),  // of Siemens
    number("Modul_Offset", kU8),
    number("Max_Input_Len", 244),
    number("Max_Output_Len", 244),
    number("Max_Data_Len", 488),
    number("Max_Diag_Data_Len", 244),
    number("Diag_Update_Delay", kU16),
    number("User_Prm_Data_Len", 237),
    {"User_Prm_Data", Kind::kBytes, 0, 237},
    number("Max_User_Prm_Data_Len", 244),
    number("Max_iParameter_Size", kU32),
    // DP-V1
    flag("DPV1_Slave"),
    flag("DPV1_Data_Types"),
    flag("C1_Read_Write_supp"),
    flag("C1_Read_Write_required"),
    number("C1_Max_Data_Len", 240),
    number("C1_Response_Timeout", kU16),
    flag("C2_Read_Write_supp"),
    flag("C2_Read_Write_required"),
    number("C2_Max_Data_Len", 240),
    number("C2_Response_Timeout", kU16),
    number("C2_Max_Count_Channels", 49),
    number("Max_Initiate_PDU_Length", kU8),
    flag("WD_Base_1ms_supp"),
    flag("Check_Cfg_Mode"),
    flag("Diagnostic_Alarm_supp"),
    flag("Process_Alarm_supp"),
    flag("Pull_Plug_Alarm_supp"),
    flag("Status_Alarm_supp"),
    flag("Update_Alarm_supp"),
    flag("Manufacturer_Specific_Alarm_supp"),
    flag("Diagnostic_Alarm_required"),
    flag("Process_Alarm_required"),
    flag("Pull_Plug_Alarm_required"),
    flag("Status_Alarm_required"),
    flag("Update_Alarm_required"),
    flag("Manufacturer_Specific_Alarm_required"),
    flag("Extra_Alarm_SAP_supp"),
    number("Alarm_Sequence_Mode_Count", 32),
    flag("Alarm_Type_Mode_supp"),
    flag("Prm_Block_Structure_supp"),
    flag("Prm_Block_Structure_req"),
    flag("PrmCmd_supp"),
    flag("Ident_Maintenance_supp"),
    flag("Jokerblock_supp"),
    any("Jokerblock_Slot"),
    any("Jokerblock_Type"),
    any("Jokerblock_Location"),
    // DP-V2
    flag("Publisher_supp"),
    flag("Subscriber_supp"),
    number("Max_Count_Publisher", kU8),
    flag("DXB_supp"),
    number("DXB_Max_Link_Count", 125),
    number("DXB_Max_Data_Length", 244),
    number("DXB_Subscribertable_Block_Location", 2),
    flag("Isochron_Mode_supp"),
    flag("Isochron_Mode_required"),
    number("TBASE_DP", kU32),
    number("TDP_MIN", kU16),
    number("TDP_MAX", kU32),
    number("T_PLL_W_MAX", kU16),
    number("TBASE_IO", kU32),
    number("TI_MIN", kU16),
    number("TO_MIN", kU16),
    flag("X_Prm_SAP_supp"),
    number("X_Max_User_Prm_Data_Len", 244),
    flag("Time_Sync_supp"),
    number("Slave_Redundancy_supp", kU8),
    number("Slave_Max_Switch_Over_Time", kU16),  // revision 5
    // DP master class 1
    flag("Master_Freeze_Mode_supp"),
    flag("Master_Sync_Mode_supp"),
    flag("Master_Fail_Safe_supp"),
    flag("Download_supp"),
    flag("Upload_supp"),
    flag("Act_Para_Brct_supp"),
    flag("Act_Param_supp"),
    number("Max_MPS_Length", kU32),
    number("Max_Lsdu_MS", kU8),
    number("Max_Lsdu_MM", kU8),
    number("Min_Poll_Timeout", kU16),
    number("LAS_Len", kU8),
    number("Max_Slaves_supp", kU8),
    number("Max_Master_Input_Len", kU8),
    number("Max_Master_Output_Len", kU8),
    number("Max_Master_Data_Len", kU16),
};

constexpr std::array<std::string_view, 11> kRates = {"9.6", "19.2", "31.25", "45.45", "93.75", "187.5",
                                                     "500", "1.5M", "3M",    "6M",    "12M"};
constexpr std::array<std::string_view, 7> kTimes = {
    "MaxTsdr_", "Trdy_", "Tqui_", "Tset_", "Tsdi_", "Transmission_Delay_", "Reaction_Delay_"};

/// Names of keywords that contain a baud rate; valid as long as the program, because Keyword only views its name.
const std::vector<std::string>& rate_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list;
    for (const auto rate : kRates) {
      list.push_back(std::string(rate) + "_supp");
      for (const auto time : kTimes) list.push_back(std::string(time) + std::string(rate));
    }
    return list;
  }();
  return names;
}

using Table = std::unordered_map<std::string, Keyword>;

const Table& table() {
  static const Table keywords = [] {
    Table result;
    for (const Keyword& keyword : kKeywords) result.emplace(lower(keyword.name), keyword);
    for (const std::string& name : rate_names()) {
      const bool supported = name.find("_supp") != std::string::npos;
      result.emplace(lower(name), supported ? flag(name) : number(name, kU16));
    }
    return result;
  }();
  return keywords;
}

/// In lower case, without underscores and blanks.
std::string bare_name(std::string_view name) {
  const auto joins = [](char c) { return c == '_' || c == ' ' || c == '\t'; };
  std::string result = lower(name);
  result.erase(std::remove_if(result.begin(), result.end(), joins), result.end());
  return result;
}

struct Slip {
  std::string_view written, meant;
};

/// Slips seen in real files. A name that ends with '_' means a family, with a baud rate after it.
constexpr Slip kSlips[] = {
    {"maxtcdr_", "maxtsdr_"},
    {"max_tsdr_", "maxtsdr_"},
    {"wd_base_lms_supp", "wd_base_1ms_supp"},  // l for 1, from a scanned manual
    {"min_slave_interval", "min_slave_intervall"},
    {"module_offset", "modul_offset"},
    {"set_slave_addr_supp", "set_slave_add_supp"},
    {"autobaud_supp", "auto_baud_supp"},
    {"freeze_supp", "freeze_mode_supp"},
    {"sync_supp", "sync_mode_supp"},
    {"max_modules", "max_module"},
};

std::string mend(std::string_view name) {
  std::string key = lower(name);
  for (const Slip& slip : kSlips) {
    const bool family = slip.written.back() == '_';
    if (family && key.compare(0, slip.written.size(), slip.written) == 0)
      return std::string(slip.meant) + key.substr(slip.written.size());
    if (!family && key == slip.written) return std::string(slip.meant);
  }
  return key;
}

bool starts_with(std::string_view text, std::string_view prefix) { return text.substr(0, prefix.size()) == prefix; }

}  // namespace

const Keyword* find_keyword(std::string_view name) {
  const auto found = table().find(lower(name));
  return found == table().end() ? nullptr : &found->second;
}

const Keyword* guess_keyword(std::string_view name) {
  if (const Keyword* mended = find_keyword(mend(name))) return mended;
  const std::string bare = bare_name(name);
  const auto same = [&](const auto& entry) { return bare_name(entry.first) == bare; };
  const auto found = std::find_if(table().begin(), table().end(), same);
  return found == table().end() ? nullptr : &found->second;
}

bool is_kept_silently(std::string_view key) {
  constexpr std::string_view kPrefixes[] = {"unit_diag_", "x_", "f_", "channel_diag", "value", "diag_", "slot"};
  return std::any_of(std::begin(kPrefixes), std::end(kPrefixes), [&](auto prefix) { return starts_with(key, prefix); });
}

}  // namespace dsdpv1::bus::gsd
