/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 */
#ifndef BENCH_H
#define BENCH_H
/*
 * Commands of the bench (board/firmware/mailbox.h): the actions of a scenario's script for the user CPU. A product
 * omits bench.c, bench_faults.c and bench_telegrams.c, and their calls in main.c.
 */
#include <stdbool.h>

#include "driver/dsdpv1.h"

/* Executes all commands posted by the bench, in order. */
void bench_run_commands(dsdpv1_device* chip);
/* True between the commands "stop" and "resume". */
bool bench_stopped(void);

#endif /* BENCH_H */
