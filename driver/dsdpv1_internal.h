/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 OR MIT */
#ifndef DSDPV1_INTERNAL_H
#define DSDPV1_INTERNAL_H
/* Shared by the driver's files. Not for applications. */
#include "dsdpv1.h"
#include "registers/dsdpv1_regs.h"

/* ------------------------------------------------------------------------------------------------------------ blocks
 */

typedef struct dsdpv1_span {
  const uint8_t* bytes;
  uint8_t length;
} dsdpv1_span;

/* A block of the user: head and data, which are adjacent, and the place of its CRC (D3). */
typedef struct dsdpv1_block {
  uint16_t address;
  dsdpv1_span head, data;
  uint16_t crc_address, crc;
} dsdpv1_block;

enum { kAcyclicHeader = 4 }; /* Function_Num, slot, index, length */

/*
 * An area that the chip fills. The CRC covers all bytes before the data, of which the last is the length (D3); only
 * a DPV1 read request has no data after its length (V5).
 */
typedef struct dsdpv1_area {
  uint16_t address;
  uint8_t header; /* bytes before the data, 1..3; kAcyclicHeader for DPV1 */
  uint16_t crc_address;
  uint8_t error_bit; /* in B00D */
  dsdpv1_error length_error, crc_error;
  uint16_t command; /* where the chip announces the block, B00E or B00F */
  uint8_t flag;     /* the bit that announces it */
} dsdpv1_area;

/* A copy of an area. */
typedef struct dsdpv1_copy {
  uint8_t header[4];
  uint8_t* data;    /* `capacity` bytes */
  uint8_t capacity; /* longer blocks are not read */
  uint16_t crc;
} dsdpv1_copy;

/* -------------------------------------------------------------------------------------------------------------- port
 */

/*
 * The functions of a port. Those that return an error, except `hold`, are called only inside a hold and, except
 * `release`, only while device->fault is OK.
 */
typedef struct dsdpv1_link {
  bool reads_crc; /* the CRCs of the chip's blocks tell whether they were read completely and correctly */
  void (*pause)(const dsdpv1_device* device, uint32_t ns);
  dsdpv1_error (*hold)(dsdpv1_device* device); /* after an error the DPRAM is not held */
  dsdpv1_error (*release)(dsdpv1_device* device);
  dsdpv1_error (*get)(dsdpv1_device* device, uint16_t address, uint8_t* bytes, uint8_t length);
  dsdpv1_error (*put)(dsdpv1_device* device, uint16_t address, dsdpv1_span head, dsdpv1_span data);
  /*
   * Writes and announces inputs; fetches `outputs` with them if there are new ones, which `fetched` reports. Null:
   * use cells.
   */
  dsdpv1_error (*exchange)(dsdpv1_device* device, const dsdpv1_block* inputs, dsdpv1_copy* outputs, bool* fetched);
  /* Null if a hold keeps the chip away: then use cells. */
  dsdpv1_error (*post)(dsdpv1_device* device, const dsdpv1_block* block); /* writes and announces it */
  dsdpv1_error (*take_flags)(dsdpv1_device* device, uint16_t command, uint8_t flags);
  dsdpv1_error (*announce)(dsdpv1_device* device, uint16_t command, uint8_t clear, uint8_t set);
} dsdpv1_link;

/* The part of dsdpv1_open that all ports share. */
void dsdpv1_open_link(dsdpv1_device* device, const dsdpv1_link* link, const dsdpv1_judge* judge);

/* ------------------------------------------------------------------------------------------------- holds (dsdpv1.c) */

/* Takes the DPRAM and counts the access in B006. After an error it is not held. */
dsdpv1_error dsdpv1_hold(dsdpv1_device* device);
/* As dsdpv1_hold, for a chip that may not be working yet: its silence is not an error. */
dsdpv1_error dsdpv1_hold_unjudged(dsdpv1_device* device);
/* Returns the first error of a telegram in this hold, or that of the release. The parallel port has none. */
dsdpv1_error dsdpv1_release(dsdpv1_device* device);
void dsdpv1_poll_pause(const dsdpv1_device* device);
void dsdpv1_sync_pause(
    const dsdpv1_device* device); /* DSDPV1_SYNC_WINDOW_NS: then the chip has seen the present levels */
/*
 * Takes the DPRAM repeatedly until the chip has cleared `flag` of B010, at most `init_polls` times. On success the
 * DPRAM is still held; otherwise it is released and `timeout` or the error of the hold returned.
 */
dsdpv1_error dsdpv1_hold_when_taken(dsdpv1_device* device, uint8_t flag, dsdpv1_error timeout);

/* ---------------------------------------------------------------------------------------- DPRAM, only inside a hold */

/*
 * After a failed telegram (device->fault) this hold transfers nothing more, and reads return 0: nothing is new or
 * waiting. dsdpv1_release returns the error.
 */
uint8_t dsdpv1_get(dsdpv1_device* device, uint16_t address);
void dsdpv1_put(dsdpv1_device* device, uint16_t address, uint8_t value);
void dsdpv1_get_block(dsdpv1_device* device, uint16_t address, uint8_t* bytes, uint8_t length);
/* Writes the block's CRC if the chip checks it: on the parallel port (SP15). */
void dsdpv1_put_crc(dsdpv1_device* device, const dsdpv1_block* block);
/* Writes the block, then its CRC. */
void dsdpv1_put_block(dsdpv1_device* device, const dsdpv1_block* block);
/* 16 bits, high byte first. */
uint16_t dsdpv1_get_word(dsdpv1_device* device, uint16_t address);

/*
 * Clear the chip's flags of `command` (B00E or B00F, which reads `seen`) around the reading of their blocks, so that
 * a flag set later means a newer block: after the reading if a hold keeps the chip away, else before it.
 */
void dsdpv1_before_fetch(dsdpv1_device* device, uint16_t command, uint8_t flags);
void dsdpv1_after_fetch(dsdpv1_device* device, uint16_t command, uint8_t seen, uint8_t flags);
/* Changes flags of B010 or B011, which reads `seen`: clears those of `clear`, sets those of `set`. */
void dsdpv1_announce(dsdpv1_device* device, uint16_t command, uint8_t seen, uint8_t clear, uint8_t set);

/* ---------------------------------------------------------------------------- blocks from the chip (dsdpv1_block.c) */

/* Reads the area; inside a hold. */
void dsdpv1_fetch(dsdpv1_device* device, const dsdpv1_area* area, dsdpv1_copy* copy);
/*
 * Checks the copy's CRC. If it is wrong, reports that in B00D and reads again in separate holds, `crc_retries`
 * times. A repeated read may return a newer block, so it also clears the flag.
 * Outside holds. Returns the area's errors or those of a hold.
 */
dsdpv1_error dsdpv1_confirm(dsdpv1_device* device, const dsdpv1_area* area, dsdpv1_copy* copy);
/* Bytes of data that the copy's header announces. */
uint8_t dsdpv1_copy_length(const dsdpv1_area* area, const dsdpv1_copy* copy);

#endif /* DSDPV1_INTERNAL_H */
