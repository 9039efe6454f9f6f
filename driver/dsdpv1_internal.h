/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 OR MIT */
#ifndef DSDPV1_INTERNAL_H
#define DSDPV1_INTERNAL_H
/* What the driver's files share. Not for applications. */
#include "dsdpv1.h"
#include "registers/dsdpv1_regs.h"

/* ------------------------------------------------------------------------------------------------------------ blocks
 */

typedef struct dsdpv1_span {
  const uint8_t* bytes;
  uint8_t length;
} dsdpv1_span;

/* A block of the user's: head and data, one right behind the other, and where its CRC stands (D3). */
typedef struct dsdpv1_block {
  uint16_t address;
  dsdpv1_span head, data;
  uint16_t crc_address, crc;
} dsdpv1_block;

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

/* -------------------------------------------------------------------------------------------------------------- port
 */

/*
 * What a port can do. Functions that return an error are called inside a hold only, but for `hold`, and only while
 * device->fault is OK, but for `release`.
 */
typedef struct dsdpv1_link {
  bool reads_crc; /* those of the chip's blocks say whether they were read as a whole and rightly */
  void (*pause)(const dsdpv1_device* device, uint32_t ns);
  dsdpv1_error (*hold)(dsdpv1_device* device); /* after an error nothing is held */
  dsdpv1_error (*release)(dsdpv1_device* device);
  dsdpv1_error (*get)(dsdpv1_device* device, uint16_t address, uint8_t* bytes, uint8_t length);
  dsdpv1_error (*put)(dsdpv1_device* device, uint16_t address, dsdpv1_span head, dsdpv1_span data);
  /*
   * Null: cells do. Writes and announces inputs; `outputs` are fetched with them when there are new ones, which
   * `fetched` then says.
   */
  dsdpv1_error (*exchange)(dsdpv1_device* device, const dsdpv1_block* inputs, dsdpv1_copy* outputs, bool* fetched);
  /* Null where a hold keeps the chip away: then cells do. */
  dsdpv1_error (*post)(dsdpv1_device* device, const dsdpv1_block* block); /* writes and announces it */
  dsdpv1_error (*take_flags)(dsdpv1_device* device, uint16_t command, uint8_t flags);
  dsdpv1_error (*announce)(dsdpv1_device* device, uint16_t command, uint8_t clear, uint8_t set);
} dsdpv1_link;

/* What dsdpv1_open has to do whatever the port is. */
void dsdpv1_open_link(dsdpv1_device* device, const dsdpv1_link* link, const dsdpv1_judge* judge);

/* ------------------------------------------------------------------------------------------------- holds (dsdpv1.c) */

/* Takes the DPRAM and counts the access in B006. After an error nothing is held. */
dsdpv1_error dsdpv1_hold(dsdpv1_device* device);
/* The same for a chip that may not be working yet: its silence is no error. */
dsdpv1_error dsdpv1_hold_unjudged(dsdpv1_device* device);
/* The first error that a telegram had in this hold, or that of the release. None on the parallel port. */
dsdpv1_error dsdpv1_release(dsdpv1_device* device);
void dsdpv1_poll_pause(const dsdpv1_device* device);
void dsdpv1_sync_pause(const dsdpv1_device* device); /* DSDPV1_SYNC_WINDOW_NS: the chip has seen what the lines are */
/*
 * Holds the DPRAM again and again until the chip has cleared `flag` of B010, at most `init_polls` times. On success the
 * DPRAM is still held; otherwise it is released and `timeout` or the error of the hold returned.
 */
dsdpv1_error dsdpv1_hold_when_taken(dsdpv1_device* device, uint8_t flag, dsdpv1_error timeout);

/* ---------------------------------------------------------------------------------------- DPRAM, only inside a hold */

/*
 * Once a telegram has failed (device->fault) nothing more is moved in this hold, and what is read is 0: nothing is new,
 * nothing waits. dsdpv1_release tells.
 */
uint8_t dsdpv1_get(dsdpv1_device* device, uint16_t address);
void dsdpv1_put(dsdpv1_device* device, uint16_t address, uint8_t value);
void dsdpv1_get_block(dsdpv1_device* device, uint16_t address, uint8_t* bytes, uint8_t length);
/* The block's CRC, where the chip looks at it: on the parallel port (SP15). */
void dsdpv1_put_crc(dsdpv1_device* device, const dsdpv1_block* block);
/* The block, then its CRC. */
void dsdpv1_put_block(dsdpv1_device* device, const dsdpv1_block* block);
/* 16 bits, high byte first. */
uint16_t dsdpv1_get_word(dsdpv1_device* device, uint16_t address);

/*
 * Flags that the chip sets (`command` B00E or B00F, which reads `seen`) are taken around the reading of their blocks,
 * so that one set afterwards means a newer block: where a hold keeps the chip away after it, else before it.
 */
void dsdpv1_before_fetch(dsdpv1_device* device, uint16_t command, uint8_t flags);
void dsdpv1_after_fetch(dsdpv1_device* device, uint16_t command, uint8_t seen, uint8_t flags);
/* Flags of B010 or B011, which reads `seen`: those of `clear` fall, those of `set` rise, the others stay. */
void dsdpv1_announce(dsdpv1_device* device, uint16_t command, uint8_t seen, uint8_t clear, uint8_t set);

/* ---------------------------------------------------------------------------- blocks from the chip (dsdpv1_block.c) */

/* Reads the area; inside a hold. */
void dsdpv1_fetch(dsdpv1_device* device, const dsdpv1_area* area, dsdpv1_copy* copy);
/*
 * Checks the copy's CRC; when it is wrong, says so in B00D and reads again in holds of its own, `crc_retries` times.
 * What is read again may be a newer block, so the flag falls with it.
 * Outside of holds. Returns the area's errors or those of a hold.
 */
dsdpv1_error dsdpv1_confirm(dsdpv1_device* device, const dsdpv1_area* area, dsdpv1_copy* copy);
/* Bytes of data that the copy's header announces. */
uint8_t dsdpv1_copy_length(const dsdpv1_area* area, const dsdpv1_copy* copy);

#endif /* DSDPV1_INTERNAL_H */
