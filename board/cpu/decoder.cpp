// Thumb instructions of ARMv7-M (A5, A7.7) as a Cortex-M3 has them: without those of DSP and floating point.
#include <utility>

#include "board/cpu/operations.hpp"

namespace dsdpv1::arm {
namespace {

using O = Operations;
using Operation = Instruction::Operation;
using U8 = std::uint8_t;
using U32 = std::uint32_t;

constexpr U8 kSp = 13, kPc = 15;

// Cycles (Cortex-M3 technical reference manual r2p0, table 3-1 and 3.3.2), where there is more than one.
constexpr U32 kLoad = 2, kLoadPc = 2, kIndexedStore = 2, kTwo = 3, kExclusive = 2, kTable = 3, kMultiplyAdd = 2,
              kLongMultiply = 3, kLongMultiplyAdd = 4, kDivide = 2, kToSpecial = 2;

/// `count` bits from bit `from` on.
constexpr U32 bits(U32 word, unsigned from, unsigned count) { return word >> from & ((1U << count) - 1); }
constexpr bool bit(U32 word, unsigned at) { return (word >> at & 1) != 0; }
constexpr U8 reg(U32 word, unsigned from) { return static_cast<U8>(word >> from & 15); }
constexpr U8 low(U32 word, unsigned from) { return static_cast<U8>(word >> from & 7); }
constexpr U32 sign_extended(U32 value, unsigned width) {
  return static_cast<U32>(static_cast<std::int32_t>(value << (32 - width)) >> (32 - width));
}

// --- operations

template <Alu what, Second second>
Operation alu_of(bool flags, bool to_sp) {
  if constexpr (has_result(what))
    if (to_sp) return flags ? &O::alu_to_sp<what, second, true> : &O::alu_to_sp<what, second, false>;
  return flags ? &O::alu<what, second, true> : &O::alu<what, second, false>;
}

template <Second second>
Operation alu_of(Alu what, bool flags, bool to_sp) {
  switch (what) {
    case Alu::kAnd: return alu_of<Alu::kAnd, second>(flags, to_sp);
    case Alu::kEor: return alu_of<Alu::kEor, second>(flags, to_sp);
    case Alu::kOrr: return alu_of<Alu::kOrr, second>(flags, to_sp);
    case Alu::kOrn: return alu_of<Alu::kOrn, second>(flags, to_sp);
    case Alu::kBic: return alu_of<Alu::kBic, second>(flags, to_sp);
    case Alu::kMov: return alu_of<Alu::kMov, second>(flags, to_sp);
    case Alu::kMvn: return alu_of<Alu::kMvn, second>(flags, to_sp);
    case Alu::kTst: return alu_of<Alu::kTst, second>(flags, to_sp);
    case Alu::kTeq: return alu_of<Alu::kTeq, second>(flags, to_sp);
    case Alu::kAdd: return alu_of<Alu::kAdd, second>(flags, to_sp);
    case Alu::kAdc: return alu_of<Alu::kAdc, second>(flags, to_sp);
    case Alu::kSub: return alu_of<Alu::kSub, second>(flags, to_sp);
    case Alu::kSbc: return alu_of<Alu::kSbc, second>(flags, to_sp);
    case Alu::kRsb: return alu_of<Alu::kRsb, second>(flags, to_sp);
    case Alu::kCmp: return alu_of<Alu::kCmp, second>(flags, to_sp);
    case Alu::kCmn: return alu_of<Alu::kCmn, second>(flags, to_sp);
  }
  return nullptr;
}

Operation alu_of(Alu what, Second second, bool flags, U8 rd) {
  const bool to_sp = rd == kSp && has_result(what);
  switch (second) {
    case Second::kImmediate: return alu_of<Second::kImmediate>(what, flags, to_sp);
    case Second::kRegister: return alu_of<Second::kRegister>(what, flags, to_sp);
    case Second::kLeft: return alu_of<Second::kLeft>(what, flags, to_sp);
    case Second::kRight: return alu_of<Second::kRight>(what, flags, to_sp);
    case Second::kShifted: return alu_of<Second::kShifted>(what, flags, to_sp);
  }
  return nullptr;
}

/// SP stays a multiple of 4.
template <Operation operation>
void and_align_sp(Engine& e, const Instruction& i) {
  operation(e, i);
  O::align_sp(e);
}

/// `aligns`: the operation writes SP.
template <Operation operation>
constexpr Operation aligned(bool aligns) {
  return aligns ? &and_align_sp<operation> : operation;
}

enum class Access : U8 { kByte, kHalf, kWord, kSignedByte, kSignedHalf };

template <Index index>
Operation load_of(Access access, bool aligns) {
  switch (access) {
    case Access::kByte: return aligned<&O::load<std::uint8_t, index>>(aligns);
    case Access::kHalf: return aligned<&O::load<std::uint16_t, index>>(aligns);
    case Access::kWord: return aligned<&O::load<std::uint32_t, index>>(aligns);
    case Access::kSignedByte: return aligned<&O::load<std::int8_t, index>>(aligns);
    case Access::kSignedHalf: return aligned<&O::load<std::int16_t, index>>(aligns);
  }
  return nullptr;
}

template <Index index>
Operation store_of(Access access, bool aligns) {
  switch (access) {
    case Access::kByte: return aligned<&O::store<std::uint8_t, index>>(aligns);
    case Access::kHalf: return aligned<&O::store<std::uint16_t, index>>(aligns);
    default: return aligned<&O::store<std::uint32_t, index>>(aligns);
  }
}

Operation load_of(Access access, Index index, bool aligns) {
  switch (index) {
    case Index::kOffset: return load_of<Index::kOffset>(access, aligns);
    case Index::kBefore: return load_of<Index::kBefore>(access, aligns);
    case Index::kAfter: return load_of<Index::kAfter>(access, aligns);
    case Index::kRegister: return load_of<Index::kRegister>(access, aligns);
    case Index::kAbsolute: return load_of<Index::kAbsolute>(access, aligns);
  }
  return nullptr;
}

Operation load_pc_of(Index index) {
  switch (index) {
    case Index::kOffset: return &O::load_pc<Index::kOffset>;
    case Index::kBefore: return &O::load_pc<Index::kBefore>;
    case Index::kAfter: return &O::load_pc<Index::kAfter>;
    case Index::kRegister: return &O::load_pc<Index::kRegister>;
    case Index::kAbsolute: return &O::load_pc<Index::kAbsolute>;
  }
  return nullptr;
}

Operation store_of(Access access, Index index, bool aligns) {
  switch (index) {
    case Index::kBefore: return store_of<Index::kBefore>(access, aligns);
    case Index::kAfter: return store_of<Index::kAfter>(access, aligns);
    case Index::kRegister: return store_of<Index::kRegister>(access, aligns);
    default: return store_of<Index::kOffset>(access, aligns);
  }
}

template <unsigned... conditions>
Operation branch_if_of(unsigned condition, std::integer_sequence<unsigned, conditions...> /*all*/) {
  static constexpr Operation kAll[] = {&O::branch_if<conditions>...};
  return kAll[condition];
}
Operation branch_if_of(unsigned condition) {
  return branch_if_of(condition, std::make_integer_sequence<unsigned, 14>());
}
template <unsigned... conditions>
Operation it_of(unsigned condition, std::integer_sequence<unsigned, conditions...> /*all*/) {
  static constexpr Operation kAll[] = {&O::it<conditions>...};
  return kAll[condition];
}
Operation it_of(unsigned condition) { return it_of(condition, std::make_integer_sequence<unsigned, 16>()); }

// --- instructions

/// The same operation inside and outside of an IT block.
Instruction always(Operation run) { return {run, run}; }
Instruction undefined() { return always(&O::refused<Trap::kUndefined>); }

/// A halfword sets the flags, but not inside of an IT block.
Instruction alu16(Alu what, Second second, U8 rd, U8 rn, U8 rm, U32 value) {
  Instruction made = {alu_of(what, second, true, rd), alu_of(what, second, !has_result(what), rd), value, rd, rn, rm};
  made.kind = has_result(what) ? Kind::kData : Kind::kCompare;
  return made;
}

Instruction alu_plain(Alu what, Second second, U8 rd, U8 rn, U8 rm, U32 value) {
  Instruction made = always(alu_of(what, second, false, rd));
  made.rd = rd, made.rn = rn, made.rm = rm, made.value = value;
  made.kind = Kind::kData;
  return made;
}

Instruction with_registers(Operation run, U8 rd, U8 rn, U8 rm, U32 value = 0) {
  Instruction made = always(run);
  made.rd = rd, made.rn = rn, made.rm = rm, made.value = value;
  return made;
}

/// An instruction with a result in rd.
Instruction data(Operation run, U8 rd, U8 rn, U8 rm, U32 value = 0) {
  Instruction made = with_registers(run, rd, rn, rm, value);
  made.kind = Kind::kData;
  return made;
}

Instruction lasting(U32 cycles, Instruction made) {
  made.cost = static_cast<std::uint16_t>(cycles);
  return made;
}

/// Where a load or store goes, see Index.
struct Place {
  Index index = Index::kOffset;
  U8 rn = 0, rm = 0;
  U32 value = 0;
  unsigned amount = 0;

  bool writes_sp() const { return (index == Index::kBefore || index == Index::kAfter) && rn == kSp; }
};

Instruction load(Access access, U8 rt, const Place& from) {
  const Operation run = rt == kPc ? load_pc_of(from.index) : load_of(access, from.index, rt == kSp || from.writes_sp());
  Instruction made = lasting(rt == kPc ? kLoadPc : kLoad, with_registers(run, rt, from.rn, from.rm, from.value));
  made.amount = static_cast<U8>(from.amount);
  if (rt == kPc) return made;
  made.kind = from.index == Index::kAbsolute   ? Kind::kLoadLiteral
              : from.index == Index::kRegister ? Kind::kLoadIndexed
                                               : Kind::kLoad;
  return made;
}

Instruction store(Access access, U8 rt, const Place& to) {
  const bool indexed = to.index == Index::kRegister;
  Instruction made = with_registers(store_of(access, to.index, to.writes_sp()), rt, to.rn, to.rm, to.value);
  made.amount = static_cast<U8>(to.amount);
  made.kind = indexed ? Kind::kStoreIndexed : Kind::kStore;
  return indexed ? lasting(kIndexedStore, made) : made;
}

Instruction load_or_store(bool loads, Access access, U8 rt, const Place& place) {
  return loads ? load(access, rt, place) : store(access, rt, place);
}

/// `up`: from the base on, else below it.
Instruction many(bool loads, bool up, bool writes_back, U8 rn, U32 list) {
  const Operation run = loads ? up ? &O::load_many<false> : &O::load_many<true>
                        : up ? &O::store_many<false>
                              : &O::store_many<true>;
  Instruction made = with_registers(run, 0, rn, 0, list);
  const auto words = static_cast<U32>(__builtin_popcount(list));
  made.shift = writes_back ? 1 : 0;
  made.amount = static_cast<U8>(4 * words);
  made.kind = Kind::kMany;
  return lasting(1 + words, made);
}

Instruction branch_to(Operation run, U32 target) {
  Instruction made = always(run);
  made.value = target;
  made.kind = Kind::kBranch;
  return made;
}

Instruction if_then(U32 state) {
  Instruction made = always(it_of(bits(state, 4, 4)));
  made.value = state;
  made.kind = Kind::kIt;
  return made;
}

/// NOP, YIELD, WFE, WFI, SEV by their numbers; others do nothing.
Instruction hint(U32 number) {
  switch (number) {
    case 2: return always(&O::executed<Trap::kWfe>);
    case 3: return always(&O::executed<Trap::kWfi>);
    case 4: return always(&O::send_event);
    default: return always(&O::nothing);
  }
}

// --- one halfword

/// DecodeImmShift (A7.4.2).
void set_shift(Instruction& of, U32 type, U32 amount) {
  of.shift = static_cast<U8>(type);
  of.amount = static_cast<U8>(amount);
  if (amount == 0 && (type == kLsr || type == kAsr)) of.amount = 32;
  if (amount == 0 && type == kRor) of.shift = kRrx;
}

Second second_of(const Instruction& shifted) {
  if (shifted.amount < 32 && shifted.shift == kLsr) return Second::kRight;
  if (shifted.shift != kLsl) return Second::kShifted;
  return shifted.amount == 0 ? Second::kRegister : Second::kLeft;
}

Instruction shift_add_subtract(U32 h) {
  const U8 rd = low(h, 0), rm = low(h, 3);
  if (bits(h, 11, 2) == 3) {
    const Alu what = bit(h, 9) ? Alu::kSub : Alu::kAdd;
    if (bit(h, 10)) return alu16(what, Second::kImmediate, rd, rm, 0, bits(h, 6, 3));
    return alu16(what, Second::kRegister, rd, rm, low(h, 6), 0);
  }
  Instruction shifted;
  set_shift(shifted, bits(h, 11, 2), bits(h, 6, 5));
  Instruction made = alu16(Alu::kMov, second_of(shifted), rd, 0, rm, 0);
  made.shift = shifted.shift, made.amount = shifted.amount;
  return made;
}

Instruction immediate16(U32 h) {
  const U8 rd = low(h, 8);
  static constexpr Alu kWhat[] = {Alu::kMov, Alu::kCmp, Alu::kAdd, Alu::kSub};
  return alu16(kWhat[bits(h, 11, 2)], Second::kImmediate, rd, rd, 0, bits(h, 0, 8));
}

Instruction data_processing16(U32 h) {
  const U8 rd = low(h, 0), rm = low(h, 3);
  const auto shift = [&](Shift type) {
    Instruction made = {&O::shift_by_register<true>, &O::shift_by_register<false>, 0, rd, rd, rm};
    made.shift = type;
    made.kind = Kind::kData;
    return made;
  };
  const auto alu = [&](Alu what) { return alu16(what, Second::kRegister, rd, rd, rm, 0); };
  switch (bits(h, 6, 4)) {
    case 0: return alu(Alu::kAnd);
    case 1: return alu(Alu::kEor);
    case 2: return shift(kLsl);
    case 3: return shift(kLsr);
    case 4: return shift(kAsr);
    case 5: return alu(Alu::kAdc);
    case 6: return alu(Alu::kSbc);
    case 7: return shift(kRor);
    case 8: return alu(Alu::kTst);
    case 9: return alu16(Alu::kRsb, Second::kImmediate, rd, rm, 0, 0);
    case 10: return alu(Alu::kCmp);
    case 11: return alu(Alu::kCmn);
    case 12: return alu(Alu::kOrr);
    case 13: return {&O::multiply<true>, &O::multiply<false>, 0, rd, rd, rm};
    case 14: return alu(Alu::kBic);
    default: return alu(Alu::kMvn);
  }
}

/// ADD, CMP, MOV of all registers, BX, BLX. `pc`: as an operand.
Instruction all_registers(U32 pc, U32 h) {
  const auto rd = static_cast<U8>((h >> 4 & 8) | (h & 7));
  const U8 rm = reg(h, 3);
  switch (bits(h, 8, 2)) {
    case 0:
      if (rd == kPc) return with_registers(&O::move_to_pc<true>, 0, 0, rm);
      if (rm == kPc) return alu_plain(Alu::kAdd, Second::kImmediate, rd, rd, 0, pc);
      return alu_plain(Alu::kAdd, Second::kRegister, rd, rd, rm, 0);
    case 1: return alu16(Alu::kCmp, Second::kRegister, 0, rd, rm, 0);
    case 2:
      if (rd == kPc && rm == kPc) return branch_to(&O::branch, pc);
      if (rd == kPc) return with_registers(&O::move_to_pc<false>, 0, 0, rm);
      if (rm == kPc) return alu_plain(Alu::kMov, Second::kImmediate, rd, 0, 0, pc);
      return alu_plain(Alu::kMov, Second::kRegister, rd, 0, rm, 0);
    default: return with_registers(bit(h, 7) ? &O::branch_link_exchange : &O::branch_exchange, 0, 0, rm);
  }
}

Instruction load_store_register16(U32 h) {
  static constexpr Access kAccess[] = {Access::kWord, Access::kHalf, Access::kByte, Access::kSignedByte,
                                       Access::kWord, Access::kHalf, Access::kByte, Access::kSignedHalf};
  const U32 what = bits(h, 9, 3);
  return load_or_store(what > 2, kAccess[what], low(h, 0), {Index::kRegister, low(h, 3), low(h, 6)});
}

/// A5.2.5 except CBZ, PUSH, POP.
Instruction miscellaneous16(U32 h) {
  const U8 rd = low(h, 0), rm = low(h, 3);
  const U32 words = bits(h, 0, 7) * 4;
  switch (h >> 6) {
    case 0xB200U >> 6: return data(&O::extend<std::int16_t>, rd, 0, rm);
    case 0xB240U >> 6: return data(&O::extend<std::int8_t>, rd, 0, rm);
    case 0xB280U >> 6: return data(&O::extend<std::uint16_t>, rd, 0, rm);
    case 0xB2C0U >> 6: return data(&O::extend<std::uint8_t>, rd, 0, rm);
    case 0xBA00U >> 6: return data(&O::rev, rd, 0, rm);
    case 0xBA40U >> 6: return data(&O::rev16, rd, 0, rm);
    case 0xBAC0U >> 6: return data(&O::revsh, rd, 0, rm);
    default: break;
  }
  switch (h >> 8) {
    case 0xB0: return alu_plain(bit(h, 7) ? Alu::kSub : Alu::kAdd, Second::kImmediate, kSp, kSp, 0, words);
    case 0xBE: return always(&O::refused<Trap::kBreakpoint>);
    case 0xBF:
      if ((h & 15) == 0) return hint(bits(h, 4, 4));
      return if_then(h & 0xFF);
    default: break;
  }
  if ((h & 0xFFE8) != 0xB660) return undefined();
  Instruction made = always(&O::change_masks);
  made.value = bits(h, 0, 2);
  made.shift = bit(h, 4) ? 1 : 0;
  return made;
}

Instruction compare_branch(U32 pc, U32 h) {
  Instruction made = branch_to(bit(h, 11) ? &O::branch_if_zero<true> : &O::branch_if_zero<false>,
                               pc + bits(h, 9, 1) * 64 + bits(h, 3, 5) * 2);
  made.rn = low(h, 0);
  return made;
}

Instruction decode16(U32 address, U32 h) {
  const U32 pc = address + 4;
  const bool loads = bit(h, 11);
  switch (h >> 12) {
    case 0:
    case 1: return shift_add_subtract(h);
    case 2:
    case 3: return immediate16(h);
    case 4:
      if (loads) return load(Access::kWord, low(h, 8), {Index::kAbsolute, 0, 0, (pc & ~3U) + bits(h, 0, 8) * 4});
      return bit(h, 10) ? all_registers(pc, h) : data_processing16(h);
    case 5: return load_store_register16(h);
    case 6: return load_or_store(loads, Access::kWord, low(h, 0), {Index::kOffset, low(h, 3), 0, bits(h, 6, 5) * 4});
    case 7: return load_or_store(loads, Access::kByte, low(h, 0), {Index::kOffset, low(h, 3), 0, bits(h, 6, 5)});
    case 8: return load_or_store(loads, Access::kHalf, low(h, 0), {Index::kOffset, low(h, 3), 0, bits(h, 6, 5) * 2});
    case 9: return load_or_store(loads, Access::kWord, low(h, 8), {Index::kOffset, kSp, 0, bits(h, 0, 8) * 4});
    case 10:
      if (loads) return alu_plain(Alu::kAdd, Second::kImmediate, low(h, 8), kSp, 0, bits(h, 0, 8) * 4);
      return alu_plain(Alu::kMov, Second::kImmediate, low(h, 8), 0, 0, (pc & ~3U) + bits(h, 0, 8) * 4);
    case 11:
      if ((h & 0xF500) == 0xB100) return compare_branch(pc, h);
      if ((h & 0xFE00) == 0xB400) return many(false, false, true, kSp, bits(h, 0, 8) | bits(h, 8, 1) << 14);
      if ((h & 0xFE00) == 0xBC00) return many(true, true, true, kSp, bits(h, 0, 8) | bits(h, 8, 1) << 15);
      return miscellaneous16(h);
    case 12: return many(loads, true, !loads || !bit(h, low(h, 8)), low(h, 8), bits(h, 0, 8));
    case 13:
      if (bits(h, 8, 4) == 14) return undefined();
      if (bits(h, 8, 4) == 15) return always(&O::executed<Trap::kSvc>);
      return branch_to(branch_if_of(bits(h, 8, 4)), pc + sign_extended(bits(h, 0, 8) << 1, 9));
    default: return branch_to(&O::branch, pc + sign_extended(bits(h, 0, 11) << 1, 12));
  }
}

// --- two halfwords

/// What op 0 to 14 of A5.3.1 and A5.3.11 means; if a Cortex-M3 has no such operation, kMov, and `known` is false.
Alu what_of(U32 op, bool discards, bool from_pc, bool& known) {
  known = true;
  switch (op) {
    case 0: return discards ? Alu::kTst : Alu::kAnd;
    case 1: return Alu::kBic;
    case 2: return from_pc ? Alu::kMov : Alu::kOrr;
    case 3: return from_pc ? Alu::kMvn : Alu::kOrn;
    case 4: return discards ? Alu::kTeq : Alu::kEor;
    case 8: return discards ? Alu::kCmn : Alu::kAdd;
    case 10: return Alu::kAdc;
    case 11: return Alu::kSbc;
    case 13: return discards ? Alu::kCmp : Alu::kSub;
    case 14: return Alu::kRsb;
    default: known = false; return Alu::kMov;
  }
}

/// ThumbExpandImm_C (A5.3.2); `rotated`: C is bit 31.
U32 expanded(U32 imm12, bool& rotated) {
  const U32 byte = imm12 & 0xFF;
  rotated = (imm12 >> 10) != 0;
  if (rotated) return O::ror(0x80 | (imm12 & 0x7F), imm12 >> 7);
  switch (imm12 >> 8) {
    case 0: return byte;
    case 1: return byte << 16 | byte;
    case 2: return byte << 24 | byte << 8;
    default: return byte * 0x01010101;
  }
}

U32 immediate12(U32 h, U32 h2) { return bits(h, 10, 1) << 11 | bits(h2, 12, 3) << 8 | bits(h2, 0, 8); }

Instruction alu32(U32 h, U32 h2, bool is_immediate) {
  const bool flags = bit(h, 4);
  const U8 rn = reg(h, 0), rd = reg(h2, 8);
  bool known = true;
  const Alu what = what_of(bits(h, 5, 4), flags && rd == kPc, rn == kPc, known);
  if (!known) return undefined();
  Instruction made = {};
  made.rd = rd, made.rn = rn, made.rm = reg(h2, 0);
  made.kind = has_result(what) ? Kind::kData : Kind::kCompare;
  Second second = Second::kImmediate;
  if (is_immediate) {
    bool rotated = false;
    made.value = expanded(immediate12(h, h2), rotated);
    made.shift = rotated ? 1 : 0;
  } else {
    set_shift(made, bits(h2, 4, 2), bits(h2, 12, 3) << 2 | bits(h2, 6, 2));
    second = second_of(made);
  }
  made.run = made.run_in_it = alu_of(what, second, flags, rd);
  return made;
}

/// A5.3.3
Instruction plain_immediate(U32 pc, U32 h, U32 h2) {
  const U8 rn = reg(h, 0), rd = reg(h2, 8);
  const U32 imm12 = immediate12(h, h2), imm16 = bits(h, 0, 4) << 12 | imm12;
  const U32 first = bits(h2, 12, 3) << 2 | bits(h2, 6, 2), last = bits(h2, 0, 5);
  const auto of_bits = [&](Operation run, U32 count) {
    Instruction made = data(run, rd, rn, 0);
    made.shift = static_cast<U8>(first);
    made.amount = static_cast<U8>(count);
    return first + count > 32 || count > 32 ? undefined() : made;
  };
  const auto saturates = [&](Operation run, U32 to) {
    Instruction made = data(run, rd, rn, 0, to);
    set_shift(made, bit(h, 5) ? kAsr : kLsl, first);
    return bit(h, 5) && first == 0 ? undefined() : made;
  };
  switch (bits(h, 4, 5)) {
    case 0b00000:
      if (rn == kPc) return alu_plain(Alu::kMov, Second::kImmediate, rd, 0, 0, (pc & ~3U) + imm12);
      return alu_plain(Alu::kAdd, Second::kImmediate, rd, rn, 0, imm12);
    case 0b01010:
      if (rn == kPc) return alu_plain(Alu::kMov, Second::kImmediate, rd, 0, 0, (pc & ~3U) - imm12);
      return alu_plain(Alu::kSub, Second::kImmediate, rd, rn, 0, imm12);
    case 0b00100: return alu_plain(Alu::kMov, Second::kImmediate, rd, 0, 0, imm16);
    case 0b01100: return data(&O::move_top, rd, 0, 0, imm16);
    case 0b10000:
    case 0b10010: return saturates(&O::saturate<true>, last + 1);
    case 0b11000:
    case 0b11010: return saturates(&O::saturate<false>, last);
    case 0b10100: return of_bits(&O::extract<true>, last + 1);
    case 0b11100: return of_bits(&O::extract<false>, last + 1);
    case 0b10110: return of_bits(rn == kPc ? &O::insert<true> : &O::insert<false>, last + 1 - first);
    default: return undefined();
  }
}

U32 far_offset(U32 h, U32 h2) {
  const U32 s = bits(h, 10, 1), i1 = bits(h2, 13, 1) ^ s ^ 1, i2 = bits(h2, 11, 1) ^ s ^ 1;
  return sign_extended(s << 24 | i1 << 23 | i2 << 22 | bits(h, 0, 10) << 12 | bits(h2, 0, 11) << 1, 25);
}

U32 conditional_offset(U32 h, U32 h2) {
  const U32 high = bits(h, 10, 1) << 20 | bits(h2, 11, 1) << 19 | bits(h2, 13, 1) << 18;
  return sign_extended(high | bits(h, 0, 6) << 12 | bits(h2, 0, 11) << 1, 21);
}

/// A5.3.4
Instruction branch_or_control(U32 pc, U32 h, U32 h2) {
  if ((h2 & 0xD000) == 0x9000) return branch_to(&O::branch, pc + far_offset(h, h2));
  if ((h2 & 0xD000) == 0xD000) return branch_to(&O::branch_link, pc + far_offset(h, h2));
  if ((h2 & 0xD000) != 0x8000) return undefined();
  if (bits(h, 6, 4) < 14) return branch_to(branch_if_of(bits(h, 6, 4)), pc + conditional_offset(h, h2));
  Instruction special = with_registers(&O::to_special, reg(h2, 8), reg(h, 0), 0, bits(h2, 0, 8));
  special.shift = bit(h2, 11) ? 1 : 0;
  switch (bits(h, 4, 7)) {
    case 0x38:
    case 0x39: return lasting(kToSpecial, special);
    case 0x3A: return bits(h2, 8, 3) == 0 ? hint(bits(h2, 0, 8)) : undefined();
    case 0x3B:
      if (bits(h2, 4, 4) == 2) return always(&O::clear_exclusive);
      if (bits(h2, 4, 4) == 6) return always(&O::refill);  // ISB
      return bits(h2, 4, 4) == 4 || bits(h2, 4, 4) == 5 ? always(&O::nothing) : undefined();
    case 0x3E:
    case 0x3F: special.run = special.run_in_it = &O::from_special; return special;
    default: return undefined();
  }
}

/// A5.3.5
Instruction multiple(U32 h, U32 h2) {
  const U32 order = bits(h, 7, 2);
  if (order != 1 && order != 2) return undefined();
  return many(bit(h, 4), order == 1, bit(h, 5), reg(h, 0), h2);
}

Instruction dual(U32 pc, U32 h, U32 h2) {
  const bool before = bit(h, 8), writes_back = bit(h, 5), loads = bit(h, 4);
  const U8 rn = reg(h, 0);
  const U32 offset = bits(h2, 0, 8) * 4, value = bit(h, 7) ? offset : 0 - offset;
  const Index index = !before ? Index::kAfter : writes_back ? Index::kBefore : Index::kOffset;
  Instruction made = lasting(kTwo, with_registers(nullptr, reg(h2, 12), rn, 0, value));
  made.ra = reg(h2, 8);
  made.kind = Kind::kMany;
  switch (index) {
    case Index::kAfter: made.run = loads ? &O::load_two<Index::kAfter> : &O::store_two<Index::kAfter>; break;
    case Index::kBefore: made.run = loads ? &O::load_two<Index::kBefore> : &O::store_two<Index::kBefore>; break;
    default: made.run = loads ? &O::load_two<Index::kOffset> : &O::store_two<Index::kOffset>; break;
  }
  if (loads && rn == kPc) {
    made.run = &O::load_two<Index::kAbsolute>;
    made.value = (pc & ~3U) + value;
    made.kind = Kind::kOther;
  }
  made.run_in_it = made.run;
  return made;
}

/// A5.3.6
Instruction dual_or_exclusive(U32 pc, U32 h, U32 h2) {
  if (bit(h, 8) || bit(h, 5)) return dual(pc, h, h2);
  const bool loads = bit(h, 4);
  const U8 rt = reg(h2, 12), result = bit(h, 7) ? reg(h2, 0) : reg(h2, 8);
  Instruction made = lasting(kExclusive, with_registers(nullptr, loads ? rt : result, reg(h, 0), reg(h2, 0), 0));
  made.ra = rt;
  made.kind = Kind::kLoad;  // for its neighbours STREX is one like LDR, too
  if (!bit(h, 7)) {
    made.value = bits(h2, 0, 8) * 4;
    made.run = loads ? &O::load_exclusive<std::uint32_t> : &O::store_exclusive<std::uint32_t>;
  } else if (bits(h2, 4, 4) == 4) {
    made.run = loads ? &O::load_exclusive<std::uint8_t> : &O::store_exclusive<std::uint8_t>;
  } else if (bits(h2, 4, 4) == 5) {
    made.run = loads ? &O::load_exclusive<std::uint16_t> : &O::store_exclusive<std::uint16_t>;
  } else if (loads && bits(h2, 4, 4) < 2) {
    made.run = bit(h2, 4) ? &O::table_branch<std::uint16_t> : &O::table_branch<std::uint8_t>;
    made.shift = made.rn == kPc ? 1 : 0;
    made.cost = kTable;
    made.kind = Kind::kTable;
  } else {
    return undefined();
  }
  made.run_in_it = made.run;
  return made;
}

/// Returns false if there is no such instruction.
bool find_place(U32 pc, U32 h, U32 h2, Place& place) {
  const U32 imm12 = bits(h2, 0, 12), imm8 = bits(h2, 0, 8);
  const bool before = bit(h2, 10), writes_back = bit(h2, 8);
  place.rn = reg(h, 0);
  if (place.rn == kPc) {
    place.index = Index::kAbsolute;
    place.value = bit(h, 7) ? (pc & ~3U) + imm12 : (pc & ~3U) - imm12;
    return bit(h, 4);  // stores do not exist
  }
  if (bit(h, 7)) {
    place.value = imm12;
    return true;
  }
  if (bits(h2, 6, 6) == 0) {
    place.index = Index::kRegister;
    place.rm = reg(h2, 0);
    place.amount = bits(h2, 4, 2);
    return true;
  }
  place.index = !writes_back ? Index::kOffset : before ? Index::kBefore : Index::kAfter;
  place.value = bit(h2, 9) ? imm8 : 0 - imm8;
  return bit(h2, 11) && (before || writes_back);
}

/// A5.3.7 to A5.3.10
Instruction load_store_single(U32 pc, U32 h, U32 h2) {
  const bool loads = bit(h, 4), is_signed = bit(h, 8);
  const U32 size = bits(h, 5, 2);
  Place place;
  if (size == 3 || (is_signed && (!loads || size == 2)) || !find_place(pc, h, h2, place)) return undefined();
  const U8 rt = reg(h2, 12);
  if (loads && rt == kPc && size != 2) return always(&O::nothing);  // PLD, PLI
  const Access access = !is_signed ? static_cast<Access>(size) : size == 0 ? Access::kSignedByte : Access::kSignedHalf;
  return load_or_store(loads, access, rt, place);
}

/// A5.3.12
Instruction register32(U32 h, U32 h2) {
  const U8 rd = reg(h2, 8), rn = reg(h, 0), rm = reg(h2, 0);
  const U32 op1 = bits(h, 4, 4), op2 = bits(h2, 4, 4);
  if (bits(h2, 12, 4) != 15) return undefined();
  if (op1 < 8 && op2 == 0) {
    Instruction made = data(bit(h, 4) ? &O::shift_by_register<true> : &O::shift_by_register<false>, rd, rn, rm);
    made.shift = static_cast<U8>(op1 >> 1);
    return made;
  }
  if (op1 < 8 && op2 >= 8 && rn == kPc) {
    static constexpr Operation kExtend[] = {&O::extend<std::int16_t>, &O::extend<std::uint16_t>, nullptr, nullptr,
                                            &O::extend<std::int8_t>,  &O::extend<std::uint8_t>};
    if (op1 > 5 || kExtend[op1] == nullptr) return undefined();
    Instruction made = data(kExtend[op1], rd, 0, rm);
    made.amount = static_cast<U8>(bits(h2, 4, 2) * 8);
    return made;
  }
  static constexpr Operation kReverse[] = {&O::rev, &O::rev16, &O::rbit, &O::revsh};
  if (op1 == 9 && op2 >= 8 && op2 < 12) return data(kReverse[op2 - 8], rd, 0, rm);
  if (op1 == 11 && op2 == 8) return data(&O::clz, rd, 0, rm);
  return undefined();
}

/// A5.3.16, A5.3.17
Instruction multiply32(U32 h, U32 h2) {
  Instruction made = data(nullptr, reg(h2, 8), reg(h, 0), reg(h2, 0));
  made.ra = reg(h2, 12);
  const auto of = [&made](Operation run, U32 cycles) {
    made.run = made.run_in_it = run;
    return lasting(cycles, made);
  };
  switch (bits(h, 4, 4) << 4 | bits(h2, 4, 4)) {
    case 0x00: return made.ra == kPc ? of(&O::multiply<false>, 1) : of(&O::multiply_add<false>, kMultiplyAdd);
    case 0x01: return of(&O::multiply_add<true>, kMultiplyAdd);
    case 0x80: return of(&O::multiply_long<true, false>, kLongMultiply);
    case 0x9F: return of(&O::divide<true>, kDivide);
    case 0xA0: return of(&O::multiply_long<false, false>, kLongMultiply);
    case 0xBF: return of(&O::divide<false>, kDivide);
    case 0xC0: return of(&O::multiply_long<true, true>, kLongMultiplyAdd);
    case 0xE0: return of(&O::multiply_long<false, true>, kLongMultiplyAdd);
    default: return undefined();
  }
}

/// A5.3
Instruction decode32(U32 address, U32 h, U32 h2) {
  const U32 pc = address + 4;
  if ((h & 0xEF00) == 0xEF00) return undefined();
  if ((h & 0xEC00) == 0xEC00) return always(&O::refused<Trap::kNoCoprocessor>);
  if ((h & 0xFE40) == 0xE800) return multiple(h, h2);
  if ((h & 0xFE40) == 0xE840) return dual_or_exclusive(pc, h, h2);
  if ((h & 0xFE00) == 0xEA00) return alu32(h, h2, false);
  if ((h & 0xF800) == 0xF000) {
    if (bit(h2, 15)) return branch_or_control(pc, h, h2);
    return bit(h, 9) ? plain_immediate(pc, h, h2) : alu32(h, h2, true);
  }
  if ((h & 0xFE00) == 0xF800) return load_store_single(pc, h, h2);
  if ((h & 0xFF00) == 0xFA00) return register32(h, h2);
  return multiply32(h, h2);
}

}  // namespace

Instruction decode(std::uint32_t address, std::uint16_t first, std::uint16_t second) {
  const bool is_long = thumb_bytes(first) == 4;
  Instruction made = is_long ? decode32(address, first, second) : decode16(address, first);
  made.halfwords = is_long ? 2 : 1;
  return made;
}

}  // namespace dsdpv1::arm
