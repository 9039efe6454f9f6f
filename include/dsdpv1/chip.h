/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Chips: kinds with their pins and parameters, one chip driven pin by pin, and the model compared with a device
 * under test (DUT).
 *
 *   dpsim_chip* chip;
 *   dpsim_chip_create(NULL, &chip);                                  // a DSDPV1, RESET is low
 *   dpsim_chip_watch(chip, DPSIM_PIN(DPSIM_DSDPV1_L_REQ), print, NULL);
 *   dpsim_chip_set(chip, 20 * 250, DPSIM_DSDPV1_RESET, 1);           // released at cycle 20
 *   dpsim_chip_advance(chip, 48000 * 250);                           // one millisecond
 *   dpsim_chip_destroy(chip);
 *
 * A change of an input at tick t is seen by the first rising edge of CLK strictly after t (P9); the host port, which is
 * asynchronous to CLK, sees it at t. Calls for one chip come in order of time.
 *
 * The same functions serve a chip that is on a bus (dpsim_bus_add_chip): its PBRXD is the line, and setting or
 * advancing it runs the whole bus up to that tick first.
 */
#ifndef DPSIM_CHIP_H
#define DPSIM_CHIP_H

/* NOLINTBEGIN(modernize-use-using): C, also when included by C++ */
#include "dsdpv1/types.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- kinds of chips, by number ---- */

/* A kind is named by its text ("dsdpv1"); NULL and "" mean the first one. These functions need no object and may be
 * called from any thread, also in callbacks. */

/** Number of kinds in the library, and their names, 0 .. count - 1; NULL beyond. */
DPSIM_API size_t dpsim_kind_count(void);
DPSIM_API const char* dpsim_kind_name(size_t index);

typedef struct dpsim_pin_info {
  uint32_t size;
  uint16_t number;         /**< number for dpsim_chip_set and dpsim_change */
  uint8_t width;           /**< number of wires, 1 to 15 */
  uint8_t input;           /**< 1: input of the chip, 0: output */
  const char* name;        /**< from the datasheet: "L_REQ" */
  const char* bus;         /**< the bus of which this pin is one direction: "D" for D_IN and D_OUT; else NULL */
  dpsim_level reset_level; /**< level before the first call */
} dpsim_pin_info;

/** Pins of a kind are numbered from 0, at most 64 of them. 0 for an unknown kind. */
DPSIM_API size_t dpsim_pin_count(const char* kind);
/** DPSIM_ERR_NOT_FOUND: no such kind or number. */
DPSIM_API dpsim_status dpsim_pin_get(const char* kind, size_t number, dpsim_pin_info* info);
/** The pin with this name. DPSIM_ERR_NOT_FOUND: no such kind or name. */
DPSIM_API dpsim_status dpsim_pin_find(const char* kind, const char* name, uint16_t* number);

/** The bit of a pin in a set of pins. */
#define DPSIM_PIN(number) ((uint64_t)1 << (number))
#define DPSIM_ALL_PINS UINT64_MAX

/* The pins of the DSDPV1 (table 1), by the numbers of dpsim_pin_get. */
enum {
  DPSIM_DSDPV1_RESET = 0, /**< low-active */
  DPSIM_DSDPV1_R_REQ = 1,
  DPSIM_DSDPV1_R_STA = 2,
  DPSIM_DSDPV1_CSR = 3, /**< low-active, as RD and WR */
  DPSIM_DSDPV1_RD = 4,
  DPSIM_DSDPV1_WR = 5,
  DPSIM_DSDPV1_A = 6,    /**< A[10:0] */
  DPSIM_DSDPV1_D_IN = 7, /**< D[7:0] as the user drives it, DPSIM_Z: released */
  DPSIM_DSDPV1_PBRXD = 8,
  DPSIM_DSDPV1_L_REQ = 9, /**< the first output */
  DPSIM_DSDPV1_L_STA = 10,
  DPSIM_DSDPV1_D_OUT = 11, /**< D[7:0] as the chip drives it, DPSIM_Z: released, DPSIM_X: unknown */
  DPSIM_DSDPV1_INTR0 = 12,
  DPSIM_DSDPV1_PBTXD = 13,
  DPSIM_DSDPV1_PBRTS = 14,
  DPSIM_DSDPV1_PBF = 15,
  DPSIM_DSDPV1_BR = 16,
  DPSIM_DSDPV1_READY = 17
};

/** A parameter of the chip that the rulings mark (p). The DSDPV1 has access_interval (H1), ready_cycles (D1),
 * rts_lead and rts_trail (P2), intr_low and intr_gap (P7), search_window_ms, search_window_bits and baud_control_ms
 * (S1), fcb_rule (S26: 0 letter, 1 content). The DSDPV1-RSU adds those of docs/chip_rsu.md; each number of a list is
 * one parameter: "uart_gaps[0]" to "uart_gaps[7]". Its straps are not parameters but the pins MODE, ADR, UBR and UIV,
 * although scenarios have keys for them (mode, address, uart_rate, interval). apc3, spc3 and vpc3 have those of
 * docs/spc3.md, xgate those of docs/xgate.md; a word is its place among the words of the key, a time is in ticks. */
typedef struct dpsim_parameter_info {
  uint32_t size;
  const char* name;        /**< the key in a scenario's `chip` */
  const char* unit;        /**< "cycles", "ms", "bit times", "ticks" */
  const char* description; /**< one sentence, with the ruling */
  int64_t minimum, maximum, default_value;
} dpsim_parameter_info;

/** 0 for an unknown kind. */
DPSIM_API size_t dpsim_parameter_count(const char* kind);
/** DPSIM_ERR_NOT_FOUND: no such kind or index. */
DPSIM_API dpsim_status dpsim_parameter_get(const char* kind, size_t index, dpsim_parameter_info* info);

/* ---- one chip ---- */

typedef struct dpsim_chip dpsim_chip;

typedef struct dpsim_parameter {
  const char* name;
  int64_t value;
} dpsim_parameter;

typedef int32_t dpsim_engine;
enum {
  DPSIM_ENGINE_SKIP = 0, /**< from event to event */
  DPSIM_ENGINE_STEP = 1  /**< evaluates each cycle of each block: slow, with the same pin changes */
};

typedef struct dpsim_chip_options {
  uint32_t size;
  dpsim_engine engine;
  const char* kind;                  /**< NULL: the first kind */
  const char* name;                  /**< on a bus, in messages and collisions; NULL: "chip" and its station's number */
  const dpsim_parameter* parameters; /**< only those that differ from the default; names as in dpsim_parameter_get */
  size_t parameter_count;
} dpsim_chip_options;

/** Creates a chip without a bus, at power-on and tick 0: inputs have the reset levels of dpsim_pin_get, so RESET is
 * low. `options` NULL: all defaults. DPSIM_ERR_NOT_FOUND: no such kind or parameter; DPSIM_ERR_ARGUMENT: a value out
 * of range. */
DPSIM_API dpsim_status dpsim_chip_create(const dpsim_chip_options* options, dpsim_chip** chip);
/** Does nothing for a chip on a bus, which the bus owns. */
DPSIM_API void dpsim_chip_destroy(dpsim_chip* chip);

/** Runs up to `tick`, then sets an input pin to a level: 0 or 1, the value of a pin with several wires, or DPSIM_Z
 * for a pin that can be released (D_IN). Setting the present level changes nothing. PBRXD of a chip on a bus cannot
 * be set (DPSIM_ERR_STATE). DPSIM_ERR_NOT_FOUND: no such pin; DPSIM_ERR_ARGUMENT: an output, or not a level of this
 * pin; DPSIM_ERR_TIME. */
DPSIM_API dpsim_status dpsim_chip_set(dpsim_chip* chip, uint64_t tick, uint16_t pin, dpsim_level level);
/** As dpsim_chip_set, for `count` changes in order; their stations are ignored. On an error the changes before it
 * are applied; `done`, if not NULL, receives their number. */
DPSIM_API dpsim_status dpsim_chip_set_many(dpsim_chip* chip, const dpsim_change* changes, size_t count, size_t* done);
/** Sends characters to PBRXD of a chip without a bus: `count` bytes with even parity, back to back, each bit `bit`
 * ticks long; the first start bit falls at `tick`. Returns at the end of the last stop bit, which `end`, if not
 * NULL, receives; other pins do not change meanwhile. DPSIM_ERR_ARGUMENT: `bit` beyond 1 to 12 000 000.
 * DPSIM_ERR_STATE: the chip is on a bus. DPSIM_ERR_TIME. */
DPSIM_API dpsim_status dpsim_chip_receive(dpsim_chip* chip, uint64_t tick, uint32_t bit, const uint8_t* bytes,
                                          size_t count, uint64_t* end);
/** Runs up to and including `tick`. On a bus the same as dpsim_bus_run. DPSIM_ERR_TIME. */
DPSIM_API dpsim_status dpsim_chip_advance(dpsim_chip* chip, uint64_t tick);
/** The tick of the next activity of the chip (on a bus: of any station) that needs no call: until then no output
 * changes unless an input does. Never before the present tick; DPSIM_NEVER: nothing is due. */
DPSIM_API dpsim_status dpsim_chip_next(dpsim_chip* chip, uint64_t* tick);
/** The present tick: that of the last set or advance. Also in callbacks. */
DPSIM_API dpsim_status dpsim_chip_now(const dpsim_chip* chip, uint64_t* tick);
/** The present level of a pin, input or output. Also in callbacks. */
DPSIM_API dpsim_status dpsim_chip_level(const dpsim_chip* chip, uint16_t pin, dpsim_level* level);
/** Runs up to `tick`, where the user samples D, and returns its level. Unlike dpsim_chip_level this counts as a
 * sample: earlier than Tw after RD and CSR fell, the level is DPSIM_X and a violation is reported (P5).
 * DPSIM_ERR_UNSUPPORTED: a kind without a parallel host bus. */
DPSIM_API dpsim_status dpsim_chip_sample(dpsim_chip* chip, uint64_t tick, dpsim_level* level);

/* ---- complete accesses of the host bus ---- */

/** When the pins change during an access, in ticks (table 15, P5, P11). The strobe is RD or WR. A negative setup is
 * a time after the strobe. */
typedef struct dpsim_access_timing {
  uint32_t size;
  uint32_t reserved;
  int64_t address_setup; /**< A before the strobe falls (Tc >= 0) */
  int64_t cs_lead;       /**< CSR falls before the strobe */
  int64_t rd_low;        /**< RD low, > 0 */
  int64_t rd_sample;     /**< D sampled after RD fell (Tw >= 375) */
  int64_t wr_low;        /**< WR low, > 0 (Ts >= 150) */
  int64_t data_setup;    /**< D before WR rises (Td >= 150) */
  int64_t data_hold;     /**< D after WR rises (Td >= 150) */
  int64_t address_hold;  /**< A after the strobe rises (writes: Td >= 150) */
  int64_t cs_trail;      /**< CSR rises after the strobe */
  int64_t recovery;      /**< from the last edge to the end of the access */
} dpsim_access_timing;

/** Fills `timing` with the times of a CPU at 72 MHz, which keep all limits. 0 is not a default in this struct: set
 * its size, call this, then change members. */
DPSIM_API dpsim_status dpsim_access_timing_default(dpsim_access_timing* timing);

/** Reads or writes one cell through the pins with all edges of the access, the first at `tick`. Returns at `end`,
 * where the next access may begin. The caller must own the DPRAM of a DSDPV1 (H2): set R_REQ and R_STA as pins.
 * SPC3 family: the asynchronous Intel bus, XCS, XRD, XWR, AB, DB; the access does not wait for XREADY (A42). `timing`
 * NULL: the default; of the SPC3 family with strobes of 2500 and rd_sample of 2333, for its usual XREADY. A value read
 * is DPSIM_X if the chip does not define it. DPSIM_ERR_UNSUPPORTED: a kind without a parallel host bus, a chip that is
 * strapped to another bus. DPSIM_ERR_ARGUMENT: `address` > 0x7FF; rd_low or wr_low < 1, another time beyond +-100 us.
 * DPSIM_ERR_TIME. */
DPSIM_API dpsim_status dpsim_chip_read(dpsim_chip* chip, uint64_t tick, uint16_t address,
                                       const dpsim_access_timing* timing, dpsim_level* value, uint64_t* end);
DPSIM_API dpsim_status dpsim_chip_write(dpsim_chip* chip, uint64_t tick, uint16_t address, uint8_t value,
                                        const dpsim_access_timing* timing, uint64_t* end);

/** Reads or writes one byte of the registers and memory of an SPC3, APC3 or VPC3+ at `tick`, to which the chip runs,
 * with all effects (A16: a read may be a command) and without the pins of its bus; an output moves at the next cycle.
 * `address`: 0 to 0x7FF, VPC3+ 0xFFF, higher ones wrap. DPSIM_ERR_UNSUPPORTED: a kind whose user has pins only.
 * DPSIM_ERR_TIME. */
DPSIM_API dpsim_status dpsim_chip_load(dpsim_chip* chip, uint64_t tick, uint16_t address, uint8_t* value);
DPSIM_API dpsim_status dpsim_chip_store(dpsim_chip* chip, uint64_t tick, uint16_t address, uint8_t value);

/* ---- serial ports of the user ---- */

/* Which kinds have one; all functions refuse others, and a chip that its strap or parameter connects otherwise, with
 * DPSIM_ERR_UNSUPPORTED:
 *
 *   kind         SPI                                         UART
 *   dsdpv1_rsu   strap MODE 1: XSS, SCK, MOSI, MISO          strap MODE 2: RXD, TXD, even parity (UA1)
 *   vpc3         strap SERIAL 1: the same pins (A59)         none
 *   xgate        parameter port 1: NSS, SCK, MOSI, MISO      parameter port 0: RXD, TXD, no parity (4.7.2)
 *   dsdpv1, dsdpv1_r, apc3, spc3: none */

typedef struct dpsim_spi_timing {
  uint32_t size;
  uint32_t bit;      /**< ticks of a bit, 2 to 12 000 000; 0: 1333 (9 MHz), of an XGate-DPS10 12 000 (1 MHz) */
  uint32_t byte_gap; /**< ticks of additional rest of SCK between two bytes, 0 to 12 000 000 */
  uint32_t reserved;
} dpsim_spi_timing;

/** Sends `count` bytes, 1 to 4096, MSB first in one frame of XSS (NSS), with all edges, while `in`, if not NULL,
 * receives as many from MISO; a released MISO is 1. The frame begins 500 ns after `tick`, with 200 ns from XSS to SCK
 * at both ends. SCK has the mode of the
 * chip's parameter spi_mode, without one 0. Returns at its `end`. `timing` NULL: the usual bit. DPSIM_ERR_ARGUMENT: a
 * member or `count` out of range. DPSIM_ERR_TIME. */
DPSIM_API dpsim_status dpsim_chip_spi(dpsim_chip* chip, uint64_t tick, const dpsim_spi_timing* timing,
                                      const uint8_t* out, uint8_t* in, size_t count, uint64_t* end);

/** Opens the user's UART at `rate`, 1200 to 3 000 000 bit/s: from now on it receives all that the chip sends, also
 * while other functions advance the chip. Again: another rate; received bytes are dropped. */
DPSIM_API dpsim_status dpsim_chip_uart_open(dpsim_chip* chip, uint32_t rate);
/** Sends characters to RXD, back to back; the first start bit falls at `tick`. Returns at the end of the last stop
 * bit. DPSIM_ERR_STATE: the UART is not open. DPSIM_ERR_TIME. */
DPSIM_API dpsim_status dpsim_chip_uart_send(dpsim_chip* chip, uint64_t tick, const uint8_t* bytes, size_t count,
                                            uint64_t* end);
/** Takes the oldest received bytes, their number into `count`: runs until there are `capacity` of them, at most up to
 * `until`. A byte has been received in the middle of its stop bit; one with a wrong parity or stop bit is dropped.
 * After dpsim_chip_restore bytes are received again once TXD has rested for a character. DPSIM_ERR_STATE: the UART is
 * not open. DPSIM_ERR_TIME. */
DPSIM_API dpsim_status dpsim_chip_uart_receive(dpsim_chip* chip, uint64_t until, uint8_t* bytes, size_t capacity,
                                               size_t* count);

/* ---- changes of pins ---- */

/** Reports changes of these pins, also inputs, from now on, in order of time: to `fn`, or, with `fn` NULL, by
 * keeping them for dpsim_chip_read_changes. The order within one tick is undefined. A second call replaces the
 * first, `pins` 0 stops it; changes already kept stay. Bits beyond the chip's pins are ignored (DPSIM_ALL_PINS).
 * Costs time: watch as few pins as possible. On a bus a chip whose PBRXD and PBTXD are not watched receives
 * telegrams as a whole. */
DPSIM_API dpsim_status dpsim_chip_watch(dpsim_chip* chip, uint64_t pins, dpsim_change_fn fn, void* user);
/** Takes the oldest kept changes: at most `capacity` of them into `changes`, their number into `count`. A number
 * below `capacity` means that none are left. Memory grows until changes are taken, so call this after each advance
 * (1 ms of a saturated bus with all pins has some 20 000 changes). Also in callbacks of other objects. */
DPSIM_API dpsim_status dpsim_chip_read_changes(dpsim_chip* chip, dpsim_change* changes, size_t capacity, size_t* count);

/* ---- events of the chip ---- */

typedef int32_t dpsim_severity;
enum {
  DPSIM_SEVERITY_INFO = 0,     /**< a state change or a service that was carried out */
  DPSIM_SEVERITY_REFUSAL = 1,  /**< the chip refused something that a master or the user asked for */
  DPSIM_SEVERITY_VIOLATION = 2 /**< the user's side broke a rule of the host port or the handshake */
};

/** An event, as a reason and numbers (docs/reasons.md). */
typedef struct dpsim_chip_event {
  uint64_t tick;
  uint16_t station; /**< as in dpsim_change */
  uint16_t reason;  /**< number in this version of the library; dpsim_reason_get gives its code, which never changes */
  uint16_t a, b, c; /**< values for {a}, {b}, {c} in the text */
  uint16_t reserved[3];
} dpsim_chip_event;

/** Called for each event; dpsim_chip_event_text gives its text, in the callback or later. */
typedef void (*dpsim_chip_event_fn)(void* user, const dpsim_chip_event* event);

/** `fn` NULL: no callback. */
DPSIM_API dpsim_status dpsim_chip_on_event(dpsim_chip* chip, dpsim_chip_event_fn fn, void* user);
/** Writes the event as one line of text without its tick, with a final 0. DPSIM_ERR_SPACE: cut at `capacity`, which
 * must be at least 1; 256 is always enough. Also in callbacks. */
DPSIM_API dpsim_status dpsim_chip_event_text(const char* kind, const dpsim_chip_event* event, char* text,
                                             size_t capacity);

typedef struct dpsim_reason_info {
  uint32_t size;
  dpsim_severity severity;
  const char* code; /**< stable: "PRM_IDENT" */
} dpsim_reason_info;

/** Number of reasons of a kind, numbered from 0; 0 for an unknown kind. Also in callbacks. */
DPSIM_API size_t dpsim_reason_count(const char* kind);
/** DPSIM_ERR_NOT_FOUND: no such kind or number. Also in callbacks. */
DPSIM_API dpsim_status dpsim_reason_get(const char* kind, size_t reason, dpsim_reason_info* info);

typedef int32_t dpsim_dp_state; /* table 5 */
enum { DPSIM_DP_OFFLINE = 0, DPSIM_DP_WAIT_PRM = 1, DPSIM_DP_WAIT_CFG = 2, DPSIM_DP_DATA_EXCH = 3 };

/** The coding of B012 (table 5): 0 = 12 Mbit/s, 1 = 6M, 2 = 3M, 3 = 1.5M, 4 = 500k, 5 = 187.5k, 6 = 93.75k, 7 = 45.45k,
 *  8 = 19.2k, 9 = 9.6k. */
typedef int32_t dpsim_baud;
#define DPSIM_BAUD_COUNT 10
#define DPSIM_BAUD_NONE ((dpsim_baud)-1) /**< the search is running */

typedef struct dpsim_chip_status {
  uint32_t size;
  dpsim_dp_state dp_state;
  dpsim_baud baud;
  uint8_t address;             /**< the station's present address, 0 before the initialisation */
  uint8_t master;              /**< the parameterising master, 255 = none */
  uint16_t reserved;           /**< 0 */
  uint64_t telegrams_received; /**< error-free telegrams of all stations */
  uint64_t telegrams_answered; /**< answers sent */
  uint64_t data_exchanges;     /**< executed, repetitions not counted */
  uint64_t outputs_missed;     /**< H5: blocks that newer ones replaced before the user fetched them */
  uint64_t accesses;           /**< of the chip to the memory shared with the user */
  uint64_t longest_wait;       /**< H1: the most ticks that a due access waited for the user */
  uint8_t c2_master[2];        /**< table 30: the masters that hold the C2 channels 0x30 and 0x2F, 0 = none */
  uint8_t c2_state[2];         /**< bit 0 in use, 1 connected, 2 a request is open */
} dpsim_chip_status;

/** States and counters; changes nothing. Also in callbacks. */
DPSIM_API dpsim_status dpsim_chip_get_status(const dpsim_chip* chip, dpsim_chip_status* status);

/** Reads one cell of the memory shared by chip and user, without pins, time or side effects: for debuggers and
 * checks. DPSIM_ERR_ARGUMENT: `address` beyond it (DSDPV1: 0x7FF). DPSIM_ERR_UNSUPPORTED: an XGate-DPS10, which has no
 * such memory. Also in callbacks. */
DPSIM_API dpsim_status dpsim_chip_peek(const dpsim_chip* chip, uint16_t address, uint8_t* value);
/** Writes one cell; the chip finds it (a flag, for example) at its next access. */
DPSIM_API dpsim_status dpsim_chip_poke(dpsim_chip* chip, uint16_t address, uint8_t value);

/* ---- save and restore ---- */

#define DPSIM_MAX_CHIP_STATE 32768

/** Saves the complete state of a chip without a bus as bytes for dpsim_chip_restore, in this process or another:
 * registers, memory, levels of its pins, activity in progress, the tick. Callbacks, watched pins and kept changes are
 * not saved. `bytes` has room for `capacity`, `size` receives their number; DPSIM_MAX_CHIP_STATE is always enough.
 *
 *    uint8_t state[DPSIM_MAX_CHIP_STATE];
 *    size_t size;
 *    dpsim_chip_save(chip, state, sizeof state, &size);
 *    ...
 *    dpsim_chip_restore(again, state, size);
 *
 * DPSIM_ERR_SPACE: `size` is what is needed. DPSIM_ERR_STATE: the chip is on a bus, whose line, masters and time are
 * not part of a chip. */
DPSIM_API dpsim_status dpsim_chip_save(const dpsim_chip* chip, uint8_t* bytes, size_t capacity, size_t* size);
/** Resumes the saved chip at its tick, which may be before the present one: pins, events and status are the same at
 * each tick as without the save. Kind and parameters must be the same, the engine need not. Callbacks and the set of
 * watched pins stay; the jump of pin levels is not reported, and kept changes are discarded. DPSIM_ERR_INPUT: not a
 * state, cut or damaged, or of another format version, kind or parameter; the chip is then unchanged.
 * DPSIM_ERR_STATE: the chip is on a bus. */
DPSIM_API dpsim_status dpsim_chip_restore(dpsim_chip* chip, const uint8_t* bytes, size_t size);

/* ---- scoreboard: the model compared with a DUT ---- */

/* The model receives the inputs of a DUT (RTL, a recording), whose outputs must equal the model's at every tick. The
 * levels at the end of a tick are compared. DPSIM_X of the model matches everything (P5); DPSIM_X and DPSIM_Z of the
 * DUT match only themselves. MISO of a DSDPV1-RSU in RTL is the pin's register: its pin is taken to follow
 * spi_miso_delay later, as in lockstep (docs/microarchitecture_rsu.md, 5.1). */
typedef struct dpsim_scoreboard dpsim_scoreboard;

typedef struct dpsim_scoreboard_options {
  uint32_t size;
  uint32_t reserved;
  int64_t tolerance; /**< ticks; a difference that lasts at most this long is ignored; 0: exact */
  int64_t warm_up;   /**< ticks with RESET low before comparison starts, during which RTL may have X; 0: from tick 0 */
} dpsim_scoreboard_options;

/** `model`: kind and parameters, those of the DUT. Both sides begin with the levels of dpsim_pin_get; feed a change
 * if the DUT starts with another level. `model`, `options` NULL: all defaults. DPSIM_ERR_NOT_FOUND: no such kind or
 * parameter; DPSIM_ERR_ARGUMENT: a value out of range. */
DPSIM_API dpsim_status dpsim_scoreboard_create(const dpsim_chip_options* model, const dpsim_scoreboard_options* options,
                                               dpsim_scoreboard** scoreboard);
DPSIM_API void dpsim_scoreboard_destroy(dpsim_scoreboard* scoreboard);

#define DPSIM_LAST_EVENTS 3

typedef struct dpsim_scoreboard_result {
  uint32_t size;
  uint16_t pin;           /**< the first that differs; of several at one tick the one with the lowest number */
  dpsim_level model, dut; /**< its levels */
  uint16_t input;         /**< the input that changed last, and its level */
  dpsim_level input_level;
  uint16_t event_count; /**< 0 to DPSIM_LAST_EVENTS */
  uint64_t tick;        /**< start of the difference; DPSIM_NEVER: none so far */
  uint64_t input_tick;  /**< of the input's change; DPSIM_NEVER: no input has changed */
  uint64_t matched;     /**< changes of the model's outputs that the DUT made as well, or that were to DPSIM_X */
  uint64_t
      next; /**< when the model acts or a difference is judged without a change of the DUT; DPSIM_NEVER: nothing due */
  dpsim_chip_event events[DPSIM_LAST_EVENTS]; /**< the model's, the latest first (dpsim_chip_event_text) */
} dpsim_scoreboard_result;

/** Feeds the DUT's changes of inputs and outputs, in order of time (their stations are ignored); the DUT makes no
 * others up to `until`. All ticks before `until` are then judged, and `result`, if not NULL, receives the state;
 * after the first difference comparison stops. On an error the changes before the wrong one are applied.
 * DPSIM_ERR_NOT_FOUND: no such pin; DPSIM_ERR_ARGUMENT: not a level of this pin, or DPSIM_X for an input;
 * DPSIM_ERR_TIME. */
DPSIM_API dpsim_status dpsim_scoreboard_compare(dpsim_scoreboard* scoreboard, const dpsim_change* changes, size_t count,
                                                uint64_t until, dpsim_scoreboard_result* result);

#ifdef __cplusplus
}
#endif

/* NOLINTEND(modernize-use-using) */

#endif
