#pragma once
// The effect of each packet of gdb while the processor is halted ("Debugging with GDB", appendix E.2 to E.4).
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "board/cpu/breakpoints.hpp"
#include "board/cpu/debug_target.hpp"
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
  explicit GdbCommands(DebugTarget& target, bool reverses = false) : target_(target), reverses_(reverses) {}

  struct Result {
    std::optional<std::string>
        reply;  ///< empty text: the packet is not known; nullopt: the reply comes when the run stops
    Resumption resumption = Resumption::kNone;
    bool stop_acknowledging = false;  ///< after the reply
  };
  Result execute(std::string_view packet);

  const Breakpoints& breakpoints() const { return breakpoints_; }
  const Watchpoints& watchpoints() const { return watchpoints_; }
  const StepRange& step_range() const { return step_range_; }
  Stops stops() const { return {breakpoints_, watchpoints_}; }
  void set_stops(Stops stops);
  /// Nothing stops the run any longer.
  void forget_stops();

  /// The reply that tells why the run has stopped; `?` repeats it.
  void set_stop_reply(std::string reply) { stop_reply_ = std::move(reply); }
  const std::string& stop_reply() const { return stop_reply_; }

 private:
  std::string query(std::string_view packet);
  std::string set(std::string_view packet, Result& result);
  std::string transfer(GdbFields fields);
  std::string monitor(std::string_view command);

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
  Result resume(GdbFields fields);
  Result resume_at(GdbFields fields, Resumption resumption);

  DebugTarget& target_;
  bool reverses_;
  Breakpoints breakpoints_;
  Watchpoints watchpoints_;
  StepRange step_range_;
  std::string stop_reply_;
};

}  // namespace dsdpv1::arm
