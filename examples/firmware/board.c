/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 */
/* Clocks, pins, memory bus, time and interrupts of the evaluation board. */
#include "examples/firmware/board.h"

#include <stddef.h>

#include "examples/firmware/console.h"
#include "examples/firmware/interrupts.h"
#include "examples/firmware/stm32f103.h"

enum {
  kKeyPin = 0,     /* port A */
  kSerialTxPin = 9 /* port A */
};

/* Pins of the chip's interrupt, whose pin is the number of its EXTI line, and of its RESET. */
typedef struct card_pins {
  gpio_registers* intr0_port;
  uint32_t exti_port;
  unsigned intr0, irq, reset; /* RESET: port E */
} card_pins;

/* 4 bits of priority, in the high nibble; a lower number goes first. Timekeeping continues while INTR0 is served. */
enum { kPrioritySysTick = 0x00, kPrioritySerial = 0x20, kPriorityIntr0 = 0x40 };

/* ----------------------------------------------------------------------------------------------------------- clocks */

static void wait_for(const reg32* address, uint32_t mask, uint32_t value) {
  while ((*address & mask) != value) {
  }
}

/* 8 MHz x 9 = 72 MHz; APB1 allows at most 36 MHz. Waits for the crystal, without which no timing is right. */
void board_start_clocks(void) {
  RCC->CR |= RCC_CR_HSEON;
  wait_for(&RCC->CR, RCC_CR_HSERDY, RCC_CR_HSERDY);
  FLASH_ACR = FLASH_ACR_PRFTBE | FLASH_ACR_LATENCY_2;
  RCC->CFGR = RCC_CFGR_PLLSRC_HSE | RCC_CFGR_PLLMUL9 | RCC_CFGR_PPRE1_DIV2;
  RCC->CR |= RCC_CR_PLLON;
  wait_for(&RCC->CR, RCC_CR_PLLRDY, RCC_CR_PLLRDY);
  RCC->CFGR |= RCC_CFGR_SW_PLL;
  wait_for(&RCC->CFGR, RCC_CFGR_SWS, RCC_CFGR_SWS_PLL);
}

static void start_peripherals(void) {
  RCC->AHBENR = RCC_AHBENR_SRAMEN | RCC_AHBENR_FLITFEN | RCC_AHBENR_FSMCEN;
  RCC->APB2ENR = RCC_APB2ENR_AFIOEN | RCC_APB2ENR_IOPAEN | RCC_APB2ENR_IOPBEN | RCC_APB2ENR_IOPCEN |
                 RCC_APB2ENR_IOPDEN | RCC_APB2ENR_IOPEEN | RCC_APB2ENR_IOPFEN | RCC_APB2ENR_IOPGEN |
                 RCC_APB2ENR_SPI1EN | RCC_APB2ENR_USART1EN;
  RCC->APB1ENR = RCC_APB1ENR_SPI2EN | RCC_APB1ENR_USART2EN;
}

/* ------------------------------------------------------------------------------------------------------------- pins */

void board_pin(gpio_registers* port, unsigned pin, uint32_t function) {
  reg32* half = pin < 8u ? &port->CRL : &port->CRH;
  const unsigned shift = 4u * (pin % 8u);
  *half = (*half & ~(0xFu << shift)) | function << shift;
}

static void configure_all(gpio_registers* port, uint32_t pins, uint32_t function) {
  for (unsigned pin = 0; pin < 16u; ++pin)
    if ((pins >> pin & 1u) != 0u) board_pin(port, pin, function);
}

/* The lines of the chip: card(), its reset, kBtr and kBcr of the memory bus. */
#ifdef BOARD_WIRING
#include BOARD_WIRING
#else
#include "examples/firmware/dsdpv1_wiring.h"
#endif

static void configure_memory_bus(void) {
  configure_all(GPIOD, 0xC0B3u, GPIO_ALTERNATE_50MHZ); /* D2 D3 NOE NWE NE1 D0 D1 */
  configure_all(GPIOE, 0x0780u, GPIO_ALTERNATE_50MHZ); /* D4..D7 */
  configure_all(GPIOF, 0xF03Fu, GPIO_ALTERNATE_50MHZ); /* A0..A9 */
  configure_all(GPIOG, 0x0001u, GPIO_ALTERNATE_50MHZ); /* A10 */
}

static void start_memory_bus(void) {
  configure_memory_bus();
  FSMC_BANK1->NE[0].BTR = kBtr;
  FSMC_BANK1->NE[0].BCR = kBcr;
}

bool board_key(void) { return (GPIOA->IDR >> kKeyPin & 1u) != 0u; }

void board_release_chip(void) { release_reset(); }

void board_halt(void) {
  (void)board_lock();
  hold_reset();
  for (;;) {
  }
}

/* ------------------------------------------------------------------------------------------------------------- time */

/* CYCCNT overflows after a minute; SysTick reads it at least every millisecond. */
enum { kTick = 1000u * BOARD_HCLK_MHZ };

static volatile uint32_t overflows, last_count;

/* The next tick comes after so many cycles, later ones every millisecond again. */
static void tick_in(uint32_t cycles) {
  SYST->LOAD = cycles - 1u;
  SYST->VAL = 0;
  board_barrier();
  SYST->LOAD = kTick - 1u;
}

static void start_time(void) {
  DEMCR |= DEMCR_TRCENA;
  DWT->CYCCNT = 0;
  DWT->CTRL |= DWT_CTRL_CYCCNTENA;
  SCB->SHPR[SCB_SHPR_SYSTICK] = kPrioritySysTick;
  DBGMCU_CR |= DBGMCU_CR_DBG_SLEEP;
  tick_in(kTick);
  SYST->CTRL = SYST_CTRL_CLKSOURCE | SYST_CTRL_TICKINT | SYST_CTRL_ENABLE;
}

uint64_t board_now(void) {
  const uint32_t before = board_lock();
  const uint32_t count = DWT->CYCCNT;
  if (count < last_count) ++overflows;
  last_count = count;
  const uint64_t now = (uint64_t)overflows << 32 | count;
  board_unlock(before);
  return now;
}

void systick_handler(void) { (void)board_now(); }

uint64_t board_cycles(uint64_t ns) { return (ns * BOARD_HCLK_MHZ + 999u) / 1000u; }

void board_wait(uint64_t cycles) {
  const uint64_t end = board_now() + cycles;
  while (board_now() < end) board_sleep(end);
}

/* WFE, not WFI: it keeps the event of an interrupt between the caller's test and the sleep. */
void board_sleep(uint64_t until) {
  enum { kWorthwhile = 200 }; /* below it setting up the tick takes longer */
  const uint64_t now = board_now();
  if (until > now + kWorthwhile) {
    tick_in(until - now < kTick ? (uint32_t)(until - now) : kTick);
    __asm__ volatile("wfe" ::: "memory");
  }
}

/* ------------------------------------------------------------------------------------------------------- interrupts */

static void (*intr0_handler)(void);

/* Falling edges count: an INTR0 is low for only 1.3 us (P7). */
static void configure_intr0(void) {
  const card_pins* pins = card();
  const unsigned shift = 4u * (pins->intr0 % 4u);
  reg32* selection = &AFIO->EXTICR[pins->intr0 / 4u];
  pins->intr0_port->BSRR = 1u << pins->intr0; /* pull-up */
  board_pin(pins->intr0_port, pins->intr0, GPIO_INPUT_PULL);
  *selection = (*selection & ~(0xFu << shift)) | pins->exti_port << shift;
  EXTI->RTSR &= ~(1u << pins->intr0);
  EXTI->FTSR |= 1u << pins->intr0;
  NVIC->IPR[pins->irq] = kPriorityIntr0;
}

void board_enable_intr0(bool enabled) {
  const unsigned irq = card()->irq;
  if (enabled) {
    NVIC->ISER[irq / 32u] = 1u << irq % 32u;
  } else {
    NVIC->ICER[irq / 32u] = 1u << irq % 32u;
    board_barrier();
    __asm__ volatile("isb" ::: "memory"); /* no handler begins after this */
  }
}

void board_on_intr0(void (*handler)(void)) {
  const unsigned irq = card()->irq;
  intr0_handler = handler;
  EXTI->IMR |= 1u << card()->intr0;
  EXTI->PR = 1u << card()->intr0;
  NVIC->ICPR[irq / 32u] = 1u << irq % 32u;
  board_enable_intr0(true);
}

/* Clear the flag before the work: a second INTR0 meanwhile makes the handler run again. */
static void serve_intr0(void) {
  EXTI->PR = 1u << card()->intr0;
  board_barrier();
  if (intr0_handler != NULL) intr0_handler();
}

void exti9_5_handler(void) { serve_intr0(); }
void exti15_10_handler(void) { serve_intr0(); }

void board_enable_serial(unsigned irq) {
  NVIC->IPR[irq] = kPrioritySerial;
  NVIC->ISER[irq / 32u] = 1u << irq % 32u;
}

uint32_t board_lock(void) {
  uint32_t before; /* set by the instruction */
  __asm__ volatile("mrs %0, primask\n\tcpsid i" : "=r"(before)::"memory");
  return before;
}

void board_unlock(uint32_t before) { __asm__ volatile("msr primask, %0" ::"r"(before) : "memory"); }

/* ------------------------------------------------------------------------------------------------------------ start */

void board_start(void) {
  SCB->CCR |= SCB_CCR_DIV_0_TRP;
  start_peripherals();
  configure_wiring();
  configure_intr0();
  start_memory_bus();
  start_time();
  board_pin(GPIOA, kKeyPin, GPIO_INPUT_PULL); /* down */
  board_pin(GPIOA, kSerialTxPin, GPIO_ALTERNATE_50MHZ);
  console_start();
}
