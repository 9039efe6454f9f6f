/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 */
/*
 * A PROFIBUS segment: chips, masters of class 1 and class 2, external stations, and a monitor that receives all
 * telegrams.
 *
 *   dpsim_bus* bus;       dpsim_bus_create(NULL, &bus);                 // 12 Mbit/s
 *   dpsim_chip* chip;     dpsim_bus_add_chip(bus, NULL, &chip);
 *   dpsim_master* master; dpsim_bus_add_master(bus, &options, &master);
 *   dpsim_master_add_slave(master, &slave);
 *   dpsim_master_start(master);
 *   dpsim_bus_run(bus, 12000000);                                       // one millisecond
 *
 * Every participant is a station, numbered from 0 in the order in which it was added. At one tick chips act before
 * the monitor and the monitor before masters. So a chip's output of cycle n is visible to every station at the tick
 * of cycle n.
 *
 * An external station (dpsim_bus_add_station) is simulated by the caller, such as RTL in a bench or another model.
 * The caller drives the line for it and receives the line through dpsim_bus_watch:
 *
 *   for (;;) {                                  // each time step of the simulator, at `now`
 *     dpsim_bus_run(bus, now);
 *     if (dut_changed) dpsim_bus_drive(bus, now, station, rts, txd);
 *     dpsim_bus_next(bus, &wake);               // come back then, or when the DUT changes
 *   }
 */
#ifndef DPSIM_BUS_H
#define DPSIM_BUS_H

/* NOLINTBEGIN(modernize-use-using): C, also when included by C++ */
#include "dsdpv1/chip.h"
#include "dsdpv1/telegram.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- the segment ---- */

typedef struct dpsim_bus dpsim_bus;

typedef struct dpsim_bus_options {
  uint32_t size;
  dpsim_baud baud; /**< of the masters, which may change it later; the monitor follows them */
} dpsim_bus_options;

/** `options` NULL: 12 Mbit/s. DPSIM_ERR_ARGUMENT: unknown rate. */
DPSIM_API dpsim_status dpsim_bus_create(const dpsim_bus_options* options, dpsim_bus** bus);
/** Destroys the bus and all its stations; handles of its chips and masters become invalid. */
DPSIM_API void dpsim_bus_destroy(dpsim_bus* bus);

/** Runs all stations up to and including `tick`. DPSIM_ERR_TIME. */
DPSIM_API dpsim_status dpsim_bus_run(dpsim_bus* bus, uint64_t tick);
/** The tick of the next station activity that needs no call, the present one at the earliest; DPSIM_NEVER if none is
 * due. */
DPSIM_API dpsim_status dpsim_bus_next(dpsim_bus* bus, uint64_t* tick);
/** The present tick. Also in callbacks. */
DPSIM_API dpsim_status dpsim_bus_now(const dpsim_bus* bus, uint64_t* tick);

/** Adds a chip: PBRTS enables its RS-485 driver, PBTXD is the driver's input, PBRXD receives the line. All functions
 * of chip.h apply to it, and it counts as a station with its pins. Chips are added before all other stations and
 * before the bus runs (DPSIM_ERR_STATE). Errors as of dpsim_chip_create. */
DPSIM_API dpsim_status dpsim_bus_add_chip(dpsim_bus* bus, const dpsim_chip_options* options, dpsim_chip** chip);
/** Adds a station that the caller simulates, with its driver off. `name` NULL: "station" and its number. */
DPSIM_API dpsim_status dpsim_bus_add_station(dpsim_bus* bus, const char* name, uint16_t* station);
/** Runs up to `tick`, then switches the driver of an external station on or off (`enabled`); while on, it drives
 * `level` (0 or 1). Two drivers enabled at once are a collision, which the monitor flags; low wins.
 * DPSIM_ERR_NOT_FOUND: not a station of dpsim_bus_add_station; DPSIM_ERR_TIME. */
DPSIM_API dpsim_status dpsim_bus_drive(dpsim_bus* bus, uint64_t tick, uint16_t station, int32_t enabled, int32_t level);
/** The present level of the line. Also in callbacks. */
DPSIM_API dpsim_status dpsim_bus_line(const dpsim_bus* bus, dpsim_level* level);
/** Wire fault: runs up to `tick`, then forces the line to `level` (0 or 1), or releases it with DPSIM_Z. */
DPSIM_API dpsim_status dpsim_bus_force(dpsim_bus* bus, uint64_t tick, dpsim_level level);
/** Wire fault: unplugs a station (`plugged` 0), which then receives an idle line and does not drive the wire. */
DPSIM_API dpsim_status dpsim_bus_plug(dpsim_bus* bus, uint64_t tick, uint16_t station, int32_t plugged);
/** The number of a chip's station. DPSIM_ERR_STATE: the chip is not on a bus. Also in callbacks. */
DPSIM_API dpsim_status dpsim_chip_station(const dpsim_chip* chip, uint16_t* station);

/* Pins of masters and external stations in dpsim_change: the state of their driver. For pins of chips see
 * dpsim_pin_get. */
enum { DPSIM_STATION_TXD = 0, DPSIM_STATION_RTS = 1 };

enum {
  DPSIM_WATCH_LINE = 1,   /**< the line: station DPSIM_LINE, pin 0 */
  DPSIM_WATCH_DRIVERS = 2 /**< drivers of masters and outside stations: DPSIM_STATION_TXD, DPSIM_STATION_RTS */
};
/** Reports changes of `what`, a set of DPSIM_WATCH_..., from now on, in order of time: to `fn`, or, with `fn` NULL,
 * by keeping them for dpsim_bus_read_changes. A second call replaces the first; `what` 0 stops it. Costs time,
 * because telegrams are then made bit by bit. */
DPSIM_API dpsim_status dpsim_bus_watch(dpsim_bus* bus, uint32_t what, dpsim_change_fn fn, void* user);
/** As dpsim_chip_read_changes. */
DPSIM_API dpsim_status dpsim_bus_read_changes(dpsim_bus* bus, dpsim_change* changes, size_t capacity, size_t* count);

/* ---- the monitor ---- */

/** Called at the end of each telegram, valid or not. `fn` NULL: no callback. */
DPSIM_API dpsim_status dpsim_bus_on_telegram(dpsim_bus* bus, dpsim_telegram_fn fn, void* user);

typedef int32_t dpsim_flag;
enum {
  DPSIM_FLAG_COLLISION = 0,         /**< two drivers on the line at once */
  DPSIM_FLAG_GAP = 1,               /**< idle time between two characters of a telegram (S10) */
  DPSIM_FLAG_SYN_VIOLATED = 2,      /**< a request less than T_SYN (33 bit times) after the last activity */
  DPSIM_FLAG_TSDR_EARLY = 3,        /**< an answer before min_TSDR */
  DPSIM_FLAG_TSDR_LATE = 4,         /**< an answer after max_TSDR (S3) */
  DPSIM_FLAG_CHARACTER_ERROR = 5,   /**< wrong parity or stop bit */
  DPSIM_FLAG_TELEGRAM_ERROR = 6,    /**< see dpsim_decode_error */
  DPSIM_FLAG_UNANSWERED = 7,        /**< no answer within the slot time */
  DPSIM_FLAG_UNEXPECTED_ANSWER = 8, /**< not requested, or from the wrong station */
  DPSIM_FLAG_GLITCH = 9,            /**< a low level shorter than half a bit */
  DPSIM_FLAG_TWO_MASTERS = 10,      /**< a master sends while another has the token */
  DPSIM_FLAG_COUNT = 11
};
/** "collision", "gap", ...; "" for other numbers. Also in callbacks. */
DPSIM_API const char* dpsim_flag_name(dpsim_flag flag);

typedef struct dpsim_bus_statistics {
  uint32_t size;
  uint32_t reserved;
  uint64_t telegrams; /**< valid ones */
  uint64_t wrong;
  uint64_t by_kind[5];              /**< valid ones by dpsim_telegram_kind */
  uint64_t flags[DPSIM_FLAG_COUNT]; /**< by dpsim_flag */
} dpsim_bus_statistics;
/** Also in callbacks. */
DPSIM_API dpsim_status dpsim_bus_get_statistics(const dpsim_bus* bus, dpsim_bus_statistics* statistics);

typedef struct dpsim_tsdr_statistics {
  uint32_t size;
  uint32_t reserved;
  uint64_t requests; /**< to this address, repetitions included */
  uint64_t answers;  /**< valid ones */
  uint64_t unanswered;
  uint64_t tsdr_min, tsdr_max, tsdr_mean; /**< ticks; 0 without answers */
} dpsim_tsdr_statistics;
/** Statistics of one address, 0 to 126; zeros if it was never asked. Also in callbacks. */
DPSIM_API dpsim_status dpsim_bus_get_tsdr(const dpsim_bus* bus, uint8_t address, dpsim_tsdr_statistics* statistics);

/* ---- events of masters and monitor ---- */

typedef int32_t dpsim_event_type;
enum {
  DPSIM_EVENT_FLAG = 0,             /**< the monitor: id (dpsim_flag), text; station is DPSIM_LINE */
  DPSIM_EVENT_SLAVE_STATE = 1,      /**< address, from, to (dpsim_slave_state), text: why, empty for a step forward */
  DPSIM_EVENT_INPUTS = 2,           /**< address, data: inputs that differ from the earlier ones */
  DPSIM_EVENT_DIAGNOSIS = 3,        /**< address, data: of an answer to Slave_Diag */
  DPSIM_EVENT_REQUEST_DONE = 4,     /**< id, address, outcome (dpsim_outcome), data: bytes of the answer as received;
                                         id 0, of a scenario: data without frame, text: service and answer */
  DPSIM_EVENT_ACYCLIC_DONE = 5,     /**< id, address, outcome (dpsim_acyclic_outcome), data, codes, text: in words */
  DPSIM_EVENT_CONNECTION_STATE = 6, /**< id: the connection, address, from, to (dpsim_connection_state) */
  DPSIM_EVENT_CONNECTION_END = 7,   /**< id: the connection, address, outcome (dpsim_connection_end), codes, text */
  DPSIM_EVENT_RING_STATE = 8        /**< from, to (dpsim_ring_state), text: why */
};

/** One struct for all event types; members not named for a type are 0, NULL, or 255 for `address`. */
typedef struct dpsim_event {
  uint64_t tick;
  dpsim_event_type type;
  uint32_t id;
  uint16_t station; /**< of the master */
  uint16_t address; /**< of the slave */
  int32_t from, to;
  int32_t outcome;
  uint32_t codes; /**< Error_Decode * 65536 + Error_Code_1 * 256 + Error_Code_2 (tables 28, 29); for an abort subnet,
                     instance and reason, and detail in the same bytes */
  uint32_t data_size;
  const uint8_t* data;
  const char* text; /**< never NULL */
} dpsim_event;

typedef void (*dpsim_event_fn)(void* user, const dpsim_event* event);
/** `fn` NULL: no callback. Commands to masters may be given in the callback. */
DPSIM_API dpsim_status dpsim_bus_on_event(dpsim_bus* bus, dpsim_event_fn fn, void* user);

#ifdef __cplusplus
}
#endif

/* NOLINTEND(modernize-use-using) */

#endif
