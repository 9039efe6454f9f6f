/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Firmware of a simple PROFIBUS-DP slave: STM32F103ZE and a chip of the SPC3 family. It initialises the chip, judges
 * the master's blocks, exchanges inputs and outputs at a fixed period and serves the user watchdog. When the chip has
 * gone OFFLINE it begins again.
 *
 *   PC0..PC6  station address; 0, without switches, stands for 3
 *   PB0       high: the main loop polls; low: X/INT has a handler, which judges
 *   PA0       key: external diagnosis
 */
#include "examples/firmware/board.h"
#include "examples/firmware/console.h"
#include "examples/firmware/spc3/cyclic.h"
#include "examples/firmware/spc3/planted.h"
#include "examples/firmware/spc3/station.h"

enum { kPeriodNs = 100000 };

static void turn(spc3_device* chip) {
  station_service();
  if (planted_fetches()) cyclic_fetch(chip);
  if (planted_gives()) cyclic_give(chip);
  spc3_serve_watchdog(chip);
  station_watch_key();
  planted_turn(chip);
}

static void wait_until(uint64_t due) {
  console_poll();
  while (board_now() < due) {
    if (!console_busy()) board_sleep(due);
    console_poll();
  }
}

/* A long handler must not cause a burst of turns. */
static uint64_t next_turn(uint64_t due, uint64_t period) {
  const uint64_t now = board_now();
  return due + period < now ? now : due + period;
}

int main(void) {
  board_start();
  board_release_chip();
  planted_start();
  spc3_device* chip = station_open();
  const uint64_t period = board_cycles(kPeriodNs);
  console_text("SPC3 example firmware\r\n");
  for (;;) {
    station_bring_up();
    for (uint64_t due = board_now(); !station_is_offline(); due = next_turn(due, period)) {
      wait_until(due);
      turn(chip);
    }
  }
}
