// The second pass over a GSD: moves settings to their members, resolves references between blocks, reports what is
// missing.
#include <algorithm>
#include <iterator>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "bus/gsd/cfg.hpp"
#include "bus/gsd/parser.hpp"

namespace dsdpv1::bus::gsd {
namespace {

constexpr int kMaxUserPrm = 237;  // 244 bytes of a Set_Prm without its first seven

class Completion {
 public:
  Completion(Gsd& gsd, const Settings& settings, Diagnostics& diagnostics)
      : gsd_(gsd), settings_(settings), diagnostics_(diagnostics) {}

  void run() {
    fill_texts();
    fill_flags();
    fill_numbers();
    fill_bauds();
    fill_old_user_prm();
    check_missing();
    check_blocks();
    check_parameters();
    check_slots();
    if (!gsd_.is_master) check_slave();
  }

 private:
  std::optional<int> number(const std::string& key) const {
    const auto found = settings_.numbers.find(key);
    return found == settings_.numbers.end() ? std::nullopt : std::optional<int>(static_cast<int>(found->second));
  }
  bool flag(const std::string& key) const { return number(key).value_or(0) == 1; }
  std::string text(const std::string& key) const {
    const auto found = settings_.texts.find(key);
    return found == settings_.texts.end() ? std::string() : found->second;
  }

  void fill_texts() {
    gsd_.vendor = text("vendor_name");
    gsd_.model = text("model_name");
    gsd_.device_revision = text("revision");
    gsd_.hardware_release = text("hardware_release");
    gsd_.software_release = text("software_release");
    gsd_.order_number = text("ordernumber");
    gsd_.implementation = text("implementation_type");
    gsd_.info_text = text("info_text");
    gsd_.slave_family = text("slave_family");
  }

  void fill_flags() {
    gsd_.is_master = flag("station_type");
    gsd_.auto_baud = flag("auto_baud_supp");
    gsd_.freeze = flag("freeze_mode_supp");
    gsd_.sync = flag("sync_mode_supp");
    gsd_.fail_safe = flag("fail_safe");
    gsd_.set_slave_add = flag("set_slave_add_supp");
    gsd_.dpv1 = flag("dpv1_slave");
    gsd_.c1_read_write = flag("c1_read_write_supp");
    gsd_.c2_read_write = flag("c2_read_write_supp");
    gsd_.wd_base_1ms = flag("wd_base_1ms_supp");
    fill_alarms();
    gsd_.modular = flag("modular_station");
    gsd_.fix_preset_modules = flag("fixpresetmodules");
  }

  void fill_alarms() {
    for (std::size_t i = 0; i < kAlarmNames.size(); ++i)
      if (flag(lower(kAlarmNames[i]) + "_alarm_supp"))
        gsd_.alarms.types = static_cast<std::uint8_t>(gsd_.alarms.types | 1U << (kFirstAlarmBit + i));
    gsd_.alarms.extra_sap = flag("extra_alarm_sap_supp");
    gsd_.alarms.type_mode = flag("alarm_type_mode_supp");
    gsd_.alarms.sequence_count = number("alarm_sequence_mode_count").value_or(0);
  }

  void fill_numbers() {
    gsd_.revision = number("gsd_revision").value_or(0);
    gsd_.ident = static_cast<std::uint16_t>(number("ident_number").value_or(0));
    gsd_.c1_max_data = number("c1_max_data_len");
    gsd_.c2_max_data = number("c2_max_data_len");
    gsd_.c2_channels = number("c2_max_count_channels");
    gsd_.c1_response_timeout = number("c1_response_timeout");
    gsd_.c2_response_timeout = number("c2_response_timeout");
    gsd_.max_modules = number("max_module");
    gsd_.max_input = number("max_input_len");
    gsd_.max_output = number("max_output_len");
    gsd_.max_data = number("max_data_len");
    gsd_.max_diag = number("max_diag_data_len");
    gsd_.max_user_prm = number("max_user_prm_data_len");
    gsd_.module_offset = number("modul_offset");
    gsd_.min_slave_interval = number("min_slave_intervall");
  }

  void fill_bauds() {
    for (int i = 0; i < kBaudCount; ++i) {
      const std::string rate = lower(gsd_baud_name(i));
      gsd_.bauds[static_cast<std::size_t>(i)] = {flag(rate + "_supp"), number("maxtsdr_" + rate)};
    }
    gsd_.pa = {flag("31.25_supp"), number("maxtsdr_31.25")};
  }

  /// User_Prm_Data counts only without Ext_User_Prm_Data keywords: files contain both, for old and new masters.
  void fill_old_user_prm() {
    const auto length = number("user_prm_data_len");
    const auto& data = settings_.user_prm_data;
    if (!gsd_.prm.constants.empty() || !gsd_.prm.refs.empty()) return;
    gsd_.prm.length = length;
    if (!data) return;
    gsd_.prm.constants.push_back(*data);
    const int given = static_cast<int>(data->bytes.size());
    if (!length) gsd_.prm.length = given;
    if (length.value_or(given) == given) return;
    diagnostics_.warning(data->line,
                         fmt::format("User_Prm_Data has {} bytes, User_Prm_Data_Len = {} counts", given, *length));
    gsd_.prm.constants.back().bytes.resize(static_cast<std::size_t>(*length));
  }

  void check_missing() {
    if (settings_.seen.count("ident_number") == 0)
      diagnostics_.error(1, "Ident_Number is missing, Ident_Number = 0x0000 to 0xFFFF is needed");
    for (const char* name : {"GSD_Revision", "Vendor_Name", "Model_Name"})
      if (settings_.seen.count(lower(name)) == 0) diagnostics_.warning(0, fmt::format("{} is missing", name));
    if (gsd_.revision > 5) {
      diagnostics_.warning(
          0, fmt::format("GSD_Revision = {} is newer than 5, its new keywords are kept only", gsd_.revision));
    }
  }

  void check_blocks() {
    check_block(gsd_.prm, gsd_.max_user_prm, "Max_User_Prm_Data_Len", 0);
    for (const GsdModule& module : gsd_.modules) {
      check_block(module.prm, module.prm.length, "Ext_Module_Prm_Data_Len", module.line);
      check_block(module.f_prm, module.f_prm.length, "F_Ext_Module_Prm_Data_Len", module.line);
    }
  }

  void check_block(const GsdPrmBlock& block, std::optional<int> length, std::string_view length_name, int line) {
    for (const GsdPrmConst& constant : block.constants) {
      check_extent("Ext_User_Prm_Data_Const", constant.offset, static_cast<int>(constant.bytes.size()), length,
                   length_name, constant.line);
    }
    for (const GsdPrmRef& ref : block.refs) check_ref(ref, length, length_name);
    const bool used = !block.constants.empty() || !block.refs.empty();
    if (used && !length && !block.length) diagnostics_.warning(line, fmt::format("{} is missing", length_name));
  }

  void check_ref(const GsdPrmRef& ref, std::optional<int> length, std::string_view length_name) {
    const auto found = gsd_.parameters.find(ref.parameter);
    if (found == gsd_.parameters.end()) {
      diagnostics_.error(ref.line, fmt::format("Ext_User_Prm_Data_Ref({}) names ExtUserPrmData {}, {}", ref.offset,
                                               ref.parameter, defined(gsd_.parameters, "ExtUserPrmData")));
      return;
    }
    check_extent("Ext_User_Prm_Data_Ref", ref.offset, size_of(found->second.type), length, length_name, ref.line);
  }

  void check_extent(std::string_view keyword, int offset, int size, std::optional<int> length,
                    std::string_view length_name, int line) {
    if (!length || offset + size <= *length) return;
    diagnostics_.error(line, fmt::format("{}({}) reaches byte {}, {} = {} allows {}", keyword, offset,
                                         offset + size - 1, length_name, *length,
                                         *length == 0   ? "none"
                                         : *length == 1 ? "0"
                                                        : fmt::format("0 to {}", *length - 1)));
  }

  /// "1, 2, 3 are defined": the possible targets of a reference.
  template <typename Map>
  static std::string defined(const Map& map, std::string_view what) {
    constexpr std::size_t kShown = 8;
    if (map.empty()) return fmt::format("no {} is defined", what);
    std::vector<int> numbers;
    for (const auto& entry : map)
      if (numbers.size() < kShown) numbers.push_back(entry.first);
    return fmt::format("{}{} {} defined", fmt::join(numbers, ", "), map.size() > kShown ? ", ..." : "",
                       map.size() == 1 ? "is" : "are");
  }

  void check_parameters() {
    for (const auto& [number, parameter] : gsd_.parameters) {
      if (!parameter.text_ref || gsd_.prm_texts.count(*parameter.text_ref) != 0) continue;
      diagnostics_.error(parameter.line, fmt::format("ExtUserPrmData {} names PrmText {}, {}", number,
                                                     *parameter.text_ref, defined(gsd_.prm_texts, "PrmText")));
    }
  }

  bool has_module(std::int64_t reference) const {
    return std::any_of(
        gsd_.modules.begin(), gsd_.modules.end(), [&](const GsdModule& m) { return m.reference == reference; });
  }

  void check_slots() {
    for (const GsdSlot& slot : gsd_.slots) {
      if (slot.preset != 0 && !has_module(slot.preset)) {
        diagnostics_.error(
            slot.line, fmt::format("Slot({}) presets module {}, a module reference number of the file or 0 is allowed",
                                   slot.number, slot.preset));
      }
    }
    std::set<int> references;
    for (const GsdModule& module : gsd_.modules) {
      if (!module.reference || references.insert(*module.reference).second) continue;
      diagnostics_.warning(module.line, fmt::format("module reference number {} is used before", *module.reference));
    }
  }

  void check_slave() {
    check_bauds();
    check_modules();
    if (gsd_.dpv1 && prm_bytes() < 3)
      diagnostics_.warning(0, "DPV1_Slave = 1, but the user parameters lack the three DPV1 bytes");
    if (gsd_.max_user_prm.value_or(0) > kMaxUserPrm) {
      diagnostics_.warning(
          0, fmt::format("Max_User_Prm_Data_Len = {}, a Set_Prm carries at most {}", *gsd_.max_user_prm, kMaxUserPrm));
    }
    if (!gsd_.modular) return;
    if (!gsd_.max_modules) diagnostics_.warning(0, "Max_Module is missing in a modular station");
    if (!gsd_.max_input || !gsd_.max_output)
      diagnostics_.warning(0, "Max_Input_Len or Max_Output_Len is missing in a modular station");
  }

  int prm_bytes() const {
    int bytes = gsd_.prm.length.value_or(0);
    for (const auto& constant : gsd_.prm.constants)
      bytes = std::max(bytes, constant.offset + static_cast<int>(constant.bytes.size()));
    for (const auto& ref : gsd_.prm.refs) bytes = std::max(bytes, ref.offset + 1);
    return bytes;
  }

  void check_bauds() {
    bool any = false;
    for (int i = 0; i < kBaudCount; ++i) {
      const GsdBaud& rate = gsd_.bauds[static_cast<std::size_t>(i)];
      any = any || rate.supported;
      if (rate.supported && !rate.max_tsdr)
        diagnostics_.warning(0, fmt::format("MaxTsdr_{} is missing", gsd_baud_name(i)));
    }
    if (!any && gsd_.pa.supported)
      diagnostics_.warning(0, "31.25 kbit/s (PROFIBUS PA) is the only rate, a DP line needs a coupler for it");
    else if (!any)
      diagnostics_.warning(0, "no baud rate is supported");
  }

  void check_modules() {
    if (gsd_.modules.empty()) diagnostics_.warning(0, "no Module is defined, a Chk_Cfg cannot be made");
    for (const GsdModule& module : gsd_.modules) {
      const CfgLengths lengths = cfg_lengths(module.cfg);
      if (!lengths.ok()) diagnostics_.warning(module.line, lengths.error);
    }
  }

  Gsd& gsd_;
  const Settings& settings_;
  Diagnostics& diagnostics_;
};

}  // namespace

void complete(Gsd& gsd, const Settings& settings, Diagnostics& diagnostics) {
  Completion(gsd, settings, diagnostics).run();
}

}  // namespace dsdpv1::bus::gsd
