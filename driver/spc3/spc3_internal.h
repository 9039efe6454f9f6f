/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 OR MIT */
#ifndef SPC3_INTERNAL_H
#define SPC3_INTERNAL_H
/* Shared by the driver's files. Not for applications. */
#include <stddef.h>

#include "registers/spc3_regs.h"
#include "spc3.h"

enum { kDiagHead = 6 };      /* standard bytes of a diagnosis */
#define SPC3_SEGMENT_BITS 3u /* of an address; a pointer has the others */
#define SPC3_PIECE 32u       /* bytes of RAM that the driver holds at once, beside the block that is judged */

uint8_t spc3_get(const spc3_device* device, uint16_t address);
void spc3_put(const spc3_device* device, uint16_t address, uint8_t value);

/* A word at `address`: low byte first, high byte first on a Motorola bus. */
uint16_t spc3_get_word(const spc3_device* device, uint16_t address);
void spc3_put_word(const spc3_device* device, uint16_t address, uint16_t value);

/* Address of the buffer that the cell points to. */
uint16_t spc3_buffer(const spc3_device* device, uint16_t pointer);

void spc3_get_bytes(const spc3_device* device, uint16_t address, uint8_t* bytes, uint8_t length);
void spc3_put_bytes(const spc3_device* device, uint16_t address, const uint8_t* bytes, uint8_t length);
/* Bytes from `address` to `end`, at most SPC3_PIECE. */
uint8_t spc3_piece(uint16_t address, uint16_t end);
void spc3_fill(const spc3_device* device, uint16_t address, uint16_t end, uint8_t value);

#endif /* SPC3_INTERNAL_H */
