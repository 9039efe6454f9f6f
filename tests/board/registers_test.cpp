// Registers of the ARM board's peripherals, as in RM0008 (rev. 20) and PM0075 for an STM32F103xE: their reset values,
// writable bits, and fields that the board reports because it does not have them.
#include "board/stm32/registers.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <map>
#include <string>

#include "board/stm32/exti.hpp"
#include "board/stm32/flash_interface.hpp"
#include "board/stm32/fsmc.hpp"
#include "board/stm32/gpio.hpp"
#include "board/stm32/rcc.hpp"
#include "board/stm32/spi.hpp"
#include "board/stm32/terminal.hpp"
#include "board/stm32/timer.hpp"
#include "board/stm32/usart.hpp"
#include "board/stm32/watchdog.hpp"

namespace dsdpv1::arm {
namespace {

using Offset = std::uint32_t;
using Word = std::uint32_t;

/// Values read: after a reset, after a store of ones, after a store of zeros.
struct Reads {
  const char* name;
  Word reset, ones, zeros;
};

template <class Block>
using Read = std::function<Word(Block&, Offset)>;
template <class Block>
using Write = std::function<void(Block&, Offset, Word)>;

template <class Block>
void expect_registers(const RegisterTable& table, const std::map<Offset, Reads>& expected, const Read<Block>& read,
                      const Write<Block>& write, const Block& fresh = Block()) {
  std::map<Offset, std::string> declared, named;
  for (const RegisterEntry& each : table.registers()) declared[each.offset] = each.name;
  for (const auto& [offset, reads] : expected) {
    named[offset] = reads.name;
    Block ones = fresh, zeros = fresh;
    EXPECT_EQ(read(ones, offset), reads.reset) << reads.name;
    write(ones, offset, 0xFFFF'FFFF);
    EXPECT_EQ(read(ones, offset), reads.ones) << reads.name;
    write(zeros, offset, 0);
    EXPECT_EQ(read(zeros, offset), reads.zeros) << reads.name;
  }
  EXPECT_EQ(declared, named);
  Block block = fresh;
  for (Offset offset = 0; offset < 0x400; offset += 4)
    if (expected.count(offset) == 0) {
      write(block, offset, 0xFFFF'FFFF);
      EXPECT_EQ(read(block, offset), 0U) << offset;
    }
}

/// Masks of the reported fields, and a word that uses none of them.
struct Fields {
  std::map<std::string, Word> masks;
  Word fine = 0;
};

void expect_tags(const RegisterTable& table, const std::map<Offset, Fields>& expected) {
  for (const RegisterEntry& each : table.registers()) {
    const auto found = expected.find(each.offset);
    const Fields fields = found == expected.end() ? Fields() : found->second;
    EXPECT_TRUE(table.asked(each.offset, fields.fine).empty()) << each.name;
    for (unsigned bit = 0; bit < 32; ++bit) {
      std::vector<std::string> wanted, asked;
      for (const auto& [name, mask] : fields.masks)
        if ((mask >> bit & 1U) != 0) wanted.push_back(name);
      for (const Tag* tag : table.asked(each.offset, fields.fine ^ 1U << bit)) asked.emplace_back(tag->name);
      EXPECT_EQ(asked, wanted) << each.name << ", bit " << bit;
    }
    EXPECT_EQ(table.is_plain(each.offset), fields.masks.empty() && each.offset < 0x80) << each.name;
  }
}

TEST(Registers, OfRcc) {
  const Read<Rcc> read = [](Rcc& rcc, Offset offset) { return rcc.read(offset); };
  expect_registers<Rcc>(Rcc::kRegisters,
                        {{0x00, {"CR", 0x0000'0083, 0x030F'00FB, 0}},  // RDY bits follow their ON bits
                         {0x04, {"CFGR", 0, 0x077F'FFF3, 0}},
                         {0x08, {"CIR", 0, 0x1F00, 0}},
                         {0x0C, {"APB2RSTR", 0, 0xFFFD, 0}},
                         {0x10, {"APB1RSTR", 0, 0x3AFE'C83F, 0}},
                         {0x14, {"AHBENR", 0x14, 0x557, 0}},
                         {0x18, {"APB2ENR", 0, 0xFFFD, 0}},
                         {0x1C, {"APB1ENR", 0, 0x3AFE'C83F, 0}},
                         {0x20, {"BDCR", 0, 0x1'8307, 0}},
                         {0x24, {"CSR", 0x0C00'0000, 0x0100'0003, 0x0C00'0000}}},  // RMVF clears the flags
                        read, &Rcc::write);
  expect_tags(
      Rcc::kRegisters,
      {{0x00, {{{"HSITRIM", 0xF8}, {"HSEBYP", 0x4'0000}, {"CSSON", 0x8'0000}}, 0x80}},
       {0x04, {{{"MCO", 0x0700'0000}}}},
       {0x08,
        {{{"LSIRDYIE", 0x100}, {"LSERDYIE", 0x200}, {"HSIRDYIE", 0x400}, {"HSERDYIE", 0x800}, {"PLLRDYIE", 0x1000}}}},
       {0x0C, {{{"AFIORST", 1}, {"IOP[G:A]RST", 0x1FC}, {"USART1RST", 0x4000}}}},
       {0x20, {{{"LSEBYP", 4}, {"BDRST", 0x1'0000}}}}});
}

TEST(Registers, OfGpio) {
  const Read<Gpio> read = [](Gpio& port, Offset offset) { return port.read(offset, 0, 0); };
  expect_registers<Gpio>(Gpio::kRegisters,
                         {{0x00, {"CRL", 0x4444'4444, 0xFFFF'FFFF, 0}},
                          {0x04, {"CRH", 0x4444'4444, 0xFFFF'FFFF, 0}},
                          {0x08, {"IDR", 0, 0, 0}},
                          {0x0C, {"ODR", 0, 0xFFFF, 0}},
                          {0x10, {"BSRR", 0, 0, 0}},
                          {0x14, {"BRR", 0, 0, 0}},
                          {0x18, {"LCKR", 0, 0x1'FFFF, 0}}},
                         read, &Gpio::write);
  expect_tags(Gpio::kRegisters, {{0x18, {{{"LCKK", 0x1'0000}}}}});
}

TEST(Registers, OfExti) {
  const Read<Exti> read = [](Exti& exti, Offset offset) { return exti.read(offset); };
  expect_registers<Exti>(Exti::kRegisters,
                         {{0x00, {"IMR", 0, 0x7'FFFF, 0}},
                          {0x04, {"EMR", 0, 0x7'FFFF, 0}},
                          {0x08, {"RTSR", 0, 0x7'FFFF, 0}},
                          {0x0C, {"FTSR", 0, 0x7'FFFF, 0}},
                          {0x10, {"SWIER", 0, 0x7'FFFF, 0}},
                          {0x14, {"PR", 0, 0, 0}}},
                         read, &Exti::write);
  const Fields masks = {{{"MR[18:16]", 0x7'0000}}}, edges = {{{"TR[18:16]", 0x7'0000}}};
  expect_tags(Exti::kRegisters, {{0x00, masks}, {0x04, masks}, {0x08, edges}, {0x0C, edges}});
}

TEST(Registers, OfAfio) {
  const Read<Exti> read = [](Exti& exti, Offset offset) { return exti.read_afio(offset); };
  expect_registers<Exti>(Exti::kAfioRegisters,
                         {{0x00, {"EVCR", 0, 0xFF, 0}},
                          {0x04, {"MAPR", 0, 0x001F'FFFF, 0}},  // SWJ_CFG is write-only
                          {0x08, {"EXTICR1", 0, 0xFFFF, 0}},
                          {0x0C, {"EXTICR2", 0, 0xFFFF, 0}},
                          {0x10, {"EXTICR3", 0, 0xFFFF, 0}},
                          {0x14, {"EXTICR4", 0, 0xFFFF, 0}},
                          {0x1C, {"MAPR2", 0, 0x400, 0}}},
                         read, &Exti::write_afio);
  expect_tags(Exti::kAfioRegisters, {{0x00, {{{"EVOE", 0x80}}}},
                                     {0x04,
                                      {{{"I2C1_REMAP", 0x2},
                                        {"USART1_REMAP", 0x4},
                                        {"USART3_REMAP", 0x30},
                                        {"TIM1_REMAP", 0xC0},
                                        {"TIM2_REMAP", 0x300},
                                        {"TIM3_REMAP", 0xC00},
                                        {"TIM4_REMAP", 0x1000},
                                        {"CAN_REMAP", 0x6000},
                                        {"PD01_REMAP", 0x8000},
                                        {"TIM5CH4_IREMAP", 0x1'0000},
                                        {"ADC1_ETRGINJ_REMAP", 0x2'0000},
                                        {"ADC1_ETRGREG_REMAP", 0x4'0000},
                                        {"ADC2_ETRGINJ_REMAP", 0x8'0000},
                                        {"ADC2_ETRGREG_REMAP", 0x10'0000}}}}});
}

TEST(Registers, OfFsmc) {
  const Read<Fsmc> read = [](Fsmc& fsmc, Offset offset) { return fsmc.read(offset); };
  std::map<Offset, Reads> expected = {{0x00, {"BCR1", 0x30DB, 0x8'FFFF, 0x80}}};  // bit 7 is reserved and 1
  static constexpr std::array<std::array<const char*, 3>, 4> kNames = {
      {{"BCR1", "BTR1", "BWTR1"}, {"BCR2", "BTR2", "BWTR2"}, {"BCR3", "BTR3", "BWTR3"}, {"BCR4", "BTR4", "BWTR4"}}};
  for (Offset bank = 0; bank < 4; ++bank) {
    if (bank != 0) expected[8 * bank] = {kNames[bank][0], 0x30D2, 0x8'FFFF, 0x80};
    expected[8 * bank + 4] = {kNames[bank][1], 0x0FFF'FFFF, 0x3FFF'FFFF, 0};
    expected[8 * bank + 0x104] = {kNames[bank][2], 0x0FFF'FFFF, 0x3FFF'FFFF, 0x0FF0'0000};
  }
  const auto of_cards = [&expected](Offset at, std::array<const char*, 4> names) {
    expected[at] = {names[0], 0x18, 0xF'FE7E, 0};
    expected[at + 4] = {names[1], 0x40, 0x7F, 0x40};
    expected[at + 8] = {names[2], 0xFCFC'FCFC, 0xFFFF'FFFF, 0};
    expected[at + 12] = {names[3], 0xFCFC'FCFC, 0xFFFF'FFFF, 0};
  };
  of_cards(0x60, {"PCR2", "SR2", "PMEM2", "PATT2"});
  of_cards(0x80, {"PCR3", "SR3", "PMEM3", "PATT3"});
  of_cards(0xA0, {"PCR4", "SR4", "PMEM4", "PATT4"});
  expected[0x74] = {"ECCR2", 0, 0, 0};
  expected[0x94] = {"ECCR3", 0, 0, 0};
  expected[0xB0] = {"PIO4", 0xFCFC'FCFC, 0xFFFF'FFFF, 0};
  expect_registers<Fsmc>(Fsmc::kRegisters, expected, read, &Fsmc::write, Fsmc({}));
  const Fields card = {{{"PBKEN", 0x4}}}, interrupts = {{{"I[F:R]EN", 0x38}}};
  const Fields enable = {{{"MBKEN", 0x1}}}, mode = {{{"ACCMOD", 0x3000'0000}}};
  expect_tags(Fsmc::kRegisters,
              {{0x00, {{{"MTYP", 0xC}, {"BURSTEN", 0x100}, {"ASYNCWAIT", 0x8000}, {"CBURSTRW", 0x8'0000}}}},
               {0x04, mode},
               {0x08, enable},
               {0x10, enable},
               {0x18, enable},
               {0x60, card},
               {0x64, interrupts},
               {0x80, card},
               {0x84, interrupts},
               {0xA0, card},
               {0xA4, interrupts},
               {0x104, mode}});
  // NWAIT is only used in bursts.
  EXPECT_EQ(Fsmc::kRegisters.asked(0x00, 0xDFFF).size(), Fsmc::kRegisters.asked(0x00, 0xFFFF).size() - 1);
  ASSERT_EQ(Fsmc::kRegisters.asked(0x00, 0x2100).size(), 2U);
  EXPECT_STREQ(Fsmc::kRegisters.asked(0x00, 0x2100)[1]->name, "WAITEN");
}

TEST(Registers, OfTimers) {
  const Read<Timer> read = [](Timer& timer, Offset offset) { return timer.read(offset, 0); };
  const Write<Timer> write = [](Timer& timer, Offset offset, Word value) { timer.write(offset, value, 0); };
  const auto plain = [](const char* name) { return Reads{name, 0, 0xFFFF, 0}; };
  expect_registers<Timer>(Timer::kRegisters,
                          {{0x00, {"CR1", 0, 0x3FF, 0}},
                           {0x04, {"CR2", 0, 0xF8, 0}},
                           {0x08, {"SMCR", 0, 0xFFF7, 0}},
                           {0x0C, {"DIER", 0, 0x5F5F, 0}},
                           {0x10, {"SR", 0, 0, 0}},
                           {0x14, {"EGR", 0, 0, 0}},
                           {0x18, plain("CCMR1")},
                           {0x1C, plain("CCMR2")},
                           {0x20, {"CCER", 0, 0x3333, 0}},
                           {0x24, plain("CNT")},
                           {0x28, plain("PSC")},
                           {0x2C, {"ARR", 0xFFFF, 0xFFFF, 0}},
                           {0x34, plain("CCR1")},
                           {0x38, plain("CCR2")},
                           {0x3C, plain("CCR3")},
                           {0x40, plain("CCR4")},
                           {0x48, {"DCR", 0, 0x1F1F, 0}},
                           {0x4C, plain("DMAR")}},
                          read, write);
  expect_tags(Timer::kRegisters, {{0x00, {{{"DIR", 0x10}, {"CMS", 0x60}}}},
                                  {0x04, {{{"MMS", 0x70}, {"TI1S", 0x80}}}},
                                  {0x08, {{{"SMS", 0x7}, {"ECE", 0x4000}}}},
                                  {0x0C, {{{"CC[4:1]IE", 0x1E}, {"TIE", 0x40}, {"DMA", 0x7F00}}}},
                                  {0x14, {{{"CC[4:1]G", 0x1E}, {"TG", 0x40}}}},
                                  {0x20, {{{"CC1E", 0x1}, {"CC2E", 0x10}, {"CC3E", 0x100}, {"CC4E", 0x1000}}}}});
}

TEST(Registers, OfTheWatchdog) {
  const Read<Watchdog> read = [](Watchdog& dog, Offset offset) { return dog.read(offset, 0); };
  const Write<Watchdog> write = [](Watchdog& dog, Offset offset, Word value) { dog.write(offset, value, 0); };
  expect_registers<Watchdog>(Watchdog::kRegisters,
                             {{0x00, {"KR", 0, 0, 0}},
                              {0x04, {"PR", 0, 0, 0}},  // both are closed
                              {0x08, {"RLR", 0xFFF, 0xFFF, 0xFFF}},
                              {0x0C, {"SR", 0, 0, 0}}},
                             read, write, Watchdog(10));
  expect_tags(Watchdog::kRegisters, {});
}

TEST(Registers, OfSpi) {
  const Read<Spi> read = [](Spi& spi, Offset offset) { return spi.peek(offset); };
  const Write<Spi> write = [](Spi& spi, Offset offset, Word value) { spi.write(offset, value, 0); };
  expect_registers<Spi>(Spi::kRegisters,
                        {{0x00, {"CR1", 0, 0xFFFF, 0}},
                         {0x04, {"CR2", 0, 0xE7, 0}},
                         {0x08, {"SR", 0x02, 0x02, 0x02}},
                         {0x0C, {"DR", 0, 0, 0}},  // one for sending, one for receiving
                         {0x10, {"CRCPR", 0x07, 0xFFFF, 0}},
                         {0x14, {"RXCRCR", 0, 0, 0}},
                         {0x18, {"TXCRCR", 0, 0, 0}},
                         {0x1C, {"I2SCFGR", 0, 0xFBF, 0}},
                         {0x20, {"I2SPR", 0x02, 0x3FF, 0}}},
                        read, write);
  constexpr Word kMstrAndSpe = 0x44;
  expect_tags(Spi::kRegisters,
              {{0x00, {{{"MSTR", 0x4}, {"RXONLY", 0x400}, {"CRCEN", 0x2000}, {"BIDIMODE", 0x8000}}, kMstrAndSpe}},
               {0x04, {{{"RXDMAEN", 0x1}, {"TXDMAEN", 0x2}}}},
               {0x1C, {{{"I2SMOD", 0x800}}}}});
  EXPECT_TRUE(Spi::kRegisters.asked(0x00, 0).empty());  // a slave that is switched off
}

const std::map<Offset, Reads> kUsart = {{0x00, {"SR", 0xC0, 0xC0, 0xC0}}, {0x04, {"DR", 0, 0, 0}},
                                        {0x08, {"BRR", 0, 0xFFFF, 0}},    {0x0C, {"CR1", 0, 0x3FFF, 0}},
                                        {0x10, {"CR2", 0, 0x7F6F, 0}},    {0x14, {"CR3", 0, 0x7FF, 0}},
                                        {0x18, {"GTPR", 0, 0xFFFF, 0}}};
const Fields kUsartCr2 = {{{"CLKEN", 0x800}, {"LINEN", 0x4000}}};
const Fields kUsartCr3 = {
    {{"IREN", 0x2}, {"HDSEL", 0x8}, {"SCEN", 0x20}, {"DMAR", 0x40}, {"DMAT", 0x80}, {"CTSE", 0x200}, {"CTSIE", 0x400}}};

TEST(Registers, OfUsart2) {
  const Read<Usart> read = [](Usart& usart, Offset offset) { return usart.peek(offset); };
  const Write<Usart> write = [](Usart& usart, Offset offset, Word value) { usart.write(offset, value, 0); };
  std::map<Offset, Reads> expected = kUsart;
  expected[0x00].zeros = 0x80;  // TC can be cleared so, TXE cannot
  expect_registers<Usart>(Usart::kRegisters, expected, read, write);
  expect_tags(Usart::kRegisters, {{0x0C, {{{"SBK", 0x1}, {"RWU", 0x2}}}}, {0x10, kUsartCr2}, {0x14, kUsartCr3}});
}

TEST(Registers, OfUsart1TheTerminal) {
  const Read<Terminal> read = [](Terminal& terminal, Offset offset) { return terminal.read(offset); };
  expect_registers<Terminal>(Terminal::kRegisters, kUsart, read, &Terminal::write);  // always ready
  expect_tags(Terminal::kRegisters, {{0x0C,
                                      {{{"SBK", 0x1},
                                        {"RE", 0x4},
                                        {"IDLEIE", 0x10},
                                        {"RXNEIE", 0x20},
                                        {"TCIE", 0x40},
                                        {"TXEIE", 0x80},
                                        {"PEIE", 0x100}}}},
                                     {0x10, kUsartCr2},
                                     {0x14, kUsartCr3}});
}

TEST(Registers, OfTheFlashInterface) {
  const Read<FlashInterface> read = [](FlashInterface& flash, Offset offset) { return flash.read(offset); };
  expect_registers<FlashInterface>(FlashInterface::kRegisters,
                                   {{0x00, {"ACR", 0x30, 0x3F, 0}},  // PRFTBS follows PRFTBE
                                    {0x04, {"KEYR", 0, 0, 0}},
                                    {0x08, {"OPTKEYR", 0, 0, 0}},
                                    {0x0C, {"SR", 0, 0, 0}},
                                    {0x10, {"CR", 0x80, 0x80, 0x80}},  // locked
                                    {0x14, {"AR", 0, 0, 0}},
                                    {0x1C, {"OBR", 0x03FF'FFFC, 0x03FF'FFFC, 0x03FF'FFFC}},
                                    {0x20, {"WRPR", 0xFFFF'FFFF, 0xFFFF'FFFF, 0xFFFF'FFFF}}},
                                   read, &FlashInterface::write);
  expect_tags(FlashInterface::kRegisters, {{0x00, {{{"HLFCYA", 0x8}}}},
                                           {0x04, {{{"FKEYR", 0xFFFF'FFFF}}}},
                                           {0x08, {{{"OPTKEYR", 0xFFFF'FFFF}}}},
                                           {0x0C, {{{"PGERR", 0x4}, {"WRPRTERR", 0x10}, {"EOP", 0x20}}}},
                                           {0x10,
                                            {{{"PG", 0x1},
                                              {"PER", 0x2},
                                              {"MER", 0x4},
                                              {"OPTPG", 0x10},
                                              {"OPTER", 0x20},
                                              {"STRT", 0x40},
                                              {"ERRIE", 0x400},
                                              {"EOPIE", 0x1000}}}},
                                           {0x14, {{{"FAR", 0xFFFF'FFFF}}}}});
}

TEST(Registers, FlashInterfaceSaysWaitStatesAndPrefetch) {
  FlashInterface flash;
  EXPECT_EQ(flash.wait_states(), 0U);
  EXPECT_TRUE(flash.prefetch());
  flash.write(0x00, 0x01);
  EXPECT_EQ(flash.wait_states(), 1U);
  EXPECT_FALSE(flash.prefetch());
  flash.write(0x00, 0x12);
  EXPECT_EQ(flash.wait_states(), 2U);
  EXPECT_TRUE(flash.prefetch());
  flash.write(0x00, 0x07);  // reserved
  EXPECT_EQ(flash.wait_states(), 2U);
}

}  // namespace
}  // namespace dsdpv1::arm
