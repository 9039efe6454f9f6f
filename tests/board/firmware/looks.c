/* Waits for pins of the chip in pure polling loops, and prints on USART1 in which cycle it saw them. */
#include <stdint.h>

#define WORD(address) (*(volatile uint32_t*)(address))

enum { kPortC = 0x40011000, kLow = 0x00, kIn = 0x08, kSet = 0x10, kClear = 0x14, kRounds = 60 };

static void say(uint32_t word) {
  for (int digit = 28; digit >= 0; digit -= 4) WORD(0x40013804) = (uint32_t) "0123456789ABCDEF"[word >> digit & 15u];
  WORD(0x40013804) = '\n';
}

static uint32_t now(void) { return WORD(0xE0001004); }

void run(void);
void run(void) {
  static uint32_t seen[3 * kRounds];
  uint32_t count = 0;
  WORD(0x40021018) = 0x41FD;
  WORD(0xE000EDFC) = 1u << 24;                         /* DEMCR.TRCENA */
  WORD(0xE0001000) = 1;                                /* DWT: cycles */
  WORD(0x4001380C) = 0x2008;                           /* USART1_CR1: UE, TE */
  WORD(kPortC + kLow) = 0x11444444;                    /* PC6, PC7 */
  for (uint32_t pulses = 1; pulses <= 400; ++pulses) { /* while the DPRAM is not requested */
    while ((WORD(kPortC + kIn) & 1u << 8) == 0) {
    }
    while ((WORD(kPortC + kIn) & 1u << 8) != 0) {
    }
    for (uint32_t i = 0; i < pulses % 16; ++i) __asm volatile("nop");
    if (pulses % 20 == 0) say(now());
  }
  for (int round = 0; round < kRounds; ++round) {
    while ((WORD(kPortC + kIn) & 1u << 8) == 0) {
    }
    seen[count++] = now(); /* L_REQ rises: the chip accesses the DPRAM */
    while ((WORD(kPortC + kIn) & 1u << 8) != 0) {
    }
    seen[count++] = now();
    WORD(kPortC + kSet) = 1u << 6; /* R_REQ, sometimes while L_REQ is high */
    while ((WORD(kPortC + kIn) & 3u << 8) != 0) {
    }
    seen[count++] = now();
    for (volatile int i = 0; i < round; ++i) {
    }
    WORD(kPortC + kClear) = 1u << 6;
    for (volatile int i = 0; i < round % 7; ++i) {
    }
  }
  for (uint32_t i = 0; i < count; ++i) say(seen[i]);
  for (;;) __asm volatile("wfi");
}

/* Initial stack pointer, reset. */
extern char stack_top[];
__attribute__((section(".vectors"), used)) static const void* const vectors[16] = {
    [0] = stack_top, [1] = (const void*)run};
