/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 */
/* Straps of the card. */
#include "examples/firmware/straps.h"

#include "examples/firmware/board.h"

static strap_levels levels = {kModeParallel, 0, 0, 0, 1};

/* The pins from `first` on, pulled down. */
static uint8_t read_pins(gpio_registers* port, unsigned first, unsigned count) {
  for (unsigned pin = first; pin < first + count; ++pin) {
    port->BRR = 1u << pin;
    board_pin(port, pin, GPIO_INPUT_PULL);
  }
  return (uint8_t)(port->IDR >> first & ((1u << count) - 1u));
}

void straps_read(void) {
  levels.mode = read_pins(GPIOC, 10, 2);
  levels.address = read_pins(GPIOB, 0, 2);
  levels.rate = read_pins(GPIOD, 8, 3);
  levels.interval = read_pins(GPIOE, 13, 3);
  const bool serial = levels.mode == kModeSpi || levels.mode == kModeUart;
  levels.card = serial && levels.address == 2u ? 2u : 1u;
}

const strap_levels* straps(void) { return &levels; }
