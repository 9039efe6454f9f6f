// How long instructions take in pairs and by their operands (Cortex-M3 technical reference manual r2p0, 3.3).
#include "board/cpu/instruction.hpp"

namespace dsdpv1::arm {
namespace {

/// `of` has this register in its address.
bool addresses_by(const Instruction& of, std::uint8_t reg) {
  switch (of.kind) {
    case Kind::kLoadIndexed:
    case Kind::kStoreIndexed:
    case Kind::kTable: return of.rn == reg || of.rm == reg;
    case Kind::kLoad:
    case Kind::kStore:
    case Kind::kMany: return of.rn == reg;
    default: return false;
  }
}

bool is_load(const Instruction& one) {
  return one.kind == Kind::kLoad || one.kind == Kind::kLoadLiteral || one.kind == Kind::kLoadIndexed;
}

bool goes_beside_it(const Instruction& one) { return one.kind != Kind::kOther && one.kind < Kind::kMany; }

}  // namespace

/// A load overlaps with the load or store after it, unless that waits for its address; a store at an offset has one
/// cycle in any case. An address that has just been computed comes a cycle late. IT is carried out beside a halfword.
unsigned cycles_before(const Instruction& one, const Instruction& next) {
  const bool overlaps = is_load(next) || next.kind == Kind::kStoreIndexed;
  if (is_load(one) && overlaps && !addresses_by(next, one.rd)) return one.cost - 1U;
  if (one.kind == Kind::kData && addresses_by(next, one.rd)) return one.cost + 1U;
  if (next.kind == Kind::kIt && one.halfwords == 1 && goes_beside_it(one)) return one.cost - 1U;
  return one.cost;
}

}  // namespace dsdpv1::arm
