#pragma once
// What a debugger does to a processor, so that a run can be done again as it was.
#include <cstdint>
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
  std::uint64_t board = 0;         ///< of those that the run has made so far, from 0: each reset of the station makes one
  std::uint64_t instructions = 0;  ///< that the processor had begun when it was halted
  bus::Tick at = 0;
  Kind kind = Kind::kRegister;
  std::uint32_t where = 0;
  std::vector<std::uint8_t> bytes = {};
};

struct DebugHistory {
  std::vector<DebuggerInput> inputs;  ///< in order
  bus::Tick live_from = 0;            ///< the debugger has a say from then on, when all inputs are played
  std::uint64_t boards = 0;           ///< that the run has made so far
};

}  // namespace dsdpv1::user_cpu
