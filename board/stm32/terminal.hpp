#pragma once
// USART1 of the STM32F103 (RM0008, chapter USART) as a terminal: what is sent comes out as lines; nothing is received.
// It is always ready: the bit rate is not simulated.
#include <cstdint>
#include <functional>
#include <string>

#include "board/stm32/registers.hpp"

namespace dsdpv1::arm {

class Terminal {
 public:
  static const RegisterTable kRegisters;

  std::uint32_t read(std::uint32_t offset) const { return words_.read(offset); }
  void write(std::uint32_t offset, std::uint32_t value);
  /// The registers; characters that were sent stay.
  void reset() { words_ = {}; }

  /// A line without its end; longer ones than 200 characters are cut. Unprintable characters are dots.
  std::function<void(const std::string&)> on_line;
  /// Characters sent after the last line's end.
  const std::string& unfinished() const { return line_; }

 private:
  void send(char character);
  RegisterWords<kRegisters, 7> words_;
  std::string line_;
};

}  // namespace dsdpv1::arm
