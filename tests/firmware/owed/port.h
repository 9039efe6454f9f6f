/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 */
#ifndef PORT_H
#define PORT_H
/* How the station reaches the DPRAM: parallel.c or spi.c, one of them in a build. */
#include <stdint.h>

#define WORD(address) (*(volatile uint32_t*)(address))

/* stm32f103.c */
uint32_t now(void); /* cycles of 72 MHz, modulo 2^32 */
void pause_us(uint32_t us);

void port_start(void);
void take(void);
void give_back(void);
void read_cells(unsigned from, uint8_t* bytes, unsigned count);
void write_cells(unsigned to, const uint8_t* bytes, unsigned count);

uint8_t cell(unsigned address);
void set_cell(unsigned address, uint8_t value);
uint16_t crc16(const uint8_t* bytes, unsigned count);

#endif /* PORT_H */
