/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 */
#ifndef STRAPS_H
#define STRAPS_H
/*
 * The straps of a DSDPV1-RSU, which the board's processor also reads. On a board for a chip without them the pins
 * are open, and the pull-downs select the parallel port of card 1.
 *
 *   PC10, PC11    MODE: 0 parallel, 1 SPI, 2 UART         PD8..PD10     UBR: rate of the UART
 *   PB0, PB1      ADR: 1 or 2, the card                   PE13..PE15    UIV: interval that ends its telegrams
 */
#include <stdint.h>

enum { kModeParallel = 0, kModeSpi = 1, kModeUart = 2 };

typedef struct strap_levels {
  uint8_t mode, address, rate, interval;
  uint8_t card; /* 1 or 2: selects the chip's RESET, INTR0 and SPI */
} strap_levels;

/* Call it once, when the ports have their clocks. */
void straps_read(void);
const strap_levels* straps(void);

#endif /* STRAPS_H */
