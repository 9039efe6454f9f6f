/* Firmware that a real board would not forgive, in four stores: port B has no clock. It does nothing else. */
#include <stdint.h>

#define WORD(address) (*(volatile uint32_t*)(address))

void run(void);
void run(void) {
  for (int i = 0; i < 4; ++i) WORD(0x40010C10) = 1; /* GPIOB_BSRR */
  for (;;) __asm volatile("wfi");
}

/* Initial stack pointer, reset. */
extern char stack_top[];
__attribute__((section(".vectors"), used)) static const void* const vectors[16] = {
    [0] = stack_top, [1] = (const void*)run};
