#pragma once
// A kind of slave chip: the names of its pins, events, checks and keys, and the factories that put it on the bench with
// its user CPU.
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "io/keys/keys.hpp"
#include "model/profibus/event.hpp"
#include "model/profibus/reason.hpp"
#include "tb/chip/checks/check.hpp"
#include "tb/chip/checks/chip_checks.hpp"
#include "tb/chip/host_reader.hpp"
#include "tb/chip/pin_chip.hpp"
#include "tb/chip/pins/pins.hpp"
#include "tb/chip/timing_diagram.hpp"
#include "tb/chip/user_cpu/debug_history.hpp"
#include "tb/chip/user_cpu/outside_line.hpp"
#include "tb/chip/user_cpu/program.hpp"
#include "tb/chip/user_cpu/station_cpu.hpp"

namespace dsdpv1::cosim {
class RandomCases;
class RtlOf;
}  // namespace dsdpv1::cosim
namespace dsdpv1::calibrate {
class Claims;
}

namespace dsdpv1::tb {

namespace scenario {
struct Scenario;
struct Slave;
}  // namespace scenario

/// A scenario's settings for one kind of chip. Each kind derives its own.
struct OwnSettings {
  virtual ~OwnSettings() = default;
  int line = 0;
};

/// A code in logs, result files and scenarios, with its text and advice.
struct CodeText {
  std::string code, severity;
  std::string source;  ///< rulings and clauses, as "S6, T19-4"
  std::string text, advice;
  std::string example = {};  ///< the text with example values; empty without values
};

/// Codes of one origin, in the order of their table.
struct CodeTable {
  std::string title, introduction;
  std::vector<CodeText> codes;
};

/// A script action for the user program that only programs for this kind of chip support.
struct Order {
  keys::Choice choice;  ///< its word under `do`, and its keys
  /// text for the log
  std::string (*said)(const user_cpu::command::OfChip& order) = nullptr;
  bool one_by_one = false;  ///< `times`: number of repetitions
};

/// An internal signal of the chip for waves.
struct InnerSignal {
  const char* name;
  int width;  ///< 0: its values are words
};

/// The last action of a user CPU at its chip, derived from the pins.
class AccessReader {
 public:
  virtual ~AccessReader() = default;
  /// In order of time; inputs at one tick in the order of the pins' numbers.
  virtual void pin(bus::Tick at, PinNumber pin, Level level) = 0;
  /// Cell, value and time of the last access, or "none".
  virtual std::string words() const = 0;
};

/// How the core evaluates time.
enum class Engine : std::uint8_t {
  kStep,  ///< every cycle
  kSkip,  ///< from event to event
};

/// A chip for one slave.
struct ChipRequest {
  std::string name;
  const OwnSettings& settings;  ///< from ChipKind::make_chip_settings
  Engine engine = Engine::kSkip;
  bool inside = false;  ///< internal signals are needed; Engine::kStep
  PinMask watched = 0;  ///< pins whose changes are needed; inputs of the host bus all or none
  bool late = false;    ///< they may be reported late: see ChipListener::edges
};

/// `--gdb`: the debugger of a processor that runs firmware.
struct GdbRequest {
  std::optional<int> port;                      ///< absent: no connection is possible; only repeats earlier inputs
  std::function<void(const std::string&)> say;  ///< prints a line for the user
  std::function<bool()> stopped;                ///< whether to end the run
  std::shared_ptr<user_cpu::DebugHistory> history;
  bool goes_back = true;  ///< the run is repeated when the debugger goes back
};

/// Makes the user CPU that starts at `start` with these initialisation data.
using MakeUser =
    std::function<std::unique_ptr<user_cpu::StationCpu>(const user_cpu::StationConfig& station, Tick start)>;

/// Arguments for a user CPU of one slave. All except `left_out` must outlive the result.
struct UserRequest {
  const scenario::Scenario& scenario;
  const scenario::Slave& slave;
  ChipView& chip;         ///< of the same kind
  const GdbRequest* gdb;  ///< null without a debugger
  /// Receives the addresses of actions and expectations that the program cannot execute or report.
  std::set<const void*>& left_out;
  user_cpu::OutsideLine* outside = nullptr;  ///< the program is outside of the simulation
};

class ChipKind {
 public:
  virtual ~ChipKind() = default;

  /// As in scenarios, "dsdpv1".
  virtual const char* name() const = 0;
  /// As in documents.
  virtual const char* title() const = 0;
  virtual const PinTable& pins() const = 0;
  virtual const BoardPins& board_pins() const = 0;
  /// Cells of the memory shared by chip and user.
  virtual int cells() const { return 0; }
  /// The user gives it a buffer for Set_Prm; a longer one is answered RR.
  virtual bool has_prm_buffer() const { return false; }
  /// It takes a Chk_Cfg while the user judges the parameters.
  virtual bool takes_cfg_early() const { return false; }
  /// Its user CPU gives the chip the diagnoses of a script or a recording.
  virtual bool hands_over_diagnoses() const { return true; }
  /// Bytes of the longest configuration; default: the protocol's maximum.
  virtual int most_cfg() const { return 244; }

  // --- Scenarios. Objects are those of `ObjectOf<S>` with S the settings that the next function makes.
  // Parameters of the chip, under `chip`.
  virtual const keys::Object& chip_keys() const = 0;
  virtual std::unique_ptr<OwnSettings> make_chip_settings() const = 0;
  /// Whether a key of the chip is the level of pins, which a program without a scenario sets.
  virtual bool is_strap(const std::string& /*key*/) const { return false; }
  /// Throws InputError for settings that are inconsistent, or not supported by this program.
  virtual void check_chip(const OwnSettings& /*settings*/, const keys::Source& /*source*/) const {}
  /// The processor and its bus to the chip, under `user_cpu`.
  virtual const keys::Object& user_keys() const = 0;
  virtual std::unique_ptr<OwnSettings> make_user_settings() const = 0;
  /// Throws InputError for settings of a user CPU that are inconsistent or do not fit the chip's; `where` is the line
  /// of the slave.
  virtual void check_user(const OwnSettings& /*settings*/, const OwnSettings& /*chip*/, const keys::Source& /*source*/,
                          const std::string& /*slave*/, int /*where*/) const {}
  /// Throws InputError for what a slave of the scenario has, or the script asks of it, and this chip does not have.
  virtual void check_slave(const scenario::Scenario& /*scenario*/, const scenario::Slave& /*slave*/) const {}
  /// Throws InputError for an order that has no effect with these settings of the user CPU and the chip; `where` is its
  /// line.
  virtual void check_order(const std::string& /*order*/, const OwnSettings& /*user*/, const OwnSettings& /*chip*/,
                           const keys::Source& /*source*/, int /*where*/) const {}
  /// The place of a key of `init` in the chip, as written in its documents; empty: none.
  virtual std::string place_of(const std::string& /*init_key*/) const { return ""; }
  virtual const std::vector<Order>& orders() const;
  /// Words of command::OfChip::block, for the key `area`.
  virtual const std::vector<keys::Word>& blocks() const;

  // --- On the bench.
  // Its core as a device with pins.
  virtual std::unique_ptr<PinDevice> make_device(const ChipRequest& request) const = 0;
  /// Makes `device`, its core or RTL, the next station of the segment, with straps according to the settings. To be
  /// added to the timeline.
  virtual std::unique_ptr<PinChip> make_pin_chip(const ChipRequest& request, std::unique_ptr<PinDevice> device,
                                                 bus::Segment& segment) const = 0;
  /// The factory that makes the slave's user CPU at each release of its reset. Throws InputError if the scenario's
  /// settings for it are unusable.
  virtual MakeUser make_user(const UserRequest& request) const = 0;
  /// Whether a debugger can be connected to the slave's user CPU.
  virtual bool has_debugger(const scenario::Slave& /*slave*/) const { return false; }
  /// True if a program outside of the simulation can be the slave's user, by a serial line (UserRequest::outside).
  virtual bool has_outside_line(const scenario::Slave& /*slave*/) const { return false; }
  /// Whether the slave's user CPU is a process of its own, which a copy of this one does not have.
  virtual bool has_process(const scenario::Slave& /*slave*/) const { return false; }
  /// True if --view tlm cannot have the slave's user CPU: it sets pins in this scenario for which that view only has
  /// transactions.
  virtual bool needs_pins(const scenario::Scenario& /*scenario*/, const scenario::Slave& /*slave*/) const {
    return false;
  }

  // --- Optional features: null if missing.
  // For co-simulation with RTL: the user's own, and --engine rtl and lockstep with the reference RTL.
  virtual const cosim::RtlOf* rtl() const { return nullptr; }
  virtual bool has_reference_rtl() const { return false; }
  /// For rtl-random and rtl-faults; requires rtl().
  virtual const cosim::RandomCases* random() const { return nullptr; }
  /// Evidence for its rulings in captures of its pins, for calibrate.
  virtual const calibrate::Claims* claims() const { return nullptr; }

  // --- Events.
  // The reasons of its events.
  virtual const std::vector<profibus::Reason>& reasons() const = 0;
  /// As text.
  virtual std::string describe(const profibus::Event& event) const = 0;
  /// The cell concerned, as written in its documents; empty: none.
  virtual std::string cell_of(const profibus::Event& /*event*/) const { return ""; }
  /// The user's act that caused an event; absent by default: nothing that the user did.
  virtual std::optional<user_cpu::Act> act_of(const profibus::Event& /*event*/) const { return std::nullopt; }
  /// Default null: no text for its accesses.
  virtual std::unique_ptr<AccessReader> make_access_reader() const { return nullptr; }
  /// Null by default, and if the chip's user has no serial port. `chip`: its settings.
  virtual std::unique_ptr<HostReader> make_host_reader(const OwnSettings& /*chip*/) const { return nullptr; }
  /// Codes of the chip's events, of its user program, and of other findings at its user's side.
  virtual const std::vector<CodeTable>& codes() const = 0;

  /// In display order; default none: all pins in the order of the table.
  virtual const std::vector<PinGroup>& pin_groups() const;
  /// Signals reported by ChipListener::inside; none by default.
  virtual const std::vector<InnerSignal>& inner_signals() const;

  // --- Checks of its user's side; none by default.
  virtual const checks::RuleTable& rules() const;
  /// Pins that the checks need.
  virtual PinMask checked_pins() const { return 0; }
  /// `chip`: the scenario's settings for it, null without a scenario.
  virtual std::unique_ptr<checks::ChipChecks> make_checks(const checks::Limits& /*limits*/,
                                                          const OwnSettings* /*chip*/) const {
    return nullptr;
  }

  // --- Timing diagrams of its pins in a run's report; none by default.
  virtual const std::vector<TimingDiagram>& timing_diagrams() const;
  virtual const std::vector<BusyTime>& busy_times() const;
};

using ChipKinds = std::vector<const ChipKind*>;

/// All kinds in this program, the default of scenarios first.
const ChipKinds& chip_kinds();
/// Null if a user CPU of this kind knows no such order.
const Order* order_of(const ChipKind& kind, const std::string& word);
/// Null if there is none with this name.
const ChipKind* find_chip_kind(const std::string& name);
/// Adds one, which must outlive the program's use of scenarios, before the first scenario is read or described.
void add_chip_kind(const ChipKind& kind);
/// The built-in kinds: defined by the room that knows them (kinds/).
std::vector<const ChipKind*> built_in_chip_kinds();

}  // namespace dsdpv1::tb
