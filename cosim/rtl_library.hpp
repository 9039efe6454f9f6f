#pragma once
// A Verilated design in a shared library of its own, reference RTL or a user's, and what such a library exports in C.
// It needs no code of the program.
#include <cstdint>

namespace dsdpv1::cosim {

/// What is not initialised or reset begins with zeros (0), with ones (1), or with values that depend on the seed (2).
struct RtlStart {
  int fill = 0;
  std::uint32_t seed = 1;
  std::uint32_t fault = 0;           ///< the single fault of a build for these, 0: none
  const void* parameters = nullptr;  ///< of the reference RTL: what its kind has agreed upon with it
};

/// Its functions, all of them dsdpv1_rtl_NAME.
struct RtlLibrary {
  void* (*create)(const RtlStart* start) = nullptr;
  void (*destroy)(void* design) = nullptr;
  std::uint32_t (*layout)() = nullptr;  ///< of what it shares with the program; of the reference RTL
  void (*eval)(void* design, bool clk, std::int16_t* levels) = nullptr;  ///< as Rtl::eval
  void (*memory)(void* design, std::uint8_t* image) = nullptr;           ///< null: it cannot be seen
  void (*trace)(void* design, const char* file) = nullptr;               ///< and dump: only of a traced build
  void (*dump)(void* design, std::uint64_t picoseconds) = nullptr;
};

}  // namespace dsdpv1::cosim
