#pragma once
// A debugger's inputs to a processor, so that a run can be repeated identically up to a place.
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
    kRegister,  ///< `where`: its number in the debugger; `bytes`: its value, little endian
    kMemory,    ///< `where`: the address
    kReset,
  };
  std::uint64_t board = 0;  ///< number of the board in this run, from 0: each reset of the station makes a new one
  std::uint64_t instructions = 0;  ///< begun by the processor when it was halted
  bus::Tick at = 0;
  Kind kind = Kind::kRegister;
  std::uint32_t where = 0;
  std::vector<std::uint8_t> bytes = {};
};

/// A debugger goes back: the run is repeated up to a place before the present one. Places of a processor are twice the
/// instructions begun, plus one while it sleeps after the last of them.
struct Journey {
  std::uint64_t board = 0;
  std::uint64_t until = 0;  ///< its end
  std::uint64_t limit = 0;  ///< the place of its begin: it must end before
  bool searches = false;    ///< finds the last place before `until` where the run would have stopped
  std::string reply;        ///< message to the debugger's user at its end
};

struct DebugHistory {
  std::vector<DebuggerInput> inputs;   ///< in order
  bus::Tick live_from = 0;             ///< the debugger has control from then on, after all inputs have been replayed
  std::uint64_t boards = 0;            ///< made by the run so far
  std::optional<std::uint64_t> begin;  ///< the first place where the debugger had control
  std::optional<Journey> back;         ///< requested: the run ends and begins again
  std::optional<Journey> journey;      ///< in progress
  std::shared_ptr<void> connection;    ///< of the debugger, kept from one of these runs to the next

  void begin_again() {
    boards = 0;
    journey = std::exchange(back, std::nullopt);
  }
};

}  // namespace dsdpv1::user_cpu
