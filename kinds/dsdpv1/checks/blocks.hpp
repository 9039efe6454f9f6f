#pragma once
// The blocks of the DPRAM that one side writes and announces to the other with a flag (tables 2, 8 to 11), and the
// range of their CRC (D3).
#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "registers/dsdpv1_regs.hpp"

namespace dsdpv1::checks {

using dsdpv1::regs::Address;

struct Block {
  const char* name;
  Address command;    ///< B00E, B00F: the chip announces it; B010, B011: the user
  std::uint8_t flag;  ///< bit of `command`
  Address first;
  Address data;  ///< after the length and its header
  Address crc;   ///< high byte, the low one follows
};

// Blocks written by the user.
constexpr std::array<Block, 5> kUserBlocks = {{
    {"initialisation", dsdpv1::regs::kUserCommand1, dsdpv1::regs::kUserCommand1Init, dsdpv1::regs::kInit,
     dsdpv1::regs::kInitAddress, dsdpv1::regs::kInitCrc},
    {"inputs", dsdpv1::regs::kUserCommand1, dsdpv1::regs::kUserCommand1Input, dsdpv1::regs::kInput,
     dsdpv1::regs::kInputData, dsdpv1::regs::kInputCrc},
    {"diagnosis", dsdpv1::regs::kUserCommand1, dsdpv1::regs::kUserCommand1Diag, dsdpv1::regs::kDiag,
     dsdpv1::regs::kDiagData, dsdpv1::regs::kDiagCrc},
    {"C1 answer", dsdpv1::regs::kUserCommand2, dsdpv1::regs::kUserCommand2C1, dsdpv1::regs::kC1, dsdpv1::regs::kC1Data,
     dsdpv1::regs::kC1Crc},
    {"C2 answer", dsdpv1::regs::kUserCommand2, dsdpv1::regs::kUserCommand2C2, dsdpv1::regs::kC2, dsdpv1::regs::kC2Data,
     dsdpv1::regs::kC2Crc},
}};

// Blocks written by the chip.
constexpr std::array<Block, 5> kChipBlocks = {{
    {"outputs", dsdpv1::regs::kChipCommand1, dsdpv1::regs::kChipCommand1Output, dsdpv1::regs::kOutput,
     dsdpv1::regs::kOutputData, dsdpv1::regs::kOutputCrc},
    {"parameters", dsdpv1::regs::kChipCommand1, dsdpv1::regs::kChipCommand1Prm, dsdpv1::regs::kPrm,
     dsdpv1::regs::kPrmData, dsdpv1::regs::kPrmCrc},
    {"configuration", dsdpv1::regs::kChipCommand1, dsdpv1::regs::kChipCommand1Cfg, dsdpv1::regs::kCfg,
     dsdpv1::regs::kCfgData, dsdpv1::regs::kCfgCrc},
    {"C1 request", dsdpv1::regs::kChipCommand2, dsdpv1::regs::kChipCommand2C1, dsdpv1::regs::kC1, dsdpv1::regs::kC1Data,
     dsdpv1::regs::kC1Crc},
    {"C2 request", dsdpv1::regs::kChipCommand2, dsdpv1::regs::kChipCommand2C2, dsdpv1::regs::kC2, dsdpv1::regs::kC2Data,
     dsdpv1::regs::kC2Crc},
}};

/// A block of the chip on which the user gives a verdict, and its bit of B010.
struct Judged {
  const Block& block;
  std::uint8_t verdict;
};
constexpr std::array<Judged, 2> kJudgedBlocks = {{
    {kChipBlocks[1], dsdpv1::regs::kUserCommand1PrmVerdict},
    {kChipBlocks[2], dsdpv1::regs::kUserCommand1CfgVerdict},
}};

/// "B00E.1": a bit of a cell.
std::string flag_name(Address cell, std::uint8_t flag);

/// Reads a cell; absent if its content is unknown.
using Look = std::function<std::optional<std::uint8_t>(Address)>;

/// The number of bytes covered by the CRC of a block of the user; absent if a byte is unknown, or the length is invalid
/// (D12, V14: the chip refuses such a block unread).
std::optional<unsigned> covered(const Block& block, const Look& look);
/// The CRC over `count` bytes from `first` (4.2, D2); absent if a byte is unknown.
std::optional<std::uint16_t> crc_over(Address first, unsigned count, const Look& look);

}  // namespace dsdpv1::checks
