/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 */
#ifndef BENCH_TELEGRAMS_H
#define BENCH_TELEGRAMS_H
/* Telegrams over SPI and UART that go wrong because a scenario asks for it. */
#include <stdint.h>

/* Puts itself before the functions of the port that is open. Once, when it is. */
void bench_telegrams_start(void);
/* The next telegrams go wrong: DSDPV1_SPOIL_ of the mailbox. */
void bench_spoil(uint8_t which, uint32_t times);

#endif /* BENCH_TELEGRAMS_H */
