#pragma once
// A kind of slave chip: what its pins, events, checks and keys are called, and what puts it on the bench with its user
// CPU.
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

/// What a scenario says with the keys of one kind of chip. Each kind derives its own.
struct OwnSettings {
  virtual ~OwnSettings() = default;
  int line = 0;
};

/// A code that logs, result files and scenarios may hold, what it says and what to do about it.
struct CodeText {
  std::string code, severity, text, advice;
  std::string example = {};  ///< the text with values in it; empty where it has none
};

/// Codes of one origin, in the order of their table.
struct CodeTable {
  std::string title, introduction;
  std::vector<CodeText> codes;
};

/// Something that a script can order the user program to do, and only programs for this kind of chip know.
struct Order {
  keys::Choice choice;  ///< its word under `do`, and the keys that it takes
  /// What the log says when it is given.
  std::string (*said)(const user_cpu::command::OfChip& order) = nullptr;
  bool one_by_one = false;  ///< `times`: so many orders
};

/// A signal inside of the chip that waves can show.
struct InnerSignal {
  const char* name;
  int width;  ///< 0: its values are words
};

/// What a user CPU did last at its chip, from the pins.
class AccessReader {
 public:
  virtual ~AccessReader() = default;
  /// In order of time; of inputs at one tick in the order of the pins' numbers.
  virtual void pin(bus::Tick at, PinNumber pin, Level level) = 0;
  /// Its cell, value and time; "none" when there was none.
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
  const OwnSettings& settings;  ///< of ChipKind::make_chip_settings
  Engine engine = Engine::kSkip;
  bool inside = false;  ///< inner signals are wanted; Engine::kStep
  PinMask watched = 0;  ///< pins whose changes are wanted; of the inputs of the host bus all or none
};

/// `--gdb`: the debugger of a processor that runs firmware.
struct GdbRequest {
  std::optional<int> port;                      ///< absent: nobody can connect, only what was done before is done again
  std::function<void(const std::string&)> say;  ///< a line for the user
  std::function<bool()> stopped;                ///< whether the run is to end
  std::shared_ptr<user_cpu::DebugHistory> history;
  bool goes_back = true;  ///< who carries out the run does it again when the debugger goes back
};

/// Makes the user CPU that starts at `start` with these initialisation data.
using MakeUser =
    std::function<std::unique_ptr<user_cpu::StationCpu>(const user_cpu::StationConfig& station, Tick start)>;

/// A user CPU for one slave. All of it must outlive the result, but for `left_out`.
struct UserRequest {
  const scenario::Scenario& scenario;
  const scenario::Slave& slave;
  ChipView& chip;         ///< made by the same kind
  const GdbRequest* gdb;  ///< null without a debugger
  /// Gets the actions and expectations that the program cannot carry out or tell, by address.
  std::set<const void*>& left_out;
};

class ChipKind {
 public:
  virtual ~ChipKind() = default;

  /// As scenarios write it, "dsdpv1".
  virtual const char* name() const = 0;
  /// As documents call it.
  virtual const char* title() const = 0;
  virtual const PinTable& pins() const = 0;
  virtual const BoardPins& board_pins() const = 0;
  /// Cells of the memory that chip and user share.
  virtual int cells() const { return 0; }
  /// Bytes of the longest configuration that it holds; by default all that the protocol has.
  virtual int most_cfg() const { return 244; }

  // --- Scenarios. Objects are those of `ObjectOf<S>` with S the settings that the next function makes.
  /// Parameters of the chip itself, under `chip`.
  virtual const keys::Object& chip_keys() const = 0;
  virtual std::unique_ptr<OwnSettings> make_chip_settings() const = 0;
  /// Whether a key of the chip is the level of pins, which a program that has no scenario sets.
  virtual bool is_strap(const std::string& /*key*/) const { return false; }
  /// Throws InputError for settings that do not fit each other, or that this program does not have.
  virtual void check_chip(const OwnSettings& /*settings*/, const keys::Source& /*source*/) const {}
  /// The processor and its bus to the chip, under `user_cpu`.
  virtual const keys::Object& user_keys() const = 0;
  virtual std::unique_ptr<OwnSettings> make_user_settings() const = 0;
  /// Throws InputError for settings of a user CPU that do not fit each other or the chip's; `where` is the line of the
  /// slave.
  virtual void check_user(const OwnSettings& /*settings*/, const OwnSettings& /*chip*/, const keys::Source& /*source*/,
                          const std::string& /*slave*/, int /*where*/) const {}
  /// Throws InputError for an order that is of no use with these settings of the user CPU and the chip; `where` is its
  /// line.
  virtual void check_order(const std::string& /*order*/, const OwnSettings& /*user*/, const OwnSettings& /*chip*/,
                           const keys::Source& /*source*/, int /*where*/) const {}
  /// Where the chip keeps the value of a key of `init`, as its documents say it; empty: nowhere.
  virtual std::string place_of(const std::string& /*init_key*/) const { return ""; }
  virtual const std::vector<Order>& orders() const;
  /// Words of command::OfChip::block, for the key `area`.
  virtual const std::vector<keys::Word>& blocks() const;

  // --- On the bench.
  /// Its core behind pins.
  virtual std::unique_ptr<PinDevice> make_device(const ChipRequest& request) const = 0;
  /// `device`, its core or RTL, as the next station of the segment, its straps as the settings say. To be added to the
  /// timeline.
  virtual std::unique_ptr<PinChip> make_pin_chip(const ChipRequest& request, std::unique_ptr<PinDevice> device,
                                                 bus::Segment& segment) const = 0;
  /// What makes the slave's user CPU at each release of its reset. Throws InputError where the scenario's settings for
  /// it are no use.
  virtual MakeUser make_user(const UserRequest& request) const = 0;
  /// Whether the slave's user CPU is one that a debugger can be connected to.
  virtual bool has_debugger(const scenario::Slave& /*slave*/) const { return false; }
  /// Whether a user CPU of the scenario moves pins that --view tlm has only transactions for.
  virtual bool needs_pins(const scenario::Scenario& /*scenario*/) const { return false; }

  // --- Faculties that a kind may lack: null.
  /// For RTL beside the model: --engine rtl and lockstep, cosim.
  virtual const cosim::RtlOf* rtl() const { return nullptr; }
  /// For rtl-random and rtl-faults, of a kind that has rtl(), too.
  virtual const cosim::RandomCases* random() const { return nullptr; }
  /// What captures of its pins can show of its rulings, for calibrate.
  virtual const calibrate::Claims* claims() const { return nullptr; }

  // --- What happens.
  /// Of its events.
  virtual const std::vector<profibus::Reason>& reasons() const = 0;
  /// In words.
  virtual std::string describe(const profibus::Event& event) const = 0;
  /// The cell that it is about, as its documents write it; empty: none.
  virtual std::string cell_of(const profibus::Event& /*event*/) const { return ""; }
  /// By default null: its accesses are not put into words.
  virtual std::unique_ptr<AccessReader> make_access_reader() const { return nullptr; }
  /// By default, and where the chip's user has no serial port, null. `chip`: its settings.
  virtual std::unique_ptr<HostReader> make_host_reader(const OwnSettings& /*chip*/) const { return nullptr; }
  /// Codes of the chip's events; of what its user program reports; of what else its user's side can meet.
  virtual const std::vector<CodeTable>& codes() const = 0;

  /// In the order in which they are shown; none by default: all pins as the table has them.
  virtual const std::vector<PinGroup>& pin_groups() const;
  /// Those that ChipListener::inside tells; none by default.
  virtual const std::vector<InnerSignal>& inner_signals() const;

  // --- Checks of its user's side; none by default.
  virtual const checks::RuleTable& rules() const;
  /// Pins that the checks need.
  virtual PinMask checked_pins() const { return 0; }
  /// `chip`: what the scenario says of it, null where there is no scenario.
  virtual std::unique_ptr<checks::ChipChecks> make_checks(const checks::Limits& /*limits*/,
                                                          const OwnSettings* /*chip*/) const {
    return nullptr;
  }

  // --- What a report of a run shows of its pins; none by default.
  virtual const std::vector<TimingDiagram>& timing_diagrams() const;
  virtual const std::vector<BusyTime>& busy_times() const;
};

/// All kinds that this program knows, the default of scenarios first.
const std::vector<const ChipKind*>& chip_kinds();
/// Null when there is none with this name.
const ChipKind* find_chip_kind(const std::string& name);
/// Adds one, which must outlive the program's use of scenarios, before the first scenario is read or described.
void add_chip_kind(const ChipKind& kind);
/// Those that are built in: defined by the room that knows them (kinds/).
std::vector<const ChipKind*> built_in_chip_kinds();

}  // namespace dsdpv1::tb
