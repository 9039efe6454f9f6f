/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 */
/* Faults at the handshake and in the DPRAM. */
#include "examples/firmware/bench_faults.h"

#include <stddef.h>

#include "board/firmware/mailbox.h"
#include "driver/dsdpv1_internal.h"
#include "examples/firmware/board.h"
#include "examples/firmware/dsdpv1_port_stm32.h"
#include "examples/firmware/port.h"
#include "examples/firmware/report.h"
#include "examples/firmware/straps.h"
#include "registers/dsdpv1_regs.h"

/* ------------------------------------------------------------------------------------------------------- wrong CRCs */

static struct {
  uint16_t address; /* of the CRC's high byte */
  uint32_t times;
} wrong_crcs[] = {[DSDPV1_AREA_INIT] = {DSDPV1_REG_INIT_CRC, 0},
                  [DSDPV1_AREA_INPUTS] = {DSDPV1_REG_INPUT_CRC, 0},
                  [DSDPV1_AREA_DIAGNOSIS] = {DSDPV1_REG_DIAG_CRC, 0},
                  [DSDPV1_AREA_C1_ANSWER] = {DSDPV1_REG_C1_CRC, 0},
                  [DSDPV1_AREA_C2_ANSWER] = {DSDPV1_REG_C2_CRC, 0}};
enum { kAreas = sizeof wrong_crcs / sizeof wrong_crcs[0] };

static bool any_wrong; /* one test per write on a board without faults */

void bench_wrong_crc(uint8_t area, uint32_t times) {
  if (area < kAreas) {
    wrong_crcs[area].times = times;
    any_wrong = true;
  }
}

static uint8_t spoil(uint16_t address, uint8_t value) {
  bool more = false;
  for (unsigned area = 0; area < kAreas; ++area) {
    if (wrong_crcs[area].times != 0u && wrong_crcs[area].address == address) {
      --wrong_crcs[area].times;
      value ^= 0x01u;
    }
    more = more || wrong_crcs[area].times != 0u;
  }
  any_wrong = more;
  return value;
}

static void write(void* ctx, uint16_t address, uint8_t value) {
  (void)ctx;
  port_dpram_write(address, any_wrong ? spoil(address, value) : value);
}

/* Other accesses go directly to the board. */
static uint8_t read(void* ctx, uint16_t address) {
  (void)ctx;
  return port_dpram_read(address);
}
static void set_r_req(void* ctx, bool level) { port_stm32.set_r_req(ctx, level); }
static void set_r_sta(void* ctx, bool level) { port_stm32.set_r_sta(ctx, level); }
static bool get_l_req(void* ctx) { return port_stm32.get_l_req(ctx); }
static bool get_l_sta(void* ctx) { return port_stm32.get_l_sta(ctx); }
const dsdpv1_port bench_port = {NULL, read, write, set_r_req, set_r_sta, get_l_req, get_l_sta, port_pause};

/* -------------------------------------------------------------------------------------------------------- handshake */

/* Over SPI: claims through the driver. */
static void claim_for(dsdpv1_device* chip, uint64_t ns) {
  if (!report_check(dsdpv1_hold(chip), DSDPV1_DURING_EXCHANGE)) return;
  board_wait(board_cycles(ns));
  report_check(dsdpv1_release(chip), DSDPV1_DURING_EXCHANGE);
}

/* On the memory bus, without the driver, whose holds are as short as possible. */
void bench_hold(dsdpv1_device* chip, uint64_t ns) {
  if (straps()->mode != kModeParallel) {
    claim_for(chip, ns);
    return;
  }
  board_enable_intr0(false);
  port_stm32.set_r_req(NULL, true);
  while (port_stm32.get_l_req(NULL) || port_stm32.get_l_sta(NULL)) {
  }
  port_stm32.set_r_sta(NULL, true);
  board_wait(board_cycles(ns));
  port_stm32.set_r_sta(NULL, false);
  port_stm32.set_r_req(NULL, false);
  board_enable_intr0(true);
}

/* Both stores are adjacent at every optimisation level: one cycle from pin to pin. */
static void raise_both(void) {
  const uint32_t r_req = kRReqBit;
  const uint32_t r_sta = kRStaBit;
  __asm__ volatile("str %1, [%0]\n\tstr %2, [%0]" ::"r"(&GPIOC->BSRR), "r"(r_req), "r"(r_sta) : "memory");
}

static void raise_one_after_the_other(uint32_t cycles) {
  const uint32_t start = DWT->CYCCNT;
  GPIOC->BSRR = kRReqBit;
  while (DWT->CYCCNT - start < cycles) {
  }
  GPIOC->BSRR = kRStaBit;
}

/* Four cycles a pass, then a cycle for each that is left: a loop that reads CYCCNT has no finer step than ten. */
static void spend(uint32_t cycles) {
  enum { kPass = 4 };
  for (uint32_t left = cycles / kPass; left != 0u; --left) __asm__ volatile("");
  switch (cycles % kPass) {
    case 3: __asm__ volatile("nop\n\tnop\n\tnop"); break;
    case 2: __asm__ volatile("nop\n\tnop"); break;
    case 1: __asm__ volatile("nop"); break;
    default: break;
  }
}

/*
 * The chip accesses the DPRAM once a microsecond, 72 cycles, and at once after a release. Waits a cycle longer each
 * time, so that some of a series coincide with an access.
 */
static void wander(void) {
  enum { kSteps = 97 };
  static uint32_t step;
  spend(step);
  step = (step + 1u) % kSteps;
}

void bench_early_r_sta(uint64_t after_ns, uint64_t hold_ns) {
  const uint64_t after = board_cycles(after_ns);
  const uint64_t hold = board_cycles(hold_ns);
  enum { kLoop = 10 }; /* reading CYCCNT takes about as long */
  board_enable_intr0(false);
  wander();
  if (after < kLoop)
    raise_both();
  else
    raise_one_after_the_other((uint32_t)after);
  board_wait(hold);
  GPIOC->BRR = kRStaBit;
  GPIOC->BRR = kRReqBit;
  board_enable_intr0(true);
}
