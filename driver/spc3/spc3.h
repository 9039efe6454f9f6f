/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 OR MIT */
#ifndef SPC3_H
#define SPC3_H
/*
 * Driver for the PROFIBUS-DP slave chips of the SPC3 family (APC3, SPC3, VPC3+ in DPV0), user side. Rulings (A17, A24
 * ...) are those of docs/spc3.md, SPC3_REG_ constants those of registers/spc3_regs.h.
 *
 * C99, no allocation, no operating system, no floating point, no waiting. The device maker supplies two functions, for
 * a byte of the chip, and the judging of parameters and configuration.
 *
 *   spc3_device chip;
 *   spc3_open(&chip, &port, &application);
 *   for (;;) {
 *     while (spc3_initialise(&chip, &config) == SPC3_ERR_NOT_OFFLINE) {}
 *     spc3_set_inputs(&chip, in, in_length);                 DATA_EX waits for the first ones (A24)
 *     spc3_start(&chip);
 *     do {
 *       events = spc3_service(&chip);                        or in the handler of X/INT
 *       spc3_set_inputs(&chip, in, in_length);
 *       spc3_get_outputs(&chip, &outputs);
 *       spc3_serve_watchdog(&chip);
 *     } while ((events & SPC3_REG_EVENT_MAC_RESET) == 0u);
 *   }
 *
 * Contexts: spc3_service may run in an interrupt handler while one thread calls the others, except spc3_open,
 * spc3_initialise and spc3_start. The port's functions are called from both.
 */
/* NOLINTBEGIN(modernize-deprecated-headers, modernize-use-using): C, also when included by C++ */
#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Longest telegram of the chip, in bytes (A4), and the least ones of Set_Prm, Set_Slave_Address. */
#define SPC3_MAX_BLOCK 244u
#define SPC3_MAX_DIAG 238u /* after the six standard bytes */
#define SPC3_MIN_PRM 7u
#define SPC3_MIN_SSA 4u

/* ----------------------------------------------------------------------------------------------------------- errors */

/* X(name, value, text). Values are stable: 1x use and chip, 2x configuration refused, 4x cyclic data, 5x diagnosis. */
#define SPC3_ERROR_TABLE(X)                                                                                           \
  X(SPC3_OK, 0, "success")                                                                                            \
  X(SPC3_ERR_ARGUMENT, 10, "an argument or a function of the port is null")                                           \
  X(SPC3_ERR_NOT_OFFLINE, 11, "the chip finishes a request before it goes OFFLINE; call again")                       \
  X(SPC3_ERR_RAM, 12, "the chip's RAM does not hold what was written: no chip, wrong wiring, or not 2 KB as a VPC3+") \
  X(SPC3_ERR_CONFIG_ADDRESS, 20, "station address above 126")                                                         \
  X(SPC3_ERR_CONFIG_LENGTH, 21, "a largest length is out of its range")                                               \
  X(SPC3_ERR_CONFIG_CFG, 22, "the configuration is missing, empty or longer than its largest length")                 \
  X(SPC3_ERR_CONFIG_FIT, 23, "the buffers of these lengths do not fit into the RAM")                                  \
  X(SPC3_ERR_INPUT_LENGTH, 40, "other than the configured number of input bytes")                                     \
  X(SPC3_ERR_OUTPUT_LENGTH, 41, "the caller's buffer is smaller than the outputs; they stay in the chip")             \
  X(SPC3_ERR_DIAG_LENGTH, 50, "diagnosis longer than the initialisation allowed")                                     \
  X(SPC3_ERR_DIAG_BUSY, 51, "the chip still has both diagnosis buffers; call again after diag_changed")

typedef enum spc3_error {
#define SPC3_ERROR_ENUMERATOR(name, value, text) name = (value),
  SPC3_ERROR_TABLE(SPC3_ERROR_ENUMERATOR)
#undef SPC3_ERROR_ENUMERATOR
} spc3_error;

/* The error in words, one line in English; "unknown error" for values not in the table. Never null. */
const char* spc3_error_text(spc3_error error);

/* ----------------------------------------------------------------------------------------------- port, application */

/*
 * Access to a byte of the chip, addresses 0x000..0x7FF; `ctx` is passed to all. A read can be a command (A16): once.
 * SPI: instructions 13H and 12H. `read_array` and `write_array`, of 1 to 244 bytes from `address` on, may be null; they
 * are for SPI (03H, 02H), and never called for addresses below 0x16.
 */
typedef struct spc3_port {
  void* ctx;
  uint8_t (*read)(void* ctx, uint16_t address);
  void (*write)(void* ctx, uint16_t address, uint8_t value);
  void (*read_array)(void* ctx, uint16_t address, uint8_t* bytes, uint8_t length);
  void (*write_array)(void* ctx, uint16_t address, const uint8_t* bytes, uint8_t length);
} spc3_port;

/* A Chk_Cfg. The lengths are the largest of the initialisation; a judge that accepts sets those of the configuration.
 */
typedef struct spc3_cfg {
  const uint8_t* bytes;
  uint8_t length;
  uint8_t output_length, input_length; /* master to slave, slave to master */
} spc3_cfg;

/*
 * The application, called from spc3_service. Blocks are copies, valid during the call. Return true to accept.
 * Null: parameters are accepted; a configuration if it is that of Get_Cfg; the others are ignored.
 */
typedef struct spc3_application {
  void* ctx;
  /* The whole Set_Prm; the first seven bytes are right, the user's begin at bytes[7]. One of seven bytes does not come.
   */
  bool (*prm)(void* ctx, const uint8_t* bytes, uint8_t length);
  /* In DATA_EX other lengths than those in force are refused, whatever this returns (A25). */
  bool (*cfg)(void* ctx, spc3_cfg* cfg);
  /* The chip has this address now: keep it, and `locked`, over power-off. `rest`: what the master sent after the four
   * bytes. */
  void (*address)(void* ctx, uint8_t address, bool locked, const uint8_t* rest, uint8_t length);
  /* A Global_Control that the chip has carried out, SPC3_REG_ORG_GC_COMMAND_ bits. */
  void (*control)(void* ctx, uint8_t command);
} spc3_application;

/* ----------------------------------------------------------------------------------------------------------- device */

/* Zero means off, or the default. */
typedef struct spc3_config {
  uint8_t address;               /* 0..126; 126: to be set by Set_Slave_Address */
  bool address_locked;           /* no Set_Slave_Address changes it */
  uint16_t ident;                /* Ident_Number of the GSD */
  uint8_t max_output, max_input; /* 0..244 bytes, master to slave and slave to master */
  uint8_t max_diag;              /* 0..238 bytes after the six standard bytes */
  uint8_t max_prm;               /* 7..244 bytes of a whole Set_Prm */
  uint8_t max_cfg;               /* 1..244 bytes of a Chk_Cfg */
  uint8_t max_ssa;               /* 0: no Set_Slave_Address; 4..244 bytes of a whole one */
  const uint8_t* cfg;            /* the configuration for Get_Cfg, only read during spc3_initialise */
  uint8_t cfg_length;            /* 1..max_cfg */
  bool change_cfg;               /* Get_Cfg shows the configuration accepted last (A26) */
  bool sync, freeze;             /* supported */
  bool clear_by_empty;           /* Spec_Clear: an empty data telegram clears the outputs (A46) */
  bool combined;                 /* DP and other protocols on one line: another min_TSDR (A33) */
  uint8_t min_tsdr;              /* bit times until Set_Prm brings another; 0: the chip's, 11 without `combined` */
  uint8_t baud_control;          /* val x val x 10 ms without a telegram end the baud rate (A31); 0: 30, 9 s */
  uint16_t user_wd;              /* data telegrams between two spc3_serve_watchdog; 0: 65536 (A34) */
  uint16_t interrupts;           /* SPC3_REG_EVENT_ bits that raise X/INT; 0: polled */
  bool int_active_high;          /* X/INT; else low */
  bool int_pause_1ms;            /* at least 1 ms between two interrupts, else 1 us */
  bool motorola;                 /* the bus is one of the Motorola kind */
  bool vpc3;                     /* 2 KB of RAM; else 1.5 KB */
} spc3_config;

/* State of one chip. The members are private to the driver. */
typedef struct spc3_device {
  spc3_port port;
  spc3_application application;
  uint8_t max_output, max_input, max_diag, min_tsdr; /* of the last initialisation */
  uint8_t prm_tsdr;                                  /* of the last Set_Prm that was accepted; 0: none */
  bool change_cfg, motorola;
  uint8_t block[SPC3_MAX_BLOCK]; /* the one that is judged */
} spc3_device;

/* Prepares `device`; touches no register. `port` is copied, `application` too, which may be null. Errors: ARGUMENT. */
spc3_error spc3_open(spc3_device* device, const spc3_port* port, const spc3_application* application);

/*
 * Takes the chip OFFLINE, tests and clears its RAM, and writes registers, organisation and buffers. Then the first
 * inputs and diagnosis may be given, and spc3_start. Interrupt and other calls are to be off. Errors: ARGUMENT,
 * NOT_OFFLINE, RAM; 20..23 before anything is written.
 */
spc3_error spc3_initialise(spc3_device* device, const spc3_config* config);

/* Leaves OFFLINE: the chip searches the baud rate. Serves the user watchdog once. */
void spc3_start(spc3_device* device);

/* ----------------------------------------------------------------------------------------------------------- events */

/*
 * Takes all events: judges, answers, calls the application, and ends the interrupt (EOI). Returns SPC3_REG_EVENT_ bits
 * of what came. After mac_reset the chip is OFFLINE: initialise it again. After new_cfg give inputs, or DATA_EX waits
 * (A24).
 */
uint16_t spc3_service(spc3_device* device);

/* ------------------------------------------------------------------------------------------------------ cyclic data */

/* Hands over inputs, of the configured length. The chip sends the newest. Errors: INPUT_LENGTH, ARGUMENT. */
spc3_error spc3_set_inputs(spc3_device* device, const uint8_t* bytes, uint8_t length);

/* The caller sets `bytes` and `capacity`. */
typedef struct spc3_outputs {
  uint8_t* bytes;
  uint8_t capacity;
  uint8_t length; /* bytes copied */
  bool fresh;     /* there were new outputs; else nothing was copied */
  bool cleared;   /* they are zeros by the chip: Clear, or the master has gone */
} spc3_outputs;

/* Fetches the newest outputs. Errors: OUTPUT_LENGTH, ARGUMENT. */
spc3_error spc3_get_outputs(spc3_device* device, spc3_outputs* outputs);

/* The application works: it is called at least once in `user_wd` data telegrams, or the chip leaves its master (A34).
 */
void spc3_serve_watchdog(spc3_device* device);

/* --------------------------------------------------------------------------------------------- diagnosis, control */

/* Byte 0 of a diagnosis (table 5.7). */
#define SPC3_DIAG_EXT 0x01u      /* Ext_Diag: the device has an error */
#define SPC3_DIAG_STAT 0x02u     /* Stat_Diag: its data are not valid */
#define SPC3_DIAG_OVERFLOW 0x04u /* there is more than fits */

/*
 * Hands over a diagnosis: `flags` of SPC3_DIAG_, and the bytes after the six standard ones. The master sees it, and the
 * buffer comes back with the event diag_changed. Errors: DIAG_LENGTH, DIAG_BUSY, ARGUMENT.
 */
spc3_error spc3_set_diagnosis(spc3_device* device, uint8_t flags, const uint8_t* bytes, uint8_t length);

/* The status register as it is: SPC3_REG_STATUS_ bits. */
uint16_t spc3_status(const spc3_device* device);

/* Ends data exchange: the master has to begin again with Set_Prm. */
void spc3_leave_master(spc3_device* device);

/* OFFLINE after the request in progress; then the event mac_reset. */
void spc3_go_offline(spc3_device* device);

#ifdef __cplusplus
}
#endif

/* NOLINTEND(modernize-deprecated-headers, modernize-use-using) */

#endif /* SPC3_H */
