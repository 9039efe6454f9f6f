/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The rules of a chip's user side (handshake, host port, cells, service: docs/checks.md), judged from any pins: those
 * of a model, of RTL, of a recording.
 *
 *   dpsim_checker* checker;
 *   dpsim_checker_create(NULL, &checker);
 *   dpsim_checker_on_violation(checker, print, NULL);
 *   dpsim_checker_pins(checker, changes, count, NULL);     // all of them, in order of time
 *   dpsim_checker_finish(checker, end);
 */
#ifndef DPSIM_CHECKS_H
#define DPSIM_CHECKS_H

/* NOLINTBEGIN(modernize-use-using): C, also when included by C++ */
#include "dsdpv1/chip.h"
#include "dsdpv1/telegram.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef int32_t dpsim_bound;
enum {
  DPSIM_BOUND_MIN = 0, /**< the least allowed value: margin = value - limit */
  DPSIM_BOUND_MAX = 1, /**< the greatest: margin = limit - value */
  DPSIM_BOUND_RULE = 2 /**< no value: kept or not */
};

#define DPSIM_NO_LIMIT INT64_MAX /**< only measured, never violated */

typedef struct dpsim_rule_info {
  uint32_t size;
  dpsim_bound bound;
  const char* name;   /**< stable: "TIMING_TS", "OWNERSHIP_BOTH_OWN" */
  const char* rule;   /**< what must hold, one sentence without its stop */
  const char* clause; /**< of the datasheet, and rulings */
  const char* advice; /**< what to do about a violation */
  int64_t limit;      /**< default, ticks; DPSIM_NO_LIMIT; 0 of DPSIM_BOUND_RULE */
} dpsim_rule_info;

/** Rules of a kind, numbered from 0; 0 for a kind that there is not. Any thread, also in callbacks. */
DPSIM_API size_t dpsim_rule_count(const char* kind);
/** DPSIM_ERR_NOT_FOUND: no such kind, number or name. Any thread, also in callbacks. */
DPSIM_API dpsim_status dpsim_rule_get(const char* kind, size_t rule, dpsim_rule_info* info);
DPSIM_API dpsim_status dpsim_rule_find(const char* kind, const char* name, size_t* rule);

typedef struct dpsim_checker dpsim_checker;

/** Another limit for one rule. */
typedef struct dpsim_limit {
  const char* rule; /**< its name */
  int64_t value;    /**< ticks; of DPSIM_BOUND_RULE not looked at */
  int32_t off;      /**< 1: not checked at all */
  int32_t reserved;
} dpsim_limit;

typedef struct dpsim_checker_options {
  uint32_t size;
  uint32_t limit_count;
  const char* kind;          /**< NULL: the first one */
  const dpsim_limit* limits; /**< those that are not to have their defaults */
} dpsim_checker_options;

/** `options` NULL: all rules of the first kind with their defaults. DPSIM_ERR_NOT_FOUND: no such kind or rule. */
DPSIM_API dpsim_status dpsim_checker_create(const dpsim_checker_options* options, dpsim_checker** checker);
DPSIM_API void dpsim_checker_destroy(dpsim_checker* checker);

/** The pins that it needs, as a set of DPSIM_PIN; others may be fed, too. */
DPSIM_API dpsim_status dpsim_checker_wants(const dpsim_checker* checker, uint64_t* pins);

/** A change of a pin. It begins with the reset levels of dpsim_pin_get; what has another level at the start of a
 * recording is a change there. Ticks never go back (DPSIM_ERR_TIME); what changes at one tick may come in any order.
 *  DPSIM_ERR_NOT_FOUND: no such pin; DPSIM_ERR_ARGUMENT: no level of it. */
DPSIM_API dpsim_status dpsim_checker_pin(dpsim_checker* checker, uint64_t tick, uint16_t pin, dpsim_level level);
/** The same for many, those of any station. On an error those before it are carried out; `done`, if not NULL, is their
 *  number. */
DPSIM_API dpsim_status dpsim_checker_pins(dpsim_checker* checker, const dpsim_change* changes, size_t count,
                                          size_t* done);
/** The user begins a read now and samples D at `sample`: told before the read's first edge. Left out, the time is taken
 *  from the pins: at the pins nobody sees a sample (P5). */
DPSIM_API dpsim_status dpsim_checker_sample(dpsim_checker* checker, uint64_t sample);
/** A telegram on the chip's line, at its end, of any station: rules about cells and service need them. */
DPSIM_API dpsim_status dpsim_checker_telegram(dpsim_checker* checker, const dpsim_heard* heard);
/** Once, at the end; afterwards only results are asked (DPSIM_ERR_STATE). */
DPSIM_API dpsim_status dpsim_checker_finish(dpsim_checker* checker, uint64_t tick);

typedef struct dpsim_violation {
  uint64_t tick;  /**< where the rule was broken */
  uint64_t found; /**< when that could be seen, not before `tick` */
  int64_t margin; /**< ticks, below 0; 0 when has_margin is 0 */
  uint32_t rule;  /**< number, see dpsim_rule_get */
  int32_t has_margin;
  const char* name; /**< of the rule */
  const char* text; /**< what was wrong, in words */
  const char* pins; /**< the last changes of the pins that the rule is about: "WR=1 0.000 ns, D_IN=5A -8.333 ns" */
} dpsim_violation;

typedef void (*dpsim_violation_fn)(void* user, const dpsim_violation* violation);
/** Told as soon as it can be seen, inside of the call that feeds. `fn` NULL: nobody listens; they are counted. */
DPSIM_API dpsim_status dpsim_checker_on_violation(dpsim_checker* checker, dpsim_violation_fn fn, void* user);

typedef struct dpsim_check_result {
  uint32_t size;
  int32_t has_margin; /**< 1: worst_margin and at are good */
  int32_t has_value;  /**< 1: worst_value is good */
  uint32_t reserved;
  uint64_t count;       /**< how often the rule was applied */
  uint64_t violations;  /**< how often in vain */
  int64_t worst_margin; /**< ticks, the least one, positive = kept */
  int64_t worst_value;  /**< ticks, measured then; without a limit the greatest one */
  uint64_t at;          /**< when that was; of DPSIM_BOUND_RULE the first violation; DPSIM_NEVER: not yet */
} dpsim_check_result;
/** So far. DPSIM_ERR_NOT_FOUND: no such rule. Also in callbacks. */
DPSIM_API dpsim_status dpsim_checker_get_result(const dpsim_checker* checker, size_t rule, dpsim_check_result* result);

#ifdef __cplusplus
}
#endif

/* NOLINTEND(modernize-use-using) */

#endif
