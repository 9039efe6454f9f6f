/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 */
/* The driver's port: what a device maker writes for their MCU. */
#include "examples/firmware/dsdpv1_port_stm32.h"

#include <stddef.h>

#include "examples/firmware/board.h"
#include "examples/firmware/port.h"

static uint8_t port_read(void* ctx, uint16_t address) {
  (void)ctx;
  return port_dpram_read(address);
}

static void port_write(void* ctx, uint16_t address, uint8_t value) {
  (void)ctx;
  port_dpram_write(address, value);
}

static void set_pin(uint32_t bit, bool level) {
  GPIOC->BSRR = level ? bit : bit << 16;
  board_barrier();
}

#ifdef DSDPV1_PLANTED_EARLY_R_STA

/*
 * A deliberate mistake for the tests of the bench: R_STA follows R_REQ in the next instruction, without sampling the
 * chip's lines. It works as long as the chip happens to be idle.
 */
static void port_set_r_req(void* ctx, bool level) {
  (void)ctx;
  set_pin(kRReqBit, level);
  set_pin(kRStaBit, level);
}

static void port_set_r_sta(void* ctx, bool level) {
  (void)ctx;
  set_pin(kRStaBit, level);
}

static bool port_get_l_req(void* ctx) {
  (void)ctx;
  return false;
}

static bool port_get_l_sta(void* ctx) {
  (void)ctx;
  return false;
}

#else

/* Ruling H2: from R_REQ's rise to R_STA's at least 170 ns, rounded up to whole cycles. */
enum { kReqToStaCycles = (170 * BOARD_HCLK_MHZ + 999) / 1000 };

static uint32_t asked_at; /* CYCCNT just after R_REQ changed */

static void let_pass(uint32_t since, uint32_t cycles) {
  while (DWT->CYCCNT - since < cycles) {
  }
}

static void port_set_r_req(void* ctx, bool level) {
  (void)ctx;
  set_pin(kRReqBit, level);
  asked_at = DWT->CYCCNT;
}

static void port_set_r_sta(void* ctx, bool level) {
  (void)ctx;
  if (level) let_pass(asked_at, kReqToStaCycles);
  set_pin(kRStaBit, level);
}

static bool port_get_l_req(void* ctx) {
  (void)ctx;
  return (GPIOC->IDR & kLReqBit) != 0u;
}

static bool port_get_l_sta(void* ctx) {
  (void)ctx;
  return (GPIOC->IDR & kLStaBit) != 0u;
}

#endif

const dsdpv1_port port_stm32 = {NULL,           port_read,      port_write,     port_set_r_req,
                                port_set_r_sta, port_get_l_req, port_get_l_sta, port_pause};
