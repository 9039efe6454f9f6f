/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The model as reference: it gets the inputs of somebody's chip (the DUT: RTL, a recording), whose outputs have to be
 * the model's at every tick.
 *
 *   dpsim_scoreboard* scoreboard;
 *   dpsim_scoreboard_create(NULL, NULL, &scoreboard);                             // a DSDPV1, exactly
 *   dpsim_scoreboard_compare(scoreboard, changes, count, now, &result);           // again and again
 *   if (result.tick != DPSIM_NEVER) print(result.tick, result.pin, result.model, result.dut);
 *
 * Compared are the levels that a tick ends with: what changes twice at one tick has changed once. What the model calls
 * DPSIM_X matches everything (P5); DPSIM_X and DPSIM_Z of the DUT match only themselves. MISO of a DSDPV1-RSU in RTL is
 * the pin's register: from one level to the other its pin is taken to follow spi_miso_delay later, as in lockstep
 * (docs/microarchitecture_rsu.md, 5.1).
 */
#ifndef DPSIM_SCOREBOARD_H
#define DPSIM_SCOREBOARD_H

/* NOLINTBEGIN(modernize-use-using): C, also when included by C++ */
#include "dsdpv1/chip.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct dpsim_scoreboard dpsim_scoreboard;

typedef struct dpsim_scoreboard_options {
  uint32_t size;
  uint32_t reserved;
  int64_t tolerance; /**< ticks; a difference that lasts no longer is none; 0: exactly */
  int64_t warm_up;   /**< ticks with RESET low before it compares, in which RTL leaves X; 0: it does from tick 0 on */
} dpsim_scoreboard_options;

/** `model`: kind and parameters, those of the DUT. Both sides begin with the levels of dpsim_pin_get: what the DUT has
 *  otherwise at the start is a change there. `model`, `options` NULL: all defaults.
 *  DPSIM_ERR_NOT_FOUND: no such kind or parameter; DPSIM_ERR_ARGUMENT: a value out of range. */
DPSIM_API dpsim_status dpsim_scoreboard_create(const dpsim_chip_options* model, const dpsim_scoreboard_options* options,
                                               dpsim_scoreboard** scoreboard);
DPSIM_API void dpsim_scoreboard_destroy(dpsim_scoreboard* scoreboard);

#define DPSIM_LAST_EVENTS 3

typedef struct dpsim_scoreboard_result {
  uint32_t size;
  uint16_t pin;           /**< that is different first; of several at one tick the one with the least number */
  dpsim_level model, dut; /**< its levels */
  uint16_t input;         /**< that changed last, and its level */
  dpsim_level input_level;
  uint16_t event_count; /**< 0 to DPSIM_LAST_EVENTS */
  uint64_t tick;        /**< since when they differ; DPSIM_NEVER: nowhere so far */
  uint64_t input_tick;  /**< of the input's change; DPSIM_NEVER: none has changed */
  uint64_t matched;     /**< changes of the model's outputs that the DUT has made as well */
  uint64_t next;        /**< when something happens or is judged without a change of the DUT; DPSIM_NEVER: never */
  dpsim_chip_event events[DPSIM_LAST_EVENTS]; /**< the model's, the latest first (dpsim_chip_event_text) */
} dpsim_scoreboard_result;

/** The DUT has made these changes of inputs and outputs, in order of time (their stations are not looked at), and no
 *  others up to `until`. All ticks before `until` are judged then, and `result`, if not NULL, says what is known; after
 *  the first difference nothing more is compared. On an error the changes before the wrong one are carried out.
 *  DPSIM_ERR_NOT_FOUND: no such pin; DPSIM_ERR_ARGUMENT: no level of it, of an input also DPSIM_X; DPSIM_ERR_TIME. */
DPSIM_API dpsim_status dpsim_scoreboard_compare(dpsim_scoreboard* scoreboard, const dpsim_change* changes, size_t count,
                                                uint64_t until, dpsim_scoreboard_result* result);

#ifdef __cplusplus
}
#endif

/* NOLINTEND(modernize-use-using) */

#endif
