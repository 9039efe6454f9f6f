#include "board/stm32/rcc.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace dsdpv1::arm {
namespace {

constexpr std::uint32_t kCr = 0x00, kCfgr = 0x04, kCir = 0x08, kApb2rstr = 0x0C, kApb1rstr = 0x10, kBdcr = 0x20,
                        kCsr = 0x24;
constexpr std::uint32_t kRmvf = 1U << 24U, kResetFlags = 0xFC00'0000, kPinReset = 1U << 26U, kSoftwareReset = 1U << 28U,
                        kWatchdogReset = 1U << 29U;

constexpr RegisterList kRccRegisters = {  // of high-density devices
    {kCr, "CR", 0x83, 0x010D'00F9},
    {kCfgr, "CFGR", 0, 0x077F'FFF3},
    {kCir, "CIR", 0, 0x1F00},
    {kApb2rstr, "APB2RSTR", 0, 0xFFFD},
    {kApb1rstr, "APB1RSTR", 0, 0x3AFE'C83F},
    {Rcc::kAhbenr, "AHBENR", 0x14, 0x557},
    {Rcc::kApb2enr, "APB2ENR", 0, 0xFFFD},
    {Rcc::kApb1enr, "APB1ENR", 0, 0x3AFE'C83F},
    {kBdcr, "BDCR", 0, 0x1'8305},
    {kCsr, "CSR", 0x0C00'0000, kRmvf | 1U}};
// Clocks and resets of peripherals that the board does not have are none: their use is listed.
constexpr TagList kRccTags = {
    {kCr, 3, 5, "HSITRIM", 0x10}, {kCr, 18, 1, "HSEBYP"},           {kCr, 19, 1, "CSSON"},
    {kCfgr, 24, 3, "MCO"},        {kCir, 8, 1, "LSIRDYIE"},         {kCir, 9, 1, "LSERDYIE"},
    {kCir, 10, 1, "HSIRDYIE"},    {kCir, 11, 1, "HSERDYIE"},        {kCir, 12, 1, "PLLRDYIE"},
    {kApb2rstr, 0, 1, "AFIORST"}, {kApb2rstr, 2, 7, "IOP[G:A]RST"}, {kApb2rstr, 14, 1, "USART1RST"},
    {kBdcr, 2, 1, "LSEBYP"},      {kBdcr, 16, 1, "BDRST"}};

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

constexpr RegisterTable Rcc::kRegisters{kRccRegisters, kRccTags};

bool Rcc::is_on(unsigned source) const {
  const bool on = source <= kPll && (words_[kCr] >> std::array<unsigned, 3>{0, 16, 24}.at(source) & 1U) != 0;
  if (source != kPll) return on;
  return on && is_on((words_[kCfgr] & kPllSource) != 0 ? kHse : kHsi);
}

std::int64_t Rcc::sysclk_hz() const {
  const std::uint32_t cfgr = words_[kCfgr];
  const std::int64_t pll = kOscillator / (pll_input_is_halved(cfgr) ? 2 : 1) * pll_factor(cfgr);
  return source_ == kPll ? pll : kOscillator;
}

std::int64_t Rcc::hclk_hz() const { return sysclk_hz() / ahb_divider(words_[kCfgr]); }

unsigned Rcc::apb1_divider() const { return apb_divider(words_[kCfgr] >> 8U); }

unsigned Rcc::apb2_divider() const { return apb_divider(words_[kCfgr] >> 11U); }

std::string Rcc::hclk_source() const {
  const std::uint32_t cfgr = words_[kCfgr];
  const std::int64_t divider = ahb_divider(cfgr);
  const std::string ahb = divider == 1 ? "" : fmt::format(", divided by {}", divider);
  if (source_ != kPll) return (source_ == kHsi ? "HSI" : "HSE") + ahb;
  return fmt::format("PLL, {} x {}{}{}", pll_factor(cfgr), (cfgr & kPllSource) != 0 ? "HSE" : "HSI",
                     pll_input_is_halved(cfgr) ? " / 2" : "", ahb);
}

std::uint32_t Rcc::read(std::uint32_t offset) const {
  const std::uint32_t value = words_.read(offset);
  switch (offset) {
    case kCr: return with_ready(value, 1U << 0U | 1U << 16U | 1U << 24U);  // HSI, HSE, PLL
    case kCfgr: return value | source_ << 2U;                              // SWS
    case kBdcr:
    case kCsr: return with_ready(value, 1U);  // LSE, LSI
    default: return value;
  }
}

void Rcc::reset(bool by_watchdog) {
  const std::uint32_t flags = words_[kCsr] & kResetFlags;
  *this = {};
  words_[kCsr] = (words_[kCsr] & ~kResetFlags) | flags | kPinReset | (by_watchdog ? kWatchdogReset : kSoftwareReset);
}

void Rcc::write(std::uint32_t offset, std::uint32_t value) {
  words_.write(offset, value);
  if (offset == kCsr && (value & kRmvf) != 0) words_[kCsr] &= ~kResetFlags;
  if (const unsigned wanted = words_[kCfgr] & 0x3U; is_on(wanted)) source_ = wanted;
}

}  // namespace dsdpv1::arm
