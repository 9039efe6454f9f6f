/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 */
#ifndef BENCH_TELEGRAMS_H
#define BENCH_TELEGRAMS_H
/* Disturbs telegrams over SPI and UART on request of a scenario. */
#include <stdint.h>

/* Wraps the functions of the open port. Call it once, after opening it. */
void bench_telegrams_start(void);
/* Disturbs the next telegrams: DSDPV1_SPOIL_ of the mailbox. */
void bench_spoil(uint8_t which, uint32_t times);

#endif /* BENCH_TELEGRAMS_H */
