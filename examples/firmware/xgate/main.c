/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Firmware of a simple PROFIBUS-DP slave: STM32F103ZE and an XGate-DPS10, by UART or, with XGATE_SPI, by SPI. Address
 * 8, 2 bytes of inputs, which are the outputs of the exchange before, and 2 of outputs.
 */
#include <stddef.h>

#include "examples/firmware/board.h"
#include "examples/firmware/console.h"
#include "examples/firmware/xgate/port.h"

enum { kAddress = 8, kIdent = 0x0F01, kInputs = 2, kOutputs = 2 };
enum { kStartNs = 11000000, kRetryNs = 1000000 }; /* the module's own start takes 10 ms (X18) */

static xgate_module module;
static uint8_t process[XGATE_MAX_DATA];

static void say(const char* text) {
  console_text(text);
  while (console_busy()) console_poll();
}

static void initialise(void) {
  const xgate_config config = {
      .address = kAddress,
      .ident = kIdent,
      .inputs = kInputs,
      .outputs = kOutputs,
      .cfg = {0x11, 0x21},
      .cfg_length = 2,
  };
  while (xgate_initialise(&module, &config) != XGATE_OK) board_wait(board_cycles(kRetryNs));
  say("initialised\r\n");
}

/* XGATE_ERR_MODULE: there is no master yet (table 4.13). Silence: the module has lost its power. */
static void exchange(void) {
  uint8_t length = 0;
  const xgate_result result = xgate_exchange(&module, process, kInputs, process, sizeof process, &length);
  if (result == XGATE_ERR_MODULE) board_wait(board_cycles(kRetryNs));
  if (result == XGATE_ERR_SILENT) {
    say("no answer\r\n");
    initialise();
  }
}

int main(void) {
  const xgate_application none = {NULL, NULL, NULL, NULL}; /* requests of C1 and C2 are refused */
  board_start();
  port_start();
  board_release_chip();
  board_wait(board_cycles(kStartNs));
  (void)xgate_open(&module, &port_stm32, &none);
  say("XGate example firmware\r\n");
  initialise();
  for (;;) exchange();
}
