#pragma once
// The pins of the host port as moved by the FSMC of an STM32F103: converts the fields of its registers to the edges of
// an AccessTiming. Source: ST's RM0008, chapter FSMC, and the asynchronous SRAM timings of the STM32F103xE datasheet,
// whose figures for ADDSET = 0, DATAST = 1 are repeated in the test.
#include "board/stm32/fsmc_timing.hpp"
#include "model/dsdpv1/host_access.hpp"

namespace dsdpv1::user_cpu {

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
/// CSR then stays high for at least BUSTURN + 1 in mode 1 and BUSTURN + 2 in mode A. Every edge is its HCLK count in
/// ticks, rounded once.
FsmcAccess access_timing(const FsmcBank& bank);

}  // namespace dsdpv1::user_cpu
