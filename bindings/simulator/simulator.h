/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What a simulator of Verilog or SystemVerilog calls, by DPI-C or by VPI: the model, the scoreboard, the checks and a
 * master on the C API, behind numbers and packed pins. One set of functions serves both interfaces, so that both do the
 * same. Their callers are the modules of bindings/systemverilog/.
 *
 * Handles are numbers from 1. A function that can fail returns less than 0 (dpsim_status), one that creates 0; then
 * dsdpv1_error() has the words. A simulator calls from one thread.
 *
 * Time of pins with a CLK is counted in halves of its cycles: half 2n is the rising edge n, 2n + 1 the falling edge
 * after it, each at tick 125 x half. A change between two edges lies `ps` picoseconds after the last one, rounded to
 * the nearest tick of 1/12 ns and never beyond the next edge. So model and RTL see the same edges whatever the clock
 * does, and at 48 MHz each change is at its own absolute tick, half a tick (42 ps) away at most.
 *
 * Packed pins are the kind's inputs or outputs by the number of dpsim_pin_get, from bit 0: the wires of each; then a
 * bit for each that can be released (whose level at reset is DPSIM_Z), 1 when it is; of outputs then a bit for each, 1
 * when its level is unknown. The wires of what is released or unknown are 0. The modules that pack them are written
 * from the same list (generate.py).
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

/** Words for the last call that failed, one line. */
DSDPV1_SIMULATOR_API const char* dsdpv1_error(void);
/** The oldest message of an object that was not taken yet: a difference, a violation, an event of a master. "": none.
 */
DSDPV1_SIMULATOR_API const char* dsdpv1_message(int32_t handle);
/** Ends an object. */
DSDPV1_SIMULATOR_API int32_t dsdpv1_close(int32_t handle);

/* ---- the model ---- */

/** `options`: the kind of chip and its parameters as scenarios have them, "kind=dsdpv1_rsu rts_lead=0 uart_gaps[0]=9";
 * "": a DSDPV1 with its defaults. */
DSDPV1_SIMULATOR_API int32_t dsdpv1_model_create(const char* options);
/** The inputs at this time. Returns the outputs; `next` is the half cycle in which one may change by itself; when that
 * is this one, less than 0: so many ps after its edge. With a `half` of -1 there is no CLK: `ps` is the absolute time,
 * and so is `next`. INT64_MAX: never. */
DSDPV1_SIMULATOR_API int64_t dsdpv1_model_step(int32_t handle, int64_t half, int64_t ps, int64_t inputs, int64_t* next);

/* ---- the scoreboard: a model beside somebody's RTL ---- */

/** That of the C API (dpsim_scoreboard_create); it compares from the fourth cycle with RESET low on. */
DSDPV1_SIMULATOR_API int32_t dsdpv1_scoreboard_create(const char* options, int64_t tolerance_ps);
/** The pins at this time. Returns 1 after the first difference (dsdpv1_message has the words), else 0. `next` as above.
 */
DSDPV1_SIMULATOR_API int32_t dsdpv1_scoreboard_step(int32_t handle, int64_t half, int64_t ps, int64_t inputs,
                                                    int64_t outputs, int64_t* next);
/** Changes of the model's outputs that the RTL made as well. */
DSDPV1_SIMULATOR_API int32_t dsdpv1_scoreboard_matched(int32_t handle);

/* ---- the checks (docs/checks.md) ---- */

/** `options`: the kind of chip, and limits in ticks, "kind=dsdpv1_rsu TIMING_TS=240", "TIMING_TW=off"; `baud`
 * (dpsim_baud) is that of the line, so that telegrams are heard; -1: rules that need telegrams are left out. */
DSDPV1_SIMULATOR_API int32_t dsdpv1_checker_create(const char* options, int32_t baud);
/** The pins at this time. Returns the number of violations so far; dsdpv1_message has the words of each. */
DSDPV1_SIMULATOR_API int32_t dsdpv1_checker_step(int32_t handle, int64_t half, int64_t ps, int64_t inputs,
                                                 int64_t outputs);
/** Once, at the end. Returns the number of violations. */
DSDPV1_SIMULATOR_API int32_t dsdpv1_checker_finish(int32_t handle);
/** How often rules were applied. */
DSDPV1_SIMULATOR_API int32_t dsdpv1_checker_applied(int32_t handle);

/* ---- a master on a line that the simulator has ---- */

/** `options`: members of dpsim_master_options ("master_class=2 address=3 ring=1"), `baud` (dpsim_baud), and `verbose`:
 * 1 makes messages of what happens. */
DSDPV1_SIMULATOR_API int32_t dsdpv1_master_create(const char* options);
/** All masters of a scenario's file, which start by themselves and carry out the script as far as it is theirs
 * (dpsim_bus_add_scenario); a first message says what is left out. `settings` replace keys of the file, separated by
 * ';': "baud=1.5M". Functions with the handle are for the first master. */
DSDPV1_SIMULATOR_API int32_t dsdpv1_master_load(const char* scenario, const char* settings, int32_t verbose);
/** The other stations at the absolute time `ps`: whether one of them drives the line, and its level. Returns the
 * master's own driver, TXD + 2 RTS; `wake` is the absolute time at which it does something by itself, -1: never. */
DSDPV1_SIMULATOR_API int32_t dsdpv1_master_step(int32_t handle, int64_t ps, int32_t enabled, int32_t level,
                                                int64_t* wake);

/** A slave by its GSD file; `modules` by name, separated by ';', "": those that the file presets. `options`: members of
 * dpsim_slave ("flags=8 wd_fact_1=10 wd_fact_2=10"). */
DSDPV1_SIMULATOR_API int32_t dsdpv1_master_add_gsd(int32_t handle, const char* path, const char* modules,
                                                   int32_t address, const char* options);
/** A slave by its numbers, `options` as above, with ident, input_length, output_length. */
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
/** Of the last data exchange; returns their number. */
DSDPV1_SIMULATOR_API int32_t dsdpv1_master_get_inputs(int32_t handle, int32_t address, uint32_t* data);
/** dpsim_slave_state. */
DSDPV1_SIMULATOR_API int32_t dsdpv1_master_slave_state(int32_t handle, int32_t address);
DSDPV1_SIMULATOR_API int32_t dsdpv1_master_exchanges(int32_t handle, int32_t address);

/* Requests: each returns its number. */
DSDPV1_SIMULATOR_API int32_t dsdpv1_master_ask(int32_t handle, int32_t service, int32_t address);
/** An SRD high; dsap, ssap -1: without. */
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
/** 1: done. `outcome` is dpsim_outcome, of read, write, transport dpsim_acyclic_outcome; `codes` of the first the FC of
 * the answer, of the others as dpsim_event has them; `data`, `count` of the answer, without addresses and SAPs. 0: not
 * yet. */
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
