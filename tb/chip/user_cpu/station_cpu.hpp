#pragma once
// The user CPU of a station as the bench sees it, whatever chip it serves and whatever runs on it: a C++ program or
// firmware on a board.
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bus/timeline.hpp"
#include "tb/chip/user_cpu/others.hpp"
#include "tb/chip/user_cpu/program.hpp"

namespace dsdpv1::user_cpu {

/// What a board with a processor of its own tells at the end.
struct BoardReport {
  std::uint64_t instructions = 0;
  std::uint64_t cycles = 0;        ///< of its clock, since the start
  std::int64_t hclk_hz = 0;        ///< its clock at the end ...
  std::string hclk_source;         ///< ... and where it comes from
  std::vector<std::string> notes;  ///< what its firmware did that the board does not do like a real one
};

/// Lives from the release of the board's reset to the next reset.
class StationCpu : public bus::Agent {
 public:
  /// The chip's interrupt changed at `at`; also callable while the chip runs ahead of this agent's turn.
  virtual void interrupt_changed(Tick at, bool level) = 0;
  /// Carried out in order, each as soon as the program has finished what it is at.
  virtual void command(Tick now, const Command& command) = 0;
  virtual UserCounters counters() const = 0;
  /// Of those the blocks of outputs alone: cheap, looked at after each step.
  virtual std::uint64_t outputs_received() const = 0;
  /// Whether the program tells what it does: its counters, its errors, the outputs that it fetched.
  virtual bool tells() const { return true; }
  /// What the program fetched last.
  virtual const std::vector<std::uint8_t>& outputs() const = 0;
  /// Absent where there is no such board.
  virtual std::optional<BoardReport> board() const { return std::nullopt; }

  /// To be set before the first turn; null, as at first: nothing is known, each action has a turn of its own.
  virtual void set_others(Others* others) { others_ = others; }

  std::function<void(const ProgramError&)> on_error;
  /// A line of text that the program printed.
  std::function<void(Tick at, const std::string& line)> on_text;
  /// The processor cannot go on: why, in one line, and its registers in several.
  std::function<void(Tick at, const std::string& why, const std::string& registers)> on_failure;
  /// next() has changed outside of a turn and of the calls above, as what it waits for has come at a pin.
  std::function<void()> on_plan;
  /// A debugger wants the run to end.
  std::function<void()> on_killed;

 protected:
  Others* others() const { return others_; }

 private:
  Others* others_ = nullptr;
};

}  // namespace dsdpv1::user_cpu
