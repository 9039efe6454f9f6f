/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Telegrams of the data link layer (EN 50170 / IEC 61158-4 type 3) as fields, bytes and text. No objects, no state;
 * all functions may be called from any thread, also in callbacks.
 */
#ifndef DPSIM_TELEGRAM_H
#define DPSIM_TELEGRAM_H

/* NOLINTBEGIN(modernize-use-using): C, also when included by C++ */
#include "dsdpv1/types.h"

#ifdef __cplusplus
extern "C" {
#endif

#define DPSIM_MAX_DATA 246     /**< bytes of data of SD2, SAP bytes included */
#define DPSIM_MAX_TELEGRAM 255 /**< bytes of the longest telegram on the wire */
#define DPSIM_BROADCAST 127
#define DPSIM_NO_SAP ((int16_t)-1)

typedef int32_t dpsim_telegram_kind;
enum {
  DPSIM_SD1 = 0, /**< 10 DA SA FC FCS 16: no data */
  DPSIM_SD2 = 1, /**< 68 LE LEr 68 DA SA FC data FCS 16 */
  DPSIM_SD3 = 2, /**< A2 DA SA FC data(8) FCS 16 */
  DPSIM_SD4 = 3, /**< DC DA SA: the token */
  DPSIM_SC = 4   /**< E5: short acknowledge */
};

typedef struct dpsim_telegram {
  uint32_t size;
  dpsim_telegram_kind kind;
  uint8_t da, sa; /**< 0 to 127, without the extension bit; 0 in SC */
  uint8_t fc;     /**< frame control; 0 in SD4 and SC */
  uint8_t reserved;
  int16_t dsap, ssap; /**< the extension bytes, DPSIM_NO_SAP if there are none (0 is a SAP: set both) */
  uint16_t data_size; /**< bytes in `data`, SAP bytes not counted */
  uint8_t data[DPSIM_MAX_DATA];
} dpsim_telegram;

typedef int32_t dpsim_decode_error;
enum {
  DPSIM_DECODE_OK = 0,
  DPSIM_DECODE_START_DELIMITER = 1,        /**< the first byte is not 10, 68, A2, DC or E5 */
  DPSIM_DECODE_LENGTH_RANGE = 2,           /**< LE below 4 or above 249 */
  DPSIM_DECODE_LENGTH_MISMATCH = 3,        /**< LE and LEr differ */
  DPSIM_DECODE_SECOND_START_DELIMITER = 4, /**< the fourth byte of SD2 is not 68 */
  DPSIM_DECODE_FCS = 5,
  DPSIM_DECODE_END_DELIMITER = 6,
  DPSIM_DECODE_MISSING_SAP = 7, /**< bit 7 of DA or SA announces an extension byte that is missing */
  DPSIM_DECODE_TRUNCATED = 8    /**< the bytes end inside the telegram */
};

/** Encodes a telegram as the bytes on the wire, with FCS. `bytes` has room for `capacity`; DPSIM_MAX_TELEGRAM is
 * always enough. DPSIM_ERR_ARGUMENT: a field out of range, or data that do not fit the kind; DPSIM_ERR_SPACE:
 * `count` is the number needed. */
DPSIM_API dpsim_status dpsim_telegram_encode(const dpsim_telegram* telegram, uint8_t* bytes, size_t capacity,
                                             size_t* count);

/** Decodes the first telegram of `bytes`. DPSIM_OK also for an invalid one: `error` says what is wrong; `telegram`
 * is filled if it is valid or only FCS or end delimiter are wrong. `used`, if not NULL, receives the number of bytes
 * taken, for an invalid telegram up to the place of the error. */
DPSIM_API dpsim_status dpsim_telegram_decode(const uint8_t* bytes, size_t count, dpsim_telegram* telegram,
                                             dpsim_decode_error* error, size_t* used);
/** "wrong FCS"; "" for DPSIM_DECODE_OK and other numbers. */
DPSIM_API const char* dpsim_decode_error_text(dpsim_decode_error error);

typedef int32_t dpsim_explain_style;
enum {
  DPSIM_EXPLAIN_LINE = 0,    /**< one line: "2 -> 5  SRD high FCB=1 FCV=1  Slave_Diag request" */
  DPSIM_EXPLAIN_SERVICE = 1, /**< the service: "Slave_Diag"; empty for FDL status and the like */
  DPSIM_EXPLAIN_BYTES = 2    /**< a line for each byte: offset, value, meaning, as `dsdpv1-sim decode` prints them */
};

/** Describes the first telegram of `bytes`; an invalid one as far as it was understood, then the error. `dpv1` says
 * whether the slave is parameterised for DPV1, which decides how a device related diagnosis is read: 1, 0, or -1 for
 * unknown (both ways are shown). */
DPSIM_API dpsim_status dpsim_telegram_explain(const uint8_t* bytes, size_t count, dpsim_explain_style style,
                                              int32_t dpv1, const char** text);

/** A telegram as received by the monitor of a bus or run. */
typedef struct dpsim_heard {
  uint64_t start; /**< tick of the falling edge of its first start bit */
  uint64_t end;   /**< end of its last stop bit */
  uint64_t tsdr;  /**< for an answer: ticks from the end of the request; else DPSIM_NEVER */
  const uint8_t* bytes;
  uint16_t count;           /**< of `bytes` */
  uint8_t station;          /**< the answering station; for SC the station that was asked; 255: not an answer */
  uint8_t character_errors; /**< 1: a parity bit or stop bit was wrong */
  dpsim_decode_error error;
  int32_t baud; /**< index of the rate, see dpsim_baud */
} dpsim_heard;

/** Called at the end of each telegram, valid or not. */
typedef void (*dpsim_telegram_fn)(void* user, const dpsim_heard* heard);

#ifdef __cplusplus
}
#endif

/* NOLINTEND(modernize-use-using) */

#endif
