/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The interface for simulators of Verilog and SystemVerilog, by DPI-C or VPI: the model, the scoreboard, the checks
 * and a master on the C API, with numbers as handles and packed pins. One set of functions serves both interfaces,
 * so that both behave the same. The modules of bindings/systemverilog/ call it.
 *
 * Handles are numbers from 1. A function that can fail returns a negative number (dpsim_status), one that creates an
 * object returns 0; dsdpv1_error() then has the text. A simulator calls from one thread.
 *
 * Time of pins with a CLK is counted in halves of its cycles: half 2n is the rising edge n, 2n + 1 the falling edge
 * after it, each at tick 125 x half. A change between two edges lies `ps` picoseconds after the last one, rounded to
 * the nearest tick of 1/12 ns and never beyond the next edge. So model and RTL see the same edges whatever the clock
 * does, and at 48 MHz each change is at its absolute tick, at most half a tick (42 ps) off.
 *
 * Packed pins are the kind's inputs or outputs by the number of dpsim_pin_get, from bit 0: the wires of each; then a
 * bit for each releasable pin (whose level at reset is DPSIM_Z), 1 while it is released; for outputs then a bit for
 * each, 1 while its level is unknown. The wires of a released or unknown pin are 0. generate.py derives the modules
 * that pack them from the same list.
 *
 * Bytes are a vector of 256 bytes, the first in bits 7:0: uint32_t[64].
 */
#ifndef DSDPV1_SIMULATOR_H
#define DSDPV1_SIMULATOR_H

#include <stdint.h> /* NOLINT(modernize-deprecated-headers): C includes this, too */

#if defined(__GNUC__)
#define DSDPV1_SIMULATOR_API __attribute__((visibility("default")))
#else
#define DSDPV1_SIMULATOR_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

#define DSDPV1_BYTES 256

/** Text of the last call that failed, one line. */
DSDPV1_SIMULATOR_API const char* dsdpv1_error(void);
/** The oldest message of an object that has not been taken: a difference, a violation, an event of a master. "":
 * none. */
DSDPV1_SIMULATOR_API const char* dsdpv1_message(int32_t handle);
/** Destroys an object. */
DSDPV1_SIMULATOR_API int32_t dsdpv1_close(int32_t handle);

/* ---- the model ---- */

/** `options`: the kind of chip and its parameters as in scenarios, "kind=dsdpv1_rsu rts_lead=0 uart_gaps[0]=9"; "":
 * a DSDPV1 with its defaults. */
DSDPV1_SIMULATOR_API int32_t dsdpv1_model_create(const char* options);
/** Sets the inputs at this time and returns the outputs. `next` is the half cycle in which one may change without a
 * change of an input; if that is this one, a negative number: so many ps after its edge. A `half` of -1 means no
 * CLK: `ps` and `next` are then absolute times. INT64_MAX: never. */
DSDPV1_SIMULATOR_API int64_t dsdpv1_model_step(int32_t handle, int64_t half, int64_t ps, int64_t inputs, int64_t* next);

/* ---- the scoreboard: the model compared with RTL ---- */

/** As dpsim_scoreboard_create; compares from the fourth cycle with RESET low on. */
DSDPV1_SIMULATOR_API int32_t dsdpv1_scoreboard_create(const char* options, int64_t tolerance_ps);
/** Feeds the pins at this time. Returns 1 after the first difference (dsdpv1_message has the text), else 0. `next`
 * as above. */
DSDPV1_SIMULATOR_API int32_t dsdpv1_scoreboard_step(int32_t handle, int64_t half, int64_t ps, int64_t inputs,
                                                    int64_t outputs, int64_t* next);
/** Changes of the model's outputs that the RTL made as well. */
DSDPV1_SIMULATOR_API int32_t dsdpv1_scoreboard_matched(int32_t handle);

/* ---- the checks (docs/checks.md) ---- */

/** `options`: the kind of chip, and limits in ticks, "kind=dsdpv1_rsu TIMING_TS=240", "TIMING_TW=off"; `baud`
 * (dpsim_baud) is the rate of the line, so that telegrams are received; -1: skips rules that need telegrams. */
DSDPV1_SIMULATOR_API int32_t dsdpv1_checker_create(const char* options, int32_t baud);
/** Feeds the pins at this time. Returns the number of violations so far; dsdpv1_message has the text of each. */
DSDPV1_SIMULATOR_API int32_t dsdpv1_checker_step(int32_t handle, int64_t half, int64_t ps, int64_t inputs,
                                                 int64_t outputs);
/** Call once, at the end. Returns the number of violations. */
DSDPV1_SIMULATOR_API int32_t dsdpv1_checker_finish(int32_t handle);
/** How often rules were applied. */
DSDPV1_SIMULATOR_API int32_t dsdpv1_checker_applied(int32_t handle);

/* ---- a master on the simulator's line ---- */

/** `options`: members of dpsim_master_options ("master_class=2 address=3 ring=1"), `baud` (dpsim_baud), and
 * `verbose`: 1 reports events as messages. */
DSDPV1_SIMULATOR_API int32_t dsdpv1_master_create(const char* options);
/** All masters of a scenario's file, which start automatically and execute the script's actions for masters
 * (dpsim_bus_add_scenario); a first message lists the ignored parts. `settings` replace keys of the file, separated
 * by ';': "baud=1.5M". Functions with the handle apply to the first master. */
DSDPV1_SIMULATOR_API int32_t dsdpv1_master_load(const char* scenario, const char* settings, int32_t verbose);
/** The other stations at the absolute time `ps`: whether one of them drives the line, and its level. Returns the
 * master's driver, TXD + 2 RTS; `wake` is the absolute time of its next activity that needs no call, -1: never. */
DSDPV1_SIMULATOR_API int32_t dsdpv1_master_step(int32_t handle, int64_t ps, int32_t enabled, int32_t level,
                                                int64_t* wake);

/** Adds a slave by its GSD file; `modules` by name, separated by ';', "": those that the file presets. `options`:
 * members of dpsim_slave ("flags=8 wd_fact_1=10 wd_fact_2=10"). */
DSDPV1_SIMULATOR_API int32_t dsdpv1_master_add_gsd(int32_t handle, const char* path, const char* modules,
                                                   int32_t address, const char* options);
/** Adds a slave by its numbers, `options` as above, with ident, input_length, output_length. */
DSDPV1_SIMULATOR_API int32_t dsdpv1_master_add_slave(int32_t handle, int32_t address, const char* options,
                                                     const uint32_t* prm, int32_t prm_size, const uint32_t* cfg,
                                                     int32_t cfg_size);
DSDPV1_SIMULATOR_API int32_t dsdpv1_master_start(int32_t handle);
DSDPV1_SIMULATOR_API int32_t dsdpv1_master_stop(int32_t handle);
DSDPV1_SIMULATOR_API int32_t dsdpv1_master_set_baud(int32_t handle, int32_t baud);
DSDPV1_SIMULATOR_API int32_t dsdpv1_master_set_clear(int32_t handle, int32_t clear);
DSDPV1_SIMULATOR_API int32_t dsdpv1_master_release(int32_t handle, int32_t address);
DSDPV1_SIMULATOR_API int32_t dsdpv1_master_activate(int32_t handle, int32_t address);
DSDPV1_SIMULATOR_API int32_t dsdpv1_master_set_outputs(int32_t handle, int32_t address, const uint32_t* data,
                                                       int32_t count);
/** Inputs of the last data exchange; returns their number. */
DSDPV1_SIMULATOR_API int32_t dsdpv1_master_get_inputs(int32_t handle, int32_t address, uint32_t* data);
/** dpsim_slave_state. */
DSDPV1_SIMULATOR_API int32_t dsdpv1_master_slave_state(int32_t handle, int32_t address);
DSDPV1_SIMULATOR_API int32_t dsdpv1_master_exchanges(int32_t handle, int32_t address);

/* Requests: each returns its number. */
DSDPV1_SIMULATOR_API int32_t dsdpv1_master_ask(int32_t handle, int32_t service, int32_t address);
/** An SRD high; dsap, ssap -1: none. */
DSDPV1_SIMULATOR_API int32_t dsdpv1_master_request(int32_t handle, int32_t address, int32_t dsap, int32_t ssap,
                                                   const uint32_t* data, int32_t count);
DSDPV1_SIMULATOR_API int32_t dsdpv1_master_global_control(int32_t handle, int32_t command, int32_t group,
                                                          int32_t address);
DSDPV1_SIMULATOR_API int32_t dsdpv1_master_set_slave_address(int32_t handle, int32_t address, int32_t new_address,
                                                             int32_t ident, int32_t lock);
/** `peer`: class 1 a slave's address, class 2 a connection. */
DSDPV1_SIMULATOR_API int32_t dsdpv1_master_read(int32_t handle, int32_t peer, int32_t slot, int32_t index,
                                                int32_t count);
DSDPV1_SIMULATOR_API int32_t dsdpv1_master_write(int32_t handle, int32_t peer, int32_t slot, int32_t index,
                                                 const uint32_t* data, int32_t count);
DSDPV1_SIMULATOR_API int32_t dsdpv1_master_transport(int32_t handle, int32_t peer, int32_t slot, int32_t index,
                                                     const uint32_t* data, int32_t count);
/** 1: done. `outcome` is dpsim_outcome, for read, write, transport dpsim_acyclic_outcome; `codes`: the FC of the
 * answer, for those three as in dpsim_event; `data`, `count` of the answer, without addresses and SAPs. 0: not yet. */
DSDPV1_SIMULATOR_API int32_t dsdpv1_master_done(int32_t handle, int32_t id, int32_t* outcome, int32_t* codes,
                                                uint32_t* data, int32_t* count);

/** Class 2: returns the connection's number. `send_timeout` unit 10 ms, 0: its default. */
DSDPV1_SIMULATOR_API int32_t dsdpv1_master_add_connection(int32_t handle, int32_t slave, int32_t send_timeout);
DSDPV1_SIMULATOR_API int32_t dsdpv1_master_connect(int32_t handle, int32_t connection);
DSDPV1_SIMULATOR_API int32_t dsdpv1_master_abort(int32_t handle, int32_t connection, int32_t reason);
/** dpsim_connection_state. */
DSDPV1_SIMULATOR_API int32_t dsdpv1_master_connection_state(int32_t handle, int32_t connection);

#ifdef __cplusplus
}
#endif

#endif
