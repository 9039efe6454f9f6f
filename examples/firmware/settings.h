/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 */
#ifndef SETTINGS_H
#define SETTINGS_H
/*
 * The kind of device: station, timing, objects, nameplate. On the bench the scenario defines it
 * (board/firmware/mailbox.h); on a separate board the firmware is the device of own_settings (settings.c).
 */
#include <stdbool.h>
#include <stdint.h>

#include "board/firmware/mailbox.h"
#include "driver/dsdpv1.h"

extern dsdpv1_mailbox dsdpv1_bench;

/* Times of the settings in HCLK cycles. */
typedef struct settings_times {
  uint64_t start_delay, period, judge_delay, retry_delay, answer_delay;
} settings_times;

/* Determines who defines the device. Call it once, first of all. */
void settings_load(void);
/* True when a bench has filled in the mailbox and may give commands. */
bool settings_from_bench(void);
/* Only the objects' data and the way of answering may change while the firmware runs. */
dsdpv1_mailbox_settings* settings(void);
const settings_times* settings_in_cycles(void);

/* For dsdpv1_initialise; valid as long as `station`. */
dsdpv1_config settings_config(const dsdpv1_mailbox_station* station);

#endif /* SETTINGS_H */
