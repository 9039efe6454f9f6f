/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 */
#ifndef DSDPV1_PORT_STM32_H
#define DSDPV1_PORT_STM32_H
/* The driver's port on the evaluation board (board.h): the DPRAM on the memory bus, the handshake on port C. */
#include <stdint.h>

#include "driver/dsdpv1.h"
#include "examples/firmware/stm32f103.h"

/* For dsdpv1_open; board_start first. */
extern const dsdpv1_port port_stm32;

enum { kRReqBit = 1 << 6, kRStaBit = 1 << 7, kLReqBit = 1 << 8, kLStaBit = 1 << 9 }; /* PC6 to PC9 */

/* One byte of the DPRAM, 0x000 to 0x7FF; requires a hold. */
static inline uint8_t port_dpram_read(uint16_t address) { return ((const volatile uint8_t*)FSMC_BANK1_NE1)[address]; }

/* The barrier keeps the last byte before R_STA's fall, because the memory bus has a write buffer. */
static inline void port_dpram_write(uint16_t address, uint8_t value) {
  ((volatile uint8_t*)FSMC_BANK1_NE1)[address] = value;
  __asm__ volatile("dsb" ::: "memory");
}

#endif /* DSDPV1_PORT_STM32_H */
