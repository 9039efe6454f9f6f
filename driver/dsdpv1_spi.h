/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 OR MIT */
#ifndef DSDPV1_SPI_H
#define DSDPV1_SPI_H
/*
 * The driver on the SPI port of a DSDPV1-RSU (M2-PB-SPI): rulings SP1 to SP18 in docs/chip_rsu.md.
 *
 *   static dsdpv1_spi spi = {.exchange = xss_frame, .address = 1};
 *   dsdpv1_open_spi(&chip, &spi, &judge);
 *
 * All other calls are as on the parallel port. A hold is a claim by B014 (SP12), repeated while the chip is in an
 * access (reply E0 + address, code 00). One telegram reads or writes a block; dsdpv1_exchange writes inputs and
 * fetches new outputs in one read-and-write telegram. Telegrams without a valid reply are repeated
 * (tuning.telegram_retries). The chip needs 2.7 us between a write telegram and the next frame (SP9): at clocks up
 * to 11.8 MHz the four bytes of the reply last that long.
 */
/* NOLINTBEGIN(modernize-deprecated-headers, modernize-use-using): C, also when included by C++ */
#include "dsdpv1_serial.h"

#ifdef __cplusplus
extern "C" {
#endif

#define DSDPV1_SPI_SPARE 16u /* largest `spare` */
/* Longest frame: read and write of 244 bytes each way (248 and 249 bytes). */
#define DSDPV1_SPI_FRAME (248u + 249u + DSDPV1_SPI_SPARE)

/*
 * The port, static or as long-lived as the device: the driver keeps its telegrams in it. Set the members above the
 * line before dsdpv1_open_spi.
 */
typedef struct dsdpv1_spi {
  void* ctx; /* passed to the functions */
  /*
   * One frame: XSS low, `n` bytes (1..DSDPV1_SPI_FRAME) out and in, XSS high. Mode 0, MSB first. `out` and `in` are
   * the same memory: store a byte after sending it. Return false if the frame could not be made; it is repeated.
   */
  bool (*exchange)(void* ctx, const uint8_t* out, uint8_t* in, uint16_t n);
  void (*pause)(void* ctx, uint32_t ns); /* waits at least `ns`; may be null if polling without a pause is acceptable */
  uint8_t address;                       /* of the chip: 1 or 2 (pins ADR) */
  uint8_t spare;  /* 0..DSDPV1_SPI_SPARE: bytes by which a reply may be delayed after the request (SP6) */
  bool block_crc; /* the chip also checks the CRCs of blocks in the DPRAM (SP15) */
  /* ---------------------------------------------------------------------------------------------- the driver's own */
  dsdpv1_serial serial;
  uint8_t bytes[DSDPV1_SPI_FRAME];
} dsdpv1_spi;

/*
 * Prepares `device`; sends no frame. `port` is kept, `judge` copied; `judge` may be null (accept everything).
 * Errors: ARGUMENT (also address or spare out of range).
 */
dsdpv1_error dsdpv1_open_spi(dsdpv1_device* device, dsdpv1_spi* port, const dsdpv1_judge* judge);

#ifdef __cplusplus
}
#endif

/* NOLINTEND(modernize-deprecated-headers, modernize-use-using) */

#endif /* DSDPV1_SPI_H */
