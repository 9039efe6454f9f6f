/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 OR MIT */
#ifndef DSDPV1_BENCH_WIRE_H
#define DSDPV1_BENCH_WIRE_H
/*
 * What a program and the bench say to each other: over a stream socket, whose number the program finds in
 * DSDPV1_BENCH_FD. The program sends a request, the addresses that it was called from, and its bytes; the bench answers
 * when that has been carried out. Numbers as the machine has them, times in ticks of 1/12 ns.
 */
/* NOLINTBEGIN(modernize-deprecated-headers, modernize-use-using, cppcoreguidelines-macro-usage): C, also in C++ */
#include <stdint.h>

#define DSDPV1_BENCH_VARIABLE "DSDPV1_BENCH_FD"
#define DSDPV1_BENCH_VERSION 2u
#define DSDPV1_BENCH_TICKS_PER_NS 12u
#define DSDPV1_BENCH_CALLERS 12u /* at most, the nearest first */

enum {
  DSDPV1_BENCH_HELLO = 1, /* value: DSDPV1_BENCH_VERSION; ticks: the address at which the program's file begins in
                             memory, less that in the file; the first request */
  DSDPV1_BENCH_READ,      /* address; answer: value */
  DSDPV1_BENCH_WRITE,     /* address, value */
  DSDPV1_BENCH_R_REQ,     /* value: 0, 1 */
  DSDPV1_BENCH_R_STA,
  DSDPV1_BENCH_L_REQ, /* answer: value 0, 1 */
  DSDPV1_BENCH_L_STA,
  DSDPV1_BENCH_WAIT,     /* ticks; value 1: INTR0's fall ends it early */
  DSDPV1_BENCH_EXCHANGE, /* SPI: `length` bytes follow, and the answer */
  DSDPV1_BENCH_SEND,     /* UART: `length` bytes follow */
  DSDPV1_BENCH_RECEIVE /* UART: at most `value` characters, `ticks` without one end it; `length` bytes follow the answer
                        */
};

typedef struct dsdpv1_bench_request {
  uint32_t what, address, value, length;
  uint64_t ticks;
  uint32_t callers; /* return addresses that follow, uint64_t each; then `length` bytes */
  uint32_t unused;
} dsdpv1_bench_request;

typedef struct dsdpv1_bench_answer {
  uint64_t now; /* ticks since the begin of the run */
  uint32_t value, length;
  uint32_t intr0; /* 1: INTR0 has fallen since the last answer */
  uint32_t unused;
} dsdpv1_bench_answer;

/* NOLINTEND(modernize-deprecated-headers, modernize-use-using, cppcoreguidelines-macro-usage) */

#endif /* DSDPV1_BENCH_WIRE_H */
