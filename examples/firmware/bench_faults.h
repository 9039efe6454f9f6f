/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 */
#ifndef BENCH_FAULTS_H
#define BENCH_FAULTS_H
/* What firmware must not do, done on purpose because a scenario asks for it. */
#include <stdint.h>

#include "driver/dsdpv1.h"

/* The board's port, with a way to spoil CRCs. For dsdpv1_open. */
extern const dsdpv1_port bench_port;

/* Takes the DPRAM by the rules and keeps it far too long. */
void bench_hold(dsdpv1_device* chip, uint64_t ns);
/* Raises R_STA so long after R_REQ without a look at the chip's lines (against H2), and lowers both after the hold. */
void bench_early_r_sta(uint64_t after_ns, uint64_t hold_ns);
/* The next blocks of that area (DSDPV1_AREA_) go out with a wrong CRC. */
void bench_wrong_crc(uint8_t area, uint32_t times);

#endif /* BENCH_FAULTS_H */
