/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 */
/*
 * A PROFIBUS segment: chips, masters of class 1 and class 2, stations outside of the library, and a monitor that hears
 * all.
 *
 *   dpsim_bus* bus;       dpsim_bus_create(NULL, &bus);                 // 12 Mbit/s
 *   dpsim_chip* chip;     dpsim_bus_add_chip(bus, NULL, &chip);
 *   dpsim_master* master; dpsim_bus_add_master(bus, &options, &master);
 *   dpsim_master_add_slave(master, &slave);
 *   dpsim_master_start(master);
 *   dpsim_bus_run(bus, 12000000);                                       // one millisecond
 *
 * Everybody on the bus is a station, numbered from 0 in the order of being added. At one tick chips act before the
 * monitor, the monitor before masters; so a chip's output of cycle n is seen by all who look at the tick of cycle n.
 *
 * A station outside (dpsim_bus_add_station) is whatever the caller simulates: RTL in a bench, another model. The caller
 * drives the line for it, and hears the line by dpsim_bus_watch:
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

/** `options` NULL: 12 Mbit/s. DPSIM_ERR_ARGUMENT: a rate that there is not. */
DPSIM_API dpsim_status dpsim_bus_create(const dpsim_bus_options* options, dpsim_bus** bus);
/** With all that is on it; handles of its chips and masters are no good any more. */
DPSIM_API void dpsim_bus_destroy(dpsim_bus* bus);

/** Runs everybody up to and including `tick`. DPSIM_ERR_TIME. */
DPSIM_API dpsim_status dpsim_bus_run(dpsim_bus* bus, uint64_t tick);
/** The tick at which the next one of the stations acts by itself, the present one at the earliest; DPSIM_NEVER when
 * nobody has anything to do. */
DPSIM_API dpsim_status dpsim_bus_next(dpsim_bus* bus, uint64_t* tick);
/** The present tick. Also in callbacks. */
DPSIM_API dpsim_status dpsim_bus_now(const dpsim_bus* bus, uint64_t* tick);

/** A chip on the line: PBRTS enables its RS-485 driver, PBTXD is what that drives, PBRXD hears the line. All functions
 * of chip.h serve it, and it counts as a station with its pins. Chips are added before anybody else and before the bus
 * runs (DPSIM_ERR_STATE). Errors as of dpsim_chip_create. */
DPSIM_API dpsim_status dpsim_bus_add_chip(dpsim_bus* bus, const dpsim_chip_options* options, dpsim_chip** chip);
/** A station that the caller simulates, its driver off. `name` NULL: "station" and its number. */
DPSIM_API dpsim_status dpsim_bus_add_station(dpsim_bus* bus, const char* name, uint16_t* station);
/** Runs up to `tick`, then an outside station's driver is `enabled` and drives `level` (0 or 1) while it is. Two
 * drivers enabled at once are a collision, which the monitor flags; low wins. DPSIM_ERR_NOT_FOUND: no station from
 * dpsim_bus_add_station; DPSIM_ERR_TIME. */
DPSIM_API dpsim_status dpsim_bus_drive(dpsim_bus* bus, uint64_t tick, uint16_t station, int32_t enabled, int32_t level);
/** The present level of the line. Also in callbacks. */
DPSIM_API dpsim_status dpsim_bus_line(const dpsim_bus* bus, dpsim_level* level);
/** Faults of the wire: runs up to `tick`, then the line is forced to `level` (0 or 1), or with DPSIM_Z let go. */
DPSIM_API dpsim_status dpsim_bus_force(dpsim_bus* bus, uint64_t tick, dpsim_level level);
/** ... or a station is unplugged (`plugged` 0): it hears an idle line, its driver does not reach the wire. */
DPSIM_API dpsim_status dpsim_bus_plug(dpsim_bus* bus, uint64_t tick, uint16_t station, int32_t plugged);
/** The number of a chip's station. DPSIM_ERR_STATE: it is on no bus. Also in callbacks. */
DPSIM_API dpsim_status dpsim_chip_station(const dpsim_chip* chip, uint16_t* station);

/* Pins of masters and of outside stations in dpsim_change: what their driver does. Those of chips: dpsim_pin_get. */
enum { DPSIM_STATION_TXD = 0, DPSIM_STATION_RTS = 1 };

enum {
  DPSIM_WATCH_LINE = 1,   /**< the line: station DPSIM_LINE, pin 0 */
  DPSIM_WATCH_DRIVERS = 2 /**< drivers of masters and outside stations: DPSIM_STATION_TXD, DPSIM_STATION_RTS */
};
/** From now on changes of `what`, a set of DPSIM_WATCH_..., are told: to `fn`, or, with `fn` NULL, they are kept for
 *  dpsim_bus_read_changes. In order of time. A second call replaces the first, `what` 0 ends it. Costs time: telegrams
 *  are then made bit by bit. */
DPSIM_API dpsim_status dpsim_bus_watch(dpsim_bus* bus, uint32_t what, dpsim_change_fn fn, void* user);
/** As dpsim_chip_read_changes. */
DPSIM_API dpsim_status dpsim_bus_read_changes(dpsim_bus* bus, dpsim_change* changes, size_t capacity, size_t* count);

/* ---- the monitor ---- */

/** Each telegram at its end, right or wrong. `fn` NULL: nobody listens. */
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
  DPSIM_FLAG_UNEXPECTED_ANSWER = 8, /**< that nobody asked for, or by the wrong station */
  DPSIM_FLAG_GLITCH = 9,            /**< a low level shorter than half a bit */
  DPSIM_FLAG_TWO_MASTERS = 10,      /**< a master sends while another has the token */
  DPSIM_FLAG_COUNT = 11
};
/** "collision", "gap", ...; "" for other numbers. Also in callbacks. */
DPSIM_API const char* dpsim_flag_name(dpsim_flag flag);

typedef struct dpsim_bus_statistics {
  uint32_t size;
  uint32_t reserved;
  uint64_t telegrams; /**< right ones */
  uint64_t wrong;
  uint64_t by_kind[5];              /**< right ones by dpsim_telegram_kind */
  uint64_t flags[DPSIM_FLAG_COUNT]; /**< by dpsim_flag */
} dpsim_bus_statistics;
/** Also in callbacks. */
DPSIM_API dpsim_status dpsim_bus_get_statistics(const dpsim_bus* bus, dpsim_bus_statistics* statistics);

typedef struct dpsim_tsdr_statistics {
  uint32_t size;
  uint32_t reserved;
  uint64_t requests; /**< to this address, repetitions included */
  uint64_t answers;  /**< right ones */
  uint64_t unanswered;
  uint64_t tsdr_min, tsdr_max, tsdr_mean; /**< ticks; 0 without answers */
} dpsim_tsdr_statistics;
/** Of one address, 0 to 126; zeros when nobody has asked it. Also in callbacks. */
DPSIM_API dpsim_status dpsim_bus_get_tsdr(const dpsim_bus* bus, uint8_t address, dpsim_tsdr_statistics* statistics);

/* ---- what masters and monitor tell ---- */

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

/** One struct for all of them; members that a type does not name are 0, NULL, and `address` 255. */
typedef struct dpsim_event {
  uint64_t tick;
  dpsim_event_type type;
  uint32_t id;
  uint16_t station; /**< of the master */
  uint16_t address; /**< of the slave */
  int32_t from, to;
  int32_t outcome;
  uint32_t codes; /**< Error_Decode * 65536 + Error_Code_1 * 256 + Error_Code_2 (tables 28, 29); of an abort subnet,
                       instance and reason, detail likewise */
  uint32_t data_size;
  const uint8_t* data;
  const char* text; /**< never NULL */
} dpsim_event;

typedef void (*dpsim_event_fn)(void* user, const dpsim_event* event);
/** `fn` NULL: nobody listens. Commands to masters may be given in the callback. */
DPSIM_API dpsim_status dpsim_bus_on_event(dpsim_bus* bus, dpsim_event_fn fn, void* user);

#ifdef __cplusplus
}
#endif

/* NOLINTEND(modernize-use-using) */

#endif
