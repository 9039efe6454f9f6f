/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Common parts of the C API: the version, errors, time, levels of pins.
 *
 * Objects. A chip, a bus with its stations, a checker, a scoreboard, a GSD file and a run are objects behind opaque
 * handles: created by ..._create (or ..._load), released by ..._destroy, which also accepts NULL. A master, and a
 * chip on a bus, belong to their bus and end with it.
 *
 * Errors. A function that can fail returns a dpsim_status: DPSIM_OK (0), or a negative code. On an error nothing was
 * done, results written through pointers are unchanged, and dpsim_error_message() says what was wrong and what is
 * allowed. No C++ exception leaves the library, and none may leave a callback.
 *
 * Threads. The only global state is the message of the last error, which each thread has for itself. An object, with
 * all that belongs to it, may be used by one thread at a time, not always the same one. Different objects are
 * independent and may run in different threads at once. Callbacks come in the calling thread, before the call
 * returns.
 *
 * Callbacks. Inside a callback the calling object must not be run, changed or destroyed: such a call fails with
 * DPSIM_ERR_STATE. Functions that may be called there are marked "also in callbacks": those that only read, and
 * commands to masters. Pointers passed to a callback are valid until it returns.
 *
 * Structs. A struct that the caller fills begins with `size`: zero it, set size to its sizeof, then set the members
 * that differ from their defaults. 0 (NULL, an empty text) in any member means its default, unless said otherwise.
 * For a struct that the library fills, set `size` before; of an older, shorter version only its members are filled.
 * So structs may grow at their end without breaking callers. Structs in arrays (dpsim_change) have no size and never
 * change within an ABI version; structs passed to a callback by pointer may grow at their end.
 *
 * Texts are UTF-8. A name returned by the library (of a pin, a code, a rule) is valid as long as the library. Any
 * other text is valid until the next call with the same object or, for functions without an object, until the next
 * call of the same function in the same thread.
 *
 * Names of signals, services and states are those of the DSDPV1 datasheet and of EN 50170 / IEC 61158; H1, P9 and
 * the like refer to the rulings of docs/chip.md.
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
#define DPSIM_ABI_MINOR 6

/** The ABI of the loaded library: major * 65536 + minor. A caller compiled with this header works with it if the
 * major number is the same and the minor number is not less. Also in callbacks. */
DPSIM_API uint32_t dpsim_abi_version(void);
/** The version of the project, "0.1.0". */
DPSIM_API const char* dpsim_version(void);

/* ---- errors ---- */

typedef int32_t dpsim_status;
enum {
  DPSIM_OK = 0,
  DPSIM_ERR_ARGUMENT = -1,  /**< a null pointer, or a value out of its range */
  DPSIM_ERR_SIZE = -2,      /**< a struct's `size` is not that of any version, or was not set */
  DPSIM_ERR_NOT_FOUND = -3, /**< no kind, pin, parameter, slave, connection, rule, module of that name or number */
  DPSIM_ERR_TIME = -4,      /**< a tick before the object's present one */
  DPSIM_ERR_STATE = -5,     /**< not now: inside a callback, after the run, for a master of the other class */
  DPSIM_ERR_INPUT = -6, /**< a file, text or saved state is wrong or cannot be read: "file:line: what is wrong, what is
                             allowed" */
  DPSIM_ERR_SPACE = -7, /**< the caller's buffer is too small; a returned size is the one needed */
  DPSIM_ERR_UNSUPPORTED =
      -8, /**< not supported by this library: an ARM board in a scenario, an access to a chip without a host bus */
  DPSIM_ERR_NO_MEMORY = -9,
  DPSIM_ERR_INTERNAL = -10 /**< a fault of the library itself; please report its message */
};

/** Text of this thread's last failed call, one line: "dpsim_chip_set: pin is 18, expected 0 to 17". Empty if none
 * has failed yet; a successful call does not change it. Valid until the next failing call of this thread. */
DPSIM_API const char* dpsim_error_message(void);
/** "DPSIM_ERR_TIME"; "unknown status" for other numbers. */
DPSIM_API const char* dpsim_status_name(dpsim_status status);

/* ---- time ---- */

/* Times are ticks of 1/12 ns since the start of simulation: a cycle of the 48 MHz clock is 250 ticks, its rising edge n
   at tick 250 n; a bit at 12 Mbit/s is 1000. All times of the chip's documents and of PROFIBUS are whole numbers of
   ticks. */
#define DPSIM_TICKS_PER_CYCLE 250
#define DPSIM_TICKS_PER_NS 12
/** Result meaning "never". */
#define DPSIM_NEVER UINT64_MAX
/** The last tick that may be given to a function: 12.18 years. */
#define DPSIM_LAST_TICK ((uint64_t)1 << 62)

typedef int32_t dpsim_unit;
enum { DPSIM_FS, DPSIM_PS, DPSIM_NS, DPSIM_US, DPSIM_MS, DPSIM_S, DPSIM_CYCLES };

/** The absolute time `time` in ticks, rounded to nearest (a half up). A time in fs or ps from dpsim_ticks_to
 * converts back to the same tick. DPSIM_NEVER if it is beyond DPSIM_LAST_TICK or `unit` is invalid. Always convert
 * absolute times, so that nothing drifts. Also in callbacks. */
DPSIM_API uint64_t dpsim_ticks_from(uint64_t time, dpsim_unit unit);
/** The absolute time of `ticks`, rounded to the nearest unit: the error in fs and ps is at most 0.5 fs or 0.5 ps and
 * does not grow. UINT64_MAX if it does not fit (fs: beyond 5.1 hours). */
DPSIM_API uint64_t dpsim_ticks_to(uint64_t ticks, dpsim_unit unit);

/* ---- levels and their changes ---- */

/** 0 or 1 for a single wire, the value for several (A, D). */
typedef int16_t dpsim_level;
#define DPSIM_Z ((dpsim_level)-1) /**< released */
#define DPSIM_X ((dpsim_level)-2) /**< unknown */

/** One change of one pin. 16 bytes in this order on every machine; for arrays (numpy: u8, u2, u2, i2, u2). */
typedef struct dpsim_change {
  uint64_t tick;
  uint16_t
      station;  /**< the pin's station: on a bus the station, in a run the slave, or DPSIM_LINE; 0 for a chip alone */
  uint16_t pin; /**< number in the pin table of the station */
  dpsim_level level;
  uint16_t reserved; /**< 0 */
} dpsim_change;

/** Used instead of a station: the two wires of the segment, whose only pin is 0. 1 is idle. */
#define DPSIM_LINE UINT16_MAX

/** Called at each change; `change` is valid until it returns. */
typedef void (*dpsim_change_fn)(void* user, const dpsim_change* change);

#ifdef __cplusplus
}
#endif

/* NOLINTEND(modernize-deprecated-headers, modernize-use-using) */

#endif
