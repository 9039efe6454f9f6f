#include "tb/user_cpu/arm/rcc.hpp"

namespace arm {
namespace {

constexpr std::uint32_t kCr = 0x00, kCfgr = 0x04, kBdcr = 0x20, kCsr = 0x24;

/// In CR, BDCR and CSR the ready bit stands above its enable bit.
std::uint32_t with_ready(std::uint32_t value, std::uint32_t enables) {
  return (value & ~(enables << 1U)) | (value & enables) << 1U;
}

}  // namespace

std::uint32_t Rcc::read(std::uint32_t offset) const {
  if (offset / 4 >= kWords) return 0;
  const std::uint32_t value = word(offset);
  switch (offset) {
    case kCr: return with_ready(value, 1U << 0U | 1U << 16U | 1U << 24U);  // HSI, HSE, PLL
    case kCfgr: return (value & ~0xCU) | (value & 0x3U) << 2U;             // SWS follows SW
    case kBdcr:
    case kCsr: return with_ready(value, 1U);  // LSE, LSI
    default: return value;
  }
}

void Rcc::write(std::uint32_t offset, std::uint32_t value) {
  if (offset / 4 < kWords) words_.at(offset / 4) = value;
}

}  // namespace arm
