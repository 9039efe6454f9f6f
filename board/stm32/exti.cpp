#include "board/stm32/exti.hpp"

namespace dsdpv1::arm {
namespace {

constexpr std::uint32_t kImr = 0x00, kEmr = 0x04, kRtsr = 0x08, kFtsr = 0x0C, kSwier = 0x10, kPr = 0x14;
constexpr std::uint32_t kLines = 0x7'FFFF;
constexpr std::uint32_t kLines5To9 = 0x03E0, kLines10To15 = 0xFC00;

constexpr RegisterList kExtiRegisters = {  // of 19 lines; only 0 to 15 are pins
    {kImr, "IMR", 0, kLines},   {kEmr, "EMR", 0, kLines}, {kRtsr, "RTSR", 0, kLines},
    {kFtsr, "FTSR", 0, kLines}, {kSwier, "SWIER"},        {kPr, "PR"}};
constexpr TagList kExtiTags = {  // PVD, RTC alarm, USB wake-up
    {kImr, 16, 3, "MR[18:16]"},
    {kEmr, 16, 3, "MR[18:16]"},
    {kRtsr, 16, 3, "TR[18:16]"},
    {kFtsr, 16, 3, "TR[18:16]"}};

constexpr std::uint32_t kEvcr = 0x00, kMapr = 0x04;
constexpr RegisterList kAfioList = {
    {kEvcr, "EVCR", 0, 0xFF},     {kMapr, "MAPR", 0, 0x1F'FFFF},  // SWJ_CFG can only be written
    {0x08, "EXTICR1", 0, 0xFFFF}, {0x0C, "EXTICR2", 0, 0xFFFF},  {0x10, "EXTICR3", 0, 0xFFFF},
    {0x14, "EXTICR4", 0, 0xFFFF}, {0x1C, "MAPR2", 0, 0x400}};
constexpr TagList kAfioTags = {  // remapped SPI1 and USART2 do leave their pins
    {kEvcr, 7, 1, "EVOE"},
    {kMapr, 1, 1, "I2C1_REMAP"},
    {kMapr, 2, 1, "USART1_REMAP"},
    {kMapr, 4, 2, "USART3_REMAP"},
    {kMapr, 6, 2, "TIM1_REMAP"},
    {kMapr, 8, 2, "TIM2_REMAP"},
    {kMapr, 10, 2, "TIM3_REMAP"},
    {kMapr, 12, 1, "TIM4_REMAP"},
    {kMapr, 13, 2, "CAN_REMAP"},
    {kMapr, 15, 1, "PD01_REMAP"},
    {kMapr, 16, 1, "TIM5CH4_IREMAP"},
    {kMapr, 17, 1, "ADC1_ETRGINJ_REMAP"},
    {kMapr, 18, 1, "ADC1_ETRGREG_REMAP"},
    {kMapr, 19, 1, "ADC2_ETRGINJ_REMAP"},
    {kMapr, 20, 1, "ADC2_ETRGREG_REMAP"}};

}  // namespace

constexpr RegisterTable Exti::kRegisters{kExtiRegisters, kExtiTags};
constexpr RegisterTable Exti::kAfioRegisters{kAfioList, kAfioTags};

void Exti::write(std::uint32_t offset, std::uint32_t value) {
  value &= kLines;
  if (offset == kPr) {  // cleared by writing 1
    words_[kPr] &= ~value;
    words_[kSwier] &= ~value;
  } else if (offset == kSwier) {
    request(value & ~words_[kSwier]);
    words_[kSwier] |= value;
  } else {
    words_.write(offset, value);
  }
}

void Exti::edge(unsigned port, unsigned line, bool level) {
  if (port_of(line) == port && ((level ? words_[kRtsr] : words_[kFtsr]) >> line & 1U) != 0) request(1U << line);
}

/// PR also of masked lines, an event of those that EMR lets through.
void Exti::request(std::uint32_t lines) {
  words_[kPr] |= lines;
  event_ = event_ || (lines & words_[kEmr]) != 0;
}

bool Exti::listens(unsigned port) const {
  for (unsigned line = 0; line < 16; ++line)
    if (port_of(line) == port && ((words_[kRtsr] | words_[kFtsr]) >> line & 1U) != 0) return true;
  return false;
}

unsigned Exti::requests() const {
  const std::uint32_t asked = words_[kPr] & words_[kImr];
  return (asked & 0x1FU) | static_cast<unsigned>((asked & kLines5To9) != 0) << 5U |
         static_cast<unsigned>((asked & kLines10To15) != 0) << 6U;
}

}  // namespace dsdpv1::arm
