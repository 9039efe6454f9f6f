/* Firmware without start-up code for the tests of ELF loader, line table and gdb server: counts in RAM endlessly. */
static volatile unsigned counter;

static unsigned next_of(unsigned value) __attribute__((noinline));
static unsigned next_of(unsigned value) { return value + 3; } /* LINE next_of */

void run(void) {
  for (;;) counter = next_of(counter); /* LINE run */
}

/* Initial stack pointer and reset vector (ARMv7-M B1.5.3). */
extern char stack_top[];
__attribute__((section(".vectors"), used)) static const void* const vectors[2] = {stack_top, (const void*)run};
