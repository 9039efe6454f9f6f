#include "tests/board/unicorn/random_code.hpp"

#include <array>
#include <cstring>
#include <set>
#include <string_view>

#include "board/cpu/instruction.hpp"

namespace dsdpv1::arm::differential {
namespace {

/// Bits of encodings in the notation of chapter A7 of the architecture: 0 and 1; letters, each a separate field:
///   i a number    d n m t a registers that may have any value (three bits: r0 to r4)    b a base    x the index
///   s a number of 1 to 31 (a shift)    w a width that fits after a shift: 0    r registers of a list, none of a base
/// After a comma, the choice inside an IT block: "-" never.
constexpr std::string_view kPatterns[] = {
    // A5.2.1 to A5.2.3
    "000 00 iiiii mmm ddd",
    "000 01 iiiii mmm ddd",
    "000 10 iiiii mmm ddd",
    "00011 00 mmm nnn ddd",
    "00011 01 mmm nnn ddd",
    "00011 10 iii nnn ddd",
    "00011 11 iii nnn ddd",
    "00100 ddd iiiiiiii",
    "00101 nnn iiiiiiii",
    "00110 ddd iiiiiiii",
    "00111 ddd iiiiiiii",
    "010000 0000 mmm ddd",
    "010000 0001 mmm ddd",
    "010000 0010 mmm ddd",
    "010000 0011 mmm ddd",
    "010000 0100 mmm ddd",
    "010000 0101 mmm ddd",
    "010000 0110 mmm ddd",
    "010000 0111 mmm ddd",
    "010000 1000 mmm nnn",
    "010000 1001 nnn ddd",
    "010000 1010 mmm nnn",
    "010000 1011 mmm nnn",
    "010000 1100 mmm ddd",
    "010000 1101 nnn ddd",
    "010000 1110 mmm ddd",
    "010000 1111 mmm ddd",
    "01000100 0 mmmm ddd",
    "01000101 1 mmmm 0nn",
    "01000110 0 mmmm ddd",
    // A5.2.4: loads and stores
    "01001 ddd iiiiiiii",
    "0101 000 xxx bbb ttt",
    "0101 001 xxx bbb ttt",
    "0101 010 xxx bbb ttt",
    "0101 011 xxx bbb ttt",
    "0101 100 xxx bbb ttt",
    "0101 101 xxx bbb ttt",
    "0101 110 xxx bbb ttt",
    "0101 111 xxx bbb ttt",
    "0110 0 iiiii bbb ttt",
    "0110 1 iiiii bbb ttt",
    "0111 0 iiiii bbb ttt",
    "0111 1 iiiii bbb ttt",
    "1000 0 iiiii bbb ttt",
    "1000 1 iiiii bbb ttt",
    "1001 0 ttt iiiiiiii",
    "1001 1 ttt iiiiiiii",
    "10100 ddd iiiiiiii",
    "10101 ddd iiiiiiii",
    "1011 0000 0 0000iii",
    "1011 0000 1 0000iii",
    "1011 0010 00 mmm ddd",
    "1011 0010 01 mmm ddd",
    "1011 0010 10 mmm ddd",
    "1011 0010 11 mmm ddd",
    "1011 1010 00 mmm ddd",
    "1011 1010 01 mmm ddd",
    "1011 1010 11 mmm ddd",
    "1011 0100 000 iiii1",
    "1011 0101 000 iiiii",
    "1011 1100 000 iiii1",
    "11000 110 000 rrrrr",
    "11001 111 000 rrrrr",
    "1011 1111 0000 0000",
    "1011 1111 0100 0000",
    "1011 0110 0110 0010,-",
    "1011 0110 0111 0010,-",
    // A5.3.1, A5.3.2: data processing, shifted register; modified immediate
    "1110101 0000 i nnnn 0 iii dddd ii ii mmmm",
    "1110101 0001 i nnnn 0 iii dddd ii ii mmmm",
    "1110101 0010 i nnnn 0 iii dddd ii ii mmmm",
    "1110101 0010 i 1111 0 iii dddd ii ii mmmm",
    "1110101 0011 i nnnn 0 iii dddd ii ii mmmm",
    "1110101 0011 i 1111 0 iii dddd ii ii mmmm",
    "1110101 0100 i nnnn 0 iii dddd ii ii mmmm",
    "1110101 1000 i nnnn 0 iii dddd ii ii mmmm",
    "1110101 1010 i nnnn 0 iii dddd ii ii mmmm",
    "1110101 1011 i nnnn 0 iii dddd ii ii mmmm",
    "1110101 1101 i nnnn 0 iii dddd ii ii mmmm",
    "1110101 1110 i nnnn 0 iii dddd ii ii mmmm",
    "1110101 0000 1 nnnn 0 iii 1111 ii ii mmmm",
    "1110101 0100 1 nnnn 0 iii 1111 ii ii mmmm",
    "1110101 1000 1 nnnn 0 iii 1111 ii ii mmmm",
    "1110101 1101 1 nnnn 0 iii 1111 ii ii mmmm",
    "11110 i 0 0000 i nnnn 0 iii dddd iiiiiiii",
    "11110 i 0 0001 i nnnn 0 iii dddd iiiiiiii",
    "11110 i 0 0010 i nnnn 0 iii dddd iiiiiiii",
    "11110 i 0 0010 i 1111 0 iii dddd iiiiiiii",
    "11110 i 0 0011 i nnnn 0 iii dddd iiiiiiii",
    "11110 i 0 0011 i 1111 0 iii dddd iiiiiiii",
    "11110 i 0 0100 i nnnn 0 iii dddd iiiiiiii",
    "11110 i 0 1000 i nnnn 0 iii dddd iiiiiiii",
    "11110 i 0 1010 i nnnn 0 iii dddd iiiiiiii",
    "11110 i 0 1011 i nnnn 0 iii dddd iiiiiiii",
    "11110 i 0 1101 i nnnn 0 iii dddd iiiiiiii",
    "11110 i 0 1110 i nnnn 0 iii dddd iiiiiiii",
    "11110 i 0 0000 1 nnnn 0 iii 1111 iiiiiiii",
    "11110 i 0 0100 1 nnnn 0 iii 1111 iiiiiiii",
    "11110 i 0 1000 1 nnnn 0 iii 1111 iiiiiiii",
    "11110 i 0 1101 1 nnnn 0 iii 1111 iiiiiiii",
    // A5.3.3: plain immediates
    "11110 i 10000 0 nnnn 0 iii dddd iiiiiiii",
    "11110 i 10101 0 nnnn 0 iii dddd iiiiiiii",
    "11110 i 10000 0 1111 0 iii dddd iiiiiiii",
    "11110 i 10101 0 1111 0 iii dddd iiiiiiii",
    "11110 i 10010 0 iiii 0 iii dddd iiiiiiii",
    "11110 i 10110 0 iiii 0 iii dddd iiiiiiii",
    "11110 0 1100 0 0 nnnn 0 iii dddd ii 0 iiiii",
    "11110 0 1100 1 0 nnnn 0 sss dddd ss 0 iiiii",
    "11110 0 1110 0 0 nnnn 0 iii dddd ii 0 iiiii",
    "11110 0 1110 1 0 nnnn 0 sss dddd ss 0 iiiii",
    "11110 0 1101 0 0 nnnn 0 iii dddd ii 0 iiiii",
    "11110 0 1111 0 0 nnnn 0 iii dddd ii 0 iiiii",
    "11110 0 1101 1 0 nnnn 0 iii dddd ii 0 iiiii",
    "11110 0 1101 1 0 1111 0 iii dddd ii 0 iiiii",
    // A5.3.4: MRS, MSR, barriers, hints
    "11110 0111110 1111 1000 dddd 000000 ii",
    "11110 0111110 1111 1000 dddd 0000100 i",
    "11110 0111110 1111 1000 dddd 000100 0i",
    "11110 0111110 1111 1000 dddd 00010011",
    "11110 0111110 1111 1000 dddd 00010100",
    "11110 0111000 nnnn 1000 1000 00000000,-",
    "11110 0111000 nnnn 1000 1000 00010000,-",
    "11110 0111000 nnnn 1000 1000 00010001,-",
    "11110 0111011 1111 1000 1111 0100 1111",
    "11110 0111011 1111 1000 1111 0101 1111",
    "11110 0111011 1111 1000 1111 0110 1111,-",
    "11110 0111011 1111 1000 1111 0010 1111",
    "11110 0111010 1111 1000 0000 00000000",
    // A5.3.5, A5.3.6: several registers
    "1110100 010 0 0 bbbb 0 r 0 rrrrrrrrrrrrr",
    "1110100 010 1 0 bbbb 0 r 0 rrrrrrrrrrrrr",
    "1110100 100 0 0 bbbb 0 r 0 rrrrrrrrrrrrr",
    "1110100 100 1 0 bbbb 0 r 0 rrrrrrrrrrrrr",
    "1110100 010 0 1 bbbb 0 r 0 rrrrrrrrrrrrr",
    "1110100 010 1 1 bbbb 0 r 0 rrrrrrrrrrrrr",
    "1110100 100 0 1 bbbb 0 r 0 rrrrrrrrrrrrr",
    "1110100 100 1 1 bbbb 0 r 0 rrrrrrrrrrrrr",
    "1110100 1 i 1 i 0 bbbb tttt aaaa iiiiiiii",
    "1110100 1 i 1 0 1 bbbb tttt aaaa iiiiiiii",
    "1110100 0 i 1 1 0 bbbb tttt aaaa iiiiiiii",
    "1110100 0 i 1 1 1 bbbb tttt aaaa iiiiiiii",
    // A5.3.7 to A5.3.10: single ones
    "1111100 0 0 000 bbbb tttt 1 i i i iiiiiiii",
    "1111100 0 1 000 bbbb tttt iiiiiiiiiiii",
    "1111100 0 1 010 bbbb tttt iiiiiiiiiiii",
    "1111100 0 1 100 bbbb tttt iiiiiiiiiiii",
    "1111100 0 1 001 bbbb tttt iiiiiiiiiiii",
    "1111100 0 1 011 bbbb tttt iiiiiiiiiiii",
    "1111100 0 1 101 bbbb tttt iiiiiiiiiiii",
    "1111100 1 1 001 bbbb tttt iiiiiiiiiiii",
    "1111100 1 1 011 bbbb tttt iiiiiiiiiiii",
    "1111100 0 0 010 bbbb tttt 1 1 i 0 iiiiiiii",
    "1111100 0 0 100 bbbb tttt 1 1 i 1 iiiiiiii",
    "1111100 0 0 100 bbbb tttt 1 0 i 1 iiiiiiii",
    "1111100 0 0 001 bbbb tttt 1 1 i i iiiiiiii",
    "1111100 0 0 011 bbbb tttt 1 1 i i iiiiiiii",
    "1111100 0 0 101 bbbb tttt 1 1 i i iiiiiiii",
    "1111100 0 0 101 bbbb tttt 1 0 i 1 iiiiiiii",
    "1111100 1 0 001 bbbb tttt 1 1 i i iiiiiiii",
    "1111100 1 0 011 bbbb tttt 1 0 i 1 iiiiiiii",
    "1111100 0 0 000 bbbb tttt 000000 ii xxxx",
    "1111100 0 0 010 bbbb tttt 000000 ii xxxx",
    "1111100 0 0 100 bbbb tttt 000000 ii xxxx",
    "1111100 0 0 001 bbbb tttt 000000 ii xxxx",
    "1111100 0 0 011 bbbb tttt 000000 ii xxxx",
    "1111100 0 0 101 bbbb tttt 000000 ii xxxx",
    "1111100 1 0 001 bbbb tttt 000000 ii xxxx",
    "1111100 1 0 011 bbbb tttt 000000 ii xxxx",
    "1111100 0 1 101 1111 tttt 0000 iiiiiiii",
    "1111100 0 1 001 1111 tttt 0000 iiiiiiii",
    "1111100 1 1 011 1111 tttt 0000 iiiiiiii",
    "1111100 0 1 001 bbbb 1111 iiiiiiiiiiii",
    // A5.3.12, A5.3.16, A5.3.17
    "11111010 000 i nnnn 1111 dddd 0000 mmmm",
    "11111010 001 i nnnn 1111 dddd 0000 mmmm",
    "11111010 010 i nnnn 1111 dddd 0000 mmmm",
    "11111010 011 i nnnn 1111 dddd 0000 mmmm",
    "11111010 0000 1111 1111 dddd 10 ii mmmm",
    "11111010 0001 1111 1111 dddd 10 ii mmmm",
    "11111010 0100 1111 1111 dddd 10 ii mmmm",
    "11111010 0101 1111 1111 dddd 10 ii mmmm",
    "11111010 1001 MMMM 1111 dddd 1000 mmmm",
    "11111010 1001 MMMM 1111 dddd 1001 mmmm",
    "11111010 1001 MMMM 1111 dddd 1010 mmmm",
    "11111010 1001 MMMM 1111 dddd 1011 mmmm",
    "11111010 1011 MMMM 1111 dddd 1000 mmmm",
    "11111011 0000 nnnn 1111 dddd 0000 mmmm",
    "11111011 0000 nnnn aaaa dddd 0000 mmmm",
    "11111011 0000 nnnn aaaa dddd 0001 mmmm",
    "11111011 1000 nnnn aaaa dddd 0000 mmmm",
    "11111011 1001 nnnn 1111 dddd 1111 mmmm",
    "11111011 1010 nnnn aaaa dddd 0000 mmmm",
    "11111011 1011 nnnn 1111 dddd 1111 mmmm",
    "11111011 1100 nnnn aaaa dddd 0000 mmmm",
    "11111011 1110 nnnn aaaa dddd 0000 mmmm",
};

constexpr std::array<unsigned, 7> kFree = {0, 1, 2, 3, 4, 12, 14};  ///< for any value
constexpr std::array<unsigned, 6> kBases = {6, 7, 8, 9, 10, 11};
constexpr std::uint32_t kListed = 0x501F;  ///< r0 to r4, r12, r14

unsigned below(Random& random, unsigned count) { return static_cast<unsigned>(random() % count); }

/// One field: its value, of `width` bits.
std::uint32_t value_of(Random& random, char letter, unsigned width) {
  const auto any = static_cast<std::uint32_t>(random() & ((1ULL << width) - 1));
  switch (letter) {
    case 'd':
    case 'n':
    case 'm':
    case 't':
    case 'a': return width == 3 ? below(random, 5) : width == 4 ? kFree.at(below(random, kFree.size())) : any;
    case 'b': return width == 3 ? 6 + below(random, 2) : kBases.at(below(random, kBases.size()));
    case 'x': return kIndexRegister;
    default: return any;
  }
}

class Encoder {
 public:
  Encoder(Random& random, std::string_view pattern) : random_(random), pattern_(pattern) {}

  /// Its halfwords. Fields of registers have adjacent letters, all others single bits.
  std::vector<std::uint16_t> encode() {
    for (std::size_t i = 0; i < pattern_.size() && pattern_[i] != ',';) {
      const char letter = pattern_[i];
      if (letter == ' ') {
        ++i;
        continue;
      }
      std::size_t end = i + 1;
      const bool is_field = std::string_view("dnmtabxM").find(letter) != std::string_view::npos;
      while (is_field && end < pattern_.size() && pattern_[end] == letter) ++end;
      put(letter, static_cast<unsigned>(end - i));
      i = end;
    }
    if (count_ == 16) return {static_cast<std::uint16_t>(word_)};
    return {static_cast<std::uint16_t>(word_ >> 16), static_cast<std::uint16_t>(word_)};
  }

 private:
  void put(char letter, unsigned width) {
    std::uint32_t value = 0;
    if (letter == '0' || letter == '1')
      value = letter == '1' ? 1 : 0;
    else if (letter == 'M')
      value = again();
    else if (letter == 'm' && width == 4 && again_ != 0)
      value = again_ - 1;
    else
      value = value_of(random_, letter, width);
    word_ = word_ << width | value;
    count_ += width;
  }
  /// REV and others contain their register twice.
  std::uint32_t again() {
    again_ = value_of(random_, 'm', 4) + 1;
    return again_ - 1;
  }

  Random& random_;
  std::string_view pattern_;
  std::uint32_t word_ = 0, again_ = 0;
  unsigned count_ = 0;
};

/// Excludes what the patterns alone cannot.
bool is_predictable(unsigned h) {
  const bool has_list = (h >> 11) == 0b11000 || (h >> 11) == 0b11001;
  return !has_list || (h & 0x1F) != 0;
}

/// Lists of two registers or more, without the base; two different registers.
bool is_predictable_list(unsigned h, unsigned h2) {
  return (h2 & ~kListed) == 0 && (h2 & (h2 - 1)) != 0 && (h2 >> (h & 15) & 1) == 0;
}

bool is_predictable_access(unsigned h, unsigned h2) {
  const bool has_imm12 = (h & 0x80) != 0, has_imm8 = !has_imm12 && (h2 & 0x0800) != 0;
  // Unicorn splits unaligned accesses in its own way, which shows on the bus.
  if ((h & 15) == kBusRegister && (has_imm12 || has_imm8) && (h2 & 3) != 0) return false;
  return !has_imm8 || (h & 15) == 15 || (h2 & 0x0500) != 0;  // P or W
}

bool is_predictable_field(unsigned h, unsigned h2) {
  const unsigned first = (h2 >> 12 & 7) << 2 | (h2 >> 6 & 3), last = h2 & 31;
  if ((h & 0xFFF0) == 0xF360) return last >= first;                         // BFI, BFC
  if ((h & 0xFF70) == 0xF340) return first + last <= 31;                    // SBFX, UBFX
  return ((h & 0xFFF0) != 0xF320 && (h & 0xFFF0) != 0xF3A0) || first != 0;  // SSAT16, USAT16
}

bool is_predictable(const std::vector<std::uint16_t>& code) {
  const unsigned h = code[0];
  if (code.size() == 1) return is_predictable(h);
  const unsigned h2 = code[1];
  const bool two_apart = (h2 >> 12) != (h2 >> 8 & 15);
  if ((h & 0xFE40) == 0xE800) return is_predictable_list(h, h2);
  if ((h & 0xFE40) == 0xE840 && (h & 0x10) != 0) return two_apart;  // LDRD
  if ((h & 0xFF80) == 0xFB80 && (h & 0x10) == 0) return two_apart;  // SMULL ...
  if ((h & 0xFE00) == 0xF800) return is_predictable_access(h, h2);
  return (h & 0xFA00) != 0xF200 || (h2 & 0x8000) != 0 || is_predictable_field(h, h2);
}

class Writer {
 public:
  Writer(Random& random, unsigned count) : random_(random) {
    while (starts_.size() < count) one();
    fix_branches();
  }
  std::vector<std::uint8_t> bytes() const {
    std::vector<std::uint8_t> all(code_.size() * 2);
    std::memcpy(all.data(), code_.data(), all.size());
    return all;
  }

 private:
  enum class Kind { kShortIf, kShort, kLongIf, kLong, kLink, kZero, kFar };
  struct Branch {
    std::size_t at, target;  ///< halfword; number of an instruction
    Kind kind;
  };

  void add(const std::vector<std::uint16_t>& code) {
    starts_.push_back(code_.size());
    code_.insert(code_.end(), code.begin(), code.end());
  }
  std::vector<std::uint16_t> plain(bool in_it) {
    for (;;) {
      const std::string_view pattern = kPatterns[below(random_, std::size(kPatterns))];
      if (in_it && pattern.find(",-") != std::string_view::npos) continue;
      std::vector<std::uint16_t> code = Encoder(random_, pattern).encode();
      if (is_predictable(code)) return code;
    }
  }
  void one() {
    switch (below(random_, 16)) {
      case 0: return block();
      case 1: return branch();
      case 2: return below(random_, 4) == 0 ? exclusive() : add(plain(false));
      default: return add(plain(false));
    }
  }
  /// LDREX, STREX at SP, which is aligned, with no instruction between them: Unicorn checks whether the memory is
  /// unchanged, a Cortex-M3 whether LDREX came before. Then a single STREX.
  void exclusive() {
    const unsigned base = 13, loaded = below(random_, 3), failed = 3 + below(random_, 2);
    const unsigned words = below(random_, 256), size = below(random_, 3);
    const auto load = size == 0 ? 0x0F00 | words : size == 1 ? 0x0F4F : 0x0F5F;
    const auto store = size == 0 ? failed << 8 | words : (size == 1 ? 0x0F40 : 0x0F50) | failed;
    const unsigned op = size == 0 ? 0xE840 : 0xE8C0;
    const auto half = [](unsigned bits) { return static_cast<std::uint16_t>(bits); };
    inner_.insert({starts_.size() + 1, starts_.size() + 2});
    add({half(op | 0x10 | base), half(loaded << 12 | load)});
    add({half(op | base), half(loaded << 12 | store)});
    add({half(op | base), half(loaded << 12 | store)});
  }
  /// IT with one to four instructions; a branch may be the last one.
  void block() {
    const unsigned condition = below(random_, 14), mask = 1 + below(random_, 15);
    const unsigned count = 4 - static_cast<unsigned>(__builtin_ctz(mask));
    add({static_cast<std::uint16_t>(0xBF00 | condition << 4 | mask)});
    for (unsigned i = 0; i + 1 < count; ++i) add(plain(true));
    if (below(random_, 3) == 0)
      jump(below(random_, 2) == 0 ? Kind::kShort : Kind::kLong);
    else
      add(plain(true));
  }
  void branch() {
    const unsigned kind = below(random_, 8);
    if (kind == 7) return over_one();
    jump(static_cast<Kind>(kind));
  }
  /// MOV PC, PC; skips the following ADDS r0, #1.
  void over_one() {
    add({0x46FF});
    add({0x3001});
  }
  /// Over none to three instructions; kFar: by way of a register.
  void jump(Kind kind) {
    if (kind == Kind::kFar) return far();
    add(kind == Kind::kLongIf || kind == Kind::kLong || kind == Kind::kLink ? std::vector<std::uint16_t>{0, 0}
                                                                            : std::vector<std::uint16_t>{0});
    branches_.push_back({starts_.back(), starts_.size() + below(random_, 4), kind});
  }
  /// ADR r12; ADD r12, #1 (Thumb); BX, BLX or MOV PC. Also a table of bytes.
  void far() {
    const std::size_t adr = code_.size();
    add({0xF20F, 0x0C00});
    inner_.insert({starts_.size(), starts_.size() + 1});  // ADR must be followed directly
    add({0xF10C, 0x0C01});
    static constexpr std::uint16_t kJumps[] = {0x4760, 0x47E0, 0x46E7};
    add({kJumps[below(random_, 3)]});
    branches_.push_back({adr, starts_.size() + below(random_, 3), Kind::kFar});
  }
  void fix_branches() {
    const std::size_t instructions = starts_.size();
    for (unsigned i = 0; i < 8; ++i) add({kEnd});
    for (const Branch& each : branches_) {
      std::size_t target = std::min(each.target, instructions);
      while (inner_.count(target) != 0) ++target;
      fix(each, static_cast<std::uint32_t>((starts_[target] - each.at) * 2));
    }
  }
  /// `distance` from the branch itself, bytes.
  void fix(const Branch& branch, std::uint32_t distance) {
    const std::uint32_t offset = distance - 4;  // from PC; a small number, perhaps -2
    const auto low = [&](unsigned from, unsigned count) { return offset >> from & ((1U << count) - 1); };
    std::uint16_t &h = code_[branch.at], *h2 = &code_[branch.at + 1];
    switch (branch.kind) {
      case Kind::kShortIf: h = static_cast<std::uint16_t>(0xD000 | below(random_, 14) << 8 | low(1, 8)); break;
      case Kind::kShort: h = static_cast<std::uint16_t>(0xE000 | low(1, 11)); break;
      case Kind::kZero:
        if (static_cast<std::int32_t>(offset) < 0) {
          h = 0xBF00;
          break;
        }
        h = static_cast<std::uint16_t>(0xB100 | below(random_, 2) << 11 | low(6, 1) << 9 | low(1, 5) << 3 |
                                       below(random_, 5));
        break;
      case Kind::kLongIf:
        h = static_cast<std::uint16_t>(0xF000 | low(20, 1) << 10 | below(random_, 14) << 6 | low(12, 6));
        *h2 = static_cast<std::uint16_t>(0x8000 | low(18, 1) << 13 | low(19, 1) << 11 | low(1, 11));
        break;
      case Kind::kLong:
      case Kind::kLink: {
        const unsigned s = low(24, 1), j1 = ~(low(23, 1) ^ s) & 1, j2 = ~(low(22, 1) ^ s) & 1;
        h = static_cast<std::uint16_t>(0xF000 | s << 10 | low(12, 10));
        *h2 = static_cast<std::uint16_t>((branch.kind == Kind::kLink ? 0xD000 : 0x9000) | j1 << 13 | j2 << 11 |
                                         low(1, 11));
        break;
      }
      case Kind::kFar: {  // ADR counts from the word that PC is in
        const std::uint32_t pc = static_cast<std::uint32_t>(branch.at * 2 + 4) & ~3U;
        *h2 = static_cast<std::uint16_t>(0x0C00 | ((static_cast<std::uint32_t>(branch.at * 2) + distance - pc) & 0xFF));
        break;
      }
    }
  }

  Random& random_;
  std::vector<std::uint16_t> code_;
  std::vector<std::size_t> starts_;  ///< of instructions, in halfwords
  std::vector<Branch> branches_;
  std::set<std::size_t> inner_;  ///< instructions that must not be jump targets
};

}  // namespace

std::vector<std::uint8_t> random_code(Random& random, unsigned count) { return Writer(random, count).bytes(); }

}  // namespace dsdpv1::arm::differential
