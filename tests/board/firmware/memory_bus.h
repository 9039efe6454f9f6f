/* The chip on the memory bus, as the programs of the tests set it up. */
#pragma once
#include <stdint.h>

#define REG(address) (*(volatile uint32_t*)(address))
#define CHIP(offset) (*(volatile uint8_t*)(0x60000000u + (offset)))

enum {
  GPIOC_CRL = 0x40011000,
  GPIOD_CRL = 0x40011400,
  GPIOD_CRH = 0x40011404,
  GPIOE_CRL = 0x40011800,
  GPIOE_CRH = 0x40011804,
  GPIOF_CRL = 0x40011C00,
  GPIOF_CRH = 0x40011C04,
  GPIOG_CRL = 0x40012000
};
#define FSMC_BCR1 0xA0000000u

/* The lines of the memory bus are alternate functions, R_REQ and R_STA outputs; 8 bits, not multiplexed. */
static void memory_bus(void) {
  REG(GPIOC_CRL) = 0x33444444;
  REG(GPIOD_CRL) = 0xB4BB44BB;
  REG(GPIOD_CRH) = 0xBB444444;
  REG(GPIOE_CRL) = 0xB4444444;
  REG(GPIOE_CRH) = 0x44444BBB;
  REG(GPIOF_CRL) = 0x44BBBBBB;
  REG(GPIOF_CRH) = 0xBBBB4444;
  REG(GPIOG_CRL) = 0x4444444B;
  REG(FSMC_BCR1) = 0x1081; /* MBKEN, WREN */
}
