/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 OR MIT */
#ifndef DSDPV1_BENCH_H
#define DSDPV1_BENCH_H
/*
 * Ports for firmware that is compiled for the PC and runs as a station's user CPU in dsdpv1-sim:
 *
 *   user_cpu: {kind: process, program: ./my_firmware}
 *
 *   dsdpv1_open(&chip, &dsdpv1_bench_port, &judge);
 *
 * or, over SPI and UART of a DSDPV1-RSU,
 *
 *   static dsdpv1_spi spi = {.exchange = dsdpv1_bench_exchange, .pause = dsdpv1_bench_pause, .address = 1};
 *   static dsdpv1_uart uart = {.send = dsdpv1_bench_send, .receive = dsdpv1_bench_receive,
 *                              .pause = dsdpv1_bench_pause, .address = 1, .baud = 1843200};
 *
 * Simulated time passes only in calls of this file, each as long as the scenario's `user_cpu: {timing: ...}` says, so a
 * loop of the program needs one. What the program writes to stdout is in the run's log.
 * docs/tutorials/c_driver_on_host.md.
 *
 * C99 and Linux. The program has one thread that calls these functions. If it was not started by dsdpv1-sim, the first
 * call says so and ends it with exit code 2; it ends with 0 when the run does.
 */
/* NOLINTBEGIN(modernize-deprecated-headers, modernize-use-using): C, also when included by C++ */
#include "driver/dsdpv1.h"
#include "driver/dsdpv1_spi.h"
#include "driver/dsdpv1_uart.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The parallel port: each function is one access or one pin. */
extern const dsdpv1_port dsdpv1_bench_port;

/* Functions of dsdpv1_spi and dsdpv1_uart. `ctx` is not used. */
bool dsdpv1_bench_exchange(void* ctx, const uint8_t* out, uint8_t* in, uint16_t n);
bool dsdpv1_bench_send(void* ctx, const uint8_t* bytes, uint16_t n);
uint16_t dsdpv1_bench_receive(void* ctx, uint8_t* bytes, uint16_t n, uint32_t timeout_us);
void dsdpv1_bench_pause(void* ctx, uint32_t ns);

/* Simulated time since the begin of the run, in ns. Takes none. */
uint64_t dsdpv1_bench_now_ns(void);

/* Lets `ns` pass. The handler of INTR0 runs meanwhile, and its time counts. */
void dsdpv1_bench_wait_ns(uint64_t ns);

/*
 * `handler` runs after INTR0 has fallen: at the end of the access that is going on, or at once in a wait, `timing:
 * {interrupt_latency: ...}` later. Not within itself and not while interrupts are disabled: then right afterwards, once
 * for any number of edges. Null: none.
 */
void dsdpv1_bench_on_intr0(void (*handler)(void));

/* Returns whether they were enabled before. Initially they are. */
bool dsdpv1_bench_enable_interrupts(bool enabled);

/* Waits until INTR0 has fallen since the last call, but at most `ns`. Returns whether it has; for programs without a
 * handler. */
bool dsdpv1_bench_wait_intr0(uint64_t ns);

#ifdef __cplusplus
}
#endif

/* NOLINTEND(modernize-deprecated-headers, modernize-use-using) */

#endif /* DSDPV1_BENCH_H */
