/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 */
/* Operation of the chip. */
#include "examples/firmware/spc3/station.h"

#include <stddef.h>

#include "examples/firmware/board.h"
#include "examples/firmware/console.h"
#include "examples/firmware/spc3/cyclic.h"
#include "examples/firmware/spc3/planted.h"
#include "examples/firmware/spc3/port.h"
#include "registers/spc3_regs.h"

/* ------------------------------------------------------------------------------------------------------------ device
 */

/* One module of 2 bytes in and one of 2 bytes out; up to three bytes of user parameters. */
enum { kIdent = 0x0CC9, kUserPrm = 3, kPrmHead = 7, kSsa = 16, kUserWd = 20000 };
static const uint8_t kCfg[] = {0x11, 0x21};

static spc3_device chip;
static struct {
  uint8_t address;
  bool locked, polled;
} station;
static volatile bool offline;

/* Switches, pulled down: PC0 to PC6 the station address, 0 stands for 3; PB0 high: polled, else by X/INT. */
static void read_switches(void) {
  enum { kAddressPins = 7, kUsualAddress = 3 };
  GPIOC->BRR = (1u << kAddressPins) - 1u;
  for (unsigned pin = 0; pin < (unsigned)kAddressPins; ++pin) board_pin(GPIOC, pin, GPIO_INPUT_PULL);
  GPIOB->BRR = 1u;
  board_pin(GPIOB, 0, GPIO_INPUT_PULL);
  station.address = (uint8_t)(GPIOC->IDR & ((1u << kAddressPins) - 1u));
  if (station.address == 0u) station.address = kUsualAddress;
  station.polled = (GPIOB->IDR & 1u) != 0u;
}

/* ----------------------------------------------------------------------------------------------------------- judging
 */

/* A product looks at the bytes from kPrmHead on. */
static bool judge_prm(void* ctx, const uint8_t* bytes, uint8_t length) {
  (void)ctx;
  (void)bytes;
  planted_judging();
  return length <= (unsigned)kPrmHead + (unsigned)kUserPrm;
}

static bool judge_cfg(void* ctx, spc3_cfg* cfg) {
  (void)ctx;
  if (cfg->length != sizeof kCfg || cfg->bytes[0] != kCfg[0] || cfg->bytes[1] != kCfg[1]) return false;
  cfg->output_length = kOutputs;
  cfg->input_length = kInputs;
  return true;
}

/* A product keeps both over power-off. */
static void keep_address(void* ctx, uint8_t address, bool locked, const uint8_t* rest, uint8_t length) {
  (void)ctx;
  (void)rest;
  (void)length;
  station.address = address;
  station.locked = locked;
}

static void service(void) {
  if ((spc3_service(&chip) & SPC3_REG_EVENT_MAC_RESET) != 0u) offline = true;
}

void station_service(void) {
  if (station.polled) service();
}

/* ---------------------------------------------------------------------------------------------------------- bring-up
 */

spc3_device* station_open(void) {
  const spc3_application application = {NULL, judge_prm, judge_cfg, keep_address, NULL};
  read_switches();
  port_start();
  if (spc3_open(&chip, &port_stm32, &application) != SPC3_OK) board_halt();
  return &chip;
}

static spc3_config config(void) {
  const spc3_config values = {
      .address = station.address,
      .address_locked = station.locked,
      .ident = kIdent,
      .max_output = kOutputs,
      .max_input = kInputs,
      .max_diag = 2,
      .max_prm = kPrmHead + kUserPrm,
      .max_cfg = 16,
      .max_ssa = kSsa,
      .cfg = kCfg,
      .cfg_length = sizeof kCfg,
      .sync = true,
      .freeze = true,
      .user_wd = planted_user_wd(kUserWd),
      .interrupts = (uint16_t)(SPC3_REG_EVENT_MAC_RESET | SPC3_REG_EVENT_BAUD_DETECT | SPC3_REG_EVENT_NEW_SSA |
                               SPC3_REG_EVENT_NEW_CFG | SPC3_REG_EVENT_NEW_PRM),
  };
  return values;
}

static void print_error(spc3_error error) {
  console_text("initialise: ");
  console_text(spc3_error_text(error));
  console_text("\r\n");
  while (console_busy()) console_poll();
}

static void initialise(void) {
  spc3_config values = config();
  if (station.polled) values.interrupts = 0;
  for (;;) {
    const spc3_error error = spc3_initialise(&chip, &values);
    if (error == SPC3_OK) return;
    if (error != SPC3_ERR_NOT_OFFLINE) print_error(error); /* no chip, or another one: try again */
    board_wait(board_cycles(error == SPC3_ERR_NOT_OFFLINE ? 10000u : 10000000u));
  }
}

void station_bring_up(void) {
  board_enable_intr0(false);
  initialise();
  offline = false;
  if (planted_first_inputs()) cyclic_give(&chip); /* DATA_EX waits for them (A24) */
  if (!station.polled) board_on_intr0(service);
  planted_before_start(&chip);
  spc3_start(&chip);
}

bool station_is_offline(void) { return offline; }

/* --------------------------------------------------------------------------------------------------------- diagnosis
 */

/* Contacts bounce: a level counts when it is there again after 20 ms. */
void station_watch_key(void) {
  enum { kSettlingNs = 20000000 };
  static const uint8_t kFault[] = {0x02, 0x01}; /* device-related: the header with its length, the fault's number */
  static bool reported, seen;
  static uint64_t look_at;
  if (board_now() < look_at) return;
  look_at = board_now() + board_cycles(kSettlingNs);
  const bool pressed = board_key(), stable = pressed == seen;
  seen = pressed;
  if (!stable || pressed == reported) return;
  if (spc3_set_diagnosis(&chip, pressed ? SPC3_DIAG_EXT : 0u, kFault, pressed ? sizeof kFault : 0u) == SPC3_OK)
    reported = pressed; /* else both buffers are the chip's: next time */
}
