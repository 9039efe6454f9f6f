#pragma once
// The buffers that the organisation describes (3.3).
#include <array>
#include <vector>

#include "kinds/spc3/checks/seen_chip.hpp"

namespace dsdpv1::spc3_checks {

/// A kind of telegram for the user, in the order of the bits of 2AH.
struct BlockRow {
  const char* name;
  std::uint16_t event;
  Address pointer, ok, not_ok;
  std::uint8_t least;  ///< bytes of the shortest telegram (A4)
};
constexpr std::array<BlockRow, 3> kBlocks = {
    {{"New_Prm_Data", regs::kEventNewPrm, regs::kOrgPrmPointer, regs::kPrmOk, regs::kPrmNotOk, 7},
     {"New_Cfg_Data", regs::kEventNewCfg, regs::kOrgCfgPointer, regs::kCfgOk, regs::kCfgNotOk, 1},
     {"New_SSA_Data", regs::kEventNewSsa, regs::kOrgSsaPointer, regs::kSsaFree, regs::kSsaFree, 4}}};

/// The cell with the length of the block's buffer and of its Aux.
Address length_cell(const SeenChip& chip, std::size_t block);
/// True if the telegrams of the block go through this Aux, 0 or 1; SSA without a pointer is not served (A4).
bool uses_aux(const SeenChip& chip, std::size_t block, unsigned aux);

struct Buffer {
  Address pointer = 0;
  int length = 0;
  bool of_block = false;  ///< exchanged by a telegram
};
/// Those with a length.
std::vector<Buffer> buffers_of(const SeenChip& chip);

}  // namespace dsdpv1::spc3_checks
