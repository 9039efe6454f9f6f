#pragma once
#include <cstdint>

#include "bus/time.hpp"

namespace dsdpv1::tb {

/// Registers and memory of a chip for a CPU whose bus has no pins here: one byte at tick `at`, with all effects. Calls
/// come in order of time, also with those of the chip's pins.
class RegisterPort {
 public:
  virtual std::uint8_t load(bus::Tick at, std::uint16_t address) = 0;
  virtual void store(bus::Tick at, std::uint16_t address, std::uint8_t value) = 0;

 protected:
  ~RegisterPort() = default;
};

}  // namespace dsdpv1::tb
