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
 * Then everything is as on the parallel port. There is no ownership (UA6): what the driver calls a hold is a series of
 * telegrams, between which the chip works on. Inputs, diagnosis and acyclic answers go as exchange telegrams, which set
 * the chip's flag with the block. Blocks of the chip are announced in the reply to an exchange with inputs (UA10),
 * which clears their flag; the driver notes them, and where it has to clear a flag without new inputs it sends those
 * that the DPRAM has once more. What the chip writes in several telegrams' time is checked with the CRC in the DPRAM.
 *
 * Telegrams without a right reply are sent again (tuning.telegram_retries) after a silence. When the reply to an
 * exchange is destroyed, the chip has cleared a flag all the same (UA11): the driver compares B00E and B00F before and
 * after. A block that came within that very exchange cannot be seen; its master repeats it.
 */
/* NOLINTBEGIN(modernize-deprecated-headers, modernize-use-using): C, also when included by C++ */
#include "dsdpv1_serial.h"

#ifdef __cplusplus
extern "C" {
#endif

#define DSDPV1_UART_TELEGRAM 257u /* the longest telegram */

/*
 * The port, static or as long-lived as the device: the driver keeps its telegrams in it. What stands above the line is
 * set before dsdpv1_open_uart.
 */
typedef struct dsdpv1_uart {
  void* ctx; /* handed to the functions */
  /*
   * Sends `n` characters (1..DSDPV1_UART_TELEGRAM) without a pause: 8 data bits, even parity, 1 stop bit. Returns when
   * the last one is sent, not before 12 bit times before its end. False when that could not be done; it is tried again.
   */
  bool (*send)(void* ctx, const uint8_t* bytes, uint16_t n);
  /*
   * Receives up to `n` characters: returns when they are there, or when `timeout_us` have passed without one. Their
   * number. What comes between two calls is kept (a FIFO, a buffer); characters with an error are left out.
   */
  uint16_t (*receive)(void* ctx, uint8_t* bytes, uint16_t n, uint32_t timeout_us);
  /*
   * Lets at least `ns` pass. May be null when polling without a pause is welcome, and a bit time passes anyway between
   * the return of `receive` and the start bit of the next telegram.
   */
  void (*pause)(void* ctx, uint32_t ns);
  uint32_t baud;     /* bit/s, 9600..1843200 (pins UBR) */
  uint8_t address;   /* of the chip: 1 or 2 (pins ADR) */
  uint16_t interval; /* half characters of silence that end a telegram (UA3); 0: 7 */
  uint16_t tsdr;     /* bit times until a reply (UA4), as B01A; 0: 11 */
  bool block_crc;    /* the chip judges the CRCs of blocks in the DPRAM, too (SP15) */
  /* ---------------------------------------------------------------------------------------------- the driver's own */
  dsdpv1_serial serial;
  uint8_t at_risk[2];   /* flags of B00E, B00F that stood when the reply to an exchange was destroyed */
  uint8_t news[2];      /* flags of B00E, B00F that replies have carried and nobody has asked for yet */
  uint16_t outputs_crc; /* of the outputs given to the application last, or the start value */
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
