/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 */
/* From reset to main: the vector table, RAM, and the handling of unexpected interrupts. */
#include <stdint.h>

#include "examples/firmware/board.h"
#include "examples/firmware/interrupts.h"
#include "examples/firmware/stm32f103.h"

int main(void);

/* Placed by the linker script. */
extern uint32_t __data_in_flash[], __data_begin[], __data_end[], __bss_begin[], __bss_end[], __stack_top[];

static void fill_ram(void) {
  const uint32_t* source = __data_in_flash;
  for (uint32_t* word = __data_begin; word < __data_end; ++word) *word = *source++;
  for (uint32_t* word = __bss_begin; word < __bss_end; ++word) *word = 0;
}

void reset_handler(void) {
  board_start_clocks(); /* filling the RAM takes 0.7 ms at 8 MHz */
  fill_ram();
  (void)main();
  board_halt();
}

/* A fault, or an interrupt that was never enabled: the firmware is broken, the station must not look alive. */
static void unexpected(void) { board_halt(); }

typedef void (*vector)(void);

typedef struct {
  uint32_t* initial_stack;
  vector exceptions[15]; /* 1 to 15 */
  vector interrupts[kIrqCount];
} vector_table;

#ifdef BOARD_SERIAL_INTERRUPTS
#define TIM2_HANDLER tim2_handler
#define TIM3_HANDLER tim3_handler
#else
#define TIM2_HANDLER unexpected
#define TIM3_HANDLER unexpected
#endif

#ifdef BOARD_PARALLEL_ONLY
#define SPI_HANDLER unexpected
#define USART2_HANDLER unexpected
#else
#define SPI_HANDLER spi_handler
#define USART2_HANDLER usart2_handler
#endif

#define FIVE_UNEXPECTED unexpected, unexpected, unexpected, unexpected, unexpected
#define TEN_UNEXPECTED FIVE_UNEXPECTED, FIVE_UNEXPECTED

extern const vector_table vectors;
__attribute__((section(".vectors"), used)) const vector_table vectors = {
    __stack_top,
    {reset_handler, unexpected /* NMI */, unexpected /* HardFault */, unexpected /* MemManage */,
     unexpected /* BusFault */, unexpected /* UsageFault */, 0, 0, 0, 0, unexpected /* SVCall */,
     unexpected /* DebugMonitor */, 0, unexpected /* PendSV */, systick_handler},
    {TEN_UNEXPECTED,    TEN_UNEXPECTED, /* 0 to 19 */
     unexpected,        unexpected,     unexpected,   exti9_5_handler, unexpected,     unexpected,
     unexpected,        unexpected,     TIM2_HANDLER, TIM3_HANDLER,                                /* 20 to 29 */
     FIVE_UNEXPECTED,   SPI_HANDLER,    SPI_HANDLER,  unexpected,      USART2_HANDLER, unexpected, /* 30 to 39 */
     exti15_10_handler, unexpected,     unexpected,   unexpected,      unexpected,     FIVE_UNEXPECTED,
     TEN_UNEXPECTED}, /* 40 to 59 */
};
