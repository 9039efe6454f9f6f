#pragma once
// What a debugger does to a processor, so that a run can be done again as it was, and to where.
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bus/time.hpp"

namespace dsdpv1::user_cpu {

/// A change by the debugger, while the processor is halted between two instructions.
struct DebuggerInput {
  enum class Kind : std::uint8_t {
    kRegister,  ///< `where`: its number as the debugger has it; `bytes`: its value, little endian
    kMemory,    ///< `where`: the address
    kReset,
  };
  std::uint64_t board = 0;  ///< of those that the run has made so far, from 0: each reset of the station makes one
  std::uint64_t instructions = 0;  ///< that the processor had begun when it was halted
  bus::Tick at = 0;
  Kind kind = Kind::kRegister;
  std::uint32_t where = 0;
  std::vector<std::uint8_t> bytes = {};
};

/// A debugger goes back: the run is done again up to a place before the present one. Places of a processor are twice
/// the instructions begun, and one more while it sleeps after the last of them.
struct Journey {
  std::uint64_t board = 0;
  std::uint64_t until = 0;  ///< where it ends
  std::uint64_t limit = 0;  ///< the place that it began at: it has to end before
  bool searches = false;    ///< for the last place before `until` where something would have stopped the run
  std::string reply;        ///< what the debugger's user is told at its end
};

struct DebugHistory {
  std::vector<DebuggerInput> inputs;   ///< in order
  bus::Tick live_from = 0;             ///< the debugger has a say from then on, when all inputs are played
  std::uint64_t boards = 0;            ///< that the run has made so far
  std::optional<std::uint64_t> begin;  ///< the first place where the debugger had a say
  std::optional<Journey> back;         ///< it is asked for: the run ends, and begins again
  std::optional<Journey> journey;      ///< it is under way
  std::shared_ptr<void> connection;    ///< of the debugger, from one of these runs to the next

  void begin_again() {
    boards = 0;
    journey = std::exchange(back, std::nullopt);
  }
};

}  // namespace dsdpv1::user_cpu
