/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 */
#ifndef TELEGRAM_H
#define TELEGRAM_H
/* Telegrams that read and write cells, over SPI and the UART (000 6.2, 7.1.4). */
#include <stdint.h>

enum { kAddress = 1, kRead = 0x00, kWrite = 0x20, kHead = 4, kMostBytes = 512 };

extern uint8_t frame[kMostBytes]; /* the telegram, and its reply */

/* Both return the number of bytes in `frame` so far. */
unsigned head(unsigned start, unsigned address, unsigned count);
unsigned seal(unsigned count); /* appends the CRC */
/* Its CRC is right. */
int is_sealed(const uint8_t* bytes, unsigned count);

#endif /* TELEGRAM_H */
