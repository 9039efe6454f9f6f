/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Firmware of a simple PROFIBUS-DP slave: STM32F103ZE and DSDPV1. It initialises the chip, exchanges inputs and
 * outputs at a fixed period, judges the master's blocks, and answers acyclic requests.
 */
#include "examples/firmware/bench.h"
#include "examples/firmware/bench_faults.h"
#include "examples/firmware/bench_telegrams.h"
#include "examples/firmware/board.h"
#include "examples/firmware/console.h"
#include "examples/firmware/cyclic.h"
#include "examples/firmware/dsdpv1_port_stm32.h"
#include "examples/firmware/fault_key.h"
#include "examples/firmware/objects.h"
#include "examples/firmware/report.h"
#include "examples/firmware/settings.h"
#include "examples/firmware/station.h"

/* Work that is not urgent. */
static void idle(dsdpv1_device* chip) {
  bench_run_commands(chip);
  report_print_errors();
  console_poll();
}

static bool is_idle(uint64_t due) { return bench_stopped() || board_now() < due; }

static void wait_for_turn(dsdpv1_device* chip, uint64_t due) {
  idle(chip);
  while (is_idle(due)) {
    if (!console_busy()) board_sleep(bench_stopped() ? UINT64_MAX : due);
    idle(chip);
  }
}

/* The order matters: judgement first, because the master waits for it; requests, which have no interrupt, last. */
static void turn(dsdpv1_device* chip) {
  station_service_if_pending();
  if (cyclic_exchange(chip)) station_service();
  objects_poll();
  station_service_if_pending(); /* an INTR0 during the exchange found the DPRAM held */
  if (!settings_from_bench()) fault_key_watch();
}

/* A long hold must not cause a burst of turns. */
static uint64_t not_too_late(uint64_t due, uint64_t period) {
  const uint64_t now = board_now();
  return due + period < now ? now - period : due;
}

int main(void) {
  board_start();
  board_release_chip(); /* it needs 85 us, time for the rest of the start-up */
  settings_load();
  dsdpv1_device* chip = station_open(settings_from_bench() ? &bench_port : &port_stm32);
  if (settings_from_bench()) bench_telegrams_start();
  objects_open(chip);
  board_wait(settings_in_cycles()->start_delay);
  station_bring_up();
  report_print_device();
  const uint64_t period = settings_in_cycles()->period;
  for (uint64_t due = board_now();; due += period) {
    wait_for_turn(chip, due);
    due = not_too_late(due, period);
    turn(chip);
  }
}
