/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 */
/* External diagnosis from a key. */
#include "examples/firmware/fault_key.h"

#include <stdint.h>

#include "examples/firmware/board.h"
#include "examples/firmware/station.h"

/* Contacts bounce for some milliseconds; only a stable level counts. */
enum { kSettlingMs = 20 };

static bool reported, candidate;
static uint64_t since;

/* One device-related block of two bytes: the header with its length, and the number of the fault. */
static void report_fault(bool present) {
  static const uint8_t kFault[] = {0x02, 0x01};
  if (present)
    station_set_diagnosis(DSDPV1_DIAG_EXTERNAL, kFault, sizeof kFault);
  else
    station_set_diagnosis(DSDPV1_DIAG_EXTERNAL_GONE, NULL, 0);
}

void fault_key_watch(void) {
  const bool pressed = board_key();
  const uint64_t now = board_now();
  if (pressed != candidate) {
    candidate = pressed;
    since = now;
  }
  if (candidate != reported && now - since >= (uint64_t)kSettlingMs * 1000u * BOARD_HCLK_MHZ) {
    reported = candidate;
    report_fault(reported);
  }
}
