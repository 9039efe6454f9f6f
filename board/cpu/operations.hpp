#pragma once
// The effects of instructions (ARMv7-M, A7.7). For decode() alone, which chooses among them.
#include <cstring>
#include <type_traits>

#include "board/cpu/engine.hpp"

namespace dsdpv1::arm {

/// An access that is not aligned is two or three (Cortex-M3 technical reference manual, 3.3.2).
template <unsigned bytes>
constexpr unsigned more_cycles(std::uint32_t address) {
  if (address % bytes == 0) return 0;
  return bytes == 2 ? 1 : 1 + address % 2;
}

template <unsigned bytes>
inline bool Engine::load(std::uint32_t address, std::uint32_t& value) {
  if (const unsigned more = more_cycles<bytes>(address); more != 0) spend(more);
  value = 0;
  if (const std::uint32_t offset = address - loads_.start; offset < loads_.limit) {
    std::memcpy(&value, loads_.bytes + offset, bytes);
    return true;
  }
  const std::uint32_t offset = address - constants_.start;
  if (offset >= constants_.limit) return load_elsewhere(address, bytes, value);
  read_flash();
  std::memcpy(&value, constants_.bytes + offset, bytes);
  return true;
}

template <unsigned bytes>
inline bool Engine::store(std::uint32_t address, std::uint32_t value) {
  if (const unsigned more = more_cycles<bytes>(address); more != 0) spend(more);
  const std::uint32_t offset = address - stores_.start;
  if (offset >= stores_.limit) return store_elsewhere(address, bytes, value);
  std::memcpy(stores_.bytes + offset, &value, bytes);
  if (address - watched_.start < watched_.size) events_.on_watched_store();
  return true;
}

enum class Alu : std::uint8_t {
  kAnd,
  kEor,
  kOrr,
  kOrn,
  kBic,
  kMov,
  kMvn,
  kTst,
  kTeq,  // logical: C is the shifter's
  kAdd,
  kAdc,
  kSub,
  kSbc,
  kRsb,
  kCmp,
  kCmn
};
constexpr bool is_logical(Alu what) { return what <= Alu::kTeq; }
constexpr bool has_result(Alu what) {
  return what != Alu::kTst && what != Alu::kTeq && what != Alu::kCmp && what != Alu::kCmn;
}

enum Shift : std::uint8_t { kLsl, kLsr, kAsr, kRor, kRrx };

/// The second operand: `value`, with `shift` 1 rotated, so that its bit 31 is C; rm; rm shifted left or right by
/// `amount` (1..31); rm shifted as `shift` and `amount` (1..32) say.
enum class Second : std::uint8_t { kImmediate, kRegister, kLeft, kRight, kShifted };

/// Where a load or store goes: rn + value, without, before or after writing it back; rn + (rm << amount); `value`.
enum class Index : std::uint8_t { kOffset, kBefore, kAfter, kRegister, kAbsolute };

struct Operations {
  using U32 = std::uint32_t;
  using I32 = std::int32_t;
  using U64 = std::uint64_t;
  using I64 = std::int64_t;

  static U32 sign(U32 value) { return value >> 31; }
  static U32 ror(U32 value, unsigned by) { return by == 0 ? value : value >> by | value << (32 - by); }
  static I32 as_signed(U32 value) { return static_cast<I32>(value); }
  /// The lowest bit that is set.
  static std::size_t first_of(U32 bits) { return static_cast<std::size_t>(__builtin_ctz(bits)); }

  static void set_nz(Engine& e, U32 result) { e.negative_ = e.zero_ = result; }

  /// By 0 to 255, as a register may say (A2.2.1); `carry` becomes the last bit that is shifted out.
  static U32 shifted(unsigned how, U32 value, unsigned by, U32& carry) {
    if (how == kRrx) {
      const U32 result = carry << 31 | value >> 1;
      carry = value & 1;
      return result;
    }
    if (by == 0) return value;
    switch (how) {
      case kLsl: carry = by <= 32 ? static_cast<U32>(U64{value} << by >> 32) & 1 : 0; return by < 32 ? value << by : 0;
      case kLsr: carry = by <= 32 ? static_cast<U32>(U64{value} >> (by - 1)) & 1 : 0; return by < 32 ? value >> by : 0;
      case kAsr:
        if (by >= 32) return (carry = sign(value)) != 0 ? ~U32{0} : 0;
        carry = value >> (by - 1) & 1;
        return static_cast<U32>(as_signed(value) >> by);
      default: {
        const U32 result = ror(value, by % 32);
        carry = sign(result);
        return result;
      }
    }
  }

  // --- data processing

  template <Second second>
  static U32 operand(const Engine& e, const Instruction& i, U32& carry) {
    if constexpr (second == Second::kImmediate) {
      if (i.shift != 0) carry = sign(i.value);
      return i.value;
    } else if constexpr (second == Second::kRegister) {
      return e.r_[i.rm];
    } else if constexpr (second == Second::kLeft) {
      carry = e.r_[i.rm] >> (32 - i.amount) & 1;
      return e.r_[i.rm] << i.amount;
    } else if constexpr (second == Second::kRight) {
      carry = e.r_[i.rm] >> (i.amount - 1) & 1;
      return e.r_[i.rm] >> i.amount;
    } else {
      return shifted(i.shift, e.r_[i.rm], i.amount, carry);
    }
  }

  template <bool flags>
  static U32 add(Engine& e, U32 a, U32 b, U32 carry) {
    const U64 wide = U64{a} + b + carry;
    const auto result = static_cast<U32>(wide);
    if constexpr (flags) {
      set_nz(e, result);
      e.carry_ = static_cast<U32>(wide >> 32);
      e.overflow_ = sign((a ^ result) & (b ^ result));
    }
    return result;
  }

  template <Alu what>
  static U32 logical(U32 a, U32 b) {
    switch (what) {
      case Alu::kAnd:
      case Alu::kTst: return a & b;
      case Alu::kEor:
      case Alu::kTeq: return a ^ b;
      case Alu::kOrr: return a | b;
      case Alu::kOrn: return a | ~b;
      case Alu::kBic: return a & ~b;
      case Alu::kMvn: return ~b;
      default: return b;
    }
  }

  template <Alu what, bool flags>
  static U32 arithmetic(Engine& e, U32 a, U32 b) {
    switch (what) {
      case Alu::kAdc: return add<flags>(e, a, b, e.carry_);
      case Alu::kSub:
      case Alu::kCmp: return add<flags>(e, a, ~b, 1);
      case Alu::kSbc: return add<flags>(e, a, ~b, e.carry_);
      case Alu::kRsb: return add<flags>(e, ~a, b, 1);
      default: return add<flags>(e, a, b, 0);
    }
  }

  template <Alu what, Second second, bool flags>
  static void alu(Engine& e, const Instruction& i) {
    U32 carry = e.carry_;
    const U32 b = operand<second>(e, i, carry), a = e.r_[i.rn];
    U32 result = 0;
    if constexpr (is_logical(what)) {
      result = logical<what>(a, b);
      if constexpr (flags) {
        set_nz(e, result);
        e.carry_ = carry;
      }
    } else {
      result = arithmetic<what, flags>(e, a, b);
    }
    if constexpr (has_result(what)) e.r_[i.rd] = result;
    e.done(i);
  }

  template <bool flags>
  static void shift_by_register(Engine& e, const Instruction& i) {
    U32 carry = e.carry_;
    const U32 result = shifted(i.shift, e.r_[i.rn], e.r_[i.rm] & 0xFF, carry);
    if constexpr (flags) {
      set_nz(e, result);
      e.carry_ = carry;
    }
    e.r_[i.rd] = result;
    e.done(i);
  }

  /// SP is a multiple of 4 (B1.4.1).
  static void align_sp(Engine& e) { e.r_[13] &= ~U32{3}; }
  template <Alu what, Second second, bool flags>
  static void alu_to_sp(Engine& e, const Instruction& i) {
    alu<what, second, flags>(e, i);
    align_sp(e);
  }

  static void move_top(Engine& e, const Instruction& i) {
    e.r_[i.rd] = (e.r_[i.rd] & 0xFFFF) | i.value << 16;
    e.done(i);
  }

  template <bool flags>
  static void multiply(Engine& e, const Instruction& i) {
    e.r_[i.rd] = e.r_[i.rn] * e.r_[i.rm];
    if constexpr (flags) set_nz(e, e.r_[i.rd]);
    e.done(i);
  }
  /// MLA; with `minus` MLS.
  template <bool minus>
  static void multiply_add(Engine& e, const Instruction& i) {
    const U32 product = e.r_[i.rn] * e.r_[i.rm];
    e.r_[i.rd] = minus ? e.r_[i.ra] - product : e.r_[i.ra] + product;
    e.done(i);
  }
  /// An operand of more than a halfword takes a cycle more, two of them another one with a sum (p): the manual says 3
  /// to 5 in all, 4 to 7 with a sum, by the size of the operands.
  template <bool is_signed>
  static unsigned is_wide(U32 operand) {
    return (is_signed ? as_signed(operand) != static_cast<std::int16_t>(operand) : operand > 0xFFFF) ? 1 : 0;
  }
  /// rd and ra: high and low word.
  template <bool is_signed, bool accumulates>
  static void multiply_long(Engine& e, const Instruction& i) {
    U64 result =
        is_signed ? static_cast<U64>(I64{as_signed(e.r_[i.rn])} * as_signed(e.r_[i.rm])) : U64{e.r_[i.rn]} * e.r_[i.rm];
    const unsigned wide = is_wide<is_signed>(e.r_[i.rn]) + is_wide<is_signed>(e.r_[i.rm]);
    const U64 since = e.now_;
    e.spend(wide + (accumulates && wide == 2 ? 1 : 0));
    if constexpr (accumulates) result += U64{e.r_[i.rd]} << 32 | e.r_[i.ra];
    e.r_[i.rd] = static_cast<U32>(result >> 32);
    e.r_[i.ra] = static_cast<U32>(result);
    e.done(i, since, true);
  }
  static int zeros_before(U32 value) { return value == 0 ? 32 : __builtin_clz(value); }
  /// More than 2 cycles, by what the operands' sizes differ: docs/arm_board.md says who has measured that.
  static unsigned divide_cycles(U32 what, U32 by) {
    if (what == 0 || by == 0) return 0;
    const int longer = zeros_before(by) - zeros_before(what);
    return longer < 0 ? 1 : 3 + static_cast<unsigned>(longer) / 4;
  }
  template <bool is_signed>
  static U32 magnitude(U32 value) {
    return is_signed && sign(value) != 0 ? 0 - value : value;
  }
  /// By 0 gives 0: CCR.DIV_0_TRP is not modelled.
  template <bool is_signed>
  static void divide(Engine& e, const Instruction& i) {
    const U32 by = e.r_[i.rm], what = e.r_[i.rn];
    const U64 since = e.now_;
    e.spend(divide_cycles(magnitude<is_signed>(what), magnitude<is_signed>(by)));
    e.r_[i.rd] = by == 0 ? 0 : is_signed ? static_cast<U32>(I64{as_signed(what)} / as_signed(by)) : what / by;
    e.done(i, since, true);
  }

  /// Of `amount` bits from bit `shift` on.
  static U32 field(const Instruction& i) { return static_cast<U32>((U64{1} << i.amount) - 1); }
  template <bool is_signed>
  static void extract(Engine& e, const Instruction& i) {
    const U32 top = e.r_[i.rn] << (32 - i.shift - i.amount);
    e.r_[i.rd] = is_signed ? static_cast<U32>(as_signed(top) >> (32 - i.amount)) : top >> (32 - i.amount);
    e.done(i);
  }
  /// BFI, and with `clears` BFC, which ignores rn.
  template <bool clears>
  static void insert(Engine& e, const Instruction& i) {
    const U32 bits = clears ? 0 : e.r_[i.rn];
    e.r_[i.rd] = (e.r_[i.rd] & ~(field(i) << i.shift)) | (bits & field(i)) << i.shift;
    e.done(i);
  }

  /// To `value` bits; Q is set where that changes something.
  template <bool is_signed>
  static void saturate(Engine& e, const Instruction& i) {
    U32 carry = 0;
    const I64 value = as_signed(shifted(i.shift, e.r_[i.rn], i.amount, carry));
    const I64 most = (I64{1} << (is_signed ? i.value - 1 : i.value)) - 1, least = is_signed ? -most - 1 : 0;
    const I64 result = value < least ? least : value > most ? most : value;
    e.saturated_ = e.saturated_ || result != value;
    e.r_[i.rd] = static_cast<U32>(result);
    e.done(i);
  }

  /// Extends rm, rotated right by `amount`.
  template <class Narrow>
  static void extend(Engine& e, const Instruction& i) {
    e.r_[i.rd] = static_cast<U32>(I32{static_cast<Narrow>(ror(e.r_[i.rm], i.amount))});
    e.done(i);
  }

  static U32 bytes_reversed(U32 v) { return v >> 24 | (v >> 8 & 0xFF00) | (v << 8 & 0xFF0000) | v << 24; }
  static void rev(Engine& e, const Instruction& i) {
    e.r_[i.rd] = bytes_reversed(e.r_[i.rm]);
    e.done(i);
  }
  static void rev16(Engine& e, const Instruction& i) {
    e.r_[i.rd] = ror(bytes_reversed(e.r_[i.rm]), 16);
    e.done(i);
  }
  static void revsh(Engine& e, const Instruction& i) {
    e.r_[i.rd] = static_cast<U32>(I32{static_cast<std::int16_t>(bytes_reversed(e.r_[i.rm]) >> 16)});
    e.done(i);
  }
  static void rbit(Engine& e, const Instruction& i) {
    U32 from = e.r_[i.rm], to = 0;
    for (int bit = 0; bit < 32; ++bit, from >>= 1) to = to << 1 | (from & 1);
    e.r_[i.rd] = to;
    e.done(i);
  }
  static void clz(Engine& e, const Instruction& i) {
    e.r_[i.rd] = static_cast<U32>(zeros_before(e.r_[i.rm]));
    e.done(i);
  }

  // --- loads and stores

  template <Index index>
  static U32 address(const Engine& e, const Instruction& i) {
    switch (index) {
      case Index::kAfter: return e.r_[i.rn];
      case Index::kRegister: return e.r_[i.rn] + (e.r_[i.rm] << i.amount);
      case Index::kAbsolute: return i.value;
      default: return e.r_[i.rn] + i.value;
    }
  }
  template <Index index>
  static void write_back(Engine& e, const Instruction& i) {
    if constexpr (index == Index::kBefore || index == Index::kAfter) e.r_[i.rn] += i.value;
  }

  template <class Type, Index index>
  static void load(Engine& e, const Instruction& i) {
    U32 value = 0;
    if (!e.load<sizeof(Type)>(address<index>(e, i), value)) return;
    write_back<index>(e, i);
    if constexpr (std::is_signed_v<Type>) value = static_cast<U32>(I32{static_cast<Type>(value)});
    e.r_[i.rd] = value;
    e.done(i);
  }
  template <Index index>
  static void load_pc(Engine& e, const Instruction& i) {
    U32 value = 0;
    if (!e.load<4>(address<index>(e, i), value)) return;
    write_back<index>(e, i);
    e.pay(i);
    e.exchange(value, kLoaded);
  }
  template <class Type, Index index>
  static void store(Engine& e, const Instruction& i) {
    if (!e.store<sizeof(Type)>(address<index>(e, i), e.r_[i.rd])) return;
    write_back<index>(e, i);
    e.done(i);
  }
  /// LDRD, STRD: rd and ra.
  template <Index index>
  static void load_two(Engine& e, const Instruction& i) {
    const U32 from = address<index>(e, i);
    U32 first = 0, second = 0;
    if (!e.aligned(from, 4) || !e.load<4>(from, first) || !e.load<4>(from + 4, second)) return;
    write_back<index>(e, i);
    e.r_[i.rd] = first;
    e.r_[i.ra] = second;
    e.done(i);
  }
  template <Index index>
  static void store_two(Engine& e, const Instruction& i) {
    const U32 to = address<index>(e, i);
    if (!e.aligned(to, 4) || !e.store<4>(to, e.r_[i.rd]) || !e.store<4>(to + 4, e.r_[i.ra])) return;
    write_back<index>(e, i);
    e.done(i);
  }

  /// LDM, POP of the registers in `value`, `amount` bytes; `shift` 1: the base is written back. In an IT block it
  /// begins again when it has been broken off (technical reference manual, 3.9.3).
  template <bool before>
  static void load_many(Engine& e, const Instruction& i) {
    const U32 base = e.r_[i.rn];
    U32 from = before ? base - i.amount : base;
    const U32 after = before ? from : base + i.amount;
    const U64 since = e.now_;
    std::array<U32, 16> values{};
    if (!e.aligned(from, 4)) return;
    const std::uint8_t* words = Engine::all_of(e.loads_, from, i.amount);
    if (words == nullptr) words = load_words(e, from, i.amount, values.data());
    if (words == nullptr) return;
    if (i.shift != 0) e.r_[i.rn] = after;
    for (U32 left = i.value & 0x7FFF; left != 0; left &= left - 1, words += 4)
      std::memcpy(&e.r_[first_of(left)], words, 4);
    if ((i.value >> 15) == 0) return e.done(i, since, e.it_ != 0);
    U32 target = 0;
    std::memcpy(&target, words, 4);
    e.pay(i);
    e.breakable(since, e.it_ != 0, true);
    e.exchange(target, kLoaded);
  }
  /// As bytes; nullptr: a trap.
  static const std::uint8_t* load_words(Engine& e, U32 from, U32 bytes, U32* to) {
    for (U32 done = 0; done < bytes; done += 4)
      if (!e.load<4>(from + done, to[done / 4])) return nullptr;
    return reinterpret_cast<const std::uint8_t*>(to);
  }
  template <bool before>
  static void store_many(Engine& e, const Instruction& i) {
    const U32 base = e.r_[i.rn];
    U32 to = before ? base - i.amount : base;
    const U32 after = before ? to : base + i.amount;
    const U64 since = e.now_;
    if (!e.aligned(to, 4)) return;
    if (std::uint8_t* place = e.is_watched(to, i.amount) ? nullptr : Engine::all_of(e.stores_, to, i.amount)) {
      for (U32 left = i.value; left != 0; left &= left - 1, place += 4) std::memcpy(place, &e.r_[first_of(left)], 4);
    } else {
      for (U32 left = i.value; left != 0; left &= left - 1, to += 4)
        if (!e.store<4>(to, e.r_[first_of(left)])) return;
    }
    if (i.shift != 0) e.r_[i.rn] = after;
    e.done(i, since, e.it_ != 0);
  }

  template <class Type>
  static void load_exclusive(Engine& e, const Instruction& i) {
    const U32 from = e.r_[i.rn] + i.value;
    U32 value = 0;
    if (!e.aligned(from, sizeof(Type)) || !e.load<sizeof(Type)>(from, value)) return;
    e.exclusive_ = true;
    e.r_[i.rd] = value;
    e.done(i);
  }
  /// Stores ra; rd: 0 when it was stored.
  template <class Type>
  static void store_exclusive(Engine& e, const Instruction& i) {
    const U32 to = e.r_[i.rn] + i.value;
    if (!e.aligned(to, sizeof(Type)) || (e.exclusive_ && !e.store<sizeof(Type)>(to, e.r_[i.ra]))) return;
    e.r_[i.rd] = e.exclusive_ ? 0 : 1;
    e.exclusive_ = false;
    e.done(i);
  }
  static void clear_exclusive(Engine& e, const Instruction& i) {
    e.exclusive_ = false;
    e.done(i);
  }

  // --- branches

  template <Refill refill = kDecoded>
  static void branch(Engine& e, const Instruction& i) {
    e.pay(i);
    e.follow(i, refill);
  }
  template <unsigned condition>
  static void branch_if(Engine& e, const Instruction& i) {
    if (!e.passes(condition)) return e.done(i);
    branch(e, i);
  }
  /// CBZ; with `not_zero` CBNZ.
  template <bool not_zero>
  static void branch_if_zero(Engine& e, const Instruction& i) {
    if ((e.r_[i.rn] != 0) != not_zero) return e.done(i);
    branch<kExecuted>(e, i);
  }
  static void branch_link(Engine& e, const Instruction& i) {
    e.r_[14] = (e.pc() + 4) | 1;
    branch(e, i);
  }
  /// LR is read when the branch is decoded.
  static Refill by_register(const Instruction& i) { return i.rm == 14 ? kDecoded : kExecuted; }
  static void branch_exchange(Engine& e, const Instruction& i) {
    e.pay(i);
    e.exchange(e.r_[i.rm], by_register(i));
  }
  /// Not the way back from an exception (A7.7.19): BLXWritePC.
  static void branch_link_exchange(Engine& e, const Instruction& i) {
    const U32 target = e.r_[i.rm];
    e.r_[14] = (e.pc() + 2) | 1;
    e.pay(i);
    e.set_thumb(target);
    e.go(target & ~U32{1}, by_register(i));
  }
  /// MOV and ADD to PC.
  template <bool adds>
  static void move_to_pc(Engine& e, const Instruction& i) {
    const U32 value = adds ? e.pc() + 4 + e.r_[i.rm] : e.r_[i.rm];
    e.pay(i);
    e.go(value & ~U32{1}, adds ? kExecuted : by_register(i));
  }
  /// TBB, TBH; rn is PC where `shift` is 1.
  template <class Type>
  static void table_branch(Engine& e, const Instruction& i) {
    const U32 here = e.pc() + 4, base = i.shift != 0 ? here : e.r_[i.rn];
    U32 halfwords = 0;
    if (!e.load<sizeof(Type)>(base + e.r_[i.rm] * static_cast<U32>(sizeof(Type)), halfwords)) return;
    e.pay(i);
    e.go(here + 2 * halfwords, kLoaded);
  }

  // --- others

  static void nothing(Engine& e, const Instruction& i) { e.done(i); }
  /// ISB.
  static void refill(Engine& e, const Instruction& i) {
    e.pay(i);
    e.go(e.pc() + 4, kLoaded);
  }
  /// The first condition stands in ITSTATE, too.
  template <unsigned condition>
  static void it(Engine& e, const Instruction& i) {
    e.it_ = static_cast<std::uint8_t>(i.value);
    e.done(i);
    e.goes_on() ? e.run_block(e.passes(condition)) : e.leave_block();
  }
  template <Trap why>
  static void executed(Engine& e, const Instruction& i) {
    e.done(i);
    e.trap(why);
  }
  template <Trap why>
  static void refused(Engine& e, const Instruction&) {
    e.refuse(why);
  }
  static void send_event(Engine& e, const Instruction& i) {
    e.events_.on_event();
    e.done(i);
  }
  /// `value`: bits 1 and 0 for PRIMASK and FAULTMASK; `shift` 1 sets them. A pending exception may be unmasked.
  static void change_masks(Engine& e, const Instruction& i) {
    if (e.privileged()) {
      if ((i.value & 2) != 0) e.primask_ = i.shift;
      if ((i.value & 1) != 0) e.faultmask_ = i.shift;
    }
    e.attend_at(0);
    e.done(i);
  }
  static void from_special(Engine& e, const Instruction& i) {
    e.r_[i.rd] = e.read_special(i.value);
    e.done(i);
  }
  static void to_special(Engine& e, const Instruction& i) {
    e.write_special(i.value, i.shift != 0, e.r_[i.rn]);
    e.attend_at(0);
    e.done(i);
  }
  static void not_decoded(Engine& e, const Instruction&) {
    e.decode_here();
    e.at_->run(e, *e.at_);
  }
  static void not_decoded_in_it(Engine& e, const Instruction&) {
    e.decode_here();
    e.at_->run_in_it(e, *e.at_);
  }
  /// Behind the last instruction of a page.
  static void next_page(Engine& e, const Instruction&) {
    const U32 here = e.pc();
    e.turn_page(here);
    e.until_ = 0;
  }
  static void no_memory(Engine& e, const Instruction&) {
    e.bad_address_ = e.pc();
    e.trap(Trap::kBadFetch);
  }
};

inline bool Engine::at_end_of_page() const { return at_->run == &Operations::next_page; }

}  // namespace dsdpv1::arm
