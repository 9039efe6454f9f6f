#pragma once
// External interrupts of the STM32F103: AFIO chooses the port of each of the 16 GPIO lines, EXTI the edges (RM0008,
// chapters AFIO, EXTI).
#include <array>
#include <cstdint>
#include <utility>

#include "board/stm32/registers.hpp"

namespace dsdpv1::arm {

/// Which interrupts of the NVIC the pending lines ask for: bit 0..4 lines 0..4, bit 5 lines 5 to 9, bit 6 lines 10
/// to 15.
constexpr std::array<unsigned, 7> kExtiIrq = {6, 7, 8, 9, 10, 23, 40};

class Exti {
 public:
  static const RegisterTable kRegisters, kAfioRegisters;

  std::uint32_t read(std::uint32_t offset) const { return words_.read(offset); }
  void write(std::uint32_t offset, std::uint32_t value);
  std::uint32_t read_afio(std::uint32_t offset) const { return afio_.read(offset); }
  void write_afio(std::uint32_t offset, std::uint32_t value) { afio_.write(offset, value); }

  /// The pin `line` of `port` (0 = A ... 6 = G) has got this level.
  void edge(unsigned port, unsigned line, bool level);
  /// Some line has an edge to wait for at `port`.
  bool listens(unsigned port) const;
  /// An edge or SWIER has made an event (EMR) since the last call.
  bool take_event() { return std::exchange(event_, false); }
  /// A bit for each of kExtiIrq whose interrupt is asked for.
  unsigned requests() const;

 private:
  static constexpr std::uint32_t kExticr1 = 0x08;
  unsigned port_of(unsigned line) const { return afio_[kExticr1 + line / 4 * 4] >> (line % 4 * 4) & 0xFU; }
  void request(std::uint32_t lines);
  RegisterWords<kRegisters, 6> words_;
  RegisterWords<kAfioRegisters, 8> afio_;
  bool event_ = false;
};

}  // namespace dsdpv1::arm
