#pragma once
// Derives from a GSD file and a choice of modules what a class-1 master sends: Set_Prm, Chk_Cfg, the lengths of the
// data exchange.
//
//   GsdSetup setup = set_up(gsd, {{"8 bytes in", "3"}, {}});
//   if (!setup.ok()) ...                                     // setup.diagnostics says why
//   Bytes prm = set_prm_bytes(gsd.ident, {}, setup.user_prm);
//   int inputs = setup.lengths.input;                        // bytes that the slave sends
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "bus/bytes.hpp"
#include "bus/gsd/cfg.hpp"
#include "bus/gsd/gsd.hpp"
#include "bus/master/slave_parameters.hpp"

namespace dsdpv1::bus {

/// A value for one ExtUserPrmData that replaces the file's default.
struct GsdOverride {
  std::optional<std::size_t> module;  ///< position in the choice, 0..; nullopt: a parameter of the station
  std::string parameter;              ///< name, or number of the ExtUserPrmData
  std::string value;                  ///< a number, or a text of its PrmText
};

/// Modules by name or number, in the order of their slots. The number is the module reference number, or in files
/// without them the position in the file, from 1. Empty: the modules that the file presets.
struct GsdChoice {
  std::vector<std::string> modules;
  std::vector<GsdOverride> overrides;
};

/// A field of the user parameters.
struct GsdPrmField {
  std::size_t position = 0;                 ///< byte in the user parameters
  std::size_t size = 1;                     ///< bytes
  std::optional<std::size_t> module;        ///< position in the station; nullopt: the station itself
  const GsdParameter* parameter = nullptr;  ///< in the Gsd; nullptr: constant bytes
  std::int64_t value = 0;                   ///< of the parameter
  std::string text;                         ///< the PrmText of the value, empty without one
};

struct GsdUserPrm {
  Bytes bytes;
  std::vector<GsdPrmField> fields;
  std::vector<GsdDiagnostic> diagnostics;  ///< errors of overrides
};

struct GsdSetup {
  std::vector<std::size_t> modules;  ///< of the station, as indices into Gsd::modules: fixed presets, then the choice
  Bytes user_prm;                    ///< Set_Prm after its first seven bytes, including DPV1 bytes as given by the file
  std::vector<GsdPrmField> fields;
  Bytes chk_cfg;
  CfgLengths lengths;
  std::vector<GsdDiagnostic> diagnostics;
  bool ok() const;  ///< no error among the diagnostics
};

/// The seven bytes before the user parameters (table 19).
struct SetPrmHead {
  bool lock = true, unlock = false, sync = false, freeze = false;
  std::uint8_t wd_fact_1 = 10;  ///< unit 10 ms, with WD_Base 1 ms
  std::uint8_t wd_fact_2 = 10;  ///< the watchdog is on when both factors are not 0
  std::uint8_t min_tsdr = 11;   ///< bit times, 0 leaves it unchanged
  std::uint8_t group = 0;
};

/// The modules that a master uses by default: the presets of the slots, else of the modules, else the only module of a
/// fixed station.
std::vector<std::size_t> preset_modules(const Gsd& gsd);

/// The module meant by `name` (see GsdChoice); spaces at the ends and case are ignored unless several names differ only
/// in them. nullopt, with the reason in `why`, if none or several match.
std::optional<std::size_t> find_module(const Gsd& gsd, const std::string& name, std::string& why);

/// Size of a block of parameters in bytes: the length given by the file, else the end of its last byte.
std::size_t prm_length(const Gsd& gsd, const GsdPrmBlock& block);

/// The modules of a station: with FixPresetModules the presets first, each once, then those chosen.
std::vector<std::size_t> modules_of_station(const Gsd& gsd, const std::vector<std::size_t>& chosen);

/// User parameters of the station, followed by those of its modules. A parameter named "[SlotNumber]" gets the slot of
/// its module (GSD revision 5): the file's Slot, else counted from Modul_Offset, else from 1. GsdOverride::module
/// counts in `modules`.
GsdUserPrm set_prm_user_bytes(const Gsd& gsd, const std::vector<std::size_t>& modules,
                              const std::vector<GsdOverride>& overrides);

/// The identifiers of the modules, concatenated.
Bytes chk_cfg_bytes(const Gsd& gsd, const std::vector<std::size_t>& modules);

/// A complete Set_Prm: 7 bytes and the user parameters.
Bytes set_prm_bytes(std::uint16_t ident, const SetPrmHead& head, const Bytes& user_prm);

/// True if these user parameters switch DPV1 on: DPV1_Slave, and DPV1_Enable in their first byte (table 25).
bool enables_dpv1(const Gsd& gsd, const Bytes& user_prm);

/// Requests DPV1 from a slave: sets DPV1_Enable in its Set_Prm (three more bytes, table 25) and the C1 response timeout
/// of the file. Returns why the file does not allow it, leaving `parameters` unchanged, or an empty text.
std::string enable_dpv1(const Gsd& gsd, SlaveParameters& parameters);

/// The same for alarms: their types, SAP and mode.
std::string enable_alarms(const Gsd& gsd, const AlarmParameters& alarms, SlaveParameters& parameters);

/// Builds everything and checks the limits of the file and of the protocol: modules allowed in their slots, their
/// number (Max_Module, 1 in a fixed station without it), Max_Input_Len, Max_Output_Len, Max_Data_Len, 244 bytes of
/// Chk_Cfg, 237 of user parameters.
GsdSetup set_up(const Gsd& gsd, const GsdChoice& choice);

}  // namespace dsdpv1::bus
