/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 */
/* Clocks, pins, RESET at PE4, INTR0 at PG6, vectors. */
#include "faults.h"
#include "port.h"

enum { kMHz = 72 };
#define CYCCNT 0xE0001004u
#define EXTI 0x40010400u

uint32_t now(void) { return WORD(CYCCNT); }

void pause_us(uint32_t us) {
  const uint32_t since = now();
  while (now() - since < us * kMHz) {
  }
}

void start_clocks(void) {
  WORD(0x40021000u) |= 1u << 16; /* HSE */
  while ((WORD(0x40021000u) & 1u << 17) == 0u) {
  }
  if (!HAS(NO_WAIT_STATES)) WORD(0x40022000u) = 0x12;
  WORD(0x40021004u) = 7u << 18 | 1u << 16 | 4u << 8; /* PLL: 9 x HSE; APB1 half of it */
  WORD(0x40021000u) |= 1u << 24;
  while ((WORD(0x40021000u) & 1u << 25) == 0u) {
  }
  /* TELLS(NO_WAIT_STATES) */
  WORD(0x40021004u) |= 2u;
  while ((WORD(0x40021004u) & 0xCu) != 0x8u) {
  }
  WORD(0xE000EDFCu) |= 1u << 24; /* TRCENA */
  WORD(CYCCNT - 4u) |= 1u;
}

void start_ports(void) { WORD(0x40021018u) |= HAS(GPIO_UNCLOCKED) ? 0x1E9u : 0x1FDu; }

/* RESET at PE4: low for 100 us. */
void reset_chip(void) {
  WORD(0x40011814u) = 1u << 4;
  if (!HAS(RESET_UNDRIVEN)) WORD(0x40011800u) = (WORD(0x40011800u) & 0xFFF0FFFFu) | 0x30000u;
  port_start();
  if (!HAS(RESET_SHORT)) pause_us(100);
  if (HAS(RESET_SHORT)) { /* again, after the start-up of the chip */
    WORD(0x40011810u) = 1u << 4;
    pause_us(200);
    WORD(0x40011814u) = 1u << 4;
  }
  /* TELLS(RESET_UNDRIVEN) */
  WORD(0x40011810u) = 1u << 4;
}

volatile int intr0_fell;

/* INTR0 at PG6: EXTI line 6, IRQ 23. */
void start_intr0(void) {
  WORD(0x40012010u) = 1u << 6; /* pull-up */
  WORD(0x40012000u) = (WORD(0x40012000u) & 0xF0FFFFFFu) | 0x08000000u;
  WORD(0x4001000Cu) = (WORD(0x4001000Cu) & 0xFFFFF0FFu) | 6u << 8;
  if (!HAS(EDGE_UNSET)) WORD(EXTI + 0x0Cu) |= 1u << 6;
  WORD(EXTI) |= 1u << 6;
  if (!HAS(INTR0_BY_LEVEL) && !HAS(INTR0_IGNORED)) WORD(0xE000E100u) = 1u << 23;
}

void intr0_handler(void);
void intr0_handler(void) {
  /* TELLS(UNACKNOWLEDGED) */
  if (!HAS(UNACKNOWLEDGED)) WORD(EXTI + 0x14u) = 1u << 6;
  intr0_fell = 1; /* INTR0 may have fallen before it was enabled */
}

void look_at_level(void) {
  if ((WORD(0x40012008u) & 1u << 6) == 0u) intr0_fell = 1;
}

static void stop(void) {
  for (;;) {
  }
}

extern char stack_top[];
__attribute__((section(".vectors"), used)) static const void* const vectors[16 + 60] = {
    [0] = stack_top,         [1] = (const void*)run,  [2] = (const void*)stop, [3] = (const void*)stop,
    [4] = (const void*)stop, [5] = (const void*)stop, [6] = (const void*)stop, [16 + 23] = (const void*)intr0_handler};
