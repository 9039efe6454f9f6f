#pragma once
// A scenario as typed values. describe.cpp defines the meaning, unit, range and default of each key.
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bus/bytes.hpp"
#include "bus/master/acyclic.hpp"
#include "bus/master/master2_connection.hpp"
#include "bus/master/slave_parameters.hpp"
#include "bus/time.hpp"
#include "io/keys/keys.hpp"
#include "model/profibus/dp_state.hpp"
#include "tb/chip/checks/check.hpp"
#include "tb/chip/chip_kind.hpp"
#include "tb/chip/user_cpu/program.hpp"
#include "tb/scenario/settings.hpp"

namespace dsdpv1::tb::scenario {

using keys::Name;

/// Values that follow the baud rate (bus/baud.hpp) if absent.
struct BusParameters {
  std::optional<int> slot_time;   ///< T_SL, bit times
  std::optional<int> setup_time;  ///< T_SET, bit times
  std::optional<int> quiet_time;  ///< T_QUI, bit times
  std::optional<int> retries;
  int gap_factor = 10;                             ///< cycles between two FDL status polls of the live list, 0 = none
  int highest_address = 126;                       ///< HSA
  std::optional<int> min_slave_interval;           ///< us from one data cycle's start to the next
  bool token = true;                               ///< passes the token to itself
  bool ring = false;                               ///< shares the token with other masters
  int target_rotation = bus::kTargetRotationBits;  ///< T_TR, bit times; a ring only
  int clock_error = 0;                             ///< ppm
  int line = 0;
};

/// Alarms that a master enables in Set_Prm.
struct MasterAlarms {
  bool pull_plug = false, process = false, diagnostic = false, manufacturer = false, status = false, update = false;
  int mode = 0;
  bool extra_sap = false, acknowledge = true;
  int line = 0;
};

/// A slave as a master sees it.
struct MasterSlave {
  std::optional<int> address;  ///< absent: that of the scenario's slave
  Name slave;                  ///< the scenario's slave, empty if none is meant
  Name gsd;
  std::vector<Name> modules;
  std::optional<bus::Bytes> user_prm, cfg;
  bus::Tick watchdog = 0;  ///< 0 = off
  int min_tsdr = 11;
  bus::Bytes groups;  ///< group numbers 1..8
  bool sync = false, freeze = false, fail_safe = false, dpv1 = false;
  std::optional<MasterAlarms> alarms;
  std::optional<int> ident;
  bus::Bytes outputs;
  bus::OutputPattern pattern = bus::OutputPattern::kFixed;
  std::uint32_t seed = 1;
  int line = 0;
};

using bus::Personality;

struct Master {
  Name name;
  int address = 2;
  Personality personality = Personality::kHighAlways;
  bus::Tick start = 0;
  bool operate = true;
  BusParameters bus;
  std::vector<MasterSlave> slaves;
  int line = 0;
};

/// A C2 connection of a class 2 master to a slave.
struct Connection {
  Name name, slave;
  std::optional<int> address;  ///< absent: that of the scenario's slave
  int send_timeout = 100;      ///< unit 10 ms
  bus::Bytes add_addr = {0, 0};
  bus::Tick poll_interval = 0;
  int line = 0;
};

struct Master2 {
  Name name;
  int address = 1;
  bus::Tick start = 0;
  BusParameters bus;
  std::vector<Connection> connections;
  int line = 0;
};

/// The user CPU's initialisation data for the chip (table 2).
struct InitData {
  std::optional<int> ident, max_inputs, max_outputs, max_diag, max_prm, max_cfg;
  std::optional<bus::Bytes> cfg;
  int prm_mode = 0, cfg_mode = 0;
  std::optional<bool> set_slave_address, freeze, sync, fail_safe, dpv1;
  std::vector<keys::Given> given;
  int line = 0;
};

using Behaviour = user_cpu::InputSource;
using user_cpu::Judgement;

/// An object of the user CPU that masters access by slot and index.
struct Dpv1Object {
  int slot = 0, index = 0, min_length = 0;
  bool read = true, write = true, transport = false;
  std::uint8_t classes = user_cpu::kBothClasses;
  bus::Bytes data;
  int line = 0;
};

struct Im0 : user_cpu::Nameplate {
  int line = 0;
};

using user_cpu::Answering;

struct Dpv1User {
  std::vector<Dpv1Object> objects;
  std::optional<Im0> im0;
  Answering answering = Answering::kNormal;
  bus::Tick delay = 0;
  int error_code_1 = user_cpu::kInvalidParameter, error_code_2 = 0;
  int line = 0;
};

/// The program of the user CPU; keys of the kind of chip define its processor and its connection to the chip.
struct UserCpu {
  Behaviour behaviour = Behaviour::kLoopBack;
  Judgement judge_prm = Judgement::kAccept, judge_cfg = Judgement::kAccept;
  bool overwrite_inputs = true;
  bool judge_in_handler = true;
  int line = 0;
  bus::Bytes constant;
  bus::Tick start_delay = 0;
  bus::Tick cycle = 50 * bus::kTicksPerUs;
  bus::Tick judge_delay = 0;
  bus::Tick retry_delay = bus::kTicksPerMs;
  Dpv1User dpv1;
  std::shared_ptr<OwnSettings> own;  ///< from ChipKind::make_user_settings
  std::vector<keys::Given> given;
};

struct Slave {
  Name name;
  const ChipKind* kind = nullptr;           ///< its own, else the scenario's
  std::shared_ptr<const OwnSettings> chip;  ///< from ChipKind::make_chip_settings; the same
  int address = 0;
  Name gsd;
  std::vector<Name> modules;
  InitData init;
  UserCpu user_cpu;
  bus::Tick release_reset = 10 * bus::kTicksPerUs;
  int line = 0;
};

enum class ActionKind : std::uint8_t {
  kSetInputs,
  kSetDiagnosis,
  kReinitialise,
  kResetChip,
  kOfChip,  ///< ChipKind::orders
  kWrongLength,
  kPauseUser,
  kVerdict,
  kAnswerAcyclic,
  kUnplug,
  kPlug,
  kSetOutputs,
  kReadInputs,
  kReadOutputs,
  kGetCfg,
  kSlaveDiag,
  kSetSlaveAddress,
  kC1Read,
  kC1Write,
  kGlobalControl,
  kOperate,
  kClear,
  kStopMaster,
  kStartMaster,
  kChangeBaud,
  kTelegram,
  kC2Connect,
  kC2Read,
  kC2Write,
  kC2Transport,
  kC2Abort,
  kC2Behaviour,
  kC2Raw,
  kGlitch,
  kAnswerFault,
};

/// How a slave's answer reaches the line.
enum class AnswerFaultKind : std::uint8_t { kSilent, kFcs, kEd, kParity, kLate, kSa, kDa, kSap, kDoubled, kCut };
/// Its word in scenarios.
std::string word_of(AnswerFaultKind kind);

/// Actions that the program on the user CPU must execute.
constexpr bool is_for_user_cpu(ActionKind what) {
  return what <= ActionKind::kAnswerAcyclic && what != ActionKind::kResetChip;
}

/// A condition on a slave (or the telegrams of the bus) at a point of time; all given parts must hold.
struct Condition {
  Name slave;
  std::optional<profibus::DpState> dp_state;
  std::optional<std::optional<int>> baud;  ///< the inner one: index of bus/baud.hpp, absent during the search
  std::optional<int> station_address;
  std::optional<std::int64_t> data_exchanges, data_exchanges_at_most;
  std::optional<bus::Bytes> inputs, outputs;
  Name event;
  std::int64_t count = 1;
  std::optional<std::int64_t> count_at_most;
  std::optional<double> tsdr_min, tsdr_max;  ///< bit times
  std::optional<bus::Tick> longest_wait_at_most;
  Name master, connection;
  std::optional<bus::ConnectionState> connection_state;
  std::optional<ActionKind> reply_of;
  std::optional<bus::Bytes> reply;
  std::optional<bus::AcyclicOutcome> outcome;
  int line = 0;
};

struct Expectation : Condition {
  std::optional<bus::Tick> at, by;
};

struct When : Condition {
  bus::Tick after = 0;
};

enum class Verdict : std::uint8_t { kPrm, kCfg };

/// Faults to inject into a telegram on the wire; byte positions count from 0.
struct Faults {
  std::optional<int> wrong_parity_at, missing_stop_at, gap_before, truncate_after, glitch_at;
  double gap_bits = 2;
  double glitch_start_bits = 1, glitch_bits = 0.4;
  int line = 0;
};

struct Action {
  std::optional<bus::Tick> at;
  std::optional<When> when;
  ActionKind what = ActionKind::kSetInputs;
  std::string word;  ///< for `do`
  Name slave, master, connection;
  bus::Bytes bytes;
  user_cpu::DiagnosisKind diagnosis = user_cpu::DiagnosisKind::kExtended;
  std::optional<int> address, new_address, ident;
  std::optional<bus::Bytes> cfg;
  bool lock = false, refuse = false, level = false;
  bool sync = false, unsync = false, freeze = false, unfreeze = false, clear = false;
  int group = 0;
  std::optional<bus::Tick> duration;
  std::string block;  ///< kOfChip
  int times = 1;
  std::optional<int> listen;  ///< kOfChip
  Verdict of = Verdict::kPrm;
  Answering answering = Answering::kNormal;
  int slot = 0, index = 0, length = 0;
  std::optional<int> sap;
  bus::Behaviour behaviour = bus::Behaviour::kNormal;
  int baud = 0;
  Faults faults;
  AnswerFaultKind answer_fault = AnswerFaultKind::kSilent;
  int line = 0;
};

/// A violation that does not fail the run.
struct Allow {
  Name event;
  Name slave;  ///< empty: any
  int line = 0;
};

/// Treatment of violations found by the checks of tb/chip/checks.
enum class ChecksMode : std::uint8_t {
  kFail,    ///< listed, and those not allowed by the scenario fail the run
  kReport,  ///< listed
  kOff,     ///< no checks
};

/// The checks, and limits that replace those of the scenario's kind of chip, for its slaves. Others have their kind's.
struct Checks : checks::Limits {
  ChecksMode mode = ChecksMode::kFail;
  int line = 0;
};

struct Scenario {
  std::string file;                ///< as given to `load`
  std::vector<std::string> files;  ///< files that it names (GSD files and the like), with paths usable by the program
  std::string name;
  int baud = 0;  ///< index of bus/baud.hpp
  bus::Tick end = 0;
  const ChipKind* kind = nullptr;           ///< of the slaves that name none
  std::shared_ptr<const OwnSettings> chip;  ///< from ChipKind::make_chip_settings
  std::vector<Master> masters;
  std::vector<Master2> masters2;
  std::vector<Slave> slaves;
  std::vector<Action> script;
  std::vector<Expectation> expect;
  bool expects_exchange = true;  ///< for each slave of a master, see tb/bench/exchange_watch.hpp
  std::vector<Allow> allow;
  Checks checks;
  int line = 0;
};

/// The least number of slaves.
enum class Least : std::uint8_t { kNone, kOne };

/// Reads and checks a scenario; throws InputError. GSD files are not opened here. The settings replace keys of the
/// file.
Scenario load(const std::string& path, const std::vector<Setting>& settings = {}, Least slaves = Least::kOne);
/// As load(), from text; `file` is used in errors and as the base of relative paths.
Scenario parse(const std::string& text, const std::string& file, const std::vector<Setting>& settings = {},
               Least slaves = Least::kOne);
/// An action for now, as JSON of one line with the keys of the script except at and when; `file` is used in errors.
/// Throws InputError.
Action parse_action(const std::string& json, const std::string& file, const Scenario& scenario);
/// Scenario::files of a scenario that may be wrong otherwise.
std::vector<std::string> files(const std::string& path, const std::vector<Setting>& settings = {});
/// The text of a scenario's file; throws InputError if there is none.
std::string read_file(const std::string& path);
/// `path` of a scenario, resolved by the program: relative to the scenario's folder.
std::string resolve(const Scenario& scenario, const Name& path);

/// The number of the slave with this name, in the order of the scenario; that of all slaves if there is none.
std::size_t slave_number(const Scenario& scenario, const std::string& name);
/// The slaves' kinds of chips, each once, in the order of the slaves.
ChipKinds kinds(const Scenario& scenario);
/// True if all of the slaves' kinds have reference RTL.
bool has_rtl(const Scenario& scenario);
/// True if a user CPU sets pins for which --view tlm only has transactions.
bool needs_pins(const Scenario& scenario);
/// The limits of checks for slaves of this kind.
checks::Limits limits_of(const Scenario& scenario, const ChipKind& kind);
/// Throws InputError if slaves have different chips, or parameters: `what` takes only one, "a golden trace".
void check_one_chip(const Scenario& scenario, const std::string& what);

/// True if the scenario allows this violation of `station` (a slave's name, "bus").
bool allows(const Scenario& scenario, const std::string& code, const std::string& station);

/// The description of a whole scenario with chips of this kind.
const keys::Object& description(const ChipKind& kind);
/// JSON Schema (draft 2020-12) of scenarios with chips of any kind, indented, with a line end.
std::string json_schema();
/// docs/scenarios.md.
std::string markdown(const ChipKind& kind);

}  // namespace dsdpv1::tb::scenario
