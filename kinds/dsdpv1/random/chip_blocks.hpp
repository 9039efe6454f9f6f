#pragma once
// The cells that the chip writes for its user in each transfer, as far as a user fetches them (9.5).
#include <algorithm>
#include <array>
#include <cstdint>

#include "kinds/dsdpv1/random/access_parts.hpp"
#include "registers/dsdpv1_regs.hpp"
#include "tb/chip/pin_device.hpp"

namespace dsdpv1::cosim {

struct ChipBlock {
  AccessPart part;
  int base, header, area;  ///< first cell, cells before the data, cells before the next area
  int crc, flag;           ///< its high byte; the cell of the flag
};

inline constexpr std::array<ChipBlock, 5> kChipBlocks = {
    {{AccessPart::kPrm, regs::kPrm, 1, regs::kPrmCrc - regs::kPrm, regs::kPrmCrc, regs::kChipCommand1},
     {AccessPart::kCfg, regs::kCfg, 3, regs::kCfgCrc - regs::kCfg, regs::kCfgCrc, regs::kChipCommand1},
     {AccessPart::kOutputs, regs::kOutput, 1, regs::kOutputCrc - regs::kOutput, regs::kOutputCrc, regs::kChipCommand1},
     {AccessPart::kC1Request, regs::kC1, 4, regs::kC1Crc - regs::kC1, regs::kC1Crc, regs::kChipCommand2},
     {AccessPart::kC2Request, regs::kC2, 4, regs::kC2Crc - regs::kC2, regs::kC2Crc, regs::kChipCommand2}}};

/// The parts of a block that coverage tells apart.
inline constexpr const char* kBlockCells[] = {"header", "data", "CRC", "flag"};

/// Bytes of data after the header, as the chip has written them. A request has some if it writes or transports (V14).
inline int data_of(const ChipBlock& block, const tb::PinDevice& chip) {
  const auto cell = [&](int offset) { return int{chip.peek(static_cast<std::uint16_t>(block.base + offset))}; };
  constexpr int kRead = 0x5E;
  const bool acyclic = block.part == AccessPart::kC1Request || block.part == AccessPart::kC2Request;
  if (acyclic && cell(0) == kRead) return 0;
  return std::min(cell(block.header - 1), block.area - block.header);
}

}  // namespace dsdpv1::cosim
