/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 OR MIT */
#ifndef DSDPV1_UART_H
#define DSDPV1_UART_H
/*
 * The driver on the UART port of a DSDPV1-RSU (M2-PB-UART): rulings UA1 to UA16 in docs/chip_rsu.md.
 *
 *   static dsdpv1_uart uart = {.send = send, .receive = receive, .address = 1, .baud = 1843200};
 *   dsdpv1_open_uart(&chip, &uart, &judge);
 *
 * All other calls are as on the parallel port. There is no ownership (UA6): a hold of the driver is a series of
 * telegrams, between which the chip keeps working. Inputs, diagnosis and acyclic answers are sent as exchange
 * telegrams, which set the chip's flag with the block. Blocks of the chip are announced in the reply to an exchange
 * with inputs (UA10), which clears their flag; the driver notes them. To clear a flag without new inputs, it sends
 * the inputs in the DPRAM once more. Blocks that the chip may change between telegrams are checked with the CRC in
 * the DPRAM.
 *
 * Telegrams without a valid reply are repeated (tuning.telegram_retries) after a silence. If the reply to an
 * exchange is destroyed, the chip has still cleared a flag (UA11): the driver compares B00E and B00F before and
 * after. A block that came within that very exchange cannot be seen; its master repeats it.
 */
/* NOLINTBEGIN(modernize-deprecated-headers, modernize-use-using): C, also when included by C++ */
#include "dsdpv1_serial.h"

#ifdef __cplusplus
extern "C" {
#endif

#define DSDPV1_UART_TELEGRAM 257u /* the longest telegram */

/*
 * The port, static or as long-lived as the device: the driver keeps its telegrams in it. Set the members above the
 * line before dsdpv1_open_uart.
 */
typedef struct dsdpv1_uart {
  void* ctx; /* passed to the functions */
  /*
   * Sends `n` characters (1..DSDPV1_UART_TELEGRAM) without a pause: 8 data bits, even parity, 1 stop bit. Return
   * after the last one, at most 12 bit times before its end. Return false if that was not possible; it is repeated.
   */
  bool (*send)(void* ctx, const uint8_t* bytes, uint16_t n);
  /*
   * Receives up to `n` characters: return their number once they have arrived, or after `timeout_us` without one.
   * Characters that arrive between two calls are kept (a FIFO, a buffer); those with an error are dropped.
   */
  uint16_t (*receive)(void* ctx, uint8_t* bytes, uint16_t n, uint32_t timeout_us);
  /*
   * Waits at least `ns`. May be null if polling without a pause is acceptable, and a bit time passes anyway between
   * the return of `receive` and the start bit of the next telegram.
   */
  void (*pause)(void* ctx, uint32_t ns);
  uint32_t baud;     /* bit/s, 9600..1843200 (pins UBR) */
  uint8_t address;   /* of the chip: 1 or 2 (pins ADR) */
  uint16_t interval; /* half characters of silence that end a telegram (UA3); 0: 7 */
  uint16_t tsdr;     /* bit times until a reply (UA4), as B01A; 0: 11 */
  bool block_crc;    /* the chip also checks the CRCs of blocks in the DPRAM (SP15) */
  /* ---------------------------------------------------------------------------------------------- the driver's own */
  dsdpv1_serial serial;
  uint8_t at_risk[2];     /* flags of B00E, B00F that were set when the reply to an exchange was destroyed */
  bool lost;              /* such a reply may have brought what no look had shown */
  uint8_t answered[2][4]; /* begin of the last answer on C1 and C2, which lies where requests come */
  uint8_t news[2];        /* flags of B00E, B00F that replies have reported and that are not processed yet */
  uint16_t outputs_crc;   /* of the outputs last given to the application, or the start value */
  uint8_t bytes[DSDPV1_UART_TELEGRAM];
} dsdpv1_uart;

/*
 * Prepares `device`; sends nothing. `port` is kept, `judge` copied; `judge` may be null (accept everything). Errors:
 * ARGUMENT (also address or baud out of range).
 */
dsdpv1_error dsdpv1_open_uart(dsdpv1_device* device, dsdpv1_uart* port, const dsdpv1_judge* judge);

#ifdef __cplusplus
}
#endif

/* NOLINTEND(modernize-deprecated-headers, modernize-use-using) */

#endif /* DSDPV1_UART_H */
