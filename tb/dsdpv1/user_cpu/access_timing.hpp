#pragma once
// When a CPU moves its bus pins during one access to the DPRAM. Every value is in ticks of 1/12 ns and may be negative
// where that makes sense, so that each limit of table 15 (rulings P5, P11) can be kept exactly, kept with margin, or
// violated.
#include <algorithm>

#include "bus/time.hpp"

namespace user_cpu {

using bus::Tick;

/// One read or write cycle. The strobe is RD for a read, WR for a write.
///
///   A      --<=================>--     address_setup before the strobe falls, address_hold after it rises
///   CSR    ---\_______________/---     cs_lead before, cs_trail after
///   RD/WR  ------\_________/------     rd_low or wr_low
///   D in   ---------------|-------     read: sampled rd_sample after RD fell
///   D out  ---------<==========>--     write: data_setup before WR rises, data_hold after it
///
/// The defaults are a CPU at 72 MHz (HCLK 13.9 ns) in the manner of an STM32F103. Writes are those of its FSMC with
/// ADDSET = 1, DATAST = 5: 2 HCLK of address phase, WR low for 5 HCLK, 1 HCLK of hold. Reads have the same frame, RD
/// low for 6 HCLK and sampled 1 HCLK before its rise, which no setting of the FSMC gives: its exact edges come from
/// fsmc_timing.hpp.
struct AccessTiming {
  Tick address_setup = 333;  ///< Tc: >= 0; negative: A arrives after the strobe fell
  Tick cs_lead = 333;        ///< CSR falls before the strobe; >= 0
  Tick rd_low = 1000;        ///< > 0
  Tick rd_sample = 833;      ///< Tw: >= 375 (31.25 ns) to be certain of the data
  Tick wr_low = 833;         ///< Ts: >= 150 (12.5 ns)
  Tick data_setup = 833;     ///< Td: >= 150; negative: D arrives after WR rose
  Tick data_hold = 167;      ///< Td: >= 150; 0: D is released together with WR
  Tick address_hold = 167;   ///< after the strobe rose; Td for writes
  Tick cs_trail = 167;       ///< CSR rises after the strobe; >= 0
  Tick recovery = 333;       ///< from the last edge to the end of the access
};

/// From the fall of RD until D is sampled; before RD and CSR are low there is nothing to sample.
inline Tick sample_in_read(const AccessTiming& timing) {
  return std::max({timing.rd_sample, Tick{0}, -timing.cs_lead});
}

}  // namespace user_cpu
