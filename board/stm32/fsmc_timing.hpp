#pragma once
// What the FSMC of an STM32F103 (bank 1, SRAM, 8 bits, asynchronous) is set to: the fields of FSMC_BCR, FSMC_BTR and
// FSMC_BWTR (ST's RM0008, chapter FSMC).
#include <cstdint>
#include <optional>

namespace dsdpv1::user_cpu {

enum class FsmcMode : std::uint8_t {
  k1,  ///< EXTMOD = 0: the read strobe falls with the chip select
  kA,  ///< EXTMOD = 1, ACCMOD = 00: it falls ADDSET + 1 HCLK later; writes have a register of their own
};

/// The fields of FSMC_BTR, or in mode A those of FSMC_BWTR for writes, in HCLK periods. The values are the model's for
/// a CPU that sets nothing (p), not those after a reset (15, 255, 15).
struct FsmcTiming {
  int addset = 1;   ///< 0..15
  int datast = 5;   ///< 0..255; RM0008 reserves 0: here the write strobe is not low then
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

/// The bank with these values on top.
inline FsmcBank with(FsmcBank bank, const FsmcOverride& given) {
  for (FsmcTiming* timing : {&bank.read, &bank.write}) {
    timing->addset = given.addset.value_or(timing->addset);
    timing->datast = given.datast.value_or(timing->datast);
    timing->busturn = given.busturn.value_or(timing->busturn);
  }
  if (given.hclk_mhz) bank.hclk_hz = std::int64_t{1'000'000} * *given.hclk_mhz;
  bank.mode = given.mode.value_or(bank.mode);
  return bank;
}

}  // namespace dsdpv1::user_cpu
