#pragma once
// The bench's interface to a station's user CPU, for any chip and program: a C++ program or firmware on a board.
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bus/timeline.hpp"
#include "tb/chip/user_cpu/others.hpp"
#include "tb/chip/user_cpu/place.hpp"
#include "tb/chip/user_cpu/program.hpp"

namespace dsdpv1::user_cpu {

/// Final report of a board with a processor.
struct BoardReport {
  std::uint64_t instructions = 0;
  std::uint64_t cycles = 0;        ///< of its clock, since the start
  std::int64_t hclk_hz = 0;        ///< its clock at the end ...
  std::string hclk_source;         ///< ... and its source
  std::vector<std::string> notes;  ///< actions of its firmware that the board does not model like a real one
};

/// Lives from the release of the board's reset to the next reset.
class StationCpu : public bus::Agent {
 public:
  /// The chip's interrupt changed at `at`; may be called while the chip runs ahead of this agent's turn.
  virtual void interrupt_changed(Tick at, bool level) = 0;
  /// Executed in order, each as soon as the program has finished its present work.
  virtual void command(Tick now, const Command& command) = 0;
  virtual UserCounters counters() const = 0;
  /// Only the number of output blocks: cheap, read after each step.
  virtual std::uint64_t outputs_received() const = 0;
  /// Whether the program reports its counters, its errors, and the outputs that it fetches.
  virtual bool tells() const { return true; }
  /// Whether its program carries out a script's action with this word.
  virtual bool carries_out(const std::string& /*word*/) const { return tells(); }
  /// The outputs that the program fetched last.
  virtual const std::vector<std::uint8_t>& outputs() const = 0;
  /// Absent without such a board.
  virtual std::optional<BoardReport> board() const { return std::nullopt; }

  /// Where its program did this; absent: not known. Only for the last acts, not for those before a reset.
  virtual std::optional<Place> where(const Act& /*act*/) const { return std::nullopt; }

  /// Set it before the first turn; null, the default: nothing is known, each action has a separate turn.
  virtual void set_others(Others* others) { others_ = others; }

  std::function<void(const ProgramError&)> on_error;
  /// Called for a line of text printed by the program.
  std::function<void(Tick at, const std::string& line)> on_text;
  /// Called when the processor cannot continue: the reason in one line, and its registers in several.
  std::function<void(Tick at, const std::string& why, const std::string& registers)> on_failure;
  /// Called when next() changes because of a pin event, outside a turn and the calls above.
  std::function<void()> on_plan;
  /// Called when a debugger ends the run.
  std::function<void()> on_killed;

 protected:
  Others* others() const { return others_; }

 private:
  Others* others_ = nullptr;
};

}  // namespace dsdpv1::user_cpu
