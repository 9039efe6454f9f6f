#pragma once
// Where the processor stands in an IT block (ARMv7-M, A7.3.2). Unicorn calls nobody for an instruction whose condition
// fails and does not tell ITSTATE between two instructions, so it is followed here by addresses.
#include <cstdint>

namespace dsdpv1::arm {

/// Length of the instruction that begins with this halfword (A5.1).
constexpr std::uint32_t thumb_bytes(std::uint16_t opcode) { return opcode >= 0xE800 ? 4 : 2; }

class ItBlock {
 public:
  /// Whether instructions of the block are still to come.
  bool open() const { return next_ != end_; }
  /// Address of the next instruction of an open block.
  std::uint32_t next() const { return next_; }

  /// The block whose first instruction is at `first`, with ITSTATE as it is there (0: none). `opcode_at(address)` reads
  /// code.
  template <typename OpcodeAt>
  void begin(std::uint32_t first, std::uint8_t state, OpcodeAt opcode_at) {
    first_ = next_ = end_ = first;
    state_ = state;
    for (; state != 0; state = following(state)) end_ += thumb_bytes(opcode_at(end_));
  }
  /// The instruction at next() was passed, executed or not.
  void pass(std::uint16_t opcode) { next_ += thumb_bytes(opcode); }
  void end() { next_ = end_; }

  /// ITSTATE of the instruction at `address`; 0 outside of the block.
  template <typename OpcodeAt>
  std::uint8_t state_at(std::uint32_t address, OpcodeAt opcode_at) const {
    std::uint8_t state = state_;
    std::uint32_t passed = first_;
    for (; state != 0 && passed < address; state = following(state)) passed += thumb_bytes(opcode_at(passed));
    return passed == address ? state : 0;
  }

 private:
  static std::uint8_t following(std::uint8_t state) {
    if ((state & 7U) == 0) return 0;
    return static_cast<std::uint8_t>((state & 0xE0U) | (unsigned{state} << 1U & 0x1FU));
  }

  std::uint32_t first_ = 0, next_ = 0, end_ = 0;
  std::uint8_t state_ = 0;
};

}  // namespace dsdpv1::arm
