#include "board/stm32/fsmc.hpp"

namespace dsdpv1::arm {
namespace {

constexpr std::uint32_t kBcr1 = 0x000, kBtr1 = 0x004, kBwtr1 = 0x104;
constexpr std::uint32_t kMbken = 1U << 0U, kMwid16 = 1U << 4U, kWren = 1U << 12U, kExtmod = 1U << 14U;

user_cpu::FsmcTiming fields(std::uint32_t btr) {
  user_cpu::FsmcTiming timing;
  timing.addset = static_cast<int>(btr & 0xFU);
  timing.datast = static_cast<int>(btr >> 8U & 0xFFU);
  timing.busturn = static_cast<int>(btr >> 16U & 0xFU);
  return timing;
}

}  // namespace

std::uint32_t Fsmc::read(std::uint32_t offset) const { return offset < kSize ? words_.at(offset / 4) : 0; }

void Fsmc::write(std::uint32_t offset, std::uint32_t value) {
  if (offset >= kSize) return;
  words_.at(offset / 4) = value;
  written_.at(offset / 4) = true;
}

bool Fsmc::refuses(bool write) const {
  const std::uint32_t needed = kMbken | (write ? kWren : 0);
  return written_[kBcr1 / 4] && (words_[kBcr1 / 4] & needed) != needed;
}

bool Fsmc::is_wide() const { return written_[kBcr1 / 4] && (words_[kBcr1 / 4] & kMwid16) != 0; }

user_cpu::FsmcBank Fsmc::bank(std::int64_t hclk_hz) const {
  user_cpu::FsmcBank bank;
  bank.hclk_hz = hclk_hz;
  if (written_[kBcr1 / 4] && (words_[kBcr1 / 4] & kExtmod) != 0) bank.mode = user_cpu::FsmcMode::kA;
  if (written_[kBtr1 / 4]) bank.read = bank.write = fields(words_[kBtr1 / 4]);
  if (bank.mode == user_cpu::FsmcMode::kA)
    bank.write = written_[kBwtr1 / 4] ? fields(words_[kBwtr1 / 4]) : user_cpu::FsmcTiming();
  return user_cpu::with(bank, given_);
}

}  // namespace dsdpv1::arm
