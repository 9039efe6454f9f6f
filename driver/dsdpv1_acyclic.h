/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 OR MIT */
#ifndef DSDPV1_ACYCLIC_H
#define DSDPV1_ACYCLIC_H
/*
 * DPV1 for the driver: acyclic requests of masters of class 1 (MSAC_C1) and class 2 (MSAC_C2), I&M0 (chapter 7).
 *
 * The application describes its data in a table of slots and indexes. The driver fetches requests, checks them
 * against the table, serves plain data itself, calls handlers for the rest, and writes the answers.
 *
 *   static dsdpv1_acyclic acyclic;
 *   dsdpv1_acyclic_open(&acyclic, &chip, &table);     after dsdpv1_open; config.dpv1 = true
 *   for (;;) {
 *     dsdpv1_exchange(...);
 *     dsdpv1_acyclic_poll(&acyclic, NULL);            requests have no interrupt (P7): poll
 *   }
 *
 * Class 1 and class 2 have separate DPRAM areas and do not wait for each other. The two channels of class 2 share
 * one: the chip hands over one request after another (V4) and does not report the channel.
 *
 * Contexts: dsdpv1_acyclic_poll belongs to the thread. dsdpv1_acyclic_answer and _refuse may also be called from the
 * interrupt handler; if they interrupt a hold or the poll they return DSDPV1_ERR_NESTED and do nothing.
 */
/* NOLINTBEGIN(modernize-deprecated-headers, modernize-use-using): C, also when included by C++ */
#include "dsdpv1.h"

#ifdef __cplusplus
extern "C" {
#endif

#define DSDPV1_MAX_ACYCLIC 240u /* data bytes of a request or an answer (table 2) */

/* ------------------------------------------------------------------------------------------ what is on the telegrams
 */

/* Function_Num, B5D0 and B6D0: tables 26 and 31; with bit 7 set a negative answer, tables 27 and 32. */
typedef enum dsdpv1_function {
  DSDPV1_DS_TRANSPORT = 0x51, /* class 2 only */
  DSDPV1_DS_READ = 0x5E,
  DSDPV1_DS_WRITE = 0x5F,
  DSDPV1_DS_TRANSPORT_ERROR = 0xD1,
  DSDPV1_DS_READ_ERROR = 0xDE,
  DSDPV1_DS_WRITE_ERROR = 0xDF
} dsdpv1_function;

#define DSDPV1_ERROR_DECODE 0x80u /* table 28: the only value, "codes as in DPV1" */

/* Error_Code_1, table 29: class in the high nibble, code in the low one. The application chooses Error_Code_2. */
typedef enum dsdpv1_error_code_1 {
  DSDPV1_EC_READ_ERROR = 0xA0,
  DSDPV1_EC_WRITE_ERROR = 0xA1,
  DSDPV1_EC_MODULE_FAILURE = 0xA2,
  DSDPV1_EC_VERSION_CONFLICT = 0xA8,
  DSDPV1_EC_FEATURE_NOT_SUPPORTED = 0xA9,
  DSDPV1_EC_APPLICATION_USER = 0xAA, /* ..0xAF: defined by the application */
  DSDPV1_EC_INVALID_INDEX = 0xB0,
  DSDPV1_EC_WRITE_LENGTH = 0xB1,
  DSDPV1_EC_INVALID_SLOT = 0xB2,
  DSDPV1_EC_TYPE_CONFLICT = 0xB3,
  DSDPV1_EC_INVALID_AREA = 0xB4,
  DSDPV1_EC_STATE_CONFLICT = 0xB5,
  DSDPV1_EC_ACCESS_DENIED = 0xB6,
  DSDPV1_EC_INVALID_RANGE = 0xB7,
  DSDPV1_EC_INVALID_PARAMETER = 0xB8,
  DSDPV1_EC_INVALID_TYPE = 0xB9,
  DSDPV1_EC_ACCESS_USER = 0xBA, /* ..0xBF */
  DSDPV1_EC_READ_CONSTRAIN = 0xC0,
  DSDPV1_EC_WRITE_CONSTRAIN = 0xC1,
  DSDPV1_EC_RESOURCE_BUSY = 0xC2,
  DSDPV1_EC_RESOURCE_UNAVAILABLE = 0xC3,
  DSDPV1_EC_RESOURCE_USER = 0xC8, /* ..0xCF */
  DSDPV1_EC_USER = 0xD0           /* ..0xFF */
} dsdpv1_error_code_1;

/* ------------------------------------------------------------------------------------------- slots, indexes, requests
 */

/* Classes of masters, as bits; the same as in B00F and B011. */
#define DSDPV1_CLASS_1 0x01u
#define DSDPV1_CLASS_2 0x02u
#define DSDPV1_CLASS_BOTH 0x03u

/* Services that a master may use on an object, as bits. */
#define DSDPV1_MAY_READ 0x01u
#define DSDPV1_MAY_WRITE 0x02u
#define DSDPV1_MAY_TRANSPORT 0x04u /* class 2 only */

/* A request as a callback sees it. */
typedef struct dsdpv1_request {
  uint16_t ticket;      /* names the request in a later answer */
  uint8_t master_class; /* DSDPV1_CLASS_1 or DSDPV1_CLASS_2 */
  uint8_t function;     /* DSDPV1_DS_READ, _WRITE or _TRANSPORT */
  uint8_t slot, index;
  uint8_t length;      /* read: bytes that the master asks for (V5); else bytes in `data` */
  const uint8_t* data; /* write, transport; valid until the request is answered or dropped */
} dsdpv1_request;

/* A callback's answer. */
typedef struct dsdpv1_reply {
  uint8_t* data;                      /* read, transport: room for 240 bytes; the same memory as the request's `data` */
  uint8_t length;                     /* bytes put there, preset to 0; a read is cut to what the master asks for */
  uint8_t error_code_1, error_code_2; /* when DSDPV1_FAILED; preset to the error of the service, 0xA0..0xA2, and 0 */
} dsdpv1_reply;

typedef enum dsdpv1_outcome {
  DSDPV1_DONE,    /* positive answer */
  DSDPV1_FAILED,  /* negative answer with the reply's codes */
  DSDPV1_DEFERRED /* no answer now; dsdpv1_acyclic_answer or _refuse follows. Class 2: within Send_Timeout (V3, V13) */
} dsdpv1_outcome;

/* Called from dsdpv1_acyclic_poll, outside holds, with a request that the table admits. `ctx`: the object's. */
typedef dsdpv1_outcome (*dsdpv1_handler)(void* ctx, const dsdpv1_request* request, dsdpv1_reply* reply);

/*
 * One line of the table. A service is executed by its handler or, if that is null, on `data`: a read returns the
 * first `max_length` bytes, a write replaces the first bytes. Transport needs a handler.
 */
typedef struct dsdpv1_object {
  uint8_t slot, index;
  uint8_t services; /* DSDPV1_MAY_ bits, at least one */
  uint8_t classes;  /* DSDPV1_CLASS_ bits, at least one */
  /* 0..240, min <= max. Write, transport: bytes of the request. Read: the master must ask for at least min_length. */
  uint8_t min_length, max_length;
  uint8_t* data; /* max_length bytes, or null */
  dsdpv1_handler read, write, transport;
  void* ctx;
} dsdpv1_object;

/* ---------------------------------------------------------------------------------------------------------- I&M0 */

/*
 * The electronic nameplate (Profile Guidelines, part 1: Identification & Maintenance functions), 64 bytes on the bus.
 * A master writes the call header 08 00 FD E8 (subindex 65000) to slot 0, index 255 and reads 68 bytes from there.
 */
typedef struct dsdpv1_im0 {
  uint8_t header[10];        /* manufacturer specific */
  uint16_t manufacturer_id;  /* given by the PROFIBUS organisation */
  const char* order_id;      /* at most 20 characters, filled with blanks */
  const char* serial_number; /* at most 16 characters, filled with blanks */
  uint16_t hardware_revision;
  char software_type; /* 'V' released, 'R' revision, 'P' prototype, 'U' field test, 'T' test device */
  uint8_t software_revision[3];
  uint16_t revision_counter;
  uint16_t profile_id; /* 0xF600: generic device */
  uint16_t profile_specific_type;
  uint8_t version_major, version_minor; /* of the I&M functions: 1, 1 */
  uint16_t supported;                   /* bit n: I&Mn; bit 0: profile-specific ones. I&M0 alone: 0 */
} dsdpv1_im0;

/* ----------------------------------------------------------------------------------------------------------- polling
 */

/* The table of an application. It and everything it points to must live as long as the device is used. */
typedef struct dsdpv1_table {
  const dsdpv1_object* objects;
  size_t count;
  const dsdpv1_im0* im0; /* null: no I&M; then slot 0, index 255 may be in the table */
} dsdpv1_table;

/* Result of a poll, as DSDPV1_CLASS_ bits. */
typedef struct dsdpv1_acyclic_result {
  uint8_t received; /* a request with the right CRC was fetched */
  uint8_t answered; /* an answer was handed to the chip */
  uint8_t refused;  /* the answer was a negative one */
  uint8_t dropped;  /* an answer or open request was abandoned: newer request (V13), or new initialisation */
  uint8_t repeated; /* the chip found an answer's CRC wrong (B00B.4, .5); it was written again */
  uint8_t open;     /* a request waits for dsdpv1_acyclic_answer or _refuse */
} dsdpv1_acyclic_result;

/* One of the two areas of the DPRAM. Private to the driver. */
typedef enum dsdpv1_channel_state {
  DSDPV1_CHANNEL_IDLE,
  DSDPV1_CHANNEL_OPEN,  /* deferred by the application */
  DSDPV1_CHANNEL_READY, /* the answer waits for a hold */
  DSDPV1_CHANNEL_SENT   /* written; kept until the chip has accepted its CRC */
} dsdpv1_channel_state;

typedef struct dsdpv1_channel {
  dsdpv1_channel_state state;
  bool unread;           /* the DPRAM holds a request that could not be read correctly */
  bool im0_called;       /* the call header has been written, the read may follow */
  uint16_t ticket;       /* of the last request; bit 0 is the number of the channel */
  uint8_t request[4];    /* Function_Num, slot, index, length */
  uint8_t answer[4];     /* the same of the answer, or the error codes */
  uint8_t answer_length; /* bytes of `data` after it */
  uint16_t answer_crc;
  const dsdpv1_object* object; /* addressed by the open request */
  uint8_t data[DSDPV1_MAX_ACYCLIC];
} dsdpv1_channel;

/* State of DPV1 of one chip, about half a kilobyte. The members are private to the driver. */
typedef struct dsdpv1_acyclic {
  dsdpv1_device* device;
  dsdpv1_table table;
  volatile bool polling;
  uint8_t generation; /* of the initialisation that the channels belong to */
  dsdpv1_channel channels[2];
} dsdpv1_acyclic;

/*
 * Prepares `acyclic` for an opened `device` and checks the table; touches no pin. The lists that `table` points to
 * are not copied.
 * Errors: ARGUMENT; TABLE (an object's bits, lengths, a missing handler or data, the same slot and index twice, slot
 * 0 index 255 beside I&M0); IM0 (a text is missing or too long).
 */
dsdpv1_error dsdpv1_acyclic_open(dsdpv1_acyclic* acyclic, dsdpv1_device* device, const dsdpv1_table* table);

/*
 * Fetches requests (B00F.0, B00F.1), checks their CRC, lets the table and the handlers answer and writes the answers
 * (B011.0, B011.1). Before each answer it checks B00F in the same hold: if a newer request is there, the old answer
 * is dropped (V13) and the new request served. An earlier answer whose CRC the chip found wrong is written again.
 * `result` may be null. If an error is returned, the other class has still been served.
 *
 * Negative answers of the driver, Error_Code_2 = 0, the first that applies: INVALID_SLOT (no object with that slot),
 * INVALID_INDEX, ACCESS_DENIED (class), FEATURE_NOT_SUPPORTED (transport) or ACCESS_DENIED (read, write) for a service
 * that the object does not have, WRITE_LENGTH (write, transport) or INVALID_PARAMETER (read) for the length,
 * RESOURCE_BUSY (the other class waits for a deferred answer of the same object).
 *
 * Errors: NOT_INITIALISED; C1_LENGTH, C1_CRC, C2_LENGTH, C2_CRC (the request stays, the next poll reads it again);
 * ANSWER_LENGTH (a handler gave more than 240 bytes; the master gets its preset negative answer); NESTED, DPRAM_BUSY,
 * CHIP_SILENT (finished answers go with the next poll).
 */
dsdpv1_error dsdpv1_acyclic_poll(dsdpv1_acyclic* acyclic, dsdpv1_acyclic_result* result);

/*
 * Gives the positive answer to a request that its handler deferred. `length` bytes of `data` (0..240) answer a read,
 * which is cut to the length requested, or a transport; a write takes none, and `data` may be null.
 * Errors: ARGUMENT, ANSWER_LENGTH, NO_REQUEST_OPEN (answered already), ANSWER_STALE (the request is gone, nothing
 * was sent), NESTED; DPRAM_BUSY, CHIP_SILENT (the answer goes with the next poll).
 */
dsdpv1_error dsdpv1_acyclic_answer(dsdpv1_acyclic* acyclic, uint16_t ticket, const uint8_t* data, uint8_t length);

/* Gives the negative answer. Errors: as dsdpv1_acyclic_answer. */
dsdpv1_error dsdpv1_acyclic_refuse(dsdpv1_acyclic* acyclic, uint16_t ticket, uint8_t error_code_1,
                                   uint8_t error_code_2);

#ifdef __cplusplus
}
#endif

/* NOLINTEND(modernize-deprecated-headers, modernize-use-using) */

#endif /* DSDPV1_ACYCLIC_H */
