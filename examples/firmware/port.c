/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 */
/* Selects the port. */
#include "examples/firmware/port.h"

#include "examples/firmware/board.h"
#include "examples/firmware/spi_port.h"
#include "examples/firmware/straps.h"
#include "examples/firmware/uart_port.h"

static volatile uint32_t lost;

uint32_t port_lost(void) { return lost; }

void port_note_lost(void) { ++lost; }

void port_pause(void* ctx, uint32_t ns) {
  (void)ctx;
  const uint32_t since = DWT->CYCCNT, cycles = ns * BOARD_HCLK_MHZ / 1000u + 1u;
  while (DWT->CYCCNT - since < cycles) {
  }
}

dsdpv1_error port_open(dsdpv1_device* chip, const dsdpv1_port* parallel, const dsdpv1_judge* judge) {
  switch (straps()->mode) {
    case kModeSpi: return dsdpv1_open_spi(chip, spi_port_start(), judge);
    case kModeUart: return dsdpv1_open_uart(chip, uart_port_start(), judge);
    default: return dsdpv1_open(chip, parallel, judge);
  }
}
