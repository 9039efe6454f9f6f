/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 */
#ifndef BENCH_FAULTS_H
#define BENCH_FAULTS_H
/* Deliberate mistakes of firmware, requested by a scenario. */
#include <stdint.h>

#include "driver/dsdpv1.h"

/* The board's port, with the option to write wrong CRCs. For dsdpv1_open. */
extern const dsdpv1_port bench_port;

/* Takes the DPRAM correctly and keeps it far too long. */
void bench_hold(dsdpv1_device* chip, uint64_t ns);
/* Raises R_STA so long after R_REQ without sampling the chip's lines (against H2), and lowers both after the hold. */
void bench_early_r_sta(uint64_t after_ns, uint64_t hold_ns);
/* Writes the next blocks of that area (DSDPV1_AREA_) with a wrong CRC. */
void bench_wrong_crc(uint8_t area, uint32_t times);

#endif /* BENCH_FAULTS_H */
