/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 OR MIT */
#ifndef DSDPV1_SERIAL_INTERNAL_H
#define DSDPV1_SERIAL_INTERNAL_H
/* Shared by the ports that use telegrams: 000 6.2, 6.3, 7.1.4; rulings SP4, SP10, UA5. Not for applications. */
#include "dsdpv1_internal.h"
#include "dsdpv1_serial.h"

enum {
  kStartRead = 0x00, /* start bytes; a reply's also has bit 7 set */
  kStartWrite = 0x20,
  kStartBoth = 0x40, /* SPI: read and write; UART: exchange */
  kStartError = 0xE0,
  kReplyBit = 0x80,
  kTelegramCrc = 2,
  kShortReply = 4,   /* to a write, and every error */
  kReplyOverhead = 5 /* of a reply with data: start, error code, length or nothing, CRC */
};

/* The bytes received. */
typedef struct dsdpv1_response {
  const uint8_t* bytes;
  uint16_t length;
} dsdpv1_response;

typedef struct dsdpv1_wire {
  dsdpv1_serial* serial;
  uint8_t address;
  /*
   * Sends the first `request` of serial->bytes and receives up to `most` bytes; `reply` points into the port's
   * memory, with 0 bytes if there are none. Returns false if the port's function failed.
   */
  bool (*transfer)(dsdpv1_device* device, uint16_t request, uint16_t most, dsdpv1_response* reply);
  void (*recover)(const dsdpv1_device* device); /* before a telegram is repeated */
} dsdpv1_wire;

/* A telegram of 6.2. */
typedef struct dsdpv1_order {
  uint8_t start; /* without the address */
  uint16_t address;
  dsdpv1_span head, data; /* of a write */
  uint8_t length;         /* of a read */
  uint8_t most;           /* data bytes of the reply, at most */
} dsdpv1_order;

/* Appends the CRC to `n` bytes; returns the length including it. */
uint16_t dsdpv1_seal(uint8_t* bytes, uint16_t n);
bool dsdpv1_sealed(const dsdpv1_response* reply);
/* Copies `head` and `data` to `to`; returns the position after them. */
uint8_t* dsdpv1_copy_spans(uint8_t* to, dsdpv1_span head, dsdpv1_span data);
/*
 * Sends one telegram and receives its reply, repeating as often as the tuning allows. `data` of the reply are in the
 * port's memory until the next telegram. Errors: DPRAM_BUSY (code 00, SP13; not repeated), NO_REPLY, REPLY,
 * TELEGRAM.
 */
dsdpv1_error dsdpv1_transact(dsdpv1_device* device, const dsdpv1_wire* wire, const dsdpv1_order* order,
                             dsdpv1_span* data);
/* Access to cells: dsdpv1_link's get and put. */
dsdpv1_error dsdpv1_read_cells(dsdpv1_device* device, const dsdpv1_wire* wire, uint16_t address, dsdpv1_span* data,
                               uint8_t length);
dsdpv1_error dsdpv1_write_cells(dsdpv1_device* device, const dsdpv1_wire* wire, uint16_t address, dsdpv1_span head,
                                dsdpv1_span data);
/* As dsdpv1_read_cells, but B00A..B013 are read once per hold, all in one telegram. */
dsdpv1_error dsdpv1_serial_get(dsdpv1_device* device, const dsdpv1_wire* wire, uint16_t address, uint8_t* bytes,
                               uint8_t length);
dsdpv1_error dsdpv1_know_status(dsdpv1_device* device, const dsdpv1_wire* wire);
uint8_t* dsdpv1_status_cell(dsdpv1_serial* serial, uint16_t address); /* null outside of B00A..B013 */

#endif /* DSDPV1_SERIAL_INTERNAL_H */
