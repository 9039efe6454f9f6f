#pragma once
// The user CPU's accesses to a VPC3+S by SPI (A59): a frame each, which no handler interrupts.
#include <cstdint>
#include <memory>
#include <vector>

#include "kinds/user_cpu/cpu.hpp"
#include "kinds/user_cpu/spi_master.hpp"

namespace dsdpv1::spc3_user {

class SpiUser {
 public:
  /// `cpu` must outlive it.
  SpiUser(user_cpu::Cpu& cpu, const dsdpv1::SpiTiming& timing)
      : cpu_(cpu), master_(cpu.serial_pins().make_spi_master(timing)) {}

  std::uint8_t read(std::uint16_t address);
  void write(std::uint16_t address, std::uint8_t value);
  void read_array(std::uint16_t address, std::uint8_t* bytes, std::uint8_t length);
  void write_array(std::uint16_t address, const std::uint8_t* bytes, std::uint8_t length);

 private:
  using Bytes = std::vector<std::uint8_t>;
  /// MISO, beside the data.
  Bytes frame(std::uint8_t instruction, std::uint16_t address, const Bytes& data);

  user_cpu::Cpu& cpu_;
  std::unique_ptr<user_cpu::SpiMaster> master_;
};

}  // namespace dsdpv1::spc3_user
