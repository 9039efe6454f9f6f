#include "board/stm32/rcc.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace dsdpv1::arm {
namespace {

constexpr std::uint32_t kCr = 0x00, kCfgr = 0x04, kBdcr = 0x20, kCsr = 0x24;

/// In CR, BDCR and CSR the ready bit stands above its enable bit.
std::uint32_t with_ready(std::uint32_t value, std::uint32_t enables) {
  return (value & ~(enables << 1U)) | (value & enables) << 1U;
}

constexpr std::int64_t kOscillator = 8'000'000;  // HSI, and the board's crystal
constexpr std::uint32_t kPllSource = 1U << 16U, kPllHalfCrystal = 1U << 17U;

/// PPRE1, PPRE2: 1, 2, 4, 8, 16.
unsigned apb_divider(std::uint32_t ppre) { return (ppre & 4U) == 0 ? 1 : 2U << (ppre & 3U); }

unsigned pll_factor(std::uint32_t cfgr) { return std::min((cfgr >> 18U & 0xFU) + 2, 16U); }

/// The crystal, or half of the HSI; PLLXTPRE halves the crystal.
bool pll_input_is_halved(std::uint32_t cfgr) { return (cfgr & kPllSource) == 0 || (cfgr & kPllHalfCrystal) != 0; }

/// HPRE: 1, 2, 4, 8, 16, 64, 128, 256, 512.
std::int64_t ahb_divider(std::uint32_t cfgr) {
  const unsigned hpre = cfgr >> 4U & 0xFU;
  if (hpre < 8) return 1;
  return std::int64_t{1} << (hpre - 7 + (hpre > 11 ? 1U : 0U));
}

}  // namespace

bool Rcc::is_on(unsigned source) const {
  const bool on = source <= kPll && (word(kCr) >> std::array<unsigned, 3>{0, 16, 24}.at(source) & 1U) != 0;
  if (source != kPll) return on;
  return on && is_on((word(kCfgr) & kPllSource) != 0 ? kHse : kHsi);
}

std::int64_t Rcc::hclk_hz() const {
  const std::uint32_t cfgr = word(kCfgr);
  const std::int64_t pll = kOscillator / (pll_input_is_halved(cfgr) ? 2 : 1) * pll_factor(cfgr);
  return (source_ == kPll ? pll : kOscillator) / ahb_divider(cfgr);
}

unsigned Rcc::apb1_divider() const { return apb_divider(word(kCfgr) >> 8U); }

unsigned Rcc::apb2_divider() const { return apb_divider(word(kCfgr) >> 11U); }

std::string Rcc::hclk_source() const {
  const std::uint32_t cfgr = word(kCfgr);
  const std::int64_t divider = ahb_divider(cfgr);
  const std::string ahb = divider == 1 ? "" : fmt::format(", divided by {}", divider);
  if (source_ != kPll) return (source_ == kHsi ? "HSI" : "HSE") + ahb;
  return fmt::format("PLL, {} x {}{}{}", pll_factor(cfgr), (cfgr & kPllSource) != 0 ? "HSE" : "HSI",
                     pll_input_is_halved(cfgr) ? " / 2" : "", ahb);
}

std::uint32_t Rcc::read(std::uint32_t offset) const {
  if (offset / 4 >= kWords) return 0;
  const std::uint32_t value = word(offset);
  switch (offset) {
    case kCr: return with_ready(value, 1U << 0U | 1U << 16U | 1U << 24U);  // HSI, HSE, PLL
    case kCfgr: return (value & ~0xCU) | source_ << 2U;                    // SWS
    case kBdcr:
    case kCsr: return with_ready(value, 1U);  // LSE, LSI
    default: return value;
  }
}

void Rcc::write(std::uint32_t offset, std::uint32_t value) {
  if (offset / 4 >= kWords) return;
  words_.at(offset / 4) = value;
  if (const unsigned wanted = word(kCfgr) & 0x3U; is_on(wanted)) source_ = wanted;
}

}  // namespace dsdpv1::arm
