/* Firmware that meets an undefined instruction and has no handler for it. */
void run(void);
void run(void) { __asm volatile("udf #0"); }

extern char stack_top[];
__attribute__((section(".vectors"), used)) static const void* const vectors[4] = {stack_top, (const void*)run};
