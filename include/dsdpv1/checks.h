/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The rules of a chip's user side (handshake, host port, cells, service: docs/checks.md), applied to pins from any
 * source: a model, RTL or a recording.
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
  DPSIM_BOUND_MIN = 0,  /**< the least allowed value: margin = value - limit */
  DPSIM_BOUND_MAX = 1,  /**< the greatest: margin = limit - value */
  DPSIM_BOUND_RULE = 2, /**< no value: kept or violated */
  DPSIM_BOUND_MOST = 3  /**< the greatest number: limit and values are no ticks, there are no margins */
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

/** Number of rules of a kind, numbered from 0; 0 for an unknown kind. Any thread, also in callbacks. */
DPSIM_API size_t dpsim_rule_count(const char* kind);
/** DPSIM_ERR_NOT_FOUND: no such kind, number or name. Any thread, also in callbacks. */
DPSIM_API dpsim_status dpsim_rule_get(const char* kind, size_t rule, dpsim_rule_info* info);
DPSIM_API dpsim_status dpsim_rule_find(const char* kind, const char* name, size_t* rule);

typedef struct dpsim_checker dpsim_checker;

/** Another limit for one rule. */
typedef struct dpsim_limit {
  const char* rule; /**< its name */
  int64_t value;    /**< ticks; ignored for DPSIM_BOUND_RULE */
  int32_t off;      /**< 1: not checked at all */
  int32_t reserved;
} dpsim_limit;

typedef struct dpsim_checker_options {
  uint32_t size;
  uint32_t limit_count;
  const char* kind;          /**< NULL: the first one */
  const dpsim_limit* limits; /**< rules with other limits than the default */
} dpsim_checker_options;

/** `options` NULL: all rules of the first kind with their defaults. DPSIM_ERR_NOT_FOUND: no such kind or rule.
 * DPSIM_ERR_UNSUPPORTED: a kind without rules. */
DPSIM_API dpsim_status dpsim_checker_create(const dpsim_checker_options* options, dpsim_checker** checker);
DPSIM_API void dpsim_checker_destroy(dpsim_checker* checker);

/** The pins that the checker needs, as a set of DPSIM_PIN; other pins may be fed as well. */
DPSIM_API dpsim_status dpsim_checker_wants(const dpsim_checker* checker, uint64_t* pins);

/** Feeds a change of a pin. Pins start with the reset levels of dpsim_pin_get; if a recording starts with another
 * level, feed a change there. Ticks never decrease (DPSIM_ERR_TIME); changes at one tick may come in any order.
 * DPSIM_ERR_NOT_FOUND: no such pin; DPSIM_ERR_ARGUMENT: not a level of this pin. */
DPSIM_API dpsim_status dpsim_checker_pin(dpsim_checker* checker, uint64_t tick, uint16_t pin, dpsim_level level);
/** Feeds many changes; their stations are ignored. On an error the changes before it have been fed; `done`, if not
 * NULL, receives their number. */
DPSIM_API dpsim_status dpsim_checker_pins(dpsim_checker* checker, const dpsim_change* changes, size_t count,
                                          size_t* done);
/** Announces, before the first edge of a read that starts now, that the user samples D at `sample`. Without this
 * call the time is derived from the pins, where a sample cannot be observed (P5). */
DPSIM_API dpsim_status dpsim_checker_sample(dpsim_checker* checker, uint64_t sample);
/** Feeds a telegram of any station on the chip's line, at its end: rules about cells and service need them. */
DPSIM_API dpsim_status dpsim_checker_telegram(dpsim_checker* checker, const dpsim_heard* heard);
/** Called once, at the end; after it only results may be read (DPSIM_ERR_STATE). */
DPSIM_API dpsim_status dpsim_checker_finish(dpsim_checker* checker, uint64_t tick);

typedef struct dpsim_violation {
  uint64_t tick;  /**< when the rule was broken */
  uint64_t found; /**< when the violation became visible, not before `tick` */
  int64_t margin; /**< ticks, below 0; 0 when has_margin is 0 */
  uint32_t rule;  /**< number, see dpsim_rule_get */
  int32_t has_margin;
  const char* name; /**< of the rule */
  const char* text; /**< what was wrong, in words */
  const char* pins; /**< the last changes of the pins that the rule is about: "WR=1 0.000 ns, D_IN=5A -8.333 ns" */
} dpsim_violation;

typedef void (*dpsim_violation_fn)(void* user, const dpsim_violation* violation);
/** Called as soon as a violation is visible, during the call that feeds the pins. `fn` NULL: violations are only
 * counted. */
DPSIM_API dpsim_status dpsim_checker_on_violation(dpsim_checker* checker, dpsim_violation_fn fn, void* user);

typedef struct dpsim_check_result {
  uint32_t size;
  int32_t has_margin; /**< 1: worst_margin and at are valid */
  int32_t has_value;  /**< 1: worst_value is valid */
  uint32_t reserved;
  uint64_t count;       /**< how often the rule was applied */
  uint64_t violations;  /**< how often it was broken */
  int64_t worst_margin; /**< ticks, the least one, positive = kept */
  int64_t worst_value;  /**< ticks, measured then; without a limit the greatest one */
  uint64_t at;          /**< when that was; of DPSIM_BOUND_RULE the first violation; DPSIM_NEVER: not yet */
} dpsim_check_result;
/** Result so far. DPSIM_ERR_NOT_FOUND: no such rule. Also in callbacks. */
DPSIM_API dpsim_status dpsim_checker_get_result(const dpsim_checker* checker, size_t rule, dpsim_check_result* result);

#ifdef __cplusplus
}
#endif

/* NOLINTEND(modernize-use-using) */

#endif
