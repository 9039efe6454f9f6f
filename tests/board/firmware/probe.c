/* Firmware for the tests of the board: one program for each way in which firmware uses it. The test selects it with
 * the word `program`. Results go to the chip's DPRAM, where the test reads them. */
#include <stdint.h>

#include "../../../board/firmware/mailbox.h"
#include "memory_bus.h"

#define CHIP16(offset) (*(volatile uint16_t*)(0x60000000u + (offset)))
#define BYTE(address) (*(volatile uint8_t*)(address))

enum { TIM_CR1 = 0x00, TIM_DIER = 0x0C, TIM_SR = 0x10, TIM_EGR = 0x14, TIM_CNT = 0x24, TIM_PSC = 0x28, TIM_ARR = 0x2C };
enum {
  AFIO_MAPR = 0x40010004,
  AFIO_EXTICR2 = 0x4001000C,
  EXTI_IMR = 0x40010400,
  EXTI_RTSR = 0x40010408,
  EXTI_FTSR = 0x4001040C,
  EXTI_PR = 0x40010414,
  GPIOA_CRL = 0x40010800,
  GPIOA_IDR = 0x40010808,
  GPIOA_ODR = 0x4001080C,
  GPIOB_ODR = 0x40010C0C,
  GPIOB_LCKR = 0x40010C18,
  GPIOC_CRH = 0x40011004,
  GPIOC_IDR = 0x40011008,
  GPIOC_ODR = 0x4001100C,
  GPIOC_BSRR = 0x40011010,
  GPIOC_BRR = 0x40011014,
  GPIOE_IDR = 0x40011808,
  GPIOE_BSRR = 0x40011810,
  GPIOG_IDR = 0x40012008,
  SPI1_CR1 = 0x40013000,
  SPI1_CR2 = 0x40013004,
  SPI1_SR = 0x40013008,
  SPI1_DR = 0x4001300C,
  SPI2_CR1 = 0x40003800,
  USART1_SR = 0x40013800,
  USART1_DR = 0x40013804,
  USART1_CR1 = 0x4001380C,
  USART2_CR3 = 0x40004414,
  TIM2 = 0x40000000,
  TIM6_CNT = 0x40001024,
  IWDG_KR = 0x40003000,
  IWDG_PR = 0x40003004,
  IWDG_RLR = 0x40003008,
  IWDG_SR = 0x4000300C,
  RCC_APB1RSTR = 0x40021010,
  RCC_CSR = 0x40021024,
  RCC_CR = 0x40021000,
  RCC_CFGR = 0x40021004,
  RCC_AHBENR = 0x40021014,
  RCC_APB2ENR = 0x40021018,
  RCC_APB1ENR = 0x4002101C,
  RCC_AHBRSTR = 0x40021028, /* not in this family */
  FLASH_ACR = 0x40022000
};
#define FSMC_BTR1 0xA0000004u
#define FSMC_BWTR1 0xA0000104u
#define NVIC_ISER0 0xE000E100u
#define SYST_CSR 0xE000E010u
#define SYST_RVR 0xE000E014u
#define SYST_CVR 0xE000E018u
#define ICSR 0xE000ED04u

enum { IRQ_STORM = 27, ASKS = 31 }; /* their numbers in programs */
const volatile uint32_t program __attribute__((used)) = 0;
static volatile uint32_t edges;

static void clocks(void) {
  REG(RCC_APB2ENR) = 0x41FD;
  REG(RCC_AHBENR) |= 1u << 8;
}

static void handshake(void) {
  REG(GPIOC_BSRR) = 1u << 6;
  CHIP(0) = (uint8_t)(REG(GPIOC_IDR) >> 8);
  REG(GPIOC_BSRR) = 1u << 7;
  REG(GPIOC_ODR) = 0;
  REG(GPIOC_BSRR) = 1u << 6 | 1u << 7;
  REG(GPIOC_BRR) = 1u << 7;
  REG(GPIOC_BSRR) = 1u << 22;
}

static void accesses(void) {
  REG(FSMC_BTR1) = 3u | 7u << 8;
  CHIP(0x123) = CHIP(0x456);
  REG(FSMC_BCR1) = 0x5001; /* EXTMOD: mode A, writes by BWTR */
  REG(FSMC_BWTR1) = 1u | 2u << 8;
  CHIP16(0x10) = CHIP16(0x7FE);
}

/* Reads with time to see NWAIT, writes without; then the other way round, while it is low. */
static void nwait(void) {
  REG(FSMC_BTR1) = 1u | 4u << 8;
  REG(FSMC_BWTR1) = 1u | 3u << 8;
  REG(FSMC_BCR1) = 0xD281; /* ASYNCWAIT, EXTMOD, WAITPOL */
  CHIP(1) = CHIP(2);
  REG(FSMC_BTR1) = 1u | 3u << 8;
  REG(FSMC_BWTR1) = 1u | 4u << 8;
  REG(FSMC_BCR1) = 0xD081;
  CHIP(3) = CHIP(4);
}

static void unset_accesses(void) { CHIP(1) = CHIP(2); }

static void wait_for_edges(void) {
  REG(AFIO_EXTICR2) = 6u << 8; /* line 6: port G */
  REG(EXTI_FTSR) = 1u << 6;
  REG(EXTI_IMR) = 1u << 6;
  REG(NVIC_ISER0) = 1u << 23;
}
static void busy(void) {
  wait_for_edges();
  for (;;) {
  }
}
/* Looks at the wrong half of IDR, at the right one, then until the handler of INTR0 raises R_STA. */
static void asks(void) {
  REG(GPIOC_BSRR) = 1u << 6;
  (void)*(volatile uint8_t*)GPIOC_IDR;
  REG(GPIOC_BSRR) = 1u << 7;
  REG(GPIOC_BRR) = 1u << 7;
  (void)*(volatile uint8_t*)(GPIOC_IDR + 1u);
  REG(GPIOC_BSRR) = 1u << 7;
  REG(GPIOC_BRR) = 1u << 7;
  wait_for_edges();
  while ((REG(GPIOC_IDR) & 3u << 8) != 0) {
  }
}

static void interrupt(void) {
  wait_for_edges();
  for (;;) {
    __asm volatile("wfi");
    CHIP(0) = (uint8_t)edges;
  }
}

static void chip_reset(void) {
  REG(GPIOE_CRL) = 0xB4414444;
  REG(GPIOE_BSRR) = 1u << 20;
  for (volatile int i = 0; i < 100; ++i) {
  }
  REG(GPIOE_BSRR) = 1u << 4;
  CHIP(0) = 1;
}

static void text(void) {
  static const char words[] = "ready\r\nhalf a li";
  REG(RCC_CR) |= 0x01010001; /* HSI, HSE, PLL on */
  REG(RCC_CFGR) = 2;
  CHIP(0) = (REG(RCC_CR) & 0x02020002u) == 0x02020002u && (REG(RCC_CFGR) & 0xCu) == 0x8u;
  REG(USART1_CR1) = 0x2008;
  for (const char* c = words; *c; ++c) {
    while (!(REG(USART1_SR) & 0x80)) {
    }
    REG(USART1_DR) = (uint32_t)*c;
  }
}

static void strange(void) {
  REG(TIM6_CNT) = 77;
  CHIP(0) = (uint8_t)REG(TIM6_CNT);
  CHIP(1) = (uint8_t)REG(TIM6_CNT + 4);
  REG(RCC_APB2ENR) = 0;
  REG(GPIOB_ODR) = 1;
  REG(RCC_APB2ENR) = 0x41FD;
  CHIP(2) = (uint8_t)REG(GPIOB_ODR);
}

static void undefined(void) { __asm volatile("udf #0"); }

static void bank_off(void) {
  REG(FSMC_BCR1) = 0;
  CHIP(0) = 1;
}

static void masked_and_rising(void) {
  REG(AFIO_EXTICR2) = 6u << 8;
  REG(EXTI_RTSR) = 1u << 6; /* IMR stays 0 */
  while (!REG(EXTI_PR)) {
  }
  CHIP(0) = (uint8_t)(REG(GPIOG_IDR) >> 6 & 1u);
  REG(EXTI_PR) = 1u << 6;
  CHIP(1) = (uint8_t)REG(EXTI_PR);
}

/* PA0 pulled up, PA1 pulled down, PA2 floating, PA3 analog; PA4 to PA7 the same, with switches against each of them. */
static void inputs(void) {
  REG(GPIOA_CRL) = 0x04880488;
  REG(GPIOA_ODR) = 0x11;
  CHIP(0) = (uint8_t)REG(GPIOA_IDR);
  CHIP(1) = (uint8_t)(REG(GPIOG_IDR) >> 12 & 7u);
  CHIP(2) = (uint8_t)REG(GPIOE_IDR);
}

/* Ten accesses at each clock: HSI, crystal, PLL from half of the HSI times 16, PLL from the crystal times 9, half of
 * it. */
__attribute__((noinline)) static void ten_accesses(void) {
  for (int i = 0; i < 10; ++i) CHIP(0) = (uint8_t)i;
}
static void clock_tree(void) {
  ten_accesses();
  REG(RCC_CFGR) = 1; /* not on: nothing changes */
  CHIP(1) = (uint8_t)(REG(RCC_CFGR) & 0xCu);
  REG(RCC_CR) |= 0x01010000;
  REG(RCC_CFGR) = 14u << 18 | 2u;
  ten_accesses();
  REG(RCC_CFGR) = 7u << 18 | 1u << 16 | 2u;
  ten_accesses();
  REG(RCC_CFGR) = 7u << 18 | 1u << 16 | 8u << 4 | 2u;
  ten_accesses();
  REG(0x40022000) = 2; /* FLASH_ACR: two wait states, no prefetch */
  ten_accesses();
}

/* Flash waits for SYSCLK, which the AHB divider leaves at 72 MHz. */
static void divided(void) {
  REG(RCC_CR) |= 0x01010000;
  REG(0x40022000) = 0x11; /* FLASH_ACR: one wait state */
  REG(RCC_CFGR) = 7u << 18 | 1u << 16 | 8u << 4 | 2u;
}

/* After a reset by AIRCR, which RAM survives, the terminal is off. */
static void restarted(void) {
  volatile uint32_t* const been_here = (volatile uint32_t*)0x20008000u;
  if (*been_here == 0x5AFE) {
    CHIP(0) = (uint8_t)(REG(USART1_CR1) >> 8);
    return;
  }
  *been_here = 0x5AFE;
  REG(USART1_CR1) = 0x2008;
  REG(0xE000ED0C) = 0x05FA0004;
}

static void serial_clocks(void) {
  REG(RCC_APB2ENR) = 0x51FD;
  REG(RCC_APB1ENR) = 1u << 14 | 1u << 17;
}

/* Features that the board does not have, one per line; using the last is reported. */
static void lacking(void) {
  serial_clocks();
  REG(AFIO_MAPR) = 1u << 2 | 1u; /* USART1_REMAP; the board follows SPI1_REMAP */
  REG(EXTI_IMR) = 1u << 17 | 1u << 3;
  REG(GPIOB_LCKR) = 1u << 16;
  REG(SPI1_CR2) = 1u << 1; /* TXDMAEN */
  REG(SPI1_CR2) = 3u;      /* RXDMAEN, too */
  REG(SPI2_CR1) = 1u << 6; /* a slave */
  REG(USART1_CR1) = 0x200C;
  REG(USART2_CR3) = 1u << 9;
  REG(RCC_CR) &= ~(1u << 7); /* HSITRIM */
  REG(RCC_AHBRSTR) = REG(RCC_AHBRSTR) + 1u;
  REG(FLASH_ACR) = 1u << 3;
  REG(FSMC_BCR1) = 0x1085; /* MTYP */
  CHIP16(0) = __LINE__;
}

/* Reads all words of all peripherals, with a received byte in SPI1. The test reads them before. */
__attribute__((noinline, used)) static void all_registers(void) {
  static const uint32_t bases[] = {0x40010000, 0x40010400, 0x40010800, 0x40010C00, 0x40011000, 0x40011400,
                                   0x40011800, 0x40011C00, 0x40012000, 0x40013000, 0x40003800, 0x40004400,
                                   0x40013800, 0x40021000, 0x40022000, 0xA0000000, 0xA0000100};
  for (unsigned i = 0; i < sizeof bases / sizeof *bases; ++i)
    for (uint32_t offset = 0; offset < 0x40; offset += 4) {
      const uint32_t word = REG(bases[i] + offset);
      CHIP16(0) = (uint16_t)word;
      CHIP16(2) = (uint16_t)(word >> 16);
    }
}
static void registers(void) {
  serial_clocks();
  REG(SPI1_CR1) = 0x0344; /* SSM, SSI, SPE, MSTR */
  REG(SPI1_DR) = 0x5A;
  while (!(REG(SPI1_SR) & 1u)) {
  }
  all_registers();
}

/* Reads each with all clocks except its own. */
static void clocks_off(void) {
  static const uint32_t uses[][3] = {
      {RCC_APB2ENR, 0, 0x40010000},  {RCC_APB2ENR, 2, 0x40010800},  {RCC_APB2ENR, 3, 0x40010C00},
      {RCC_APB2ENR, 4, 0x40011000},  {RCC_APB2ENR, 5, 0x40011400},  {RCC_APB2ENR, 6, 0x40011800},
      {RCC_APB2ENR, 7, 0x40011C00},  {RCC_APB2ENR, 8, 0x40012000},  {RCC_APB2ENR, 12, 0x40013000},
      {RCC_APB2ENR, 14, 0x40013800}, {RCC_APB1ENR, 14, 0x40003800}, {RCC_APB1ENR, 17, 0x40004400},
      {RCC_AHBENR, 8, EXTI_PR},      {RCC_AHBENR, 8, FSMC_BTR1},    {RCC_AHBENR, 8, 0x60000000}};
  for (unsigned i = 0; i < sizeof uses / sizeof *uses; ++i) {
    serial_clocks();
    REG(RCC_AHBENR) = 0x114;
    REG(uses[i][0]) &= ~(1u << uses[i][1]);
    const uint32_t word = REG(uses[i][2]);
    REG(RCC_AHBENR) = 0x114;
    CHIP(i) = (uint8_t)(word >> 24);
  }
}

/* The bus of 16 bits: bytes at an even and an odd address, a word. */
static void wide_bus(void) {
  REG(FSMC_BCR1) = 0x1091;
  CHIP(0x20) = CHIP(0x46);
  CHIP(0x21) = CHIP(0x47);
  *(volatile uint32_t*)0x60000030u = *(volatile uint32_t*)0x60000050u;
}

/* As after a reset, but with WREN. */
static void multiplexed(void) {
  REG(FSMC_BCR1) = 0x10CB;
  CHIP(0x20) = CHIP(0x46);
}

/* A1 and D3 float, then NOE, then NE1. */
static void floating_bus(void) {
  REG(0x40011C00) = 0x44BBBB4B;
  REG(GPIOD_CRL) = 0xB4BB444B;
  CHIP(0x25) = CHIP(0x4E);
  REG(GPIOD_CRL) = 0xB4B444BB;
  CHIP(0x25) = CHIP(0x4E);
  REG(GPIOD_CRL) = 0x44BB44BB;
  CHIP(0x25) = 1;
}

/* R_REQ as an alternate function, then open drain; RESET as an input; the lines of the chip as outputs. */
static void wrong_pins(void) {
  REG(GPIOC_CRL) = 0x3B444444;
  REG(GPIOC_BSRR) = 1u << 6; /* the first level, for an output to come */
  REG(GPIOC_BRR) = 1u << 6;
  REG(GPIOC_CRL) = 0x37444444;
  REG(GPIOC_BSRR) = 1u << 6;
  REG(GPIOC_BRR) = 1u << 6;
  REG(GPIOE_BSRR) = 1u << 20;
  REG(GPIOE_BSRR) = 1u << 4;
  REG(GPIOC_CRH) = 0x44444433;
  REG(GPIOG_CRL) = 0x4344444B;
}

/* Between the peripherals, one on the bus behind them, in a bank of the FSMC that the board lacks. */
static void outside(void) {
  REG(0x40014C00) = 1;
  CHIP(0) = (uint8_t)REG(0x40014C00);
  (void)REG(0x1FFFF7E8); /* unique device ID */
  (void)REG(0xE0042000); /* DBGMCU_IDCODE */
  (void)REG(0x50000000);
}
static void bank_2(void) { (void)REG(0x70000000); }

/* A hundred microseconds at 72 MHz, once. */
static void start_timer(void) {
  REG(RCC_APB1ENR) = 1;
  REG(RCC_APB1RSTR) = 1;
  REG(RCC_APB1RSTR) = 0;
  REG(TIM2 + TIM_PSC) = 71;
  REG(TIM2 + TIM_ARR) = 99;
  REG(TIM2 + TIM_EGR) = 1;
  CHIP(0) = (uint8_t)REG(TIM2 + TIM_SR);
  REG(TIM2 + TIM_SR) = 0;
  REG(TIM2 + TIM_DIER) = 1;
  REG(NVIC_ISER0) = 1u << 28;
  CHIP(1) = 1;
  REG(TIM2 + TIM_CR1) = 9; /* OPM, CEN */
}
static void timer(void) {
  start_timer();
  __asm volatile("wfi");
  CHIP(3) = (uint8_t)REG(TIM2 + TIM_CR1);
}
static void timer_while_busy(void) {
  start_timer();
  while (edges == 0) {
  }
  CHIP(3) = (uint8_t)REG(TIM2 + TIM_CR1);
}
static void irq_storm(void) { timer(); }

/* Once: RAM survives a reset. */
static void start_watchdog(void) {
  volatile uint32_t* const been_here = (volatile uint32_t*)0x20008000u;
  if (*been_here == 0x5AFE) {
    CHIP(0) = (uint8_t)(REG(RCC_CSR) >> 24);
    for (;;) __asm volatile("wfi");
  }
  *been_here = 0x5AFE;
  REG(IWDG_RLR) = 1; /* closed */
  CHIP(1) = (uint8_t)REG(IWDG_RLR);
  REG(IWDG_KR) = 0x5555;
  REG(IWDG_PR) = 0;
  REG(IWDG_RLR) = 3;
  CHIP(2) = (uint8_t)REG(IWDG_SR);
  REG(IWDG_KR) = 0xAAAA;
  REG(IWDG_KR) = 0xCCCC;
  for (volatile int i = 0; i < 2000; ++i) {
  }
  REG(IWDG_KR) = 0xAAAA;
}
static void watchdog(void) {
  start_watchdog();
  for (;;) {
  }
}
static void watchdog_asleep(void) {
  start_watchdog();
  for (;;) __asm volatile("wfi");
}

static void stuck(void) {
  CHIP(0) = 1;
  for (;;) {
  }
}

/* Awake each 10 ms by SysTick, which stays pending, without an access to the board. */
static void sleeps(void) {
  CHIP(0) = 1;
  __asm volatile("cpsid i");
  REG(SYST_RVR) = 719999;
  REG(SYST_CVR) = 0;
  REG(SYST_CSR) = 7;
  for (;;) {
    __asm volatile("wfi");
    REG(ICSR) = 1u << 25;
  }
}

/* Bytes of a register whose others stay. */
static void byte_stores(void) {
  REG(GPIOB_ODR) = 0xA55A;
  BYTE(GPIOB_ODR) = 0x11;
  CHIP16(0) = (uint16_t)REG(GPIOB_ODR);
  BYTE(GPIOB_ODR + 1u) = 0x22;
  CHIP16(2) = (uint16_t)REG(GPIOB_ODR);
}

/* R_STA is an output, then an input that floats. */
static void floats(void) {
  REG(GPIOC_BSRR) = 1u << 7;
  REG(GPIOC_CRL) = 0x43444444;
}

/* A pointer to a function that has no Thumb bit. */
static void call_astray(void) {
  void (*volatile nowhere)(void) = (void (*)(void))0x08000000u;
  nowhere();
  CHIP(0) = 1;
}

/* The test has told the board that the mailbox is here. */
static void nonsense(void) {
  volatile dsdpv1_mailbox* box = (volatile dsdpv1_mailbox*)0x20008000u;
  box->report.errors[0].error = 200;
  box->report.error_count = 1;
  for (;;) {
  }
}

/* A fault ends the run before this: it must never be seen at the pins. */
void HardFault_handler(void);
void HardFault_handler(void) {
  CHIP(0) = 0xEE;
  for (;;) {
  }
}

void EXTI9_5_handler(void);
void EXTI9_5_handler(void) {
  CHIP(0x7FF) = 0;
  ++edges;
  REG(EXTI_PR) = 1u << 6;
  if (program == ASKS) REG(GPIOC_BSRR) = 1u << 7;
}

void TIM2_handler(void);
void TIM2_handler(void) {
  CHIP(2) = (uint8_t)REG(TIM2 + TIM_SR);
  ++edges;
  if (program != IRQ_STORM) REG(TIM2 + TIM_SR) = ~1u;
}

void run(void);
void run(void) {
  static void (*const programs[])(void) = {handshake,
                                           accesses,
                                           unset_accesses,
                                           interrupt,
                                           chip_reset,
                                           text,
                                           strange,
                                           undefined,
                                           bank_off,
                                           masked_and_rising,
                                           inputs,
                                           clock_tree,
                                           nonsense,
                                           lacking,
                                           registers,
                                           clocks_off,
                                           busy,
                                           divided,
                                           restarted,
                                           wide_bus,
                                           multiplexed,
                                           floating_bus,
                                           wrong_pins,
                                           outside,
                                           bank_2,
                                           timer,
                                           timer_while_busy,
                                           irq_storm,
                                           watchdog,
                                           watchdog_asleep,
                                           stuck,
                                           asks,
                                           call_astray,
                                           sleeps,
                                           byte_stores,
                                           floats,
                                           nwait};
  edges = 0;
  clocks();
  memory_bus();
  programs[program]();
  for (;;) __asm volatile("wfi");
}

/* Initial stack pointer, reset, HardFault and IRQs 23, 28 (ARMv7-M B1.5.3). */
extern char stack_top[];
__attribute__((section(".vectors"), used)) static const void* const vectors[16 + 29] = {
    [0] = stack_top,
    [1] = (const void*)run,
    [3] = (const void*)HardFault_handler,
    [16 + 23] = (const void*)EXTI9_5_handler,
    [16 + 28] = (const void*)TIM2_handler};
