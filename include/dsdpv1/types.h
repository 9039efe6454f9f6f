/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What all parts of the C API have in common: the version, errors, time, levels of pins.
 *
 * Objects. A chip, a bus with all that is on it, a checker, a scoreboard, a GSD file and a run are objects behind
 * opaque handles: made by a function ..._create (or ..._load), released by ..._destroy, which takes NULL as well. A
 * master, and a chip on a bus, belong to their bus and end with it.
 *
 * Errors. A function that can fail returns a dpsim_status: DPSIM_OK (0), or a negative code; then nothing was done, and
 * dpsim_error_message() says in words what was wrong and what is allowed. Results are written through pointers, and
 * left alone on an error. No C++ exception leaves the library, and none may leave a callback.
 *
 * Threads. There is no global state but the message of the last error, which each thread has for itself. One object,
 * with all that belongs to it, is used by one thread at a time, without any need that it always be the same one;
 * different objects are independent, so that each thread may run its own at the same time as others. Callbacks come in
 * the thread that called, before that call returns.
 *
 * Callbacks. From inside of a callback the object that calls must not be run, changed or destroyed: such a call fails
 * with DPSIM_ERR_STATE. What may be called there says so ("also in callbacks"): what reads, and commands to masters.
 * Pointers that a callback is given are good until it returns.
 *
 * Structs. One that the caller fills begins with `size`: fill it with zeros, set size to its sizeof, then set what is
 * to be different. 0 (NULL, an empty text) in any member means its default, unless said otherwise. One that the library
 * fills wants its `size` set before; of an older, shorter one the members that it has are filled. So structs may grow
 * at their end without breaking callers. Structs that come in arrays (dpsim_change) have no size and never change
 * within an ABI version; those that a callback is given a pointer to may grow at their end.
 *
 * Texts are UTF-8. A text that the library gives stands as long as the library when it is a name (of a pin, a code, a
 * rule), else until the next call with the same object, or, of functions without an object, until the next call of the
 * same function in the same thread.
 *
 * Names of signals, services and states are those of the DSDPV1 datasheet and of EN 50170 / IEC 61158; H1, P9 and the
 * like are the rulings of docs/chip.md.
 */
#ifndef DPSIM_TYPES_H
#define DPSIM_TYPES_H

/* NOLINTBEGIN(modernize-deprecated-headers, modernize-use-using): C, also when included by C++ */
#include <stddef.h>
#include <stdint.h>

#if defined(__GNUC__)
#define DPSIM_API __attribute__((visibility("default")))
#else
#define DPSIM_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* ---- version ---- */

/* The ABI described here. MAJOR is the number of the library's SONAME: it changes when callers have to be compiled
   again. MINOR grows with each function or member that is added. */
#define DPSIM_ABI_MAJOR 0
#define DPSIM_ABI_MINOR 5

/** The ABI of the library that is loaded: major * 65536 + minor. A caller that was compiled with this header works with
 * it when the major number is the same and the minor number is not less. Also in callbacks. */
DPSIM_API uint32_t dpsim_abi_version(void);
/** The version of the project, "0.1.0". */
DPSIM_API const char* dpsim_version(void);

/* ---- errors ---- */

typedef int32_t dpsim_status;
enum {
  DPSIM_OK = 0,
  DPSIM_ERR_ARGUMENT = -1,  /**< a null pointer, or a value out of its range */
  DPSIM_ERR_SIZE = -2,      /**< a struct's `size` is not that of any version of it, or was not set */
  DPSIM_ERR_NOT_FOUND = -3, /**< no kind, pin, parameter, slave, connection, rule, module of that name or number */
  DPSIM_ERR_TIME = -4,      /**< a tick before the object's present time */
  DPSIM_ERR_STATE = -5,     /**< not now: inside of a callback, after the run, of a master of the other class */
  DPSIM_ERR_INPUT = -6, /**< a file, text or saved state is wrong or cannot be read: "file:line: what is wrong, what is
                             allowed" */
  DPSIM_ERR_SPACE = -7, /**< the caller's buffer is too small; where a size is returned, it is the one needed */
  DPSIM_ERR_UNSUPPORTED =
      -8, /**< this library cannot: an ARM board in a scenario, an access to a chip without a host bus */
  DPSIM_ERR_NO_MEMORY = -9,
  DPSIM_ERR_INTERNAL = -10 /**< a fault of the library itself; its message is worth a report */
};

/** The words for the last call of this thread that failed, one line: "dpsim_chip_set: pin is 18, allowed are 0 to 17".
 *  Empty when none has failed yet; a call that succeeds leaves it. Stands until the next failing call of this thread.
 */
DPSIM_API const char* dpsim_error_message(void);
/** "DPSIM_ERR_TIME"; "unknown status" for other numbers. */
DPSIM_API const char* dpsim_status_name(dpsim_status status);

/* ---- time ---- */

/* Times are ticks of 1/12 ns since the start of simulation: a cycle of the 48 MHz clock is 250 ticks, its rising edge n
   at tick 250 n; a bit at 12 Mbit/s is 1000. All times of the chip's documents and of PROFIBUS are whole numbers of
   ticks. */
#define DPSIM_TICKS_PER_CYCLE 250
#define DPSIM_TICKS_PER_NS 12
/** "Never", as an answer. */
#define DPSIM_NEVER UINT64_MAX
/** The last tick that may be given to a function: 12.18 years. */
#define DPSIM_LAST_TICK ((uint64_t)1 << 62)

typedef int32_t dpsim_unit;
enum { DPSIM_FS, DPSIM_PS, DPSIM_NS, DPSIM_US, DPSIM_MS, DPSIM_S, DPSIM_CYCLES };

/** The absolute time `time` in ticks, rounded to the nearest one (a half up). From fs and ps a time that
 *  dpsim_ticks_to gave comes back as the same tick. DPSIM_NEVER when it is beyond DPSIM_LAST_TICK or `unit` is none.
 *  Always convert absolute times, so that nothing drifts. Also in callbacks. */
DPSIM_API uint64_t dpsim_ticks_from(uint64_t time, dpsim_unit unit);
/** The absolute time of `ticks`, rounded to the nearest unit: exact for fs and ps up to half of one, so that the error
 * is at most 0.5 fs or 0.5 ps and does not grow. UINT64_MAX when it does not fit (of fs: beyond 5.1 hours). */
DPSIM_API uint64_t dpsim_ticks_to(uint64_t ticks, dpsim_unit unit);

/* ---- levels and their changes ---- */

/** 0 or 1 of a single wire, the value of several (A, D). */
typedef int16_t dpsim_level;
#define DPSIM_Z ((dpsim_level)-1) /**< released */
#define DPSIM_X ((dpsim_level)-2) /**< unknown */

/** One change of one pin. 16 bytes in this order on every machine; for arrays (numpy: u8, u2, u2, i2, u2). */
typedef struct dpsim_change {
  uint64_t tick;
  uint16_t station; /**< whose pin: of a bus the station, of a run the slave, DPSIM_LINE; of a chip alone 0 */
  uint16_t pin;     /**< number in the pin table of the station */
  dpsim_level level;
  uint16_t reserved; /**< 0 */
} dpsim_change;

/** In the place of a station: the two wires of the segment, which have the one pin 0. 1 is idle. */
#define DPSIM_LINE UINT16_MAX

/** Told of a change at once; `change` is good until it returns. */
typedef void (*dpsim_change_fn)(void* user, const dpsim_change* change);

#ifdef __cplusplus
}
#endif

/* NOLINTEND(modernize-deprecated-headers, modernize-use-using) */

#endif
