/* Firmware that does one thing in an endless loop, for ./run bench --instructions. LOOP selects it; each pass of a
 * polling loop has three instructions. */
#include <stdint.h>

#define REGISTER(address) (*(volatile uint32_t*)(address))

__attribute__((used)) void run(void) {
  REGISTER(0x40021018) = 0x1FD;      /* RCC_APB2ENR: the ports' clocks */
  REGISTER(0x40021014) |= 1u << 8;   /* RCC_AHBENR: the FSMC's */
  REGISTER(0xA0000000) = 0x1081;     /* FSMC_BCR1: bank on, 8 bit, write enable */
  REGISTER(0x40011000) = 0x11444444; /* R_REQ, R_STA */
#if LOOP == DPRAM                    /* its lines */
  REGISTER(0x40011400) = 0xB4BB44BB;
  REGISTER(0x40011404) = 0xBB444444;
  REGISTER(0x40011800) = 0xB4444444;
  REGISTER(0x40011804) = 0x44444BBB;
  REGISTER(0x40011C00) = 0x44BBBBBB;
  REGISTER(0x40011C04) = 0xBBBB4444;
  REGISTER(0x40012000) = 0x4444444B;
#endif
#if LOOP == GPIO /* R_REQ, then L_REQ on PC8 until it falls, then until it rises */
  REGISTER(0x40011010) = 1u << 6;
  for (;;) {
    while (REGISTER(0x40011008) & 0x100) {
    }
    __asm__ volatile("nop"); /* else the compiler would merge both loops into one that does not test the value read */
    while (!(REGISTER(0x40011008) & 0x100)) {
    }
  }
#elif LOOP == DPRAM /* a cell, without holding the DPRAM */
  volatile uint8_t* dpram = (volatile uint8_t*)0x60000004;
  while (*dpram != 0xA5) {
  }
#else               /* RAM */
  volatile uint32_t n;
  for (;;)
    for (n = 0; n < 1000; n++) {
    }
#endif
}

__attribute__((section(".vectors"), used)) static const void* const vectors[16] = {(const void*)0x20010000,
                                                                                   (const void*)run};
