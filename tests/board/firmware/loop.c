/* Firmware of the few instructions that the tests' processor (fake_target.cpp) knows: counts r0 up and keeps it in RAM.
 */
unsigned counter; /* at 0x20000000, all that there is in RAM */

__attribute__((naked)) void run(void) {
  __asm__ volatile("movs r0, #0");
  __asm__ volatile("movs r1, #0x20");
  __asm__ volatile("lsls r1, r1, #24");
  __asm__ volatile("b.n loop");
}

__attribute__((naked)) void loop(void) {
  __asm__ volatile("adds r0, #1"); /* LINE loop */
  __asm__ volatile("str r0, [r1]");
  __asm__ volatile("ldr r2, [r1]");
  __asm__ volatile("b.n loop");
}

void main(void) __attribute__((alias("loop"))); /* for gdb's `start` */

extern char stack_top[];
__attribute__((section(".vectors"), used)) static const void* const vectors[2] = {stack_top, (const void*)run};
