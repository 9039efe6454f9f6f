#pragma once
// A kind of chip that the bench can put on its segment, and the user CPU that goes with it.
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bus/timeline.hpp"
#include "bus/wire/segment.hpp"
#include "tb/chip/chip_kind.hpp"
#include "tb/chip/chip_view.hpp"
#include "tb/chip/user_cpu/debug_history.hpp"
#include "tb/chip/user_cpu/station_cpu.hpp"
#include "tb/scenario/scenario.hpp"

namespace dsdpv1::tb {

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

class ChipMaker : public ChipKind {
 public:
  /// The chip by the pins of its core. It is an agent of the timeline, after all that were added before.
  virtual std::unique_ptr<ChipView> make_pin_chip(const ChipRequest& request, bus::Segment& segment,
                                                  bus::Timeline& timeline) const = 0;
  /// What makes the slave's user CPU at each release of its reset. Throws InputError where the scenario's settings for
  /// it are no use.
  virtual MakeUser make_user(const UserRequest& request) const = 0;
  /// Whether the slave's user CPU is one that a debugger can be connected to.
  virtual bool has_debugger(const scenario::Slave& /*slave*/) const { return false; }
  /// The name of the program that has the slave's user CPU, where this one has not; empty: this one has.
  virtual const char* other_program(const scenario::Slave& /*slave*/) const { return ""; }
};

/// The scenario's kind of chip; throws InputError when the bench cannot make it.
const ChipMaker& chip_maker(const scenario::Scenario& scenario);

/// The settings of the standard user program, as the scenario has them.
user_cpu::ProgramOptions program_options(const scenario::UserCpu& user, const user_cpu::StationConfig& station);

}  // namespace dsdpv1::tb
