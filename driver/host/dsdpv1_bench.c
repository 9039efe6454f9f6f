/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 OR MIT */
#ifndef _GNU_SOURCE
#define _GNU_SOURCE /* dl_iterate_phdr */
#endif
#include "driver/host/dsdpv1_bench.h"

#include <errno.h>
#include <link.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <unwind.h>

#include "driver/host/dsdpv1_bench_wire.h"

/* The address from which a function of this file was called. */
#define CALLER ((uint64_t)(uintptr_t)__builtin_return_address(0))

static int bench = -1;
static uint64_t now; /* ticks, as of the last answer */
static void (*handler)(void);
static bool disabled, in_handler, fallen;

/* -------------------------------------------------------------------------------------------------------- connection
 */

/* The bench has closed the connection: the run has ended. */
static void end(void) { exit(EXIT_SUCCESS); }

static void send_bytes(const void* bytes, size_t n) {
  for (const char* at = bytes; n != 0u;) {
    const ssize_t sent = send(bench, at, n, MSG_NOSIGNAL);
    if (sent < 0 && errno == EINTR) continue;
    if (sent <= 0) end();
    at += sent;
    n -= (size_t)sent;
  }
}

static void receive_bytes(void* bytes, size_t n) {
  for (char* at = bytes; n != 0u;) {
    const ssize_t received = recv(bench, at, n, 0);
    if (received < 0 && errno == EINTR) continue;
    if (received <= 0) end();
    at += received;
    n -= (size_t)received;
  }
}

/* The addresses that lead to a function of this file, from that of its caller on. */
typedef struct trace {
  uint64_t from;
  uint64_t callers[DSDPV1_BENCH_CALLERS];
  uint32_t count;
} trace;

static _Unwind_Reason_Code add_caller(struct _Unwind_Context* context, void* to) {
  trace* const all = to;
  const uint64_t address = (uint64_t)_Unwind_GetIP(context);
  if (all->count == 0u && address != all->from) return _URC_NO_REASON; /* within this file */
  all->callers[all->count++] = address;
  return all->count < DSDPV1_BENCH_CALLERS ? _URC_NO_REASON : _URC_END_OF_STACK;
}

static trace trace_from(uint64_t from) {
  trace all = {from, {0}, 0};
  (void)_Unwind_Backtrace(add_caller, &all);
  if (all.count == 0u) all.callers[all.count++] = from; /* compiled without tables for this */
  return all;
}

/* `from`: 0, or who called. */
static dsdpv1_bench_answer ask(dsdpv1_bench_request request, const void* bytes, uint64_t from) {
  char message[sizeof request + sizeof(uint64_t) * DSDPV1_BENCH_CALLERS];
  dsdpv1_bench_answer answer;
  if (from != 0u) {
    const trace all = trace_from(from);
    request.callers = all.count;
    memcpy(message + sizeof request, all.callers, sizeof(uint64_t) * all.count);
  }
  memcpy(message, &request, sizeof request);
  send_bytes(message, sizeof request + sizeof(uint64_t) * request.callers);
  if (request.length != 0u) send_bytes(bytes, request.length);
  receive_bytes(&answer, sizeof answer);
  now = answer.now;
  fallen = fallen || answer.intr0 != 0u;
  return answer;
}

/* The first one is the program. */
static int take_load_address(struct dl_phdr_info* info, size_t size, void* to) {
  (void)size;
  *(uint64_t*)to = (uint64_t)info->dlpi_addr;
  return 1;
}

static void connect_to_bench(void) {
  uint64_t load_address = 0;
  const char* number = getenv(DSDPV1_BENCH_VARIABLE);
  if (number == NULL) {
    (void)fputs("this program is started by dsdpv1-sim: user_cpu: {kind: process, program: ...} in a scenario\n",
                stderr);
    exit(2);
  }
  bench = (int)strtol(number, NULL, 10);
  (void)setvbuf(stdout, NULL, _IOLBF, 0);
  (void)dl_iterate_phdr(take_load_address, &load_address);
  const dsdpv1_bench_request hello = {DSDPV1_BENCH_HELLO, 0, DSDPV1_BENCH_VERSION, 0, load_address, 0, 0};
  (void)ask(hello, NULL, 0);
}

/* -------------------------------------------------------------------------------------------------------- interrupts
 */

static bool open_for_interrupts(void) { return handler != NULL && !disabled && !in_handler; }

static void serve_interrupt(void) {
  while (fallen && open_for_interrupts()) {
    fallen = false;
    in_handler = true;
    handler();
    in_handler = false;
  }
}

void dsdpv1_bench_on_intr0(void (*function)(void)) {
  handler = function;
  fallen = false;
}

bool dsdpv1_bench_enable_interrupts(bool enabled) {
  const bool before = !disabled;
  disabled = !enabled;
  serve_interrupt();
  return before;
}

static dsdpv1_bench_answer call(dsdpv1_bench_request request, const void* bytes, uint64_t from) {
  if (bench < 0) connect_to_bench();
  const dsdpv1_bench_answer answer = ask(request, bytes, from);
  if (answer.length == 0u) serve_interrupt();
  return answer;
}

static uint32_t do_one(uint32_t what, uint32_t address, uint32_t value, uint64_t from) {
  const dsdpv1_bench_request request = {what, address, value, 0, 0, 0, 0};
  return call(request, NULL, from).value;
}

/* -------------------------------------------------------------------------------------------------------------- time
 */

static uint64_t ticks_of(uint64_t ns) { return ns * DSDPV1_BENCH_TICKS_PER_NS; }

uint64_t dsdpv1_bench_now_ns(void) {
  if (bench < 0) connect_to_bench();
  return now / DSDPV1_BENCH_TICKS_PER_NS;
}

static void wait_ticks(uint64_t ticks, uint64_t from) {
  if (bench < 0) connect_to_bench();
  const uint64_t until = now + ticks;
  while (now < until) {
    const dsdpv1_bench_request request = {DSDPV1_BENCH_WAIT, 0, open_for_interrupts() ? 1u : 0u, 0, until - now, 0, 0};
    (void)call(request, NULL, from);
  }
}

void dsdpv1_bench_wait_ns(uint64_t ns) { wait_ticks(ticks_of(ns), CALLER); }

void dsdpv1_bench_pause(void* ctx, uint32_t ns) {
  (void)ctx;
  wait_ticks(ticks_of(ns), CALLER);
}

bool dsdpv1_bench_wait_intr0(uint64_t ns) {
  if (bench < 0) connect_to_bench();
  const uint64_t until = now + ticks_of(ns);
  while (!fallen && now < until) {
    const dsdpv1_bench_request request = {DSDPV1_BENCH_WAIT, 0, 1, 0, until - now, 0, 0};
    (void)ask(request, NULL, CALLER);
  }
  const bool fell = fallen;
  fallen = false;
  return fell;
}

/* ----------------------------------------------------------------------------------------------------- parallel port
 */

static uint8_t read_cell(void* ctx, uint16_t address) {
  (void)ctx;
  return (uint8_t)do_one(DSDPV1_BENCH_READ, address, 0, CALLER);
}

static void write_cell(void* ctx, uint16_t address, uint8_t value) {
  (void)ctx;
  (void)do_one(DSDPV1_BENCH_WRITE, address, value, CALLER);
}

static void set_r_req(void* ctx, bool level) {
  (void)ctx;
  (void)do_one(DSDPV1_BENCH_R_REQ, 0, level ? 1u : 0u, CALLER);
}

static void set_r_sta(void* ctx, bool level) {
  (void)ctx;
  (void)do_one(DSDPV1_BENCH_R_STA, 0, level ? 1u : 0u, CALLER);
}

static bool get_l_req(void* ctx) {
  (void)ctx;
  return do_one(DSDPV1_BENCH_L_REQ, 0, 0, CALLER) != 0u;
}

static bool get_l_sta(void* ctx) {
  (void)ctx;
  return do_one(DSDPV1_BENCH_L_STA, 0, 0, CALLER) != 0u;
}

const dsdpv1_port dsdpv1_bench_port = {NULL,      read_cell, write_cell, set_r_req,
                                       set_r_sta, get_l_req, get_l_sta,  dsdpv1_bench_pause};

/* ------------------------------------------------------------------------------------------------------ serial ports
 */

static uint16_t take_bytes(const dsdpv1_bench_answer* answer, uint8_t* bytes) {
  receive_bytes(bytes, answer->length);
  serve_interrupt();
  return (uint16_t)answer->length;
}

bool dsdpv1_bench_exchange(void* ctx, const uint8_t* out, uint8_t* in, uint16_t n) {
  (void)ctx;
  const dsdpv1_bench_request request = {DSDPV1_BENCH_EXCHANGE, 0, 0, n, 0, 0, 0};
  const dsdpv1_bench_answer answer = call(request, out, CALLER);
  return take_bytes(&answer, in) == n;
}

bool dsdpv1_bench_send(void* ctx, const uint8_t* bytes, uint16_t n) {
  (void)ctx;
  const dsdpv1_bench_request request = {DSDPV1_BENCH_SEND, 0, 0, n, 0, 0, 0};
  (void)call(request, bytes, CALLER);
  return true;
}

uint16_t dsdpv1_bench_receive(void* ctx, uint8_t* bytes, uint16_t n, uint32_t timeout_us) {
  (void)ctx;
  const dsdpv1_bench_request request = {DSDPV1_BENCH_RECEIVE, 0, n, 0, ticks_of((uint64_t)timeout_us * 1000u), 0, 0};
  const dsdpv1_bench_answer answer = call(request, NULL, CALLER);
  return take_bytes(&answer, bytes);
}
