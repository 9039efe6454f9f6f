/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 */
/* A device maker writes this for their MCU. */
#include "examples/firmware/spc3/port.h"

#include <stddef.h>

#include "examples/firmware/spc3/planted.h"
#include "examples/firmware/stm32f103.h"

static volatile uint8_t* cell(uint16_t address) { return (volatile uint8_t*)(FSMC_BANK1_NE1 + address); }

static uint8_t port_read(void* ctx, uint16_t address) {
  (void)ctx;
  return *cell(address);
}

static void port_write(void* ctx, uint16_t address, uint8_t value) {
  (void)ctx;
  if (planted_write(address, &value)) *cell(address) = value;
}

const spc3_port port_stm32 = {NULL, port_read, port_write};
