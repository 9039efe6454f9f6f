/* SPDX-License-Identifier: Apache-2.0 OR MIT */
#ifndef DSDPV1_INTERNAL_H
#define DSDPV1_INTERNAL_H
/* What the driver's files share. Not for applications. */
#include "dsdpv1.h"
#include "registers/dsdpv1_regs.h"

/* ------------------------------------------------------------------------------------------------- holds (dsdpv1.c) */

/* Takes the DPRAM and counts the access in B006. After an error nothing is held. */
dsdpv1_error dsdpv1_hold(dsdpv1_device* device);
/* The same for a chip that may not be working yet: its silence is no error. */
dsdpv1_error dsdpv1_hold_unjudged(dsdpv1_device* device);
void dsdpv1_release(dsdpv1_device* device);
void dsdpv1_poll_pause(const dsdpv1_device* device);
void dsdpv1_sync_pause(const dsdpv1_device* device); /* DSDPV1_SYNC_WINDOW_NS: the chip has seen what the lines are */
/*
 * Holds the DPRAM again and again until the chip has cleared `flag` of B010, at most `init_polls` times. On success the
 * DPRAM is still held; otherwise it is released and `timeout` or the error of the hold returned.
 */
dsdpv1_error dsdpv1_hold_when_taken(dsdpv1_device* device, uint8_t flag, dsdpv1_error timeout);

/* ---------------------------------------------------------------------------------------- DPRAM, only inside a hold */

uint8_t dsdpv1_get(const dsdpv1_device* device, uint16_t address);
void dsdpv1_put(const dsdpv1_device* device, uint16_t address, uint8_t value);
void dsdpv1_get_block(const dsdpv1_device* device, uint16_t address, uint8_t* bytes, uint8_t length);
void dsdpv1_put_block(const dsdpv1_device* device, uint16_t address, const uint8_t* bytes, uint8_t length);
/* 16 bits, high byte first. */
uint16_t dsdpv1_get_word(const dsdpv1_device* device, uint16_t address);
void dsdpv1_put_word(const dsdpv1_device* device, uint16_t address, uint16_t value);

/* ---------------------------------------------------------------------------- blocks from the chip (dsdpv1_block.c) */

enum { kAcyclicHeader = 4 }; /* Function_Num, slot, index, length */

/*
 * An area that the chip fills. The bytes before the data are all covered by the CRC, the last of them is the length
 * (D3); only a DPV1 read request has no data behind its length (V5).
 */
typedef struct dsdpv1_area {
  uint16_t address;
  uint8_t header; /* bytes before the data, 1..3; kAcyclicHeader for DPV1 */
  uint16_t crc_address;
  uint8_t error_bit; /* in B00D */
  dsdpv1_error length_error, crc_error;
  uint16_t command; /* where the chip announces it, B00E or B00F */
  uint8_t flag;     /* and with which bit */
} dsdpv1_area;

/* What was read of an area. */
typedef struct dsdpv1_copy {
  uint8_t header[4];
  uint8_t* data;    /* `capacity` bytes */
  uint8_t capacity; /* longer blocks are not read */
  uint16_t crc;
} dsdpv1_copy;

/* Reads the area; inside a hold. */
void dsdpv1_fetch(const dsdpv1_device* device, const dsdpv1_area* area, dsdpv1_copy* copy);
/*
 * Checks the copy's CRC; when it is wrong, says so in B00D and reads again in holds of its own, `crc_retries` times.
 * What is read again may be a newer block, so the flag falls with it.
 * Outside of holds. Returns the area's errors or those of a hold.
 */
dsdpv1_error dsdpv1_confirm(dsdpv1_device* device, const dsdpv1_area* area, dsdpv1_copy* copy);
/* Bytes of data that the copy's header announces. */
uint8_t dsdpv1_copy_length(const dsdpv1_area* area, const dsdpv1_copy* copy);

#endif /* DSDPV1_INTERNAL_H */
