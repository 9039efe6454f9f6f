/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 OR MIT */
#ifndef DSDPV1_SERIAL_INTERNAL_H
#define DSDPV1_SERIAL_INTERNAL_H
/* What the ports with telegrams share: 000 6.2, 6.3, 7.1.4; rulings SP4, SP10, UA5. Not for applications. */
#include "dsdpv1_internal.h"
#include "dsdpv1_serial.h"

enum {
  kStartRead = 0x00, /* start bytes; a reply's has bit 7 besides */
  kStartWrite = 0x20,
  kStartBoth = 0x40, /* SPI: read and write; UART: exchange */
  kStartError = 0xE0,
  kReplyBit = 0x80,
  kTelegramCrc = 2,
  kShortReply = 4,   /* to a write, and every error */
  kReplyOverhead = 5 /* of a reply with data: start, error code, length or nothing, CRC */
};

/* What was received. */
typedef struct dsdpv1_response {
  const uint8_t* bytes;
  uint16_t length;
} dsdpv1_response;

typedef struct dsdpv1_wire {
  dsdpv1_serial* serial;
  uint8_t address;
  /*
   * Sends the first `request` of serial->bytes and receives up to `most` bytes; their place is the port's, their number
   * 0 when there are none. False when the port's own function failed.
   */
  bool (*transfer)(dsdpv1_device* device, uint16_t request, uint16_t most, dsdpv1_response* reply);
  void (*recover)(const dsdpv1_device* device); /* before a telegram is sent again */
} dsdpv1_wire;

/* A telegram of 6.2. */
typedef struct dsdpv1_order {
  uint8_t start; /* without the address */
  uint16_t address;
  dsdpv1_span head, data; /* of a write */
  uint8_t length;         /* of a read */
  uint8_t most;           /* data bytes of the reply, at most */
} dsdpv1_order;

/* The CRC behind `n` bytes; the length with it. */
uint16_t dsdpv1_seal(uint8_t* bytes, uint16_t n);
bool dsdpv1_sealed(const dsdpv1_response* reply);
/* `head` and `data` from `to` on; the place behind them. */
uint8_t* dsdpv1_copy_spans(uint8_t* to, dsdpv1_span head, dsdpv1_span data);
/*
 * One telegram and its reply, repeated as often as the tuning allows. `data` of the reply are in the port's memory
 * until the next telegram. Errors: DPRAM_BUSY (code 00, SP13; not repeated), NO_REPLY, REPLY, TELEGRAM.
 */
dsdpv1_error dsdpv1_transact(dsdpv1_device* device, const dsdpv1_wire* wire, const dsdpv1_order* order,
                             dsdpv1_span* data);
/* The cells themselves: dsdpv1_link's get and put. */
dsdpv1_error dsdpv1_read_cells(dsdpv1_device* device, const dsdpv1_wire* wire, uint16_t address, dsdpv1_span* data,
                               uint8_t length);
dsdpv1_error dsdpv1_write_cells(dsdpv1_device* device, const dsdpv1_wire* wire, uint16_t address, dsdpv1_span head,
                                dsdpv1_span data);
/* The same; B00A..B013 are read once in a hold, all of them in one telegram. */
dsdpv1_error dsdpv1_serial_get(dsdpv1_device* device, const dsdpv1_wire* wire, uint16_t address, uint8_t* bytes,
                               uint8_t length);
dsdpv1_error dsdpv1_know_status(dsdpv1_device* device, const dsdpv1_wire* wire);
uint8_t* dsdpv1_status_cell(dsdpv1_serial* serial, uint16_t address); /* null outside of B00A..B013 */

#endif /* DSDPV1_SERIAL_INTERNAL_H */
