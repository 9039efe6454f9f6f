/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 */
#ifndef SPC3_PLANTED_H
#define SPC3_PLANTED_H
/*
 * Mistakes for the tests of the bench, one for each check of the firmware's side (docs/checks.md). Only in a build with
 * SPC3_PLANTED; the switches PD8 to PD12 choose the mistake, 0 is none.
 */
#include <stdbool.h>
#include <stdint.h>

#include "driver/spc3/spc3.h"

#ifdef SPC3_PLANTED
void planted_start(void);
/* False: the byte is not written. */
bool planted_write(uint16_t address, uint8_t* value);
uint16_t planted_user_wd(uint16_t usual);
bool planted_first_inputs(void);
void planted_before_start(spc3_device* chip);
void planted_judging(void);
bool planted_fetches(void);
bool planted_gives(void);
/* At the end of each turn of the main loop. */
void planted_turn(spc3_device* chip);
#else
static inline void planted_start(void) {}
static inline bool planted_write(uint16_t address, const uint8_t* value) {
  (void)address;
  (void)value;
  return true;
}
static inline uint16_t planted_user_wd(uint16_t usual) { return usual; }
static inline bool planted_first_inputs(void) { return true; }
static inline void planted_before_start(spc3_device* chip) { (void)chip; }
static inline void planted_judging(void) {}
static inline bool planted_fetches(void) { return true; }
static inline bool planted_gives(void) { return true; }
static inline void planted_turn(spc3_device* chip) { (void)chip; }
#endif

#endif /* SPC3_PLANTED_H */
