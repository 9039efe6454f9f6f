/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 OR MIT */
#ifndef DSDPV1_H
#define DSDPV1_H
/*
 * Driver for the PROFIBUS-DP slave chip DSDPV1, user side of the DPRAM.
 *
 * C99, no allocation, no operating system, no floating point. The device maker supplies the port: `dsdpv1_port` for
 * the parallel one (two functions for a DPRAM byte, four for the handshake pins), `dsdpv1_spi` (dsdpv1_spi.h: one
 * function) or `dsdpv1_uart` (dsdpv1_uart.h: two). docs/programmers_guide.md describes the bring-up and a port for
 * an MCU.
 *
 *   dsdpv1_device chip;
 *   dsdpv1_open(&chip, &port, &judge);
 *   dsdpv1_wait_ready(&chip);                         B004 = 0xC5
 *   dsdpv1_initialise(&chip, &config);                chapter 8
 *   for (;;) {
 *     dsdpv1_service(&chip);                          after INTR0; or call it from the INTR0 handler
 *     dsdpv1_exchange(&chip, DSDPV1_INPUT_NEWEST, in, in_length, &out);
 *   }
 *
 * Every call that touches the DPRAM takes it (a "hold": R_REQ, R_STA; B014 over SPI), does its accesses and releases
 * it. The UART has no ownership: there a hold is a series of telegrams. CRCs of blocks are computed outside holds.
 * Calls block for bounded times only; the bounds are in `dsdpv1_tuning`.
 *
 * Contexts: one thread and one interrupt handler may use a device. A call from the handler that interrupts an open
 * hold returns DSDPV1_ERR_NESTED and touches nothing.
 */
/* NOLINTBEGIN(modernize-deprecated-headers, modernize-use-using): C, also when included by C++ */
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Sizes of the DPRAM areas in bytes (tables 2, 12; ruling D7). */
#define DSDPV1_MAX_IO 244u
#define DSDPV1_MAX_DIAG 238u
#define DSDPV1_MAX_PRM 237u
#define DSDPV1_MAX_CFG 200u
#define DSDPV1_MAX_ADDRESS 126u

/* Ruling H2: the chip may still start an access up to 2 cycles of 48 MHz after R_REQ rose, so the window is 3
 * cycles: 62.5 ns, rounded up. */
#define DSDPV1_SYNC_WINDOW_NS 63u

/* ----------------------------------------------------------------------------------------------------------- errors */

/*
 * X(name, value, text). Values are stable: 1x use, handshake and telegrams, 2x configuration refused by the driver, 3x
 * initialisation refused by the chip, 4x cyclic data, 5x diagnosis, 6x parameters and configuration from the master,
 * 7x DPV1 (dsdpv1_acyclic.h).
 */
#define DSDPV1_ERROR_TABLE(X)                                                                                      \
  X(DSDPV1_OK, 0, "success")                                                                                       \
  X(DSDPV1_ERR_ARGUMENT, 10, "an argument is null, or a mandatory function of the port is missing")                \
  X(DSDPV1_ERR_NESTED, 11, "the interrupted program holds the DPRAM; call again when it has released it")          \
  X(DSDPV1_ERR_DPRAM_BUSY, 12, "the chip did not release the DPRAM (L_REQ, L_STA) within the allowed polls")       \
  X(DSDPV1_ERR_CHIP_SILENT, 13, "the chip has not been at the DPRAM (B006) during the last holds")                 \
  X(DSDPV1_ERR_CHIP_NOT_READY, 14, "B004 did not become 0xC5 within the allowed polls")                            \
  X(DSDPV1_ERR_NOT_INITIALISED, 15, "no initialisation has succeeded since the device was opened")                 \
  X(DSDPV1_ERR_NO_REPLY, 16, "the chip does not answer telegrams, also when they are repeated")                    \
  X(DSDPV1_ERR_REPLY, 17, "the chip's replies are disturbed, also when telegrams are repeated")                    \
  X(DSDPV1_ERR_TELEGRAM, 18, "the chip finds the telegrams wrong, also when they are repeated")                    \
  X(DSDPV1_ERR_CONFIG_ADDRESS, 20, "station address above 126")                                                    \
  X(DSDPV1_ERR_CONFIG_INPUT, 21, "largest input length above 244")                                                 \
  X(DSDPV1_ERR_CONFIG_OUTPUT, 22, "largest output length above 244")                                               \
  X(DSDPV1_ERR_CONFIG_DIAG, 23, "diagnosis length above 238")                                                      \
  X(DSDPV1_ERR_CONFIG_PRM, 24, "largest user parameter length above 237")                                          \
  X(DSDPV1_ERR_CONFIG_CFG, 25, "largest configuration length is 0 or above 200")                                   \
  X(DSDPV1_ERR_CONFIG_CFG_LENGTH, 26, "configuration is empty, missing or longer than its largest length")         \
  X(DSDPV1_ERR_CONFIG_PRM_MODE, 27, "judging mode of the parameters is not 0, 1 or 2")                             \
  X(DSDPV1_ERR_CONFIG_CFG_MODE, 28, "judging mode of the configuration is not 0, 1 or 2")                          \
  X(DSDPV1_ERR_INIT_TIMEOUT, 30, "the chip did not take the initialisation (B010.2) within the allowed polls")     \
  X(DSDPV1_ERR_INIT_CRC, 31, "the chip refused the initialisation: wrong CRC (B00B.0)")                            \
  X(DSDPV1_ERR_INIT_LIMIT, 32, "the chip refused the initialisation: a value out of its limits (B013.0)")          \
  X(DSDPV1_ERR_INIT_REFUSED, 33, "the chip refused the initialisation and gave no reason")                         \
  X(DSDPV1_ERR_INPUT_LENGTH, 40, "more input bytes than the initialisation allowed")                               \
  X(DSDPV1_ERR_INPUT_CRC, 41, "the chip refused the previous inputs: wrong CRC (B00B.2)")                          \
  X(DSDPV1_ERR_OUTPUT_LENGTH, 42, "the output length in the DPRAM is above 244 or what the caller's buffer holds") \
  X(DSDPV1_ERR_OUTPUT_CRC, 43, "the outputs' CRC is wrong, also after reading again")                              \
  X(DSDPV1_ERR_DIAG_TYPE, 50, "diagnosis type is not 00, 01, 81, 02 or 82")                                        \
  X(DSDPV1_ERR_DIAG_LENGTH, 51, "diagnosis longer than the initialisation allowed")                                \
  X(DSDPV1_ERR_DIAG_TIMEOUT, 52, "the chip did not take the diagnosis (B010.1) within the allowed polls")          \
  X(DSDPV1_ERR_DIAG_CRC, 53, "the chip refused the diagnosis: wrong CRC (B00B.3)")                                 \
  X(DSDPV1_ERR_PRM_LENGTH, 60, "the parameter length in the DPRAM is above 237")                                   \
  X(DSDPV1_ERR_PRM_CRC, 61, "the parameters' CRC is wrong, also after reading again")                              \
  X(DSDPV1_ERR_CFG_LENGTH, 62, "the configuration length in the DPRAM is above 200")                               \
  X(DSDPV1_ERR_CFG_CRC, 63, "the configuration's CRC is wrong, also after reading again")                          \
  X(DSDPV1_ERR_NO_VERDICT_DUE, 64, "a verdict was sent that no open judgement in mode 2 waits for")                \
  X(DSDPV1_ERR_VERDICT_STALE, 65, "the master has sent a newer block; judge that one first (dsdpv1_service)")      \
  X(DSDPV1_ERR_TABLE, 70, "an object of the slot and index table contradicts itself or stands there twice")        \
  X(DSDPV1_ERR_IM0, 71, "I&M0: order or serial number is missing or longer than 20 and 16 characters")             \
  X(DSDPV1_ERR_C1_LENGTH, 72, "the length of the C1 request in the DPRAM is above 240")                            \
  X(DSDPV1_ERR_C1_CRC, 73, "the C1 request's CRC is wrong, also after reading again")                              \
  X(DSDPV1_ERR_C2_LENGTH, 74, "the length of the C2 request in the DPRAM is above 240")                            \
  X(DSDPV1_ERR_C2_CRC, 75, "the C2 request's CRC is wrong, also after reading again")                              \
  X(DSDPV1_ERR_ANSWER_LENGTH, 76, "an acyclic answer is longer than 240 bytes")                                    \
  X(DSDPV1_ERR_NO_REQUEST_OPEN, 77, "the acyclic request has been answered already")                               \
  X(DSDPV1_ERR_ANSWER_STALE, 78,                                                                                   \
    "the acyclic request is gone: a newer one or a new initialisation came; nothing was sent")

typedef enum dsdpv1_error {
#define DSDPV1_ERROR_ENUMERATOR(name, value, text) name = (value),
  DSDPV1_ERROR_TABLE(DSDPV1_ERROR_ENUMERATOR)
#undef DSDPV1_ERROR_ENUMERATOR
} dsdpv1_error;

/* The error in words, one line in English; "unknown error" for values not in the table. Never null. */
const char* dsdpv1_error_text(dsdpv1_error error);

/* ------------------------------------------------------------------------------------------------------------- port */

/*
 * The application's access to the chip over its parallel port. `ctx` is passed to every function. All are mandatory
 * except `pause`. Pins: true is high. Addresses 0x000..0x7FF.
 */
typedef struct dsdpv1_port {
  void* ctx;
  uint8_t (*read)(void* ctx, uint16_t address);
  void (*write)(void* ctx, uint16_t address, uint8_t value);
  void (*set_r_req)(void* ctx, bool level);
  void (*set_r_sta)(void* ctx, bool level);
  bool (*get_l_req)(void* ctx);
  bool (*get_l_sta)(void* ctx);
  /*
   * Waits at least `ns` nanoseconds. May be null if polling without a pause is acceptable and at least
   * DSDPV1_SYNC_WINDOW_NS pass anyway from set_r_req(true) to the third of four pin samples (an MCU below some 150
   * MHz).
   */
  void (*pause)(void* ctx, uint32_t ns);
} dsdpv1_port;

/* ---------------------------------------------------------------------------------------------------------- judging */

typedef enum dsdpv1_verdict {
  DSDPV1_ACCEPT,
  DSDPV1_REFUSE,
  DSDPV1_LATER /* no verdict now; the application calls dsdpv1_send_verdict afterwards */
} dsdpv1_verdict;

/* A configuration sent by the master (table 2: B500..; ruling D6). */
typedef struct dsdpv1_cfg_block {
  const uint8_t* bytes;
  uint8_t length;        /* 0..200 */
  uint8_t input_length;  /* bytes slave to master, computed by the chip: the length of every input block (D10) */
  uint8_t output_length; /* bytes master to slave, computed by the chip */
} dsdpv1_cfg_block;

/*
 * The application's judgement. Called from dsdpv1_service, outside holds, for every block in every judging mode (P7,
 * D15); the return value counts only in mode 2. A null function accepts. The blocks are the driver's copies, valid
 * until the next dsdpv1_service.
 */
typedef struct dsdpv1_judge {
  void* ctx;
  /* `bytes`: everything after the first 7 bytes of Set_Prm, starting with the DPV1 byte if the master sends one. */
  dsdpv1_verdict (*prm)(void* ctx, const uint8_t* bytes, uint8_t length);
  dsdpv1_verdict (*cfg)(void* ctx, const dsdpv1_cfg_block* cfg);
} dsdpv1_judge;

/* ----------------------------------------------------------------------------------------------------------- device */

/* Limits of waiting. dsdpv1_open sets the defaults given here; the application may change them afterwards. */
typedef struct dsdpv1_tuning {
  uint32_t acquire_polls;   /* 10000: samples of L_REQ and L_STA, or claims over SPI, for one hold; must span 45 us, the
                               chip's start-up (H6) */
  uint32_t ready_polls;     /* 1000: holds in which B004 is checked */
  uint32_t init_polls;      /* 1000: holds after an initialisation or diagnosis until the chip has taken it */
  uint32_t poll_pause_ns;   /* 10000: pause between two such holds, when the port has `pause` */
  uint8_t crc_retries;      /* 2: how often a block with a wrong CRC is read again */
  uint8_t silent_holds;     /* 8: holds without an access of the chip between them before it counts as silent (B006);
                               parallel port */
  uint8_t telegram_retries; /* 2: how often a telegram (SPI, UART) without a valid reply is repeated */
} dsdpv1_tuning;

/* Initialisation data for the chip (table 2 B020.., tables 12 to 14). */
typedef struct dsdpv1_config {
  uint8_t address;                              /* 0..126 */
  uint16_t ident;                               /* Ident_Number of the GSD */
  bool address_change, freeze, sync, fail_safe; /* table 12 */
  bool dpv1;                                    /* B005 = 0x1D */
  uint8_t max_input, max_output;                /* 0..244 bytes, slave to master and master to slave */
  uint8_t max_diag;                             /* 0..238 bytes after the six standard bytes */
  uint8_t max_prm;                              /* 0..237 bytes after the seven standard bytes */
  uint8_t max_cfg;                              /* 1..200 bytes */
  uint8_t prm_mode, cfg_mode;                   /* 0, 1: the chip judges; 2: the user (tables 13, 14) */
  const uint8_t* cfg;                           /* initial configuration, only read during dsdpv1_initialise */
  uint8_t cfg_length;                           /* 1..max_cfg bytes */
} dsdpv1_config;

/*
 * Flags taken from the DPRAM for an initialisation that the chip has not judged yet, or has refused: what they announce
 * still waits (D11). Only the chip sets B00E and B00F (P6), so theirs stay here until their blocks are fetched.
 */
typedef struct dsdpv1_aside {
  uint8_t chip_command[2]; /* B00E, B00F */
  uint8_t user_command_1;  /* B010 */
} dsdpv1_aside;

/* The port that the device was opened with. */
typedef union dsdpv1_any_port {
  dsdpv1_port parallel;
  struct dsdpv1_spi* spi;
  struct dsdpv1_uart* uart;
} dsdpv1_any_port;

/* State of one chip. The members are private to the driver, except `tuning`. */
typedef struct dsdpv1_device {
  const struct dsdpv1_link* link; /* what the port can do */
  dsdpv1_any_port port;
  dsdpv1_judge judge;
  dsdpv1_tuning tuning;
  bool block_crc;              /* the chip checks the CRCs of the user's blocks */
  dsdpv1_error fault;          /* of a telegram in the open hold, which then transfers nothing more */
  volatile bool held;          /* a hold is open or being asked for */
  volatile bool servicing;     /* dsdpv1_service is running: its block copies are in use */
  volatile bool intr0_pending; /* INTR0 fell, dsdpv1_service has not run since */
  bool initialised;
  uint8_t max_input, max_output, max_diag, prm_mode, cfg_mode; /* of the last successful initialisation */
  uint8_t user_status_2;                                       /* B00D as it is in the DPRAM */
  uint8_t last_count, absent_holds; /* B006 as left by the last hold; holds since the chip's last access */
  dsdpv1_aside aside;
  uint8_t generation;   /* counts successful initialisations, modulo 256 */
  uint8_t verdicts_due; /* DSDPV1_VERDICT_ bits of blocks that wait for a verdict */
  uint8_t unread;       /* the same bits, of blocks that could not be read because a hold failed */
  uint8_t prm_length, prm[DSDPV1_MAX_PRM];
  uint8_t cfg_length, cfg_input_length, cfg_output_length, cfg[DSDPV1_MAX_CFG];
} dsdpv1_device;

/*
 * Prepares `device` on the parallel port (SPI: dsdpv1_open_spi, UART: dsdpv1_open_uart); touches no pin. `port` and
 * `judge` are copied; `judge` may be null (accept everything). Errors: ARGUMENT.
 *
 * Over SPI and UART every call that touches the DPRAM can also return NO_REPLY, REPLY and TELEGRAM; its work is then
 * left unfinished, and the call may be repeated.
 */
dsdpv1_error dsdpv1_open(dsdpv1_device* device, const dsdpv1_port* port, const dsdpv1_judge* judge);

/*
 * Waits until the chip works: B004 = 0xC5, 85 us after the release of RESET (ruling D1). Call it after that release,
 * with R_REQ and R_STA low: a line that is high when the chip leaves its reset keeps it from starting (H6). Errors:
 * DPRAM_BUSY, CHIP_NOT_READY, NESTED.
 */
dsdpv1_error dsdpv1_wait_ready(dsdpv1_device* device);

/*
 * Initialises the chip (chapter 8): checks `config` against table 2, writes B005 and B020.., sets B010.2, waits for
 * the chip and clears B00A.0. In operation the chip goes through OFFLINE with the new values, and data waiting in
 * the DPRAM or for an answer are dropped. After an error the chip keeps its old values, waiting blocks and due
 * verdicts (D11). Errors: 20..28 before anything is written; 30..33; NESTED, DPRAM_BUSY, CHIP_NOT_READY (B004),
 * CHIP_SILENT.
 */
dsdpv1_error dsdpv1_initialise(dsdpv1_device* device, const dsdpv1_config* config);

/* ------------------------------------------------------------------------------------------------------ cyclic data */

typedef enum dsdpv1_input_policy {
  DSDPV1_INPUT_NEWEST,       /* inputs that the chip has not taken yet are overwritten */
  DSDPV1_INPUT_WHEN_CONSUMED /* such inputs stay; the new ones are not written (`inputs_written` = false) */
} dsdpv1_input_policy;

/* Result of an exchange. The caller sets `outputs` and `capacity`. */
typedef struct dsdpv1_exchange_result {
  uint8_t* outputs;    /* the caller's buffer; may be null if outputs are not wanted */
  uint8_t capacity;    /* its size in bytes */
  uint8_t length;      /* bytes received, valid when `outputs_new` */
  bool outputs_new;    /* the chip had new outputs (B00E.0) with a right CRC */
  bool inputs_written; /* the inputs are in the DPRAM and announced (B010.0) */
  bool intr0_missed;   /* B00E.1 or .2 is set: call dsdpv1_service, even if INTR0 was not seen */
} dsdpv1_exchange_result;

/*
 * Transfers inputs to the chip and outputs from it in one hold. The inputs must have the configured input length, or
 * the chip refuses them (D10); `inputs` null: only outputs. Outputs with a wrong CRC are read again in a separate
 * hold. If an error is returned, the other direction has still been served.
 * Errors: NOT_INITIALISED, INPUT_LENGTH (nothing done), INPUT_CRC, OUTPUT_LENGTH, OUTPUT_CRC; NESTED, DPRAM_BUSY,
 * CHIP_SILENT.
 */
dsdpv1_error dsdpv1_exchange(dsdpv1_device* device, dsdpv1_input_policy policy, const uint8_t* inputs,
                             uint8_t input_length, dsdpv1_exchange_result* result);

/*
 * Chooses the blocks that the chip's verdict on the inputs' CRC covers (B00B.2, INPUT_CRC above; B011.6, ruling
 * D16). `keep` false, as after RESET: only the last block taken. True: all blocks since dsdpv1_clear_input_error;
 * later right ones do not clear the error. Applies from the chip's next access on; an existing error stays. In one
 * hold. Errors: ARGUMENT; NESTED, DPRAM_BUSY, CHIP_SILENT.
 */
dsdpv1_error dsdpv1_keep_input_errors(dsdpv1_device* device, bool keep);

/*
 * Asks the chip to clear the error once (B011.7), which it does in its next access, before it checks new inputs.
 * Does nothing if errors are not kept. In one hold.
 * Errors: ARGUMENT; NESTED, DPRAM_BUSY, CHIP_SILENT.
 */
dsdpv1_error dsdpv1_clear_input_error(dsdpv1_device* device);

/* -------------------------------------------------------------------------------------------------------- diagnosis */

/* B227, ruling D9. */
typedef enum dsdpv1_diag_type {
  DSDPV1_DIAG_EXTENDED = 0x00,
  DSDPV1_DIAG_EXTERNAL_GONE = 0x01,
  DSDPV1_DIAG_EXTERNAL = 0x81,
  DSDPV1_DIAG_STATIC_GONE = 0x02,
  DSDPV1_DIAG_STATIC = 0x82
} dsdpv1_diag_type;

/*
 * Passes user diagnosis to the chip (B227.., B010.1) and waits until it has been taken. `data`: the bytes after the
 * six standard bytes of Slave_Diag, with the block headers of EN 50170. After a wrong CRC it is written again up to
 * `crc_retries` times.
 * Errors: NOT_INITIALISED, DIAG_TYPE, DIAG_LENGTH, DIAG_TIMEOUT, DIAG_CRC; NESTED, DPRAM_BUSY, CHIP_SILENT.
 */
dsdpv1_error dsdpv1_set_diagnosis(dsdpv1_device* device, dsdpv1_diag_type type, const uint8_t* data, uint8_t length);

/* ------------------------------------------------------------------------------ parameters and configuration, INTR0 */

/*
 * Records that INTR0 fell, for the INTR0 handler of firmware that calls dsdpv1_service from its main loop. Touches
 * no pin.
 */
void dsdpv1_on_intr0(dsdpv1_device* device);

/* True when INTR0 fell and dsdpv1_service has not run successfully since. */
bool dsdpv1_intr0_pending(const dsdpv1_device* device);

/*
 * Fetches new parameters and configuration (B00E.1, B00E.2), lets the application judge them and writes the verdicts
 * of mode 2 to the chip, both in one hold. May be called directly from the INTR0 handler; after NESTED the flag of
 * dsdpv1_on_intr0 stays set for the main loop. A block that the master replaces meanwhile is judged again, and its
 * stale verdict is not sent (H7).
 * Errors: NOT_INITIALISED, PRM_LENGTH, PRM_CRC, CFG_LENGTH, CFG_CRC (that block gets no verdict); NESTED,
 * DPRAM_BUSY, CHIP_SILENT.
 */
dsdpv1_error dsdpv1_service(dsdpv1_device* device);

#define DSDPV1_VERDICT_PRM 0x01u
#define DSDPV1_VERDICT_CFG 0x02u

/*
 * Sends verdicts that a judge function deferred with DSDPV1_LATER. `which` selects the blocks (DSDPV1_VERDICT_
 * bits), `wrong` those that are refused.
 * Errors: ARGUMENT, NO_VERDICT_DUE, VERDICT_STALE (nothing sent); NESTED, DPRAM_BUSY, CHIP_SILENT.
 */
dsdpv1_error dsdpv1_send_verdict(dsdpv1_device* device, uint8_t which, uint8_t wrong);

/* ----------------------------------------------------------------------------------------------------------- status */

/* B012.3..2. */
typedef enum dsdpv1_dp_state {
  DSDPV1_STATE_OFFLINE = 0,
  DSDPV1_STATE_WAIT_PRM = 1,
  DSDPV1_STATE_WAIT_CFG = 2,
  DSDPV1_STATE_DATA_EXCHANGE = 3
} dsdpv1_dp_state;

typedef struct dsdpv1_status {
  uint8_t version[4]; /* B000..B003: code, year - 2000, month, day */
  dsdpv1_dp_state state;
  uint32_t baud;          /* bit/s; 0 while the chip searches */
  uint16_t offline_count; /* B008/B009: how often data exchange was left */
  uint8_t crc_errors;     /* B00B as it is: 1 = the chip refused the last block of that kind (table 4) */
} dsdpv1_status;

/* Reads the chip's status bytes in one hold. Errors: ARGUMENT, NESTED, DPRAM_BUSY, CHIP_SILENT. */
dsdpv1_error dsdpv1_get_status(dsdpv1_device* device, dsdpv1_status* status);

/* -------------------------------------------------------------------------------------------------------------- CRC */

/* Start value and one step of the CRC-16 of 4.2 (polynomial 0xA001 reflected): 02 07 gives 0x1241. */
#define DSDPV1_CRC_START 0xFFFFu
uint16_t dsdpv1_crc_byte(uint16_t crc, uint8_t byte);
/* Continues `crc` over `length` bytes, low address first. */
uint16_t dsdpv1_crc(uint16_t crc, const uint8_t* bytes, size_t length);

#ifdef __cplusplus
}
#endif

/* NOLINTEND(modernize-deprecated-headers, modernize-use-using) */

#endif /* DSDPV1_H */
