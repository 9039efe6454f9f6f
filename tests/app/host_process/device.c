/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 */
/*
 * device PORT [FAULT]: a device that sends its two bytes of outputs back as inputs and has an object for acyclic reads,
 * over the port "parallel", "spi" or "uart". Faults: "ends" and "crashes" after a hundred turns, "hangs" then without a
 * call of its port, "hasty" raises R_STA at once, "blind" after a while, both without a look at the chip's lines,
 * "early" looks at once, "polls" instead of a handler of INTR0, "keeps" keeps the DPRAM in rest(), "talks" more than a
 * pipe holds.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "driver/dsdpv1_acyclic.h"
#include "driver/dsdpv1_internal.h"
#include "driver/host/dsdpv1_bench.h"

static dsdpv1_device chip;
static dsdpv1_port port;
static dsdpv1_spi spi = {.exchange = dsdpv1_bench_exchange, .pause = dsdpv1_bench_pause, .address = 1};
static dsdpv1_uart uart = {.send = dsdpv1_bench_send,
                           .receive = dsdpv1_bench_receive,
                           .pause = dsdpv1_bench_pause,
                           .address = 1,
                           .baud = 1843200};
static uint8_t process[2];
static const uint8_t cfg[] = {0x11, 0x21};
static uint8_t serial_number[4] = {0, 0, 4, 2};
static const dsdpv1_object object = {.slot = 1,
                                     .index = 1,
                                     .services = DSDPV1_MAY_READ,
                                     .classes = DSDPV1_CLASS_BOTH,
                                     .max_length = sizeof serial_number,
                                     .data = serial_number};
static const dsdpv1_table table = {&object, 1, NULL};
static dsdpv1_acyclic acyclic;
static const char* fault = "";

static bool is(const char* name) { return strcmp(fault, name) == 0; }

static void on_intr0(void) {
  static int falls;
  if (falls++ < 3) printf("INTR0 at %llu us\n", (unsigned long long)(dsdpv1_bench_now_ns() / 1000u));
  dsdpv1_service(&chip);
}

static bool low(void* ctx) {
  (void)ctx;
  return false;
}

static dsdpv1_verdict judge_cfg(void* ctx, const dsdpv1_cfg_block* block) {
  (void)ctx;
  return block->length == sizeof cfg && memcmp(block->bytes, cfg, sizeof cfg) == 0 ? DSDPV1_ACCEPT : DSDPV1_REFUSE;
}

static dsdpv1_error open_port(const char* name) {
  static const dsdpv1_judge judge = {.cfg = judge_cfg};
  port = dsdpv1_bench_port;
  if (is("hasty") || is("blind")) port.get_l_req = port.get_l_sta = low;
  if (is("hasty") || is("early")) port.pause = NULL;
  if (strcmp(name, "spi") == 0) return dsdpv1_open_spi(&chip, &spi, &judge);
  if (strcmp(name, "uart") == 0) return dsdpv1_open_uart(&chip, &uart, &judge);
  return dsdpv1_open(&chip, &port, &judge);
}

void rest(void);

static void fail_as_wanted(void) {
  for (int line = 0; is("talks") && line < 2000; ++line) printf("line %4d %090d\n", line, line);
  if (is("ends")) exit(3);
  if (is("keeps")) {
    dsdpv1_hold(&chip);
    rest();
    dsdpv1_release(&chip);
  }
  if (is("crashes")) abort();
  if (is("hangs"))
    for (;;) {
    }
}

int main(int count, char** arguments) {
  const dsdpv1_config config = {.address = 5,
                                .ident = 0x0CC9,
                                .max_input = 2,
                                .max_output = 2,
                                .freeze = true,
                                .sync = true,
                                .fail_safe = true,
                                .dpv1 = true,
                                .max_prm = 237,
                                .max_cfg = sizeof cfg,
                                .prm_mode = 2,
                                .cfg_mode = 2,
                                .cfg = cfg,
                                .cfg_length = sizeof cfg};
  if (count > 2) fault = arguments[2];
  open_port(arguments[1]);
  dsdpv1_acyclic_open(&acyclic, &chip, &table);
  while (dsdpv1_wait_ready(&chip) != DSDPV1_OK || dsdpv1_initialise(&chip, &config) != DSDPV1_OK) {
  }
  printf("initialised\n");
  if (!is("polls")) dsdpv1_bench_on_intr0(on_intr0);
  dsdpv1_service(&chip);
  for (int turn = 0;; ++turn) {
    dsdpv1_exchange_result result = {.outputs = process, .capacity = sizeof process};
    if (is("polls") && dsdpv1_bench_wait_intr0(0)) dsdpv1_on_intr0(&chip);
    if (dsdpv1_intr0_pending(&chip)) dsdpv1_service(&chip);
    dsdpv1_exchange(&chip, DSDPV1_INPUT_NEWEST, process, sizeof process, &result);
    dsdpv1_acyclic_poll(&acyclic, NULL);
    dsdpv1_bench_wait_ns(100000);
    if (turn == 100) fail_as_wanted();
  }
}
