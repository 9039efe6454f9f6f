/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 */
#ifndef BENCH_H
#define BENCH_H
/*
 * The bench's side door (board/firmware/mailbox.h): what a scenario's script wants of the user CPU. A product
 * leaves out bench.c, bench_faults.c and bench_telegrams.c, and their calls in main.c.
 */
#include <stdbool.h>

#include "driver/dsdpv1.h"

/* Carries out the commands that the bench has posted, in order; all that there are. */
void bench_run_commands(dsdpv1_device* chip);
/* Between the commands "stop" and "resume". */
bool bench_stopped(void);

#endif /* BENCH_H */
