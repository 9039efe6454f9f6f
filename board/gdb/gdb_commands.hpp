#pragma once
// The effect of each packet of gdb while the processor is halted ("Debugging with GDB", appendix E.2 to E.4).
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "board/cpu/breakpoints.hpp"
#include "board/cpu/debug_target.hpp"
#include "board/gdb/flash_loader.hpp"
#include "board/gdb/gdb_packet.hpp"

namespace dsdpv1::arm {

/// How the run continues after a packet.
enum class Resumption {
  kNone,          ///< it does not: the processor stays halted
  kContinue,      ///< until something stops it
  kStep,          ///< until an instruction outside of the step range is about to be executed
  kDetach,        ///< without gdb
  kKill,          ///< not at all: the run ends
  kStepBack,      ///< to the instruction before
  kContinueBack,  ///< to where something would have stopped it last
  kReset,         ///< to the reset handler, before its first instruction
  kBeginAgain,    ///< the whole run, with the program that its file has now
};

/// Addresses from `start` to before `end` that a step runs through; equal: one instruction only.
struct StepRange {
  std::uint32_t start = 0, end = 0;
  bool holds(std::uint32_t pc) const { return start <= pc && pc < end; }
};

/// Breakpoints and watchpoints stop the run.
struct Stops {
  Breakpoints breakpoints;
  Watchpoints watchpoints;
};

class GdbCommands {
 public:
  /// `reverses`: gdb may go back.
  explicit GdbCommands(DebugTarget& target, bool reverses = false)
      : target_(target), reverses_(reverses), flash_(target) {}

  struct Result {
    std::optional<std::string>
        reply;  ///< empty text: the packet is not known; nullopt: the reply comes when the run stops
    Resumption resumption = Resumption::kNone;  ///< kReset: the reply, if there is one, comes then
    bool stop_acknowledging = false;            ///< after the reply
    std::string refused = {};                   ///< why, for the user; most gdbs do not show it
  };
  Result execute(std::string_view packet);

  const Breakpoints& breakpoints() const { return breakpoints_; }
  const Watchpoints& watchpoints() const { return watchpoints_; }
  const StepRange& step_range() const { return step_range_; }
  Stops stops() const { return {breakpoints_, watchpoints_}; }
  void set_stops(Stops stops);
  /// `now`: flash with the program that the run's file has now. gdb may load it: the run begins again.
  void set_program(std::function<std::vector<std::uint8_t>()> now) { program_now_ = std::move(now); }

  /// gdb goes: nothing stops the run any longer.
  void forget_stops();

  /// `target extended-remote`: gdb may `run` the program again after `kill`.
  bool extended() const { return extended_; }
  void set_extended(bool extended) { extended_ = extended; }
  /// After `kill` and before `run`, while extended.
  bool killed() const { return killed_; }

  /// The reply that tells why the run has stopped; `?` repeats it.
  void set_stop_reply(std::string reply) { stop_reply_ = std::move(reply); }
  const std::string& stop_reply() const { return stop_reply_; }

 private:
  Result query(std::string_view packet);
  std::string set(std::string_view packet, Result& result);
  std::string transfer(GdbFields fields);
  Result monitor(std::string_view command);

  std::string read_register(GdbFields fields) const;
  std::string write_register(GdbFields fields);
  void write(Register which, std::uint32_t value);
  std::string read_registers() const;
  std::string write_registers(std::string_view digits);
  std::string read_memory(GdbFields fields) const;
  std::string write_memory(GdbFields fields, bool binary);
  std::string change_stop(GdbFields fields, bool insert);
  std::string change_watchpoint(const Watchpoint& point, bool insert);

  Result back(std::string_view packet) const;
  Result verbose(GdbFields fields);
  Result flash(GdbFields fields);
  Result loaded();
  Result kill(bool replies);
  Result run_again();
  Result resume(GdbFields fields);
  Result resume_at(GdbFields fields, Resumption resumption);

  DebugTarget& target_;
  bool reverses_;
  Breakpoints breakpoints_;
  Watchpoints watchpoints_;
  StepRange step_range_;
  FlashLoader flash_;
  std::function<std::vector<std::uint8_t>()> program_now_;
  bool extended_ = false, killed_ = false;
  std::string stop_reply_;
};

}  // namespace dsdpv1::arm
