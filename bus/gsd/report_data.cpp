#include "bus/gsd/report_data.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "bus/telegram/explain_data.hpp"

namespace dsdpv1::bus::gsd {
namespace {

constexpr std::size_t kHead = 7;       // bytes of Set_Prm before the user parameters
constexpr std::size_t kDpv1Bytes = 3;  // DPV1_Status_1..3, the first user parameters of a DPV1 slave

/// The number of user parameters defined by the standard: the first of a DPV1 slave, or three if it sets DPV1_Enable.
std::size_t dpv1_bytes(const Gsd& gsd, const Bytes& set_prm) {
  if (!gsd.dpv1 || set_prm.size() == kHead) return 0;
  const bool enabled = (set_prm[kHead] & 0x80U) != 0;
  return enabled ? std::min(kDpv1Bytes, set_prm.size() - kHead) : 1;
}

std::string owner(const Gsd& gsd, const GsdSetup& setup, const GsdPrmField& field) {
  if (!field.module) return "station";
  return fmt::format("module {} \"{}\"", *field.module + 1, gsd.modules.at(setup.modules.at(*field.module)).name);
}

std::string explain_field(const Gsd& gsd, const GsdSetup& setup, const GsdPrmField& field) {
  return fmt::format("{}: {}", owner(gsd, setup, field), describe(field));
}

}  // namespace

std::vector<std::pair<std::string, bool>> features(const Gsd& gsd) {
  return {{"Auto_Baud_supp", gsd.auto_baud},
          {"Freeze_Mode_supp", gsd.freeze},
          {"Sync_Mode_supp", gsd.sync},
          {"Fail_Safe", gsd.fail_safe},
          {"Set_Slave_Add_supp", gsd.set_slave_add},
          {"DPV1_Slave", gsd.dpv1},
          {"C1_Read_Write_supp", gsd.c1_read_write},
          {"C2_Read_Write_supp", gsd.c2_read_write},
          {"WD_Base_1ms_supp", gsd.wd_base_1ms},
          {"Modular_Station", gsd.modular}};
}

std::vector<std::pair<std::string, int>> limits(const Gsd& gsd) {
  const std::pair<const char*, std::optional<int>> all[] = {
      {"Max_Module", gsd.max_modules},           {"Max_Input_Len", gsd.max_input},
      {"Max_Output_Len", gsd.max_output},        {"Max_Data_Len", gsd.max_data},
      {"Max_Diag_Data_Len", gsd.max_diag},       {"Max_User_Prm_Data_Len", gsd.max_user_prm},
      {"Modul_Offset", gsd.module_offset},       {"Min_Slave_Intervall", gsd.min_slave_interval},
      {"C1_Max_Data_Len", gsd.c1_max_data},      {"C2_Max_Data_Len", gsd.c2_max_data},
      {"C2_Max_Count_Channels", gsd.c2_channels}};
  std::vector<std::pair<std::string, int>> given;
  for (const auto& [keyword, value] : all)
    if (value) given.emplace_back(keyword, *value);
  return given;
}

std::string bits(const GsdParameter& parameter) {
  if (parameter.type == GsdType::kBit) return fmt::format("bit {}", parameter.first_bit);
  if (parameter.type == GsdType::kBitArea) return fmt::format("bits {}-{}", parameter.first_bit, parameter.last_bit);
  return {};
}

std::string describe(const GsdPrmField& field) {
  if (field.parameter == nullptr) return "constant";
  const std::string place = bits(*field.parameter);
  const std::string value =
      field.text.empty() ? fmt::format("{}", field.value) : fmt::format("{} ({})", field.value, field.text);
  return fmt::format("{}{}{} = {}", place, place.empty() ? "" : " ", field.parameter->name, value);
}

std::vector<Explained> explain_set_prm(const Gsd& gsd, const Bytes& set_prm, const GsdSetup& setup) {
  const auto words = detail::set_prm_words(set_prm).bytes;
  const std::size_t telegram_part = kHead + dpv1_bytes(gsd, set_prm);
  std::vector<Explained> lines;
  for (std::size_t i = 0; i < telegram_part; ++i) lines.push_back({i, 1, words[i]});
  for (const GsdPrmField& field : setup.fields)
    lines.push_back({kHead + field.position, field.size, explain_field(gsd, setup, field)});
  std::stable_sort(lines.begin(), lines.end(), [](const auto& a, const auto& b) { return a.position < b.position; });
  return lines;
}

std::vector<Explained> explain_chk_cfg(const Bytes& chk_cfg) {
  const auto words = detail::cfg_words(chk_cfg).bytes;
  std::vector<Explained> lines;
  for (std::size_t i = 0; i < words.size(); ++i) lines.push_back({i, 1, words[i]});
  return lines;
}

GsdSetup alone(const Gsd& gsd, std::size_t module) {
  GsdSetup setup;
  setup.modules = modules_of_station(gsd, {module});
  GsdUserPrm prm = set_prm_user_bytes(gsd, setup.modules, {});
  setup.user_prm = std::move(prm.bytes);
  setup.fields = std::move(prm.fields);
  const auto others = [&](const GsdPrmField& field) {
    return !field.module || setup.modules.at(*field.module) != module;
  };
  setup.fields.erase(std::remove_if(setup.fields.begin(), setup.fields.end(), others), setup.fields.end());
  setup.chk_cfg = chk_cfg_bytes(gsd, {module});
  setup.lengths = cfg_lengths(setup.chk_cfg);
  return setup;
}

}  // namespace dsdpv1::bus::gsd
