#pragma once
// PROFIBUS GSD files (electronic data sheets), revisions 1 to 5, as vendors write them. docs/gsd.md lists the accepted
// deviations.
//
//   std::ifstream in(path);
//   GsdResult result = parse_gsd(in, path);
//   if (!result.gsd) for (const auto& d : result.diagnostics) std::cerr << to_string(d) << '\n';
//
// bus/gsd/setup.hpp derives a master's data from the file (Set_Prm, Chk_Cfg, limits), bus/gsd/report.hpp prints the
// report.
#include <array>
#include <cstdint>
#include <iosfwd>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bus/baud.hpp"
#include "bus/bytes.hpp"

namespace dsdpv1::bus {

/// One remark about a file or about a choice of modules. A file with an error cannot be used.
struct GsdDiagnostic {
  enum class Level : std::uint8_t { kWarning, kError };
  Level level = Level::kError;
  std::string file;
  int line = 0;      ///< 1..; 0 if the remark belongs to no line
  std::string text;  ///< what is wrong, what is allowed
};
/// "file:line: text" for an error, "file:line: warning: text" for a warning; without the line if it is 0.
std::string to_string(const GsdDiagnostic& diagnostic);

/// An inclusive range; a single allowed value is a range of one.
struct GsdRange {
  std::int64_t low = 0, high = 0;
};

/// The types of alarms as keywords name them (NAME_Alarm_supp), in the order of DPV1_Status_2 from bit 2 on.
constexpr std::array<const char*, 6> kAlarmNames = {"Update",     "Status",  "Manufacturer_Specific",
                                                    "Diagnostic", "Process", "Pull_Plug"};
constexpr unsigned kFirstAlarmBit = 2;

/// Alarms of DPV1.
struct GsdAlarms {
  std::uint8_t types = 0;  ///< of ..._Alarm_supp, as bits of DPV1_Status_2
  bool extra_sap = false;  ///< Extra_Alarm_SAP_supp
  bool type_mode = false;  ///< Alarm_Type_Mode_supp
  int sequence_count = 0;  ///< Alarm_Sequence_Mode_Count, 0 to 32
};

/// The data types of ExtUserPrmData. Values of several bytes are sent most significant byte first.
enum class GsdType : std::uint8_t {
  kBit,
  kBitArea,
  kUnsigned8,
  kUnsigned16,
  kUnsigned32,
  kSigned8,
  kSigned16,
  kSigned32
};
/// Size of a parameter of this type in bytes: 1, 2 or 4.
int size_of(GsdType type);
/// The GSD's word: "Unsigned16".
std::string_view name(GsdType type);
/// All values of the type; `bits` is the width of a BitArea and ignored for other types.
GsdRange range_of(GsdType type, int bits);

/// ExtUserPrmData ... EndExtUserPrmData: one parameter that the user of a master may change.
struct GsdParameter {
  int number = 0;
  std::string name;
  GsdType type = GsdType::kUnsigned8;
  int first_bit = 0, last_bit = 0;  ///< Bit and BitArea only, 0..7
  std::int64_t preset = 0;
  std::vector<GsdRange> allowed;  ///< empty: all values of the type
  std::optional<int> text_ref;    ///< number of the PrmText
  bool changeable = true, visible = true;
  int line = 0;
};

/// Ext_User_Prm_Data_Const(offset) = bytes.
struct GsdPrmConst {
  int offset = 0;
  Bytes bytes;
  int line = 0;
};
/// Ext_User_Prm_Data_Ref(offset) = number of an ExtUserPrmData.
struct GsdPrmRef {
  int offset = 0;
  int parameter = 0;
  int line = 0;
};
/// User parameters of the station or of one module; refs overwrite the constants.
struct GsdPrmBlock {
  std::optional<int> length;  ///< bytes: Ext_Module_Prm_Data_Len, for the station User_Prm_Data_Len of revision 0
  std::vector<GsdPrmConst> constants;
  std::vector<GsdPrmRef> refs;
};

/// A keyword without a member here: vendor's, F_, X_ and Unit_Diag keywords, kept as written.
struct GsdKeyword {
  std::string keyword;  ///< with its index: "Unit_Diag_Bit(17)"
  std::string value;    ///< as written after '=', without comment
  int line = 0;
};

struct GsdModule {
  std::string name;
  Bytes cfg;                     ///< identifier bytes for Chk_Cfg, 1..244
  std::optional<int> reference;  ///< module reference number (revision 3 and later)
  GsdPrmBlock prm;
  GsdPrmBlock f_prm;  ///< PROFIsafe F_ parameters, after `prm` in Set_Prm; F_Par_CRC is not computed here
  bool preset = false;
  std::string info_text;
  std::vector<GsdKeyword> keywords;
  int line = 0;
};

/// Slot(number) = "name" preset allowed,... of a SlotDefinition; modules by reference number, a preset of 0 is an empty
/// slot.
struct GsdSlot {
  int number = 0;
  std::string name;
  int preset = 0;
  std::vector<GsdRange> allowed;
  int line = 0;
};

struct GsdBaud {
  bool supported = false;
  std::optional<int> max_tsdr;  ///< bit times
};

/// The name of a baud rate in GSD keywords ("9.6", "12M"); `index` as in bus/baud.hpp, 0 = 12 Mbit/s.
std::string_view gsd_baud_name(int index);

struct Gsd {
  std::string file;
  int revision = 0;  ///< GSD_Revision; 0 if the file does not give it
  std::string vendor, model, device_revision, hardware_release, software_release, order_number, implementation,
      info_text;
  std::string slave_family;  ///< as written: "3@TdF@Temperature"
  std::uint16_t ident = 0;
  bool is_master = false;  ///< Station_Type 1
  std::array<GsdBaud, kBaudCount> bauds{};
  GsdBaud pa;  ///< 31.25 kbit/s, PROFIBUS PA: no rate of a DP line

  bool auto_baud = false, freeze = false, sync = false, fail_safe = false, set_slave_add = false;
  bool dpv1 = false;           ///< DPV1_Slave
  bool c1_read_write = false;  ///< C1_Read_Write_supp
  bool c2_read_write = false;  ///< C2_Read_Write_supp
  bool wd_base_1ms = false;    ///< WD_Base_1ms_supp
  GsdAlarms alarms;
  std::optional<int> c1_max_data, c2_max_data, c2_channels;
  std::optional<int> c1_response_timeout, c2_response_timeout;  ///< units of 10 ms

  bool modular = false;
  bool fix_preset_modules = false;  ///< modules with Preset = 1 are in every station, before those chosen
  std::optional<int> max_modules;
  std::optional<int> max_input, max_output, max_data;  ///< bytes
  std::optional<int> max_diag;                         ///< bytes with the six standard ones
  std::optional<int> max_user_prm;                     ///< Max_User_Prm_Data_Len, bytes
  std::optional<int> module_offset;                    ///< number of the first slot
  std::optional<int> min_slave_interval;               ///< units of 100 us

  GsdPrmBlock prm;
  std::map<int, GsdParameter> parameters;
  std::map<int, std::map<std::int64_t, std::string>> prm_texts;
  std::vector<GsdModule> modules;
  std::vector<GsdSlot> slots;
  std::vector<GsdKeyword> keywords;
};

struct GsdResult {
  std::optional<Gsd> gsd;                  ///< absent after an error
  std::vector<GsdDiagnostic> diagnostics;  ///< in the order of lines, at most 200
};

/// Reads a whole GSD file. `file` is the name used in diagnostics. Never throws because of the content. Latin-1 text is
/// converted to UTF-8.
GsdResult parse_gsd(std::istream& in, const std::string& file);

}  // namespace dsdpv1::bus
