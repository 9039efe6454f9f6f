/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Masters of class 1 and class 2 on a bus. A master belongs to its bus and ends with it.
 *
 * All functions here except dpsim_bus_add_... are also allowed in callbacks. Commands take effect between two
 * requests, at the present tick at the earliest; dpsim_bus_on_event reports their outcome.
 */
#ifndef DPSIM_MASTER_H
#define DPSIM_MASTER_H

/* NOLINTBEGIN(modernize-use-using): C, also when included by C++ */
#include "dsdpv1/bus.h"
#include "dsdpv1/gsd.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- masters, both classes ---- */

typedef struct dpsim_master dpsim_master;

typedef int32_t dpsim_personality;
enum {
  /** SRD high for everything, SD3 whenever 8 bytes fit, min_TSDR 0, finds slaves by Slave_Diag. */
  DPSIM_PERSONALITY_HIGH_ALWAYS = 0,
  /** SRD low for Slave_Diag, Set_Prm and Chk_Cfg, Clear before Set_Prm, finds slaves by FDL status. */
  DPSIM_PERSONALITY_CLASSIC = 1
};

typedef struct dpsim_master_options {
  uint32_t size;
  int32_t master_class;          /**< 1 or 2; 0: 1 */
  const char* name;              /**< NULL: "master" and its station's number */
  dpsim_personality personality; /**< class 1 */
  uint8_t address;               /**< 0 to 125 */
  uint8_t highest_address;       /**< HSA, 0: 126 */
  uint8_t ring;                  /**< 1: shares the token with other masters; class 2 always does */
  uint8_t no_token;              /**< 1: a single master that does not pass the token to itself after each cycle */
  /* In bit times, 0: the value of EN 50170 for the rate. */
  int32_t slot_bits;             /**< T_SL */
  int32_t set_bits;              /**< T_SET */
  int32_t quiet_bits;            /**< T_QUI */
  int32_t target_rotation_bits;  /**< T_TR, of a ring; 0: 50 000 */
  int32_t max_retries;           /**< of an unanswered request; 0: 2/3/4 at 3/6/12 Mbit/s, else 1; -1: none */
  int32_t gap_factor;            /**< cycles from one FDL status to the next (G of a ring); 0: 10; -1: none */
  int32_t min_slave_interval_us; /**< minimum cycle time; 0: the greatest of the slaves'; -1: none */
  int32_t clock_ppm;             /**< error of its clock in millionths, positive: slow */
} dpsim_master_options;

/** Adds a master, silent until dpsim_master_start. `options` NULL: class 1, address 0, all defaults. */
DPSIM_API dpsim_status dpsim_bus_add_master(dpsim_bus* bus, const dpsim_master_options* options, dpsim_master** master);

/** The number of its station. */
DPSIM_API dpsim_status dpsim_master_station(const dpsim_master* master, uint16_t* station);

/** Class 1: listens for T_TO, claims the token (in a running ring it waits to be admitted) and brings all slaves up.
 * Class 2: joins the ring. */
DPSIM_API dpsim_status dpsim_master_start(dpsim_master* master);
/** Stops the master at once, even inside a telegram, as if it had died. */
DPSIM_API dpsim_status dpsim_master_stop(dpsim_master* master);
/** Sends all later telegrams at another rate; slaves keep their states. */
DPSIM_API dpsim_status dpsim_master_set_baud(dpsim_master* master, dpsim_baud baud);

typedef int32_t dpsim_ring_state;
enum {
  DPSIM_RING_OFF = 0,
  DPSIM_RING_LISTEN_TOKEN = 1,
  DPSIM_RING_CLAIM_TOKEN = 2,
  DPSIM_RING_ACTIVE_IDLE = 3,
  DPSIM_RING_USE_TOKEN = 4,
  DPSIM_RING_GAP_POLL = 5,
  DPSIM_RING_PASS_TOKEN = 6,
  DPSIM_RING_OUT = 7 /**< left the ring: another master has the same address */
};

typedef struct dpsim_ring_status {
  uint32_t size;
  dpsim_ring_state state;
  uint8_t stations[16]; /**< LAS, the list of active stations: bit a % 8 of byte a / 8 for address a */
  uint64_t rotations;   /**< number of measurements of T_RR, from one receipt of the token to the next */
  uint64_t rotation_min, rotation_max, rotation_mean; /**< ... in ticks, 0 without measurement */
  uint64_t token_retries;                             /**< tokens repeated because no station was heard */
  uint64_t stations_dropped;                          /**< taken out of the LAS because they did not take the token */
  uint64_t stations_found;                            /**< by the GAP poll */
  uint64_t claims;                                    /**< tokens claimed after T_TO */
  uint64_t tokens_given_up;                           /**< another master was heard while this one had the token */
} dpsim_ring_status;
/** DPSIM_ERR_STATE: a single master (without `ring`). */
DPSIM_API dpsim_status dpsim_master_get_ring(const dpsim_master* master, dpsim_ring_status* status);

/* ---- masters of a scenario (docs/scenarios.md) ---- */

typedef struct dpsim_scenario_options {
  uint32_t size;
  uint32_t setting_count;
  const char*
      path; /**< path of the scenario's file; with `text`, its name in messages and the base of relative paths */
  const char* text;            /**< the scenario itself; NULL: `path` is read */
  const char* const* settings; /**< "PATH=VALUE" as in `--set`: "baud=1.5M" */
} dpsim_scenario_options;

/** Adds all masters of a scenario with their slaves, connections and the scenario's baud rate: those of class 1
 * first, each class in the order of the file. They start automatically at their times, counted from tick 0 of the
 * bus, and execute the script's actions for masters; the end of each of the script's requests is reported with `id` 0.
 * `masters` has room for `capacity`; `count` receives the number of masters.
 *
 * The slaves are not added: they are on this bus or outside. The scenario's parts about them (slaves, chip, user_cpu;
 * script actions on user CPUs, a plug or the line; checks, expect, allow, end) are ignored; `left_out`, if not NULL,
 * lists these parts in one line that is valid as long as the bus. A `when` of a master's action may use what a master
 * knows: dp_state data_exch, data_exchanges, inputs of its slaves, connection_state, reply_of.
 *
 * DPSIM_ERR_INPUT, "file:line: ...": the scenario is wrong, it has no masters, or a `when` uses something else.
 * DPSIM_ERR_SPACE: `count` is the number needed. In both cases nothing is added to the bus. */
DPSIM_API dpsim_status dpsim_bus_add_scenario(dpsim_bus* bus, const dpsim_scenario_options* options,
                                              dpsim_master** masters, size_t capacity, size_t* count,
                                              const char** left_out);

/* ---- class 1 (DPSIM_ERR_STATE for a master of class 2) ---- */

/** Before the start or in operation. DPSIM_ERR_ARGUMENT: a value out of range, or an address already in use. */
DPSIM_API dpsim_status dpsim_master_add_slave(dpsim_master* master, const dpsim_slave* slave);
/** Clear (`clear` not 0): sends zeros, or empty outputs to fail-safe slaves; else Operate, the initial mode. */
DPSIM_API dpsim_status dpsim_master_set_clear(dpsim_master* master, int32_t clear);

/* For one slave: DPSIM_ERR_NOT_FOUND if the master has none with this address. */

/** Exactly output_length bytes (DPSIM_ERR_ARGUMENT); sent from the next exchange on. */
DPSIM_API dpsim_status dpsim_master_set_outputs(dpsim_master* master, uint8_t address, const uint8_t* data,
                                                size_t count);
/** Sends Set_Prm with Unlock and then ignores the slave until dpsim_master_activate, which brings it up from the
 * start. */
DPSIM_API dpsim_status dpsim_master_release(dpsim_master* master, uint8_t address);
DPSIM_API dpsim_status dpsim_master_activate(dpsim_master* master, uint8_t address);

typedef int32_t dpsim_slave_state;
enum {
  DPSIM_SLAVE_OFFLINE = 0,  /**< does not answer; tried at most once per cycle */
  DPSIM_SLAVE_DIAGNOSE = 1, /**< Slave_Diag before the parameters */
  DPSIM_SLAVE_CLEAR = 2,    /**< Global_Control Clear before the parameters (DPSIM_PERSONALITY_CLASSIC) */
  DPSIM_SLAVE_SET_PRM = 3,
  DPSIM_SLAVE_CHK_CFG = 4,
  DPSIM_SLAVE_AWAIT_READY = 5, /**< Slave_Diag until it is ready for data exchange */
  DPSIM_SLAVE_DATA_EXCHANGE = 6,
  DPSIM_SLAVE_RELEASING = 7, /**< Set_Prm with Unlock is to be sent */
  DPSIM_SLAVE_RELEASED = 8
};

typedef struct dpsim_slave_status {
  uint32_t size;
  dpsim_slave_state state;
  const char* reason;    /**< why the last bring-up failed or data exchange ended; else empty */
  const uint8_t* inputs; /**< of the last data exchange; valid until the bus runs again, as are the other pointers */
  const uint8_t* outputs;
  const uint8_t* diagnosis; /**< data of the last Slave_Diag answer */
  uint32_t input_count, output_count, diagnosis_count;
  uint32_t reserved;
  uint64_t data_exchanges, diagnoses, parameterisations;
  uint64_t retries;  /**< repetitions sent */
  uint64_t timeouts; /**< attempts without an answer */
  uint64_t errors;   /**< wrong answers */
  uint64_t refusals; /**< answers UE, RR, RS */
} dpsim_slave_status;
DPSIM_API dpsim_status dpsim_master_get_slave(const dpsim_master* master, uint8_t address, dpsim_slave_status* status);

typedef struct dpsim_master_status {
  uint32_t size;
  uint8_t running, clear;
  uint16_t reserved;
  uint64_t cycles;     /**< complete ones */
  uint64_t cycle_time; /**< duration of the last one in ticks, start to start; 0: none yet */
} dpsim_master_status;
DPSIM_API dpsim_status dpsim_master_get_status(const dpsim_master* master, dpsim_master_status* status);

/* Acyclic requests, executed in the order of the calls. Each gets an `id`, from 1, which its
 * DPSIM_EVENT_REQUEST_DONE or DPSIM_EVENT_ACYCLIC_DONE names; `id` may be NULL. Requests of a scenario have id 0. */

typedef int32_t dpsim_outcome;
enum {
  DPSIM_OUTCOME_SENT = 0,       /**< a telegram without answer has been sent */
  DPSIM_OUTCOME_ANSWERED = 1,   /**< by a valid telegram; it may be a refusal (UE, RR, RS) */
  DPSIM_OUTCOME_NO_ANSWER = 2,  /**< nothing within the slot time, not even to the repetitions */
  DPSIM_OUTCOME_BAD_ANSWER = 3, /**< the answer to the last attempt was wrong */
  DPSIM_OUTCOME_ABORTED = 4     /**< the master was stopped or lost the token before the end */
};

/* Services without data. */
typedef int32_t dpsim_service;
enum {
  DPSIM_SERVICE_FDL_STATUS = 0,
  DPSIM_SERVICE_READ_INPUTS = 56, /**< from here on the number is the SAP */
  DPSIM_SERVICE_READ_OUTPUTS = 57,
  DPSIM_SERVICE_GET_CFG = 59,
  DPSIM_SERVICE_SLAVE_DIAG = 60
};
DPSIM_API dpsim_status dpsim_master_ask(dpsim_master* master, dpsim_service service, uint8_t address, uint32_t* id);

/* Bits of Control_Command (table 23). */
enum {
  DPSIM_CONTROL_CLEAR_DATA = 0x02,
  DPSIM_CONTROL_UNFREEZE = 0x04,
  DPSIM_CONTROL_FREEZE = 0x08,
  DPSIM_CONTROL_UNSYNC = 0x10,
  DPSIM_CONTROL_SYNC = 0x20
};
/** To `address` (DPSIM_BROADCAST: all) and the groups whose bits are set in `group` (0: all). */
DPSIM_API dpsim_status dpsim_master_global_control(dpsim_master* master, uint8_t command, uint8_t group,
                                                   uint8_t address, uint32_t* id);
/** Set_Slave_Add; `lock`: forbids later changes. */
DPSIM_API dpsim_status dpsim_master_set_slave_address(dpsim_master* master, uint8_t address, uint8_t new_address,
                                                      uint16_t ident, int32_t lock, uint32_t* id);
/** Any request; `fc` has bit 6 and the function; the master adds FCB and FCV. `sa` is ignored: the master uses its own
 * address; for another one see dpsim_master_send_raw. DPSIM_ERR_ARGUMENT: it cannot be encoded. */
DPSIM_API dpsim_status dpsim_master_request(dpsim_master* master, const dpsim_telegram* telegram, uint32_t* id);

/** Faults to inject into raw bytes on the wire. Positions count bytes from 0; those after the end have no effect. */
typedef struct dpsim_wire_faults {
  uint32_t size;
  uint32_t which; /**< DPSIM_FAULT_... of the faults to inject */
  uint16_t wrong_parity_at;
  uint16_t missing_stop_at;
  uint16_t gap_before;     /**< idle for `gap_millibits` before this byte */
  uint16_t truncate_after; /**< only so many whole characters are sent ... */
  int32_t truncate_bits;   /**< ... and so many bits of the next one */
  int32_t gap_millibits;   /**< 1/1000 bit */
  uint16_t glitch_at;      /**< the line inverted within this character */
  uint16_t reserved;
  int32_t glitch_start_millibits, glitch_length_millibits;
} dpsim_wire_faults;
enum {
  DPSIM_FAULT_PARITY = 1,
  DPSIM_FAULT_STOP = 2,
  DPSIM_FAULT_GAP = 4,
  DPSIM_FAULT_TRUNCATE = 8,
  DPSIM_FAULT_GLITCH = 16
};
/** Sends any bytes once, without repetition; `faults` may be NULL. `wants_answer` not 0: waits for an answer
 * as after a request. */
DPSIM_API dpsim_status dpsim_master_send_raw(dpsim_master* master, const uint8_t* bytes, size_t count,
                                             const dpsim_wire_faults* faults, int32_t wants_answer, uint32_t* id);

/* ---- acyclic, both classes ---- */

typedef int32_t dpsim_acyclic_outcome;
enum {
  DPSIM_ACYCLIC_POSITIVE = 0,     /**< data: what was read or transported */
  DPSIM_ACYCLIC_NEGATIVE = 1,     /**< codes: the slave's */
  DPSIM_ACYCLIC_TIMEOUT = 2,      /**< acknowledged, but no answer within the response time */
  DPSIM_ACYCLIC_REFUSED = 3,      /**< by the data link layer: UE, RR, RS; codes: its function code */
  DPSIM_ACYCLIC_NO_ANSWER = 4,    /**< the station does not answer at all */
  DPSIM_ACYCLIC_WRONG_ANSWER = 5, /**< an answer that does not fit the request */
  DPSIM_ACYCLIC_LOST = 6          /**< data exchange was left, the connection ended, or the master was stopped */
};

#define DPSIM_MAX_ACYCLIC 240 /**< bytes of data of one request or answer */

/* Class 1 (MSAC_C1): `peer` is the address of one of the master's slaves, else DPSIM_ERR_NOT_FOUND. Class 2
 * (MSAC_C2): it is the number of a connection; a closed one gives DPSIM_ERR_STATE. Requests of one peer are executed
 * one after another. */

/** DS_Read of up to `count` bytes, 0 to 255: a slave refuses more than 240. */
DPSIM_API dpsim_status dpsim_master_read(dpsim_master* master, uint32_t peer, uint8_t slot, uint8_t index,
                                         uint8_t count, uint32_t* id);
/** DS_Write of at most 240 bytes (DPSIM_ERR_ARGUMENT). */
DPSIM_API dpsim_status dpsim_master_write(dpsim_master* master, uint32_t peer, uint8_t slot, uint8_t index,
                                          const uint8_t* data, size_t count, uint32_t* id);
/** DS_Transport, class 2 only (DPSIM_ERR_STATE). */
DPSIM_API dpsim_status dpsim_master_transport(dpsim_master* master, uint32_t peer, uint8_t slot, uint8_t index,
                                              const uint8_t* data, size_t count, uint32_t* id);

/* ---- class 2: connections (DPSIM_ERR_STATE for a master of class 1) ---- */

typedef struct dpsim_connection_options {
  uint32_t size;
  uint16_t send_timeout;     /**< Send_Timeout, unit 10 ms; 0: 100 */
  uint16_t response_timeout; /**< C2_Response_Timeout, unit 10 ms; 0: twice Send_Timeout */
  uint8_t features[2];       /**< Features_Supported; 0, 0: 01 00 (DS_Read and DS_Write) */
  uint8_t profile_features[2];
  uint16_t profile_ident;
  uint8_t slave;             /**< address, 0 to 126 */
  uint8_t add_addr_size;     /**< bytes used of add_addr; 0: the short form 00 00 */
  uint32_t poll_interval_us; /**< least time between two polls; 0: at every token */
  uint8_t add_addr[232];     /**< Add_Addr (V10), sent unchanged */
} dpsim_connection_options;

/** Adds a connection, numbered from 0, in the closed state. */
DPSIM_API dpsim_status dpsim_master_add_connection(dpsim_master* master, const dpsim_connection_options* options,
                                                   uint32_t* connection);
/** Initiate; does nothing unless the connection is closed. DPSIM_ERR_NOT_FOUND: no such connection, here and below. */
DPSIM_API dpsim_status dpsim_master_connect(dpsim_master* master, uint32_t connection);
/** Aborts the connection: instance user, `reason` 0 to 15; 0: an ordinary end. */
DPSIM_API dpsim_status dpsim_master_abort(dpsim_master* master, uint32_t connection, uint8_t reason);

typedef int32_t dpsim_connection_state;
enum {
  DPSIM_CONNECTION_CLOSED = 0,
  DPSIM_CONNECTION_INITIATING = 1,
  DPSIM_CONNECTION_CONNECTING = 2,
  DPSIM_CONNECTION_OPEN = 3,
  DPSIM_CONNECTION_BUSY = 4,
  DPSIM_CONNECTION_ABORTING = 5
};
typedef int32_t dpsim_connection_end;
enum {
  DPSIM_END_SLAVE_ABORT = 0,
  DPSIM_END_MASTER = 1,     /**< by this side: requested, a wrong answer, or a timeout */
  DPSIM_END_REFUSED = 2,    /**< Initiate refused */
  DPSIM_END_NO_CHANNEL = 3, /**< the slave does not know the channel any more */
  DPSIM_END_NO_ANSWER = 4,
  DPSIM_END_STOPPED = 5 /**< the master was stopped */
};

typedef struct dpsim_connection_status {
  uint32_t size;
  dpsim_connection_state state;
  int16_t sap;           /**< of the channel, 0 to 48; -1: unknown */
  uint16_t send_timeout; /**< granted, unit 10 ms */
  uint8_t max_length;    /**< Max_Len_Data_Unit */
  uint8_t reserved[3];
  uint32_t open_requests;
} dpsim_connection_status;
DPSIM_API dpsim_status dpsim_master_get_connection(const dpsim_master* master, uint32_t connection,
                                                   dpsim_connection_status* status);

#ifdef __cplusplus
}
#endif

/* NOLINTEND(modernize-use-using) */

#endif
