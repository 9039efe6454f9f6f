/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 */
#ifndef PORT_H
#define PORT_H
/* How the station reaches the DPRAM: parallel.c or spi.c, one of them in a build. */
#include <stdint.h>

#define WORD(address) (*(volatile uint32_t*)(address))

/* board.c */
extern volatile int intr0_fell;
uint32_t now(void); /* cycles of 72 MHz, modulo 2^32 */
void pause_us(uint32_t us);
void start_clocks(void);
void start_ports(void);
void reset_chip(void); /* calls port_start while RESET is low */
void start_intr0(void);
void look_at_level(void);
void run(void); /* station.c: after a reset */

/* parallel.c, spi.c, uart.c: one of them */
void port_start(void);
void take(void);
void give_back(void);
void read_cells(unsigned from, uint8_t* bytes, unsigned count);
void write_cells(unsigned to, const uint8_t* bytes, unsigned count);

/* cells.c */
uint8_t cell(unsigned address);
void set_cell(unsigned address, uint8_t value);
void set_bits(unsigned address, uint8_t bits);
void clear_bits(unsigned address, uint8_t bits);
uint16_t read_crc(unsigned from);
void write_crc(unsigned to, uint16_t crc);
uint16_t crc16(const uint8_t* bytes, unsigned count);

/* A block of the DPRAM: `head` bytes with its length in the last of them (a request to read has no more), its CRC and
 * flag. */
struct area {
  uint16_t begin;
  uint8_t head;
  uint16_t crc, command;
  uint8_t flag;
};
extern const struct area area_inputs, area_outputs; /* station.c */

/* blocks.c; uart.c */
/* Flags of B00E or B00F whose blocks wait. */
uint8_t news(unsigned command);
/* Copies a block of the chip and clears its flag, in a hold. Returns its length, 0 where the CRC is wrong. */
unsigned fetch(const struct area* from, uint8_t* bytes);
/* Writes a block of the user and sets its flag, in a hold. */
void post(const struct area* to, const uint8_t* bytes, unsigned count);
/* Inputs (may be null) and, where there are new ones, outputs; outside of holds. */
void swap(const uint8_t* inputs, unsigned count, uint8_t* outputs, int wants_outputs);

#endif /* PORT_H */
