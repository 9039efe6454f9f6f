#pragma once
// Peripherals that the board does not have: they read 0 until written, keep what is written, and are listed at the end
// of the run.
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace dsdpv1::arm {

class OtherRegisters {
 public:
  /// An STM32F103xE has something there: a peripheral, system memory, the debug port.
  static bool is_mapped(std::uint32_t address);
  /// `address` of a word, `pc` of the instruction that uses it.
  std::uint32_t read(std::uint32_t address, std::uint32_t pc);
  void write(std::uint32_t address, std::uint32_t value, std::uint32_t pc);
  /// Without a use of it.
  std::uint32_t peek(std::uint32_t address) const;
  /// One line for each block of 1 KB that was used: its name in the STM32F103, how often, and the first place in the
  /// firmware.
  std::vector<std::string> notes(const std::function<std::string(std::uint32_t pc)>& place) const;

 private:
  struct Use {
    std::uint64_t reads = 0, writes = 0;
    std::uint32_t first_pc = 0;
  };
  Use& use(std::uint32_t address, std::uint32_t pc);
  std::map<std::uint32_t, std::uint32_t> words_;
  std::map<std::uint32_t, Use> uses_;  ///< by block
};

}  // namespace dsdpv1::arm
