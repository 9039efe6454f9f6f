#include "kinds/spc3/checks/buffers.hpp"

#include <algorithm>

namespace dsdpv1::spc3_checks {
namespace {

constexpr std::size_t kPrm = 0, kSsa = 2;

constexpr Address after(Address first, unsigned number) { return static_cast<Address>(first + number); }

/// A37: a Set_Prm then needs no Aux.
bool is_direct(const SeenChip& chip, std::size_t block) {
  return block == kPrm && (chip.mode0().value_or(0) & regs::kMode0SpecPrmBuf) != 0;
}

bool is_served(const SeenChip& chip, std::size_t block) {
  return block != kSsa || chip.cell(regs::kOrgSsaPointer) != 0;
}

unsigned aux_of(const SeenChip& chip, std::size_t block) { return chip.cell(regs::kOrgAuxSelect) >> block & 1U; }

}  // namespace

Address length_cell(const SeenChip& chip, std::size_t block) {
  return is_direct(chip, block) ? regs::kOrgSpecPrmLength : after(regs::kOrgAuxLength, aux_of(chip, block));
}

bool uses_aux(const SeenChip& chip, std::size_t block, unsigned aux) {
  return is_served(chip, block) && !is_direct(chip, block) && aux_of(chip, block) == aux;
}

std::vector<Buffer> buffers_of(const SeenChip& chip) {
  std::vector<Buffer> all;
  for (unsigned i = 0; i < 3; ++i) {
    all.push_back({after(regs::kOrgDoutPointer, i), chip.cell(regs::kOrgDoutLength)});
    all.push_back({after(regs::kOrgDinPointer, i), chip.cell(regs::kOrgDinLength)});
  }
  for (unsigned i = 0; i < 2; ++i) {
    all.push_back({after(regs::kOrgDiagPointer, i), chip.cell(after(regs::kOrgDiagLength, i))});
    const bool used = uses_aux(chip, 0, i) || uses_aux(chip, 1, i) || uses_aux(chip, 2, i);
    if (used) all.push_back({after(regs::kOrgAuxPointer, i), chip.cell(after(regs::kOrgAuxLength, i)), true});
  }
  for (std::size_t i = 0; i < kBlocks.size(); ++i)
    if (is_served(chip, i)) all.push_back({kBlocks.at(i).pointer, chip.cell(length_cell(chip, i)), true});
  all.push_back({regs::kOrgReadCfgPointer, chip.cell(regs::kOrgReadCfgLength)});
  all.erase(std::remove_if(all.begin(), all.end(), [](const Buffer& each) { return each.length == 0; }), all.end());
  return all;
}

}  // namespace dsdpv1::spc3_checks
