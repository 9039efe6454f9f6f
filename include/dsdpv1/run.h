/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Load a scenario (docs/scenarios.md), run it and read its results.
 *
 *   dpsim_run_options options = {0};
 *   options.size = sizeof options;
 *   options.path = "scenarios/power_on_12m.yaml";
 *   dpsim_run* run;
 *   if (dpsim_run_create(&options, &run) != DPSIM_OK) puts(dpsim_error_message());
 *   dpsim_run_keep(run, DPSIM_KEEP_CHANGES | DPSIM_KEEP_TELEGRAMS);
 *   dpsim_run_execute(run, NULL, NULL);
 *   dpsim_run_result(run, &json);                                     // docs/result.md
 */
#ifndef DPSIM_RUN_H
#define DPSIM_RUN_H

/* NOLINTBEGIN(modernize-use-using): C, also when included by C++ */
#include "dsdpv1/chip.h"
#include "dsdpv1/telegram.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct dpsim_run dpsim_run;

typedef int32_t dpsim_checks_mode;
enum {
  DPSIM_CHECKS_AS_SCENARIO = 0, /**< as in the scenario, else DPSIM_CHECKS_FAIL */
  DPSIM_CHECKS_FAIL = 1,        /**< violations that the scenario does not allow fail the run */
  DPSIM_CHECKS_OFF = 2,
  DPSIM_CHECKS_REPORT = 3 /**< violations are listed in the result; the verdict says how many were not judged */
};

typedef struct dpsim_run_options {
  uint32_t size;
  dpsim_engine engine;
  dpsim_checks_mode checks;
  uint32_t setting_count;
  const char*
      path; /**< path of the scenario's file; with `text`, its name in messages and the base of relative paths */
  const char* text;            /**< the scenario itself; NULL: `path` is read */
  const char* const* settings; /**< "PATH=VALUE" as in `--set`: "user_cpu.cycle=40us" */
  /* Output files, NULL: none. They are complete once dpsim_run_execute has returned, or absent. */
  const char* log;     /**< .log or .jsonl */
  const char* wave;    /**< .vcd or .fst */
  const char* capture; /**< .pcapng */
} dpsim_run_options;

/** Reads the scenario and the files it names, and builds everything. DPSIM_ERR_INPUT: "file:line: what is wrong,
 * what is allowed". DPSIM_ERR_UNSUPPORTED: a slave whose user CPU is an ARM board, which this library does not have:
 * run it with dsdpv1-sim. */
DPSIM_API dpsim_status dpsim_run_create(const dpsim_run_options* options, dpsim_run** run);
DPSIM_API void dpsim_run_destroy(dpsim_run* run);

/** The scenario's name, its end, and its slaves, numbered from 0 in the order of the file. */
typedef struct dpsim_run_info {
  uint32_t size;
  uint32_t slaves;
  const char* name;
  const char* kind; /**< of its chips; a slave may have another */
  uint64_t end;     /**< tick */
} dpsim_run_info;
DPSIM_API dpsim_status dpsim_run_get_info(const dpsim_run* run, dpsim_run_info* info);
/** DPSIM_ERR_NOT_FOUND: no such slave. */
DPSIM_API dpsim_status dpsim_run_slave(const dpsim_run* run, size_t slave, const char** name);

/* To be called before dpsim_run_execute (DPSIM_ERR_STATE later): selects what is reported during the run or kept for
 * later. Changes cover the line and all pins of all slaves, also inputs, each beginning with its power-on level at
 * tick 0, as in a golden trace (docs/traces.md). Watching pins costs time. */

/** Changes of all pins and of the line. Here and below `fn` NULL: no callback. */
DPSIM_API dpsim_status dpsim_run_on_change(dpsim_run* run, dpsim_change_fn fn, void* user);
/** Telegrams, as the monitor receives them. */
DPSIM_API dpsim_status dpsim_run_on_telegram(dpsim_run* run, dpsim_telegram_fn fn, void* user);
/** Events of the chips; `station` is the slave. */
DPSIM_API dpsim_status dpsim_run_on_event(dpsim_run* run, dpsim_chip_event_fn fn, void* user);
/** Lines printed by the programs of user CPUs. Only firmware on an ARM board prints, which needs dsdpv1-sim; the
 * native user CPU, the only one in this library, prints nothing. */
typedef void (*dpsim_text_fn)(void* user, uint16_t slave, const char* line);
DPSIM_API dpsim_status dpsim_run_on_text(dpsim_run* run, dpsim_text_fn fn, void* user);

enum { DPSIM_KEEP_CHANGES = 1, DPSIM_KEEP_TELEGRAMS = 2 };
/** Selects what is kept, a set of DPSIM_KEEP_...; 0: nothing. 16 bytes a change. */
DPSIM_API dpsim_status dpsim_run_keep(dpsim_run* run, uint32_t what);

/** Called every 100 us of simulated time: return 0 to stop the run. */
typedef int32_t (*dpsim_poll_fn)(void* user, uint64_t now);
/** Runs the scenario to its end, or until `poll` (NULL: none) returns 0; once (DPSIM_ERR_STATE). DPSIM_ERR_INPUT: a
 * file cannot be written. DPSIM_OK also if the scenario's expectations are not met: see dpsim_run_verdict. */
DPSIM_API dpsim_status dpsim_run_execute(dpsim_run* run, dpsim_poll_fn poll, void* user);

/* Only after dpsim_run_execute (DPSIM_ERR_STATE before). */

typedef struct dpsim_run_summary {
  uint32_t size;
  uint8_t passed;      /**< the verdict is 0 */
  uint8_t interrupted; /**< stopped by `poll` */
  uint16_t reserved;
  uint64_t simulated; /**< ticks */
  uint64_t telegrams, wrong_telegrams;
  uint64_t violations;
  uint64_t expectations, expectations_met;
  double wall_seconds;
} dpsim_run_summary;
DPSIM_API dpsim_status dpsim_run_get_summary(const dpsim_run* run, dpsim_run_summary* summary);
/** The run's verdict, with the text and exit code of `dsdpv1-sim run`. `exit_code`: 0 passed; 1 an expectation was
 * not met, or there was a violation that is not allowed; 3 nothing was judged; 130 stopped by `poll`. `text` also
 * says what was not judged, "PASSED, 140 violations not judged"; valid as long as the run. */
DPSIM_API dpsim_status dpsim_run_verdict(dpsim_run* run, int32_t* exit_code, const char** text);
/** The result as `dsdpv1-sim run --result` writes it: one JSON object (docs/result.md). Valid as long as the run. */
DPSIM_API dpsim_status dpsim_run_result(dpsim_run* run, const char** json);
/** The tables that `dsdpv1-sim run` prints. Valid as long as the run. */
DPSIM_API dpsim_status dpsim_run_report(dpsim_run* run, const char** text);
/** As dpsim_chip_read_changes, in order of time, for all slaves and the line. */
DPSIM_API dpsim_status dpsim_run_read_changes(dpsim_run* run, dpsim_change* changes, size_t capacity, size_t* count);
/** All kept telegrams in order of time: an array of `count` elements, valid with their bytes as long as the run. */
DPSIM_API dpsim_status dpsim_run_telegrams(const dpsim_run* run, const dpsim_heard** heard, size_t* count);

#ifdef __cplusplus
}
#endif

/* NOLINTEND(modernize-use-using) */

#endif
