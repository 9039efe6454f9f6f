#pragma once
// How the FSMC of an STM32F103 (bank 1, SRAM, 8 bits, asynchronous) moves its pins: from the fields of FSMC_BCR,
// FSMC_BTR and FSMC_BWTR to the edges of an AccessTiming. Source: ST's RM0008, chapter FSMC, and the asynchronous SRAM
// timings of the STM32F103xE datasheet, whose figures for ADDSET = 0, DATAST = 1 the test repeats.
#include <cstdint>
#include <optional>

#include "kinds/dsdpv1/user_cpu/access_timing.hpp"

namespace dsdpv1::user_cpu {

enum class FsmcMode : std::uint8_t {
  k1,  ///< EXTMOD = 0: RD falls with CSR
  kA,  ///< EXTMOD = 1, ACCMOD = 00: RD falls ADDSET + 1 HCLK after CSR; writes have a register of their own
};

/// The fields of FSMC_BTR, or in mode A those of FSMC_BWTR for writes, in HCLK periods. The values are the model's for
/// a CPU that sets nothing (p), not those after a reset (15, 255, 15).
struct FsmcTiming {
  int addset = 1;   ///< 0..15
  int datast = 5;   ///< 0..255; RM0008 reserves 0: here writes have no low time of WR then, which violates Ts
  int busturn = 0;  ///< 0..15
};

/// What one bank is set to.
struct FsmcBank {
  FsmcMode mode = FsmcMode::k1;
  FsmcTiming read, write;  ///< in mode 1 the FSMC has one register for both
  std::int64_t hclk_hz = 72'000'000;
};

/// Values that take the place of a bank's own; timing fields in both directions.
struct FsmcOverride {
  std::optional<int> addset, datast, busturn, hclk_mhz;
  std::optional<FsmcMode> mode;
};

struct FsmcAccess {
  AccessTiming read, write;
};

/// With HCLK periods counted from the fall of CSR, at which A is valid:
///
///   read, mode 1   RD falls at 0
///   read, mode A   RD falls at ADDSET + 1
///   read           D is sampled at ADDSET + 1 + DATAST + 1; RD and CSR rise 2 later, A ends there
///   write          WR falls and D is driven at ADDSET + 1; WR rises DATAST later; D, CSR and A end 1 after that
///
/// CSR then stays high for BUSTURN + 1 in mode 1 and BUSTURN + 2 in mode A at least. Every edge is its HCLK count in
/// ticks, rounded once.
FsmcAccess access_timing(const FsmcBank& bank);

FsmcBank with(FsmcBank bank, const FsmcOverride& given);

}  // namespace dsdpv1::user_cpu
