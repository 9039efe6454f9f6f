/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 */
/* Single cells and CRCs: over each port. */
#include "port.h"

uint8_t cell(unsigned address) {
  uint8_t value = 0;
  read_cells(address, &value, 1);
  return value;
}

void set_cell(unsigned address, uint8_t value) { write_cells(address, &value, 1); }

static uint16_t crc_on(uint16_t crc, const uint8_t* bytes, unsigned count) {
  while (count-- != 0u) {
    crc ^= *bytes++;
    for (unsigned i = 0; i < 8u; ++i) crc = (uint16_t)((crc & 1u) != 0u ? crc >> 1 ^ 0xA001u : crc >> 1);
  }
  return crc;
}

uint16_t crc16(const uint8_t* bytes, unsigned count) { return crc_on(0xFFFF, bytes, count); }

void write_crc(unsigned to, uint16_t crc) {
  const uint8_t bytes[2] = {(uint8_t)(crc >> 8), (uint8_t)crc};
  write_cells(to, bytes, 2);
}

uint16_t read_crc(unsigned from) {
  uint8_t bytes[2];
  read_cells(from, bytes, 2);
  return (uint16_t)(bytes[0] << 8 | bytes[1]);
}

void set_bits(unsigned address, uint8_t bits) { set_cell(address, (uint8_t)(cell(address) | bits)); }
void clear_bits(unsigned address, uint8_t bits) { set_cell(address, (uint8_t)(cell(address) & ~bits)); }
