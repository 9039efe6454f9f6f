#pragma once
// An instruction as the engine executes it: decoded once, then called.
#include <cstdint>

namespace dsdpv1::arm {

class Engine;

/// Length of the instruction that begins with this halfword (ARMv7-M, A5.1).
constexpr std::uint32_t thumb_bytes(std::uint16_t opcode) { return opcode >= 0xE800 ? 4 : 2; }

/// How an instruction affects the time of its neighbours (timing.cpp).
enum class Kind : std::uint8_t {
  kOther,
  kData,          ///< rd is the result of data processing
  kCompare,       ///< the same for flags alone
  kLoad,          ///< of a word at most, from rn + value to rd
  kLoadLiteral,   ///< no register is part of the address
  kLoadIndexed,   ///< from rn + rm
  kStore,         ///< to rn + value
  kStoreIndexed,  ///< to rn + rm
  kMany,          ///< several words from rn on
  kTable,         ///< a branch by what stands at rn + rm
  kIt,
  kBranch,  ///< to `value`
};

/// A branch's target: kSplit fills the pipeline a cycle later, kSplitLine also needs the next line of flash.
enum class Entry : std::uint8_t { kUnknown, kPlain, kSplit, kSplitLine };

/// Where a branch leads, seen from its end: a line of flash, or beyond what is known when it is decoded.
enum Reach : std::uint8_t { kSameLine, kNextLine, kOtherLine, kFar };

/// Registers and numbers mean what the operation (operations.hpp) takes them for.
struct Instruction {
  /// Carries it out, pays for it and turns to the next one; or leaves it undone with a trap.
  using Operation = void (*)(Engine&, const Instruction&);

  Operation run = nullptr;
  Operation run_in_it = nullptr;  ///< inside of an IT block, where most halfword instructions leave the flags alone
  /// Immediate, offset, list of registers; address of a literal or a branch's target. The engine keeps a branch's Reach
  /// in `shift`, and unless that is kFar the way to its target in `value`, in halfwords.
  std::uint32_t value = 0;
  std::uint8_t rd = 0, rn = 0, rm = 0, ra = 0;
  std::uint8_t shift = 0, amount = 0;
  std::uint8_t halfwords = 1;
  Kind kind = Kind::kOther;
  std::uint16_t cost = 1;  ///< as decode() makes it, cycles; as the engine keeps it, thousandths of a cycle
  Entry entry = Entry::kUnknown;
  bool ends_line = false;  ///< the one after it needs the next line of flash
};

/// The instruction at `address` (ARMv7-M, chapters A5 to A7) in `first`, and a long one also in `second`. Those that a
/// Cortex-M3 lacks are undefined, or a coprocessor's. Its cost is without neighbours and memory; `entry` and
/// `ends_line` are for the caller.
Instruction decode(std::uint32_t address, std::uint16_t first, std::uint16_t second);

/// Cycles of `one` when `next` is executed after it.
unsigned cycles_before(const Instruction& one, const Instruction& next);

}  // namespace dsdpv1::arm
