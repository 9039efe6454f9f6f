#include "board/stm32/fsmc.hpp"

namespace dsdpv1::arm {
namespace {

constexpr std::uint32_t kBcr1 = 0x000, kBtr1 = 0x004, kBcr2 = 0x008, kBcr3 = 0x010, kBcr4 = 0x018, kBwtr1 = 0x104;
constexpr std::uint32_t kMbken = 1U << 0U, kMuxen = 1U << 1U, kMwid = 3U << 4U, kBursten = 1U << 8U,
                        kWaitpol = 1U << 9U, kWren = 1U << 12U, kExtmod = 1U << 14U;
constexpr unsigned kAsyncwaitBit = 15;

constexpr std::uint32_t kPcr2 = 0x060, kSr2 = 0x064, kPcr3 = 0x080, kSr3 = 0x084, kPcr4 = 0x0A0, kSr4 = 0x0A4;

constexpr std::uint32_t kPcr = 0xF'FE7E, kSr = 0x3F, kSlowest = 0xFCFC'FCFC, kAll = 0xFFFF'FFFF;
constexpr std::uint32_t kBcr = 0x8'FF7F, kBtr = 0x3FFF'FFFF, kBwtr = 0x300F'FFFF, kLongest = 0x0FFF'FFFF;
constexpr RegisterList kFsmcRegisters = {{kBcr1, "BCR1", 0x30DB, kBcr},
                                         {kBtr1, "BTR1", kLongest, kBtr},
                                         {kBwtr1, "BWTR1", kLongest, kBwtr},
                                         {kBcr2, "BCR2", 0x30D2, kBcr},
                                         {0x00C, "BTR2", kLongest, kBtr},
                                         {0x10C, "BWTR2", kLongest, kBwtr},
                                         {kBcr3, "BCR3", 0x30D2, kBcr},
                                         {0x014, "BTR3", kLongest, kBtr},
                                         {0x114, "BWTR3", kLongest, kBwtr},
                                         {kBcr4, "BCR4", 0x30D2, kBcr},
                                         {0x01C, "BTR4", kLongest, kBtr},
                                         {0x11C, "BWTR4", kLongest, kBwtr},
                                         // NAND flash and PC card
                                         {kPcr2, "PCR2", 0x18, kPcr},
                                         {kSr2, "SR2", 0x40, kSr},
                                         {0x068, "PMEM2", kSlowest, kAll},
                                         {0x06C, "PATT2", kSlowest, kAll},
                                         {0x074, "ECCR2"},
                                         {kPcr3, "PCR3", 0x18, kPcr},
                                         {kSr3, "SR3", 0x40, kSr},
                                         {0x088, "PMEM3", kSlowest, kAll},
                                         {0x08C, "PATT3", kSlowest, kAll},
                                         {0x094, "ECCR3"},
                                         {kPcr4, "PCR4", 0x18, kPcr},
                                         {kSr4, "SR4", 0x40, kSr},
                                         {0x0A8, "PMEM4", kSlowest, kAll},
                                         {0x0AC, "PATT4", kSlowest, kAll},
                                         {0x0B0, "PIO4", kSlowest, kAll}};
constexpr TagList kFsmcTags = {  // zeros are SRAM, asynchronous, at NE1
    {kBcr1, 2, 2, "MTYP"},
    {kBcr1, 8, 1, "BURSTEN"},
    {kBcr1, 13, 1, "WAITEN", 0, kBursten},
    {kBcr1, kAsyncwaitBit, 1, "ASYNCWAIT"},
    {kBcr1, 19, 1, "CBURSTRW"},
    {kBtr1, 28, 2, "ACCMOD"},
    {kBwtr1, 28, 2, "ACCMOD"},
    {kBcr2, 0, 1, "MBKEN"},
    {kBcr3, 0, 1, "MBKEN"},
    {kBcr4, 0, 1, "MBKEN"},
    {kPcr2, 2, 1, "PBKEN"},
    {kPcr3, 2, 1, "PBKEN"},
    {kPcr4, 2, 1, "PBKEN"},
    {kSr2, 3, 3, "I[F:R]EN"},
    {kSr3, 3, 3, "I[F:R]EN"},
    {kSr4, 3, 3, "I[F:R]EN"}};

user_cpu::FsmcTiming fields(std::uint32_t btr) {
  user_cpu::FsmcTiming timing;
  timing.addset = static_cast<int>(btr & 0xFU);
  timing.datast = static_cast<int>(btr >> 8U & 0xFFU);
  timing.busturn = static_cast<int>(btr >> 16U & 0xFU);
  return timing;
}

}  // namespace

constexpr RegisterTable Fsmc::kRegisters{kFsmcRegisters, kFsmcTags};

void Fsmc::write(std::uint32_t offset, std::uint32_t value) {
  words_.write(offset, value);
  btr1_written_ = btr1_written_ || offset == kBtr1;
  bwtr1_written_ = bwtr1_written_ || offset == kBwtr1;
}

bool Fsmc::refuses(bool write) const {
  const std::uint32_t needed = kMbken | (write ? kWren : 0);
  return (words_[kBcr1] & needed) != needed;
}

bool Fsmc::is_wide() const { return (words_[kBcr1] & kMwid) != 0; }
bool Fsmc::is_multiplexed() const { return (words_[kBcr1] & kMuxen) != 0; }
bool Fsmc::waits() const { return (words_[kBcr1] >> kAsyncwaitBit & 1U) != 0; }
bool Fsmc::waits_while_high() const { return (words_[kBcr1] & kWaitpol) != 0; }
bool Fsmc::is_wait(const Tag& tag) { return tag.offset == kBcr1 && tag.bit == kAsyncwaitBit; }

user_cpu::FsmcBank Fsmc::bank(std::int64_t hclk_hz) const {
  user_cpu::FsmcBank bank;
  bank.hclk_hz = hclk_hz;
  if ((words_[kBcr1] & kExtmod) != 0) bank.mode = user_cpu::FsmcMode::kA;
  if (btr1_written_) bank.read = bank.write = fields(words_[kBtr1]);
  if (bank.mode == user_cpu::FsmcMode::kA)
    bank.write = bwtr1_written_ ? fields(words_[kBwtr1]) : user_cpu::FsmcTiming();
  return user_cpu::with(bank, given_);
}

}  // namespace dsdpv1::arm
