#pragma once
// A Verilated design in its own shared library, reference RTL or a user's, and the C functions that such a library
// exports. It needs no code of the program.
#include <cstdint>

namespace dsdpv1::cosim {

/// Registers without initialisation or reset begin with zeros (0), with ones (1), or with values that depend on the
/// seed (2).
struct RtlStart {
  int fill = 0;
  std::uint32_t seed = 1;
  std::uint32_t fault = 0;           ///< the single fault, for a build with faults; 0: none
  const void* parameters = nullptr;  ///< for the reference RTL: as agreed with its kind
};

/// Its functions, all of them dsdpv1_rtl_NAME.
struct RtlLibrary {
  void* (*create)(const RtlStart* start) = nullptr;
  void (*destroy)(void* design) = nullptr;
  std::uint32_t (*layout)() = nullptr;  ///< of the data shared with the program; for the reference RTL
  void (*eval)(void* design, bool clk, std::int16_t* levels) = nullptr;  ///< as Rtl::eval
  void (*memory)(void* design, std::uint8_t* image) = nullptr;           ///< null: it cannot be read
  void (*trace)(void* design, const char* file) = nullptr;               ///< and dump: only in a traced build
  void (*dump)(void* design, std::uint64_t picoseconds) = nullptr;
};

}  // namespace dsdpv1::cosim
