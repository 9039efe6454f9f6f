#include "board/stm32/other_registers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace dsdpv1::arm {
namespace {

constexpr std::uint32_t kBlock = 0x400;

/// Everything from here on belongs to the processor and its debug port.
constexpr std::uint32_t kPrivateBus = 0xE000'0000;
/// Settings of the debug port: every start-up writes them; they mean nothing here.
constexpr std::uint32_t kDbgmcu = 0xE004'2000;

struct Named {
  std::uint32_t address;
  const char* name;
};

// RM0008, memory map.
constexpr std::array<Named, 28> kBlocks = {{
    {0x1FFF'F000, "system memory"}, {0x1FFF'F400, "system memory"}, {0x1FFF'F800, "option bytes"},
    {0x4000'6000, "USB memory"},    {0x4001'3C00, "ADC3"},

    {0x4000'1000, "TIM6"},          {0x4000'1400, "TIM7"},          {0x4000'2800, "RTC"},
    {0x4000'2C00, "WWDG"},          {0x4000'3C00, "SPI3"},          {0x4000'4800, "USART3"},
    {0x4000'4C00, "UART4"},         {0x4000'5000, "UART5"},         {0x4000'5400, "I2C1"},
    {0x4000'5800, "I2C2"},          {0x4000'5C00, "USB"},           {0x4000'6400, "CAN"},
    {0x4000'6C00, "BKP"},           {0x4000'7000, "PWR"},           {0x4000'7400, "DAC"},
    {0x4001'2400, "ADC1"},          {0x4001'2800, "ADC2"},          {0x4001'2C00, "TIM1"},
    {0x4001'3400, "TIM8"},          {0x4001'8000, "SDIO"},          {0x4002'0000, "DMA1"},
    {0x4002'0400, "DMA2"},          {0x4002'3000, "CRC"},
}};

const Named* block_of(std::uint32_t address) {
  const auto* const found = std::find_if(kBlocks.begin(), kBlocks.end(), [address](const Named& each) {
    return each.address == (address & ~(kBlock - 1));
  });
  return found != kBlocks.end() ? found : nullptr;
}

std::string name_of(std::uint32_t block) {
  const Named* const known = block_of(block);
  return known != nullptr ? known->name : fmt::format("0x{:08X}", block);
}

}  // namespace

bool OtherRegisters::is_mapped(std::uint32_t address) { return address >= kPrivateBus || block_of(address) != nullptr; }

OtherRegisters::Use& OtherRegisters::use(std::uint32_t address, std::uint32_t pc) {
  const auto [place, fresh] = uses_.try_emplace(address & ~(kBlock - 1));
  if (fresh) place->second.first_pc = pc;
  return place->second;
}

std::uint32_t OtherRegisters::read(std::uint32_t address, std::uint32_t pc) {
  ++use(address, pc).reads;
  return peek(address);
}

std::uint32_t OtherRegisters::peek(std::uint32_t address) const {
  const auto kept = words_.find(address);
  return kept == words_.end() ? 0 : kept->second;
}

void OtherRegisters::write(std::uint32_t address, std::uint32_t value, std::uint32_t pc) {
  ++use(address, pc).writes;
  words_[address] = value;
}

std::vector<std::string> OtherRegisters::notes(const std::function<std::string(std::uint32_t)>& place) const {
  std::vector<std::string> lines;
  for (const auto& [block, use] : uses_) {
    if (block == kDbgmcu) continue;
    lines.push_back(fmt::format("{} is not on the board: {} reads and {} writes, the first in {}", name_of(block),
                                use.reads, use.writes, place(use.first_pc)));
  }
  return lines;
}

}  // namespace dsdpv1::arm
